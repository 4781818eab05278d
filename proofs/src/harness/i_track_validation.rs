//! The assignment of stage i (`spec/3-stages.md#stage-i-track-validation`) against all there are.

use mufasa::cycle::check;
use mufasa::input::cycle::{Cycle, Detection, DetectionList, Route, Track, TrackList};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch};
use mufasa::report::Outcome;
use mufasa::services::configuration::Configuration;

use super::any::{below, index};
use super::bounds::{COLUMNS, DETECTIONS, ITEMS, PLACES, TRACKS};
use super::scene::{CROSS_SECTIONS, EGO, NOW_NS, alone};
#[cfg(not(kani))]
use crate::kani;

/// `theta_tr`, m. With places a metre apart every comparison is one of integers.
const THETA_TR: u8 = 1;
/// `theta_track_max`, m: pairs have to be closer.
const CLOSER_THAN: u8 = 2;

/// Paper: stage i passes exactly when no assignment of min(gated tracks, detections) pairs costs
/// less than the cheapest, and that one has a mean below `theta_tr`.
///
/// Domain: up to 2 tracks and 3 detections on 4 places of a line. Not covered: larger lists,
/// distances that are no integers.
pub fn verify_mean_cost_is_minimal() {
    let (tracks, detections) = (places::<TRACKS>(), places::<COLUMNS>());
    let (tracks, detections) = (shown(&tracks), shown(&detections));
    let passed = passes(Profile::PAPER, 0, tracks, detections, &[]);
    let radius = detections.iter().copied().max().unwrap_or(0);
    let mut gated = [0; TRACKS];
    let gated = gate(tracks, radius, &mut gated);
    let pairs = gated.len().min(detections.len());
    let cheapest = cheapest(gated, detections, pairs, u8::MAX);
    let expected = pairs == 0 || cheapest.is_some_and(|sum| below_mean(sum, pairs));
    assert!(passed == expected);
    kani::cover!(passed && pairs == 2, "two pairs pass");
    kani::cover!(!passed && pairs == 2, "two pairs fail");
    kani::cover!(passed && pairs == 0, "nothing to compare");
    kani::cover!(gated.len() > detections.len() && pairs == 1, "more tracks than detections");
}

/// H-01: stage i passes exactly when nothing that the CAV saw is too close to call and for some
/// choice of at most `miss_budget` backed tracks that are left out nothing remains, or what remains
/// can be assigned one to one, every pair closer than `theta_track_max`, with a mean below
/// `theta_tr`.
///
/// Domain: up to 2 standing tracks, 2 detections and 2 items in each of two equal earlier lists on 4
/// places of a line, a budget of 0 or 1. Not covered: larger lists, tracks that move, distances that
/// are no integers.
pub fn verify_matched_cost_is_minimal() {
    let (tracks, detections) = (places::<TRACKS>(), places::<DETECTIONS>());
    let (tracks, detections) = (shown(&tracks), shown(&detections));
    let items = places::<ITEMS>();
    let items = shown(&items);
    let budget = below(2);
    let passed = passes(Profile::HARDENED, budget, tracks, detections, items);
    let radius = detections.iter().copied().max().unwrap_or(0);
    let backed = |at: usize| {
        let own = origin(tracks[at], items);
        let mut others = (0..tracks.len()).filter(|&other| other != at);
        own.is_some() && !others.any(|other| origin(tracks[other], items) == own)
    };
    // An origin is at most 2.15 m and 2.25 m away, a detection less than 2 m.
    let unclear = tracks.iter().any(|&track| {
        let apart = |place: &u8| track.abs_diff(*place);
        let equal = |list: &[u8], most: u8| {
            let least = list.iter().map(apart).min().filter(|&least| least <= most);
            least.is_some_and(|least| {
                list.iter().any(|&place| place + least == track)
                    && list.iter().any(|&place| place == track + least)
                    && least > 0
            })
        };
        let bound = detections.iter().map(apart).min() == Some(CLOSER_THAN);
        equal(items, 2) || equal(detections, CLOSER_THAN) || bound
    });
    let is_gated = |at: usize| at < tracks.len() && tracks[at] <= radius;
    let fits = |left: [bool; TRACKS]| {
        let may = |at: usize| !left[at] || is_gated(at) && backed(at);
        let count = usize::from(left[0]) + usize::from(left[1]);
        if count > usize::from(budget) || !may(0) || !may(1) {
            return false;
        }
        let mut rest = [0; TRACKS];
        let mut pairs = 0;
        for at in (0..TRACKS).filter(|&at| is_gated(at) && !left[at]) {
            rest[pairs] = tracks[at];
            pairs += 1;
        }
        let cheapest = cheapest(&rest[..pairs], detections, pairs, CLOSER_THAN);
        pairs == 0 || cheapest.is_some_and(|sum| below_mean(sum, pairs))
    };
    let whole = fits([false; TRACKS]);
    let partly = fits([true, false]) || fits([false, true]);
    assert!(passed == (!unclear && (whole || partly)));
    kani::cover!(passed && whole && is_gated(0) && is_gated(1), "two pairs pass");
    kani::cover!(passed && !whole, "one track is missed");
    kani::cover!(!passed && !unclear, "no assignment");
    kani::cover!(!passed && unclear && whole, "too close to call");
}

/// The first of the items that are nearest to a place, when it is at most 2 m away.
fn origin(place: u8, items: &[u8]) -> Option<usize> {
    let nearest = (0..items.len()).min_by_key(|&at| place.abs_diff(items[at]));
    nearest.filter(|&at| place.abs_diff(items[at]) <= 2)
}

fn below_mean(sum: u8, pairs: usize) -> bool {
    usize::from(sum) < pairs * usize::from(THETA_TR)
}

fn places<const N: usize>() -> ([u8; N], usize) {
    ([(); N].map(|()| below(PLACES)), index(N + 1))
}

fn shown<const N: usize>((places, count): &([u8; N], usize)) -> &[u8] {
    &places[..*count]
}

/// Tracks at most as far from place 0 as the farthest detection.
fn gate<'a>(tracks: &[u8], radius: u8, gated: &'a mut [u8; TRACKS]) -> &'a [u8] {
    let mut count = 0;
    for &track in tracks.iter().filter(|&&track| track <= radius) {
        gated[count] = track;
        count += 1;
    }
    &gated[..count]
}

/// The least sum of `pairs` distances of pairs closer than `limit`, over all ways to leave tracks
/// out and to give the others different detections; written out for at most two tracks.
fn cheapest(tracks: &[u8], detections: &[u8], pairs: usize, limit: u8) -> Option<u8> {
    let cost = |track: u8, detection: u8| {
        let apart = track.abs_diff(detection);
        (apart < limit).then_some(apart)
    };
    let mut least: Option<u8> = None;
    let mut offer = |sum: Option<u8>| {
        if let Some(sum) = sum {
            least = Some(least.map_or(sum, |least| least.min(sum)));
        }
    };
    for (i, &first) in tracks.iter().enumerate() {
        for (j, &one) in detections.iter().enumerate() {
            if pairs == 1 {
                offer(cost(first, one));
            }
            for &second in tracks.iter().skip(i + 1) {
                for (_, &other) in detections.iter().enumerate().filter(|&(k, _)| k != j) {
                    if pairs == 2 {
                        offer(cost(first, one).zip(cost(second, other)).map(|(a, b)| a + b));
                    }
                }
            }
        }
    }
    least
}

/// Whether stage i passes with tracks and detections on these places, and earlier detections on
/// those of the items.
fn passes(profile: Profile, budget: u8, tracks: &[u8], detections: &[u8], items: &[u8]) -> bool {
    let track = |at: usize| Track {
        id: at.try_into().unwrap_or(0),
        x: f64::from(tracks.get(at).copied().unwrap_or(0)),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        vx: 0.0,
        vy: 0.0,
        length: 1.0,
        width: 1.0,
    };
    let detection = |list: &[u8], at: usize| Detection {
        x: f64::from(list.get(at).copied().unwrap_or(0)),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        length: 1.0,
        width: 1.0,
    };
    let track_items: [Track; TRACKS] = core::array::from_fn(track);
    let detection_items: [Detection; COLUMNS] =
        core::array::from_fn(|at| detection(detections, at));
    let earlier: [Detection; ITEMS] = core::array::from_fn(|at| detection(items, at));
    let history = [300_000_000, 500_000_000]
        .map(|age_ns| DetectionList { stamp_ns: NOW_NS - age_ns, items: &earlier[..items.len()] });
    let parameters = Parameters {
        theta_tr: f64::from(THETA_TR),
        theta_track_max: f64::from(CLOSER_THAN),
        theta_velocity: 0.5,
        miss_budget: i64::from(budget),
        ..Parameters::default()
    };
    let list = |items| DetectionList { stamp_ns: NOW_NS, items };
    let cycle = Cycle {
        configuration: Configuration::MotRemote,
        tracks: Some(TrackList { stamp_ns: NOW_NS, items: &track_items[..tracks.len()] }),
        detections: Some(list(&detection_items[..detections.len()])),
        route: Route { closed: false, cross_sections: &CROSS_SECTIONS },
        detection_history: &history,
        ..alone(profile, parameters, EGO, NOW_NS)
    };
    let (mut rows, mut columns) = ([Row::default(); 2], [Column::default(); 5]);
    let report = check(&cycle, &mut Scratch::new(&mut rows, &mut columns));
    let Ok(report) = report else { unreachable!("the input is valid") };
    match report.stages[0] {
        Outcome::Passed => true,
        Outcome::Failed(_) => false,
        Outcome::Skipped(_) | Outcome::NotApplicable(_) | Outcome::NotScheduled => {
            unreachable!("stage i runs")
        }
    }
}
