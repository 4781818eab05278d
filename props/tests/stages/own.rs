//! Which item is a track's own where items are much closer together than a track errs
//! (`spec/hardened/what-the-cav-saw.md#tracks`): none is taken for another one, and what is far enough apart to be told
//! apart (MARGIN-11) is.

use crate::agreed::failed_clearly;
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track, TrackList};
use mufasa_model::report::Rule;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::track_validation::{detection, track};

/// A place, m.
type Place = (f64, f64);

const FRAME: Frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };

/// A cycle that only stage i decides, with lists of 300 and of 500 ms ago and the least margin.
fn cycle(tracks: &[Place], now: &[Place], of_300_ms: &[Place], of_500_ms: &[Place]) -> Cycle {
    let mut cycle =
        base::cycle(&mut Draw::new(&[]), FRAME, Profile::HARDENED, Configuration::MotRemote);
    cycle.trajectory = None;
    cycle.parameters.delta = 1e-8;
    let stamp_ns = cycle.now_ns;
    let items = tracks.iter().zip(1..).map(|(&place, id)| track(FRAME, place, id));
    cycle.tracks = Some(TrackList { stamp_ns, items: items.collect::<Vec<Track>>() });
    let list = |ms: i64, places: &[Place]| {
        let items = places.iter().map(|&place| detection(FRAME, place));
        DetectionList {
            stamp_ns: stamp_ns - ms * 1_000_000,
            items: items.collect::<Vec<Detection>>(),
        }
    };
    cycle.detections = Some(list(0, now));
    cycle.detection_history = vec![list(300, of_300_ms), list(500, of_500_ms)];
    cycle
}

/// SEEN-06, SEEN-09, MARGIN-11: two detections a tenth of a millimetre apart, now or in a list, are told apart.
#[test]
fn what_is_a_tenth_of_a_millimetre_apart_is_told_apart() {
    let (one, two) = ([(12.0, 5.0)], [(12.0, 5.0), (12.0001, 5.0)]);
    assert_eq!(failed_clearly(&cycle(&one, &two, &one, &one)), None);
    assert_eq!(failed_clearly(&cycle(&one, &one, &two, &one)), None);
}

/// SEEN-06, SEEN-07, H-01.3: at 300 ms two items are 0.3 um apart and the first track between them, nearer to the one that is
/// the origin of the second track as well, or to the other one. In the first case no track is backed, and the
/// first one has no detection. Of an implementation that looks into squares first, four times as wide as the limit of
/// the list, a border is between the items.
#[test]
fn the_nearest_item_may_be_just_beyond_a_border() {
    let base = cycle(&[], &[], &[], &[]).parameters;
    let limit = base.theta_track_max + 0.3 * base.theta_velocity;
    let border = 2.0 * (limit + 1e-6);
    for (before, behind, rule) in [(2e-7, 1e-7, Some(Rule::NoAssignment)), (1e-7, 2e-7, None)] {
        let first = border - 1e-8;
        let second = first + behind + 0.9 * limit;
        let tracks = [(first, 0.0), (second, 0.0)];
        let items = [(first - before, 0.0), (first + behind, 0.0)];
        assert_eq!(failed_clearly(&cycle(&tracks, &tracks[1..], &items, &tracks)), rule);
    }
}
