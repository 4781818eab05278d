//! `spec/hardened/H-14.md#requirements-reach`: a path that comes back to the CAV.

use mufasa_model::input::cycle::{CrossSection, Cycle};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Reading, Rule};

use super::reach::{ALONG_X, fails_beyond, fails_beyond_in, leads, on_the_line};
use super::widening::{found, witness};
use crate::near::*;

/// The CAV at v m/s brakes at once, with 6 m/s^2: s_stop is v^2 / (12 m/s^2). The points look along h; the road is 20 m
/// wide to each side.
fn braking(v: f64, lateral_tolerance: f64, points: &[[f64; 2]]) -> Cycle {
    let poses: Vec<[f64; 4]> = points.iter().map(|[x, y]| [*x, *y, 1.0, 0.0]).collect();
    let mut cycle = leads(v, &poses);
    (cycle.parameters.a_b, cycle.parameters.start_tolerance) = (6.0, 16.0);
    cycle.parameters.lateral_tolerance = lateral_tolerance;
    let wide = |x: f64| CrossSection { x, y: 0.0, left: [x, 20.0], right: [x, -20.0] };
    cycle.route.cross_sections = vec![wide(-100.0), wide(200.0)];
    cycle
}

/// s_stop is 3 m, and s_stop + max(1 m, lateral_tolerance) 5 m.
fn through(points: &[[f64; 2]]) -> Cycle {
    braking(6.0, 2.0, points)
}

/// A node just beyond s_stop, with which the list of places ends. Each point at a progress of 3 m is not so far back as
/// 1/8 m from there.
const Z: [f64; 2] = [3.03125, 0.0];

/// A way whose end is 1/8 m + e less ahead than an earlier node, not only the one before; near p and beyond s_stop = 1 m.
/// H-14.68, MARGIN-01.
#[test]
fn a_path_goes_back_by_at_most_an_eighth_of_a_metre() {
    for h in [ALONG_X, [0.0, 1.0]] {
        fails_beyond(|e| on_the_line(4.0, h, &[0.0, 0.5, 0.375 - e, 1.5]));
        fails_beyond(|e| on_the_line(4.0, h, &[0.0, 3.0, 2.875 - e, 3.5]));
    }
    let along = |ways: &[f64]| on_the_line(4.0, ALONG_X, ways);
    fails_beyond(|e| along(&[3.0, 2.875 - e]));
    fails_beyond(|e| along(&[0.0, 3.0, 2.9375, 2.875 - e, 3.5]));
    fails_beyond(|e| along(&[0.0, 3.0, 2.9375, 2.96875, 2.875 - e, 3.5]));
    fails_beyond(|e| through(&[[4.0, 0.0], [3.875 - e, 1.0], [4.0, 2.0]]));
    let mut back = along(&[0.0, 0.5, -0.5, 1.5]);
    assert_eq!(safe(&back), NO);
    back.profile = back.profile.without(HardenedRule::H14);
    assert_eq!(safe(&back), YES);
}

/// Back by more than 1/8 m, as near to p as s_stop + max(1 m, lateral_tolerance) - e: a node, or the middle of a way, of
/// which both ends are farther away.
/// H-14.68, MARGIN-01.
#[test]
fn farther_away_a_path_goes_back() {
    for h in [ALONG_X, [0.0, 1.0]] {
        fails_beyond(|e| on_the_line(4.0, h, &[0.0, 6.0, 4.0 - e, 5.0]));
    }
    for (lateral_tolerance, bound) in [(0.5, 13.0), (1.0, 13.0), (1.5, 13.5)] {
        fails_beyond(|e| braking(12.0, lateral_tolerance, &[[15.0, 0.0], [bound - e, 0.0]]));
    }
    fails_beyond(|e| through(&[[7.0, 0.0], [5.0 - e, -4.0], [5.0 - e, 4.0]]));
}

/// A way from `inner`, which is near but not back, to `outer`, which is back but not near, or the other way round. Only its
/// middle may be both: where it begins to be back it is at (3 m, 4 m), moved by e, 5 m from p without that.
/// The margins move both bounds.
/// H-14.68, MARGIN-01.
#[test]
fn the_same_point_is_near_and_back() {
    let (delta, more) = (1.0 / 1_048_576.0, 1.0 / 1_099_511_627_776.0);
    let is_safe = |with: &dyn Fn(f64) -> Cycle| {
        [-5.0 * delta, -0.5 * delta, 0.0, more, 0.5 * delta, 5.0 * delta].map(|e| {
            let mut cycle = with(e);
            cycle.parameters.delta = delta;
            safe(&cycle)
        })
    };
    let expected = [YES, NEAR_SAFE, NEAR_SAFE, NEAR_UNSAFE, NEAR_UNSAFE, NO];
    let ends = |e: f64| [[3.125, 3.5 - e], [2.0, 8.0 - e]];
    let away = |e: f64| {
        let [inner, outer] = ends(e);
        through(&[[3.125, 0.0], inner, outer])
    };
    assert_eq!(is_safe(&away), expected);
    let back = |e: f64| {
        let [inner, outer] = ends(e);
        through(&[[3.125, 0.0], [3.125, 8.0], outer, inner])
    };
    assert_eq!(is_safe(&back), expected);
    let found = |cycle: &Cycle| found(cycle, Reading::Exact);
    assert_eq!(found(&away(0.5)), Some(witness(Rule::Reach, 2, ["1.125", "0.125"])));
    assert_eq!(found(&back(0.5)), Some(witness(Rule::Reach, 3, ["1.125", "0.125"])));
}

/// A node as far from p as s_stop + max(1 m, lateral_tolerance) + e, aside of s_stop, and then a point nearer than
/// s_stop; at the next node or after one between.
/// H-14.68, MARGIN-01.
#[test]
fn a_path_does_not_come_back_from_afar() {
    // 5 m: 3 m and 4 m; 13 m: 12 m and 5 m.
    let at = |e: f64| 1.0 + e / 5.0;
    fails_beyond_in(5.0, |e| through(&[Z, [3.0 * at(e), 4.0 * at(e)], [2.9375, 0.0]]));
    let between = [3.0, 3.0];
    fails_beyond_in(5.0, |e| through(&[Z, [3.0 * at(e), -4.0 * at(e)], between, [2.9375, 0.0]]));
    let at = |e: f64| 1.0 + e / 13.0;
    let points = |e: f64| [[12.03125, 0.0], [12.0 * at(e), 5.0 * at(e)], [11.9375, 0.0]];
    for lateral_tolerance in [0.5, 1.0] {
        fails_beyond_in(13.0, |e| braking(12.0, lateral_tolerance, &points(e)));
    }
    assert_eq!(safe(&braking(12.0, 1.0625, &points(1.0 / 32.0))), YES);
}

/// From afar, as near to p as s_stop - e: the end of a way, its beginning, or its middle alone.
/// H-14.68, MARGIN-01.
#[test]
fn from_afar_a_path_comes_as_near_as_s_stop() {
    fails_beyond(|e| through(&[Z, [3.0 - e, 4.5], [3.0 - e, 0.0]]));
    fails_beyond(|e| through(&[Z, [3.0 - e, 4.5], [3.0 - e, -4.5]]));
    fails_beyond(|e| through(&[Z, [3.0 - e, 4.5], [3.0 - e, 0.25], [3.0 - e, -0.25]]));
    // Not from afar it comes nearer.
    assert_eq!(safe(&through(&[Z, [2.9375, 3.5], [2.9375, -3.5], [2.9375, 0.0]])), YES);
}

/// A trajectory that was planned before begins 6 m behind the CAV: what comes before the first node ahead is no earlier node.
/// H-14.68, H-14.1.
#[test]
fn points_that_are_no_nodes_are_no_earlier_nodes() {
    let ways = [-6.0, -4.0, -2.0, 0.0, 1.0, 2.0, 4.0];
    assert_eq!(safe(&through(&ways.map(|x| [x, 0.0]))), YES);
    assert_eq!(safe(&through(&[[-6.0, 0.0], [1.0, 0.0], [4.0, 0.0]])), YES);
}

/// The way back of a U-turn is 5 m - e beside p; farther away it leads round it.
/// H-14.68, MARGIN-01.
#[test]
fn a_u_turn_keeps_away() {
    fails_beyond(|e| through(&[[6.0, 0.0], [6.0, 5.0 - e], [-6.0, 5.0 - e]]));
    let round = |y: f64| [[6.0, 0.0], [6.0, y], [-6.0, y], [-6.0, -y], [6.0, -y], [6.0, 0.0]];
    assert_eq!(safe(&through(&round(5.5))), YES);
    assert_eq!(safe(&through(&round(4.5))), NO);
}

/// The witness is the first way, by its second node among all points. It compares how far the lower of its nodes is back
/// from the greatest progress of an earlier node with 1/8 m, whatever else is the case; else the least distance with s_stop.
/// H-14.68.
#[test]
fn the_witness_is_the_first_way_that_comes_back() {
    let is = |points: &[[f64; 2]], point: usize, compared: [&str; 2]| {
        let expected = Some(witness(Rule::Reach, point, compared));
        assert_eq!(found(&through(points), Reading::Exact), expected, "{points:?}");
    };
    let line = |ways: &[f64]| ways.iter().map(|x| [*x, 0.0]).collect::<Vec<_>>();
    is(&line(&[-1.0, 0.0, 0.5, 0.25, 1.5, 1.0, 4.0]), 3, ["0.25", "0.125"]);
    is(&line(&[0.5, 0.4375, 0.25]), 2, ["0.25", "0.125"]);
    // The lower node is the first one; it is too far away.
    is(&[[4.0, 0.0], [4.0, 6.0], [2.0, 6.0], [3.5, 0.0]], 3, ["2", "0.125"]);
    // From afar: the middle of a way, and at its end.
    is(&[[-1.0, 0.0], Z, [2.9375, 4.5], [2.9375, -2.0]], 3, ["2.9375", "3"]);
    is(&[Z, [2.9375, 4.5], [2.9375, 1.0], [2.9375, 0.5]], 3, ["2.979749360265054", "3"]);
    // Both at once; and both, one way after the other.
    is(&[[4.0, 0.0], [4.0, 4.0], [1.0, 0.0]], 2, ["3", "0.125"]);
    is(&[Z, [2.9375, 4.5], [2.9375, 0.0], [1.0, 0.0]], 2, ["2.9375", "3"]);
}

/// Points that are no nodes and places come first, wherever they are: too far aside, too long, turned and back. Then
/// come the road, and what is too close to call.
/// H-14.68, H-14.15, H-14.61, H-14.62, H-14.67, H-14.58, MARGIN-04.
#[test]
fn what_comes_back_is_asked_last_of_reach() {
    let line = |ways: &[f64]| on_the_line(4.0, ALONG_X, ways);
    let reach = |point: usize, compared| Some(witness(Rule::Reach, point, compared));
    let exact = |cycle: &Cycle| found(cycle, Reading::Exact);
    let back = line(&[0.0, 0.5, 0.25, 1.5]);
    assert_eq!(exact(&back), reach(2, ["0.25", "0.125"]));
    let no_node = line(&[0.0, -0.5, 0.5, 0.25, 1.5]);
    assert_eq!(exact(&no_node), reach(1, ["0.5", "0.125"]));
    let long = line(&[0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5]);
    assert_eq!(exact(&long), reach(13 + 13, ["3.25", "3"]));
    let mut turned = back.clone();
    let last = &mut points(&mut turned)[3];
    (last.x, last.cos, last.sin) = (1.0, -0.5, 0.75f64.sqrt());
    assert_eq!(exact(&turned), reach(4 + 6, ["-0.5", "0"]));
    let mut aside = back.clone();
    points(&mut aside)[3].y = 2.0;
    aside.parameters.lateral_tolerance = 0.5;
    assert_eq!(exact(&aside).map(|it| it.1), Some(Some(4 + 6)));
    // The road ends at 2 m, before s_stop.
    let off = |ways: &[f64]| {
        let mut cycle = through(&ways.iter().map(|x| [*x, 0.0]).collect::<Vec<_>>());
        cycle.route.cross_sections[1] =
            CrossSection { x: 2.0, y: 0.0, left: [2.0, 20.0], right: [2.0, -20.0] };
        exact(&cycle)
    };
    assert_eq!(off(&[0.5, 1.0, 1.5]).map(|it| it.0), Some(Rule::Corridor));
    assert_eq!(off(&[0.5, 0.25, 1.5]), reach(1, ["0.25", "0.125"]));
    let close = line(&[0.125, 0.5, 0.25, 1.5]);
    assert_eq!(found(&close, Reading::Strict), reach(2, ["0.25", "0.125"]));
}
