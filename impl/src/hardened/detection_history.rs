//! What the CAV saw itself: which received tracks are backed and confirmed by its own earlier
//! detections (`spec/hardened/what-the-cav-saw.md`).
//!
//! Plain doubles: places are differences of given coordinates and of v t, so that a distance of up
//! to a few km errs by less than 1e-10 m, and `CLOSE` is more. What is closer than that is not
//! told apart: stage i fails (`ambiguous`), as that of the strict model does within delta, which
//! is at least 1e-8.

pub(crate) mod explained;
pub(crate) mod lists;
mod own;
pub(crate) mod squares;

use crate::hardened::detection_history::own::{Search, too_close};
use crate::hardened::detection_history::squares::CLOSE;
use crate::hardened::h01_matched_pairs::pair_limits;
use crate::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList};
use crate::input::detection_index::DetectionIndex;
use crate::input::indexes::Indexes;
use crate::input::parameters::Parameters;
use crate::input::profile::HardenedRule;
use crate::input::scratch::{Row, Scratch};
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::Witness;
use crate::stages::i_track_validation::gate::Gate;
use crate::stages::i_track_validation::pairing::PairSum;
use crate::stages::i_track_validation::places::Places;

/// Of a usable list, ns.
const AGES_NS: [i64; 2] = [200_000_000, 1_000_000_000];
/// Of the reference list, about, ns.
const REFERENCE_AGE_NS: i64 = 500_000_000;
/// A list that is older than this counts as missing, ns.
const OLDEST_NS: i64 = 60_000_000_000;

/// A usable list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UsableList<'a> {
    pub(crate) items: &'a [Detection],
    pub(crate) index: Option<&'a DetectionIndex<'a>>,
    pub(crate) age_ns: i64,
    /// The same in s.
    pub(crate) age: f64,
}

impl UsableList<'_> {
    /// How far from the past of a track its origin may be (SEEN-06), m.
    pub(crate) fn reach(&self, cycle: &Cycle<'_>) -> f64 {
        cycle.parameters.theta_track_max + cycle.parameters.theta_velocity * self.age
    }

    /// By how much the age is not 500 ms, then the age (SEEN-02).
    fn order(&self) -> (u64, i64) {
        (self.age_ns.abs_diff(REFERENCE_AGE_NS), self.age_ns)
    }
}

/// The current detections and the usable lists of the history, by their place in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DetectionHistory<'c, 'a> {
    pub(crate) detections: Option<&'c DetectionList<'a>>,
    /// Of the current detections.
    pub(crate) index: Option<&'c DetectionIndex<'a>>,
    pub(crate) usable: [Option<UsableList<'c>>; 4],
    /// The places of the usable lists, that whose age is nearest to 500 ms first, the younger of two.
    by_reference_age: [Option<u8>; 4],
}

impl<'c, 'a> DetectionHistory<'c, 'a> {
    /// `detections`: the current ones. Where no rule looks back no list is usable.
    pub(crate) fn new(
        cycle: &'c Cycle<'a>,
        detections: Option<&'c DetectionList<'a>>,
        indexes: &Indexes<'c, 'a>,
    ) -> Self {
        let [least_ns, most_ns] = AGES_NS;
        let mut usable = [None; 4];
        if let Some(current) = detections.filter(|_| cycle.profile.looks_back()) {
            for (place, list) in usable.iter_mut().zip(cycle.detection_history) {
                let age_ns = elapsed_ns(list.stamp_ns, current.stamp_ns);
                // SEEN-01
                let is_usable = least_ns <= age_ns
                    && age_ns <= most_ns
                    && elapsed_ns(list.stamp_ns, cycle.now_ns) <= OLDEST_NS;
                *place = is_usable.then_some(UsableList {
                    items: list.items,
                    index: indexes.of(list.items),
                    age_ns,
                    age: seconds(age_ns),
                });
            }
        }
        let index = detections.and_then(|list| indexes.of(list.items));
        Self { detections, index, usable, by_reference_age: by_reference_age(&usable) }
    }

    /// The place of the reference list (SEEN-02).
    pub(crate) fn reference(&self) -> Option<usize> {
        self.by_reference_age().next()
    }

    /// The places of the usable lists, that whose age is nearest to 500 ms first, the younger of two.
    pub(crate) fn by_reference_age(&self) -> impl Iterator<Item = usize> {
        self.by_reference_age.into_iter().flatten().map(usize::from)
    }

    /// Finds for every received track whether it is backed, whether it is confirmed, and its
    /// detection then, as far as the two lists nearest to 500 ms do not tell with the others.
    /// Nothing is backed by fewer than two usable lists.
    pub(crate) fn look_back(
        &self,
        cycle: &Cycle<'_>,
        tracks: &TrackList<'_>,
        scratch: &mut Scratch<'_>,
    ) -> Seen {
        let count = tracks.items.len();
        scratch.rows.iter_mut().take(count).for_each(|row| row.seen = 0);
        let Some(detections) = self.detections else { return Seen::Open };
        if self.usable.iter().flatten().count() < 2 {
            return Seen::Open;
        }
        // SEEN-04
        let since_ns = elapsed_ns(tracks.stamp_ns, detections.stamp_ns);
        for (number, place) in self.by_reference_age().enumerate() {
            let Some(list) = self.usable.get(place).copied().flatten() else { continue };
            if number >= 2 && scratch.rows.iter().take(count).all(Row::has_own_origins) {
                break;
            }
            // SEEN-05
            let then_ns = since_ns.saturating_sub(list.age_ns);
            let list_of = (list.items, list.index);
            let search = Search::new(list_of, list.reach(cycle), then_ns, scratch.columns);
            if let Some(witness) =
                search.mark_own((own_origin(place), false), tracks.items, scratch)
            {
                return Seen::Unclear(witness);
            }
        }
        // SEEN-09
        let limit = cycle.parameters.theta_track_max;
        let list_of = (detections.items, self.index);
        let search = Search::new(list_of, limit, since_ns, scratch.columns);
        if let Some(witness) = search.mark_own((OWN_DETECTION, true), tracks.items, scratch) {
            return Seen::Unclear(witness);
        }
        let mut pairs = tracks.items.iter().zip(scratch.rows.iter_mut());
        let (parameters, items) = (&cycle.parameters, detections.items);
        let unclear = pairs.find_map(|(track, row)| judge(parameters, items, track, row));
        match unclear {
            Some(witness) => Seen::Unclear(witness),
            None if cycle.profile.has(HardenedRule::H01)
                && own_detections_pass(cycle, tracks, detections, scratch.rows) =>
            {
                Seen::Paired
            }
            None => Seen::Open,
        }
    }
}

/// The places of usable lists in the order of `UsableList::order`, then of place.
fn by_reference_age(usable: &[Option<UsableList<'_>>; 4]) -> [Option<u8>; 4] {
    if usable.iter().all(Option::is_none) {
        return [None; 4];
    }
    let mut sorted = [None; 4];
    for (place, list) in (0_u8..).zip(usable) {
        let Some(list) = list else { continue };
        let mut next = Some((list.order(), place));
        for other in &mut sorted {
            if other.is_none() || next < *other {
                next = core::mem::replace(other, next);
            }
        }
    }
    sorted.map(|entry| entry.map(|(_, place)| place))
}

/// What looking back says of stage i.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Seen {
    /// It fails: a comparison is too close to call.
    Unclear(Witness),
    /// It passes: each gated track has a detection of its own, or is left out.
    Paired,
    /// Nothing.
    Open,
}

/// The track with the index of the row is backed.
const BACKED: u16 = 1;
/// It is confirmed.
const CONFIRMED: u16 = 2;
/// Its detection is that of no other track.
const OWN_DETECTION: u16 = 4;
/// It has an own origin in the first list of the history; the next bits are of the others.
const OWN_ORIGIN: u16 = 8;
const OWN_ORIGINS: u16 = 15 * OWN_ORIGIN;

const fn own_origin(place: usize) -> u16 {
    match place {
        0 => OWN_ORIGIN,
        1 => 2 * OWN_ORIGIN,
        2 => 4 * OWN_ORIGIN,
        _ => 8 * OWN_ORIGIN,
    }
}

impl Row {
    /// Whether the track with the index of this row has an own origin in at least two lists.
    const fn has_own_origins(&self) -> bool {
        let origins = self.seen & OWN_ORIGINS;
        origins & origins.wrapping_sub(1) != 0
    }

    /// The lists in which it has one, a bit for each place of the history.
    pub(crate) fn origins(&self) -> usize {
        usize::from((self.seen & OWN_ORIGINS) >> OWN_ORIGIN.trailing_zeros())
    }

    /// Its detection, when that is the detection of no other track.
    const fn own_detection(&self) -> Option<u16> {
        if self.seen & OWN_DETECTION != 0 { Some(self.detection) } else { None }
    }

    /// Whether the track with the index of this row is backed.
    pub(crate) const fn is_backed(&self) -> bool {
        self.seen & BACKED != 0
    }

    /// The detection of the track with the index of this row, if it is confirmed.
    pub(crate) const fn confirmed_by(&self) -> Option<u16> {
        if self.seen & CONFIRMED != 0 { Some(self.detection) } else { None }
    }
}

/// Whether a track is backed and confirmed (SEEN-08, SEEN-10, SEEN-11); the witness when that
/// is too close to call.
fn judge(
    parameters: &Parameters,
    detections: &[Detection],
    track: &Track,
    row: &mut Row,
) -> Option<Witness> {
    let speed = libm::sqrt(track.vx * track.vx + track.vy * track.vy);
    let v_object = parameters.v_object;
    if (speed - v_object).abs() <= CLOSE {
        return Some(too_close(track, [speed, v_object]));
    }
    if speed > v_object || !row.has_own_origins() {
        return None;
    }
    row.seen |= BACKED;
    // SEEN-10, SEEN-11
    let detection = detections.get(usize::from(row.own_detection()?))?;
    if detection.length > 1.0 {
        let across = across(track, detection);
        let most = parameters.theta_velocity + speed * 0.1;
        if (across - most).abs() <= CLOSE {
            return Some(too_close(track, [across, most]));
        }
        if across > most {
            return None;
        }
    }
    row.seen |= CONFIRMED;
    None
}

/// The part of a velocity across the direction of a detection, m/s.
fn across(track: &Track, detection: &Detection) -> f64 {
    (track.vx * detection.sin - track.vy * detection.cos).abs()
}

/// Whether stage i certainly passes with the pairs of tracks and their own detections: as
/// `certainly_pass`, but the pairs are known. Without it stage i of W1 takes 30 % more instructions, of W2
/// 24 %.
fn own_detections_pass(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    detections: &DetectionList<'_>,
    rows: &[Row],
) -> bool {
    let places = Places::at(tracks, detections.stamp_ns);
    let mut gate = Gate::new([cycle.ego.x, cycle.ego.y], &places);
    detections.items.iter().for_each(|item| gate.include([item.x, item.y]));
    let mut sum = PairSum::new(pair_limits(cycle), &places);
    tracks.items.iter().zip(rows).all(|(track, row)| {
        let own = row.own_detection().and_then(|own| detections.items.get(usize::from(own)));
        match (gate.admits(places.of(track)), own) {
            (Some(false), _) => true,
            (is_gated, Some(own)) => sum.pair(is_gated, places.metres(track, own)),
            (_, None) => sum.leave_out(row.is_backed()),
        }
    }) && sum.passes()
}
