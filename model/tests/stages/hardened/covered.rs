//! H-06.7: where a detection covers cells, in the three readings, and which motion takes it there.

use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Track, TrackList};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::{self, AllRemote};

use crate::base::*;
use crate::near::*;

/// Between the stamps, ns: the car drives 1 m.
const APART: i64 = 62_500_000;
const LATER: [i64; 2] = [NOW - APART, NOW];
const OLDER: [i64; 2] = [NOW, NOW - APART];

/// The CAV stands after 10.75 m with its front at 12.75 m: it meets the occupied cell from 12 m to 13 m. A car ahead
/// drives at 16 m/s, and others stand beside the road. The rear of the car is at `rear` when it is detected, and covers
/// the cell up to 13.25 m. Its track is older, 1/2 m behind, and states 18 m/s.
fn behind_a_car(configuration: Configuration, [t_d, t_g]: [i64; 2], rear: f64) -> Cycle {
    let mut cycle = base(Profile::HARDENED, configuration);
    (cycle.ego.speed, cycle.parameters.tau, cycle.parameters.a_max) = (8.0, 0.5, 4.0);
    let centre = rear + 2.0;
    let seen = |stamp_ns: i64, x: f64| {
        let items = vec![detection(x, 0.0), detection(15.0, 9.0), detection(15.0, -9.0)];
        DetectionList { stamp_ns, items }
    };
    let car = Track { vx: 18.0, ..track(1, centre - 0.5, 0.0) };
    let items = vec![track(2, 15.0, 9.0), car, track(3, 15.0, -9.0)];
    cycle.tracks = Some(TrackList { stamp_ns: t_d - APART / 2, items });
    cycle.detections = Some(seen(t_d, centre));
    cycle.detection_history =
        vec![seen(t_d - 250_000_000, centre - 4.0), seen(t_d - 500_000_000, centre - 8.0)];
    let grid = cycle.grid.as_mut().expect("set");
    grid.stamp_ns = t_g;
    mark(&mut grid.occupied, 12.5, 0.5);
    cycle
}

/// Whether stage v, which runs, leaves the cell out.
fn covers(cycle: &Cycle) -> bool {
    let found = rule(cycle, Stage::V);
    assert!(passes(cycle, Stage::V) || found == Some(Rule::Occupied), "{:?}", report(cycle));
    found.is_none()
}

/// H-06.7: forwards to a grid that is later, back to one that is older; where it was detected it covers nothing.
#[test]
fn a_detection_covers_where_it_is_when_the_grid_is() {
    for configuration in REMOTE {
        let at = |stamps, rear| covers(&behind_a_car(configuration, stamps, rear));
        assert_eq!([at([NOW, NOW], 13.0), at([NOW, NOW], 14.0)], [true, false]);
        assert_eq!([at(LATER, 12.0), at(LATER, 13.0)], [true, false], "{configuration:?}");
        assert_eq!([at(OLDER, 14.0), at(OLDER, 13.0)], [true, true], "{configuration:?}");
        assert!(!at(OLDER, 15.0), "{configuration:?}");
    }
}

/// H-06.7, MARGIN-01: it covers the cell when its rear is at most 13.25 m - m from here, 1 m after it was detected.
#[test]
fn margins_move_where_a_detection_covers() {
    let at = |rear: f64| safe(&behind_a_car(AllRemote, LATER, rear));
    assert_eq!([at(12.25 - 2e-6), at(12.25 - 0.5e-6), at(12.25)], [YES, NEAR_SAFE, NEAR_SAFE]);
    assert_eq!(at(12.25f64.next_up()), NEAR_UNSAFE);
    assert_eq!([at(12.25 + 0.5e-6), at(12.25 + 2e-6)], [NEAR_UNSAFE, NO]);
}

/// What is changed, and how.
type Change = (&'static str, fn(&mut Cycle));

/// H-06.7: without a confirmed track of a current list, or where nothing examines the motion, it covers where it was
/// detected.
#[test]
fn a_motion_that_is_not_confirmed_or_not_examined_moves_nothing() {
    let changes: [Change; 5] = [
        ("no tracks", |cycle| cycle.tracks = None),
        ("one usable list", |cycle| cycle.detection_history.truncate(1)),
        ("tracks that are too old", |cycle| {
            let list = cycle.tracks.as_mut().expect("set");
            list.stamp_ns -= 250_000_000;
            list.items[1].x -= 4.0;
        }),
        ("no H-14", |cycle| cycle.profile = cycle.profile.without(HardenedRule::H14)),
        ("no stage iv", |cycle| cycle.profile = cycle.profile.without_stage(Stage::Iv)),
    ];
    for (name, change) in changes {
        let at = |stamps, rear| {
            let mut cycle = behind_a_car(AllRemote, stamps, rear);
            change(&mut cycle);
            covers(&cycle)
        };
        assert_eq!([at(LATER, 13.0), at(OLDER, 14.0)], [true, false], "{name}");
    }
}

/// What a list shows of the car.
#[derive(Clone, Copy, Debug)]
enum Past {
    /// The own origin of its track: the car has moved at so many m/s. Two items beside it are no origin: one before it in
    /// the list and nearer to the car, one behind it and farther.
    Own(f64),
    /// The same, but another track has that origin, too.
    Shared(f64),
    /// Nothing.
    Absent,
}
use Past::{Absent, Own, Shared};

/// The car as three lists of the given ages, in ms, show it. `Shared` goes with 500 ms.
fn as_seen(stamps: [i64; 2], rear: f64, lists: [(i32, Past); 3]) -> Cycle {
    let mut cycle = behind_a_car(AllRemote, stamps, rear);
    let centre = rear + 2.0;
    let list = |(age, past): (i32, Past)| {
        let at = |w: f64, y: f64| detection(centre - w * f64::from(age) / 1e3, y);
        let mut items = match past {
            Own(w) | Shared(w) => vec![at(15.0, 0.5), at(w, 0.0), at(21.0, 0.5)],
            Absent => vec![],
        };
        items.insert(0, detection(15.0, 9.0));
        DetectionList { stamp_ns: stamps[0] - i64::from(age) * 1_000_000, items }
    };
    cycle.detection_history = lists.map(list).to_vec();
    if lists.iter().any(|(_, past)| matches!(past, Shared(_))) {
        // 12 m beside the car when it is detected, and 500 ms before where the car was.
        let tracks = cycle.tracks.as_mut().expect("set");
        tracks.items.push(Track {
            vx: 18.0,
            vy: -24.0,
            ..track(4, centre - 0.5, 24.0 * 0.03125 - 12.0)
        });
    }
    cycle
}

/// H-06.7: neither the velocity of the track, 18 m/s, nor what another list or another item shows.
#[test]
fn the_motion_is_that_since_the_own_origin_in_the_list_of_the_track() {
    let cases = [
        ([(250, Own(16.0)), (500, Own(17.0)), (800, Own(19.0))], 17.0),
        ([(250, Own(16.0)), (500, Absent), (800, Own(19.0))], 16.0),
        ([(200, Own(16.0)), (500, Absent), (750, Own(19.0))], 19.0),
        ([(300, Own(16.0)), (500, Absent), (700, Own(19.0))], 16.0),
        ([(250, Own(16.0)), (500, Shared(17.0)), (800, Own(19.0))], 16.0),
    ];
    for (lists, w) in cases {
        for (stamps, t) in [(LATER, 0.0625), (OLDER, -0.0625)] {
            let least = 13.25 - w * t;
            let at = |more: f64| covers(&as_seen(stamps, least + more, lists));
            assert_eq!([at(-0.03), at(0.03)], [true, false], "{lists:?}, {stamps:?}");
        }
    }
}
