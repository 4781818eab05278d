//! `spec/hardened/H-14.md#requirements-not-examined`: who goes along, abs(w x h) <= abs(w) (0.05 + abs(c - p)/30 m), and that both who
//! follows and who keeps beside do.

use mufasa_model::hardened::h14_fail_safe::meeting::goes_along;
use mufasa_model::hardened::h14_fail_safe::motions::all_motions;
use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Track};
use mufasa_model::report::Stage;
use mufasa_model::services::configuration::Configuration::MotRemote;

use super::following::{READINGS, beside, cycle, is_follower, keeps_beside, moves};
use super::{alone, found, margins_move_meetings, scene};
use crate::base::*;
use crate::near::*;

/// Goes along in the readings strict, exact, lax.
fn is_along(cycle: &Cycle) -> [bool; 3] {
    READINGS.map(|reading| {
        let scene = scene(cycle, reading);
        goes_along(&scene, &all_motions(&scene)[0])
    })
}

fn at([x, y]: [f64; 2], [vx, vy]: [f64; 2]) -> Cycle {
    cycle(Track { vx, vy, ..track(1, x, y) })
}

/// The distance at which who drives at 3/5 aside goes along: 0.05 + 16.5/30 = 0.6; 3 m more for each 0.1 of it.
const FAR: f64 = 16.5;

/// abs(w) = 10 m/s: 3 m are 1 m/s. Both ways, to both sides, ahead and behind and aside.
/// H-14.34.
#[test]
fn who_goes_along_goes_the_way_or_the_opposite_way() {
    for w in [[8.0, 6.0], [8.0, -6.0], [-8.0, 6.0], [-8.0, -6.0]] {
        moves("behind", |e| is_along(&at([-FAR + 3.0 * e, 0.0], w)));
        moves("ahead", |e| is_along(&at([FAR - 3.0 * e, 0.0], w)));
        moves("beside", |e| is_along(&at([0.0, FAR - 3.0 * e], w)));
    }
    moves("the bound has the unit of a speed", |e| {
        is_along(&at([-FAR + 24.0 * e, 0.0], [1.0, 0.75]))
    });
    moves("aside", |e| is_along(&at([-FAR, 0.0], [8.0, 6.0 + 25.0 / 16.0 * e])));
    // Straight aside from 28.5 m on.
    moves("across", |e| is_along(&at([28.5 - 3.0 * e, 0.0], [0.0, 10.0])));
    assert_eq!(is_along(&at([100.0, 0.0], [0.0, -10.0])), [true; 3]);
}

/// The bound is included: 0.05 stands for its double, 3602879701896397/2^56, so that abs(c - p) has to be
/// 18 m - 30 times that, which is 16.5 m - 6/2^56 m.
#[test]
fn the_bound_of_going_along_is_included() {
    let at_bound = |w: [f64; 2], units: f64| {
        let mut cycle = at([0.0, FAR], w);
        cycle.ego.y = units / 2f64.powi(56);
        cycle
    };
    for w in [[8.0, 6.0], [-8.0, 6.0], [1.0, -0.75]] {
        for (units, expected) in [(5.0, true), (6.0, true), (7.0, false)] {
            assert_eq!(is_along(&at_bound(w, units))[1], expected, "{w:?} {units}");
        }
    }
    let keeping = [5.0, 6.0, 7.0].map(|units| keeps_beside(&at_bound([1.0, -0.75], units))[1]);
    assert_eq!(keeping, [true, true, false]);
    let following = [5.0, 6.0, 7.0].map(|units| {
        let mut cycle = at([-FAR, 0.0], [8.0, 6.0]);
        cycle.ego.x = -units / 2f64.powi(56);
        is_follower(&cycle, true)[1]
    });
    assert_eq!(following, [true, true, false]);
}

/// h is that of the CAV, whatever way the object looks; c is its centre now, p the CAV's reference point.
#[test]
fn going_along_is_seen_from_where_the_cav_is_now() {
    let turned = |change: &dyn Fn(&mut Cycle), x: f64, w: [f64; 2]| {
        let mut cycle = at([x, 0.0], w);
        change(&mut cycle);
        is_along(&cycle)
    };
    let looks = |c: &mut Cycle| (c.ego.cos, c.ego.sin) = (0.8, 0.6);
    moves("to where the CAV looks", |e| turned(&looks, FAR - 3.0 * e, [10.0, 0.0]));
    let faces = |c: &mut Cycle| {
        let item = &mut c.tracks.as_mut().expect("set").items[0];
        (item.cos, item.sin) = (0.8, 0.6);
    };
    moves("however it looks", |e| turned(&faces, -FAR + 3.0 * e, [8.0, 6.0]));
    // Seen 0.1 s ago it was 17.31 m away.
    let old = |c: &mut Cycle| {
        let list = c.tracks.as_mut().expect("set");
        (list.items[0].y, list.stamp_ns) = (-0.6, NOW - 100_000_000);
    };
    moves("now", |e| turned(&old, -FAR - 0.8 + 3.0 * e, [8.0, 6.0]));
    let shifted = |c: &mut Cycle| c.ego.center_offset = 10.0;
    moves("from p", |e| turned(&shifted, -FAR + 3.0 * e, [8.0, 6.0]));
    // p itself is elsewhere.
    let elsewhere = |c: &mut Cycle| c.ego.x = 1.0;
    moves("from p, wherever", |e| turned(&elsewhere, 1.0 - FAR + 3.0 * e, [8.0, 6.0]));
}

/// c = p: abs(w x h) <= 0.05 abs(w), either way.
#[test]
fn who_is_at_p_goes_along_straight() {
    // abs(vy) = 0.05 abs(w).
    let aside = 0.4 / 0.9975f64.sqrt();
    for vx in [8.0, -8.0] {
        moves("to the left", |e| is_along(&at([0.0, 0.0], [vx, aside + e])));
        moves("to the right", |e| is_along(&at([0.0, 0.0], [vx, -aside - e])));
    }
    // Behind a CAV whose rectangle is 10 m ahead of p.
    let behind = |vy: f64| {
        let mut cycle = at([0.0, 0.0], [8.0, vy]);
        cycle.ego.center_offset = 10.0;
        is_follower(&cycle, true)
    };
    moves("it follows", |e| behind(aside + e));
    // Towards a CAV that drives away from the route, 18 m beside it, its rectangle 10 m ahead of p.
    let leaving = |aside: f64| {
        let mut cycle = at([0.0, 18.0], [-0.8 - 0.6 * aside, -0.6 + 0.8 * aside]);
        (cycle.ego.y, cycle.ego.center_offset) = (18.0, 10.0);
        (cycle.ego.cos, cycle.ego.sin) = (0.8, 0.6);
        for point in points(&mut cycle) {
            (point.x, point.y) = (0.8 * point.x, 18.0 + 0.6 * point.x);
            (point.cos, point.sin) = (0.8, 0.6);
        }
        keeps_beside(&cycle)
    };
    moves("it keeps beside", |e| leaving(0.05 / 0.9975f64.sqrt() + e));
}

/// Nobody who does not go along follows or keeps beside.
#[test]
fn who_follows_or_keeps_beside_goes_along() {
    for vy in [6.0, -6.0] {
        moves("it follows", |e| is_follower(&at([-FAR + 3.0 * e, 0.0], [8.0, vy]), true));
    }
    assert_eq!(is_follower(&at([FAR, 0.0], [-8.0, 0.0]), true), [false; 3], "it goes along");
    for (vx, vy) in [(1.0, 0.75), (1.0, -0.75), (-1.0, 0.75), (-1.0, -0.75)] {
        moves("it keeps beside", |e| keeps_beside(&beside(0.0, FAR - 24.0 * e, vx, vy)));
    }
}

/// Before a corner of 90 degrees, beside the leg behind it: straight on it crosses the CAV's way, and comes towards it
/// ever so slowly.
fn before_a_corner(cycle: &mut Cycle, y: f64) {
    alone(cycle, Track { vx: -1e-4, vy: -10.0, ..track(1, 12.0, y) });
    let section = |[x, y]: [f64; 2], [right, left]: [f64; 2]| CrossSection {
        x,
        y,
        left: [x - right, y + left],
        right: [x + right, y - left],
    };
    cycle.route.cross_sections = vec![
        section([-100.0, 0.0], [0.0, 9.0]),
        section([30.0, 0.0], [9.0, 9.0]),
        section([30.0, 40.0], [9.0, 0.0]),
    ];
    points(cycle).truncate(20);
}

const NEAR: &[Near] =
    &[("who merges from behind follows", MotRemote, Profile::HARDENED, |c, e| {
        // At 20 m/s and 3/5 aside; 1.5 m are 1 m/s.
        let far = FAR - 1.5 * e;
        alone(c, Track { vx: 16.0, vy: 12.0, ..track(1, -0.8 * far, -0.6 * far) });
    })];

#[test]
fn margins_move_who_goes_along() {
    margins_move_meetings(NEAR);
}

/// H-14.28, H-14.34: who merges or crosses is examined.
#[test]
fn who_does_not_go_along_is_examined() {
    let merges = |w: [f64; 2]| found(&at([-10.0, -8.2], w)).is_some();
    assert!(merges([16.0, 12.0]), "0.6 > 0.05 + 12.93/30");
    assert!(!merges([18.0, 8.5]), "0.427 < 0.481");
    let at_corner = |y: f64| {
        let mut cycle = base(Profile::HARDENED, MotRemote);
        before_a_corner(&mut cycle, y);
        assert!(passes(&cycle, Stage::Ii));
        found(&cycle).is_some()
    };
    assert!(at_corner(10.0) && at_corner(25.9) && at_corner(39.0), "it does not come straight");
}
