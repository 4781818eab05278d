//! `spec/hardened/H-14.md#requirements-failure`: where and when an object meets the CAV.

use mufasa_model::input::cycle::{Cycle, Profile, Track};
use mufasa_model::report::{Rule, Stage};
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::{alone, crossing, found, margins_move_meetings};
use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::HARDENED;

/// Where an object from below has to be at now to be at the CAV's side after it has gone `r` m: its front
/// is 1/4 m before its centre, the CAV's side at -1 m.
fn from_below(r: f64) -> f64 {
    -1.25 - r
}

/// Last of the windows in which the CAV passes: at 0.75 m, until it is at 1 m at the latest.
fn last_of_passing() -> f64 {
    (8.0 - (64f64 - 16.0).sqrt()) / 8.0
}

/// The lax reading has no place at s_stop: here its last one is 1.5e-6 m before, one margin and a half.
fn nearly_to_s_stop(cycle: &mut Cycle) {
    points(cycle)[11].x = 10.75 - 1.5e-6;
}

const SMALL: [f64; 2] = [0.5, 0.5];

const NEAR: &[Near] = &[
    ("half of a wider width + m", MotRemote, HARDENED, |c, e| {
        c.ego.y = 0.25;
        alone(c, track(1, 8.0, -2.25 + e));
    }),
    ("who passes before the CAV comes", MotRemote, HARDENED, |c, e| {
        // At 3 m the CAV reaches its place, from first(2.75 m) on; until then it has braked.
        let t = (86f64.sqrt() - 8.0) / 4.0;
        alone(c, crossing(5.1, 1.25 - (10.0 * t - 4.0 * t * t) - e, SMALL));
    }),
    ("who comes when the CAV has passed", MotRemote, HARDENED, |c, e| {
        alone(c, crossing(-1.4, from_below(10.0 * last_of_passing()) + e, SMALL));
    }),
    ("who comes when the CAV has passed, seen 0.1 s ago", MotRemote, HARDENED, |c, e| {
        alone(c, crossing(-1.4, from_below(10.0 * (last_of_passing() + 0.1)) + e, SMALL));
        c.tracks.as_mut().expect("set").stamp_ns -= 100_000_000;
    }),
    ("who passed when it was seen 0.1 s ago", MotRemote, HARDENED, |c, e| {
        // The place before is p: r_b(0.1) = 0.96, and its rear is 1/4 m behind its centre.
        alone(c, crossing(1.0, 1.25 - 0.96 - e, SMALL));
        c.tracks.as_mut().expect("set").stamp_ns -= 100_000_000;
    }),
    ("who comes where the CAV may stand", MotRemote, HARDENED, |c, e| {
        // At 4 m: tau + t_yield + abs(w) / (2 a_yield).
        let end = 0.5 + 2.0 + 10.0 / 6.0;
        alone(c, crossing(2.0, from_below(10.0 * end) + e, [0.5, 0.0625]));
    }),
    ("who comes where the CAV may stand, however late", MotRemote, HARDENED, |c, e| {
        c.parameters.t_yield = 30.0;
        let end = 0.5 + 30.0 + 10.0 / 6.0;
        alone(c, crossing(2.0, from_below(10.0 * end) + e, [0.5, 0.0625]));
    }),
    ("who comes where the CAV may stand, until T", MotRemote, HARDENED, |c, e| {
        // It could stop after 0.5 + 10/20 s.
        (c.parameters.t_yield, c.parameters.a_yield) = (0.0, 10.0);
        alone(c, crossing(2.0, from_below(10.0 * 1.75) + e, [0.5, 0.0625]));
    }),
    ("who comes across comes until T", MotRemote, HARDENED, |c, e| {
        // It overlaps what is 0.3 m inside of the CAV's side.
        alone(c, crossing(1.85, from_below(10.0 * 1.75) + e, [0.5, 0.4]));
    }),
    ("the rectangle of who comes across - m", MotRemote, HARDENED, |c, e| {
        // That of the CAV ends at 1.7 m; at 4 m it may stand, and the object comes after T.
        alone(c, crossing(1.9 + e, -30.0, [0.5, 0.4]));
    }),
    ("way >= s_b(v) - m", MotRemote, HARDENED, |c, e| {
        // The place after 3.775 m is at 4 m; met by one who comes after the window of 3.775 m.
        (points(c)[3].x, points(c)[4].x) = (3.1, 4.0 + e);
        alone(c, crossing(1.75, -30.0, [0.5, 0.0625]));
    }),
    ("who brakes ahead", MotRemote, HARDENED, |c, e| {
        // It stands 10^2 / 16 m farther on, where the CAV is at s_stop.
        nearly_to_s_stop(c);
        alone(c, Track { vx: 10.0, ..track(1, 4.0 + 10.75 - 6.25 - e, 0.0) });
    }),
    ("who stands ahead", MotRemote, HARDENED, |c, e| {
        nearly_to_s_stop(c);
        alone(c, track(1, 4.0 + 10.75 - e, 0.0));
    }),
    ("who goes on and comes against", MotRemote, HARDENED, |c, e| {
        // It comes across: until T.
        nearly_to_s_stop(c);
        alone(c, Track { vx: -10.0, ..track(1, 4.0 + 10.75 + 17.5 - e, 0.0) });
    }),
];

#[test]
fn margins_move_where_and_when_they_meet() {
    margins_move_meetings(NEAR);
}

/// Touching is a collision.
/// H-14.45.
#[test]
fn touching_is_meeting() {
    let standing = |x: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        alone(&mut cycle, track(1, x, 0.0));
        found(&cycle).is_some()
    };
    assert!(standing(14.75) && !standing(14.75f64.next_up()));
    let beside = |y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        alone(&mut cycle, track(1, 5.0, y));
        found(&cycle).is_some()
    };
    assert!(beside(2.0) && !beside(2.0f64.next_up()));
}

/// Who passes behind where the CAV may stand is not met however late it comes; before it may stand a window
/// ends.
/// H-14.12, H-14.13, H-14.25.
#[test]
fn a_place_that_is_left_for_good_is_examined_until_then() {
    let at = |x: f64, y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.parameters.t_yield = 30.0;
        alone(&mut cycle, crossing(x, y, [0.5, 0.03125]));
        found(&cycle).is_some()
    };
    // 3.5 m is left until 3.75 m is: after (8 - sqrt(64 - 60)) / 8 = 0.75 s.
    let left = from_below(10.0 * (8.0 - 4f64.sqrt()) / 8.0);
    // Beside what comes across, so that nothing ends at T.
    assert!(at(1.484_375, left + 0.01) && !at(1.484_375, left - 0.01));
    assert!(at(1.75, left - 0.01) && at(1.75, -250.0));
}

/// The rectangle of who comes across: none for a CAV that is narrower than 0.6 m, so it comes later, too.
/// H-14.32.
#[test]
fn nobody_comes_across_a_narrow_cav() {
    let with = |width: f64, y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.width = width;
        alone(&mut cycle, crossing(1.0, y, [0.5, 4.0]));
        found(&cycle).is_some()
    };
    let late = -30.0;
    assert!(!with(0.6, late), "a line is met");
    assert!(with(0.59, late));
}

/// An object that stands where the CAV may stand is met for ever, one that stands behind it never.
#[test]
fn what_stands_is_met_where_the_cav_comes_to() {
    let with = |x: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        alone(&mut cycle, track(1, x, 0.0));
        found(&cycle).map(|witness| witness.compared)
    };
    assert_eq!(with(-4.01), None);
    assert_eq!(with(-3.99), Some([0.0, 10.75]));
    assert_eq!(with(14.5), Some([10.5, 10.75]));
    assert_eq!(with(14.7), Some([10.75, 10.75]));
}

/// H-14.45: along a bend the CAV is where the path leads.
#[test]
fn the_path_is_that_of_the_trajectory() {
    let with = |aside: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        for point in points(&mut cycle) {
            point.y = aside * point.x;
        }
        let standing = track(1, 10.0, 2.2);
        alone(&mut cycle, standing);
        found(&cycle).is_some()
    };
    assert!(!with(0.0) && with(0.05));
}

/// H-14.48, H-14.49: the first place, and there the first motion.
/// H-14.9, H-14.50.
#[test]
fn the_witness_is_the_first_place_then_the_first_motion() {
    let with = |items: &[Track]| {
        let mut cycle = base(HARDENED, MotRemote);
        alone(&mut cycle, items[0].clone());
        cycle.tracks = tracks(items.to_vec());
        let witness = found(&cycle).expect("they stand in the way");
        (witness.point, witness.track, witness.compared)
    };
    let [near, far] = [track(7, 8.0, 0.0), track(5, 10.0, 0.0)];
    // The CAV's front is at 6 m where it is 4 m along: the seventeenth place.
    let expected = (Some(51 + 16), Some(7), [4.0, 10.75]);
    assert_eq!(with(&[near.clone(), far.clone()]), expected);
    assert_eq!(with(&[far, near.clone()]), expected);
    assert_eq!(with(&[track(9, 8.0, 0.1), near]), (Some(51 + 16), Some(9), [4.0, 10.75]));
}

/// A trajectory that begins beside the CAV: the half width is greater by how far it does, across its heading.
/// H-14.26.
#[test]
fn a_trajectory_that_begins_beside_widens_the_rectangle() {
    let with = |ego: f64, x: f64, y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.y = ego;
        alone(&mut cycle, track(1, x, y));
        found(&cycle).is_some()
    };
    // The trajectory is along y = 0.
    assert!(with(0.25, 8.0, -2.25) && !with(0.25, 8.0, -2.26) && !with(0.0, 8.0, -2.25));
    assert!(with(-0.25, 8.0, -2.25) && with(-0.25, 8.0, 2.25) && !with(-0.25, 8.0, 2.26));
    // At p, too; nobody comes across what is wider.
    assert!(with(0.25, 0.0, 2.5) && !with(0.25, 0.0, 2.51));
    // Across the heading of the trajectory, which is not that of the CAV.
    let turned = |sin: f64, y: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.x = 1.0;
        alone(&mut cycle, track(1, 8.0, y));
        let first = &mut points(&mut cycle)[0];
        (first.cos, first.sin) = ((1.0 - sin * sin).sqrt(), sin);
        found(&cycle).is_some()
    };
    assert!(turned(0.1, 2.09) && !turned(0.1, 2.11) && !turned(0.0, 2.09));
}

/// The rectangle of the CAV is that of LLCC, `center_offset` ahead.
/// H-14.26.
#[test]
fn the_rectangle_is_shifted_forward() {
    let with = |center_offset: f64, x: f64| {
        let mut cycle: Cycle = base(HARDENED, MotRemote);
        cycle.ego.center_offset = center_offset;
        alone(&mut cycle, track(1, x, 0.0));
        found(&cycle).is_some()
    };
    assert!(with(1.5, 16.25) && !with(1.5, 16.26) && !with(0.0, 16.25));
}

/// H-14.27: beside a trajectory the CAV is no wider in the grid. With a = 0.5 m it would reach y = 1.
#[test]
fn a_trajectory_that_begins_beside_widens_nothing_in_the_grid() {
    let with = |cell: f64, width: f64| {
        let mut cycle = base(HARDENED, MotRemote);
        cycle.ego.width = width;
        cycle.trajectory = Some(straight(1, 0.0));
        cycle.trajectory.as_mut().expect("given").points[0].y = 0.5;
        (cycle.tracks, cycle.detections) = (None, None);
        mark(&mut cycle.grid.as_mut().expect("there is a grid").occupied, 9.5, cell);
        rule(&cycle, Stage::V)
    };
    assert_eq!(with(1.5, 1.0), None);
    assert_eq!(with(1.5, 2.0), Some(Rule::Occupied));
    assert_eq!(with(0.5, 1.0), Some(Rule::Occupied));
}
