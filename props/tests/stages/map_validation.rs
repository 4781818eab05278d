//! Stage ii of the implementation against the exact model
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`, H-07, H-11, H-14).

use crate::agreed::reports;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, DetectionList, Profile, Trajectory, TrajectoryPoint,
};
use mufasa_model::report::Rule;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;
use mufasa_props::differential::{agree, near_threshold, runner};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::{map_validation, roads};
use proptest::strategy::Strategy;

#[test]
fn paper() {
    agree("stage ii", Profile::PAPER, map_validation::cycle, near_threshold)
        .assert_aimed(&["ii", "safe"]);
}

#[test]
fn hardened() {
    agree("stage ii", Profile::HARDENED, map_validation::cycle, near_threshold)
        .assert_aimed(&["ii", "safe"]);
}

#[test]
fn roads_paper() {
    agree("roads", Profile::PAPER, roads::cycle, near_threshold).assert_aimed(&["ii", "safe"]);
}

#[test]
fn roads_hardened() {
    agree("roads", Profile::HARDENED, roads::cycle, near_threshold).assert_aimed(&["ii", "safe"]);
}

/// H-07.2, MARGIN-01: a point before now, at now or after it is about as far from the CAV as it can drive by then.
#[test]
fn positions() {
    agree("positions", Profile::HARDENED, runs_ahead, near_threshold)
        .assert_aimed(&["ii", "no_obstacle_check"]);
}

/// A plan that H-07.2 decides at its second point.
pub fn runs_ahead(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let mut cycle = base::cycle(draw, frame, profile, Configuration::PlanRemote);
    map_validation::positions(draw, frame, &mut cycle);
    cycle
}

/// The CAV stands on a straight road that goes at an angle to the frame, in degrees. Its trajectory turns to the
/// right, in two steps, from 30 degrees left of the frame to 30 degrees right of it.
fn turning_right(frame: Frame, road: f64) -> Cycle {
    let turned = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        frame.turn((cos, sin))
    };
    let mut cycle =
        base::cycle(&mut Draw::new(&[]), frame, Profile::HARDENED, Configuration::PlanRemote);
    let stamp_ns = cycle.now_ns;
    (cycle.ego.cos, cycle.ego.sin) = turned(30.0);
    cycle.ego.speed = 0.0;
    cycle.parameters.start_tolerance = 10.0;
    let (cos, sin) = turned(road);
    cycle.route = base::road(Frame { cos, sin, ..frame }, 10.0);
    cycle.detections = Some(DetectionList { stamp_ns, items: Vec::new() });
    // Each step leads along the middle of its two headings.
    let (mut at, mut points) = ([frame.x, frame.y], Vec::new());
    for (t_ns, heading, way) in
        [(0, 30.0, 15.0), (1, 0.0, -15.0), (2, -30.0, -30.0), (3, -30.0, 0.0)]
    {
        let ([x, y], (cos, sin), (dx, dy)) = (at, turned(heading), turned(way));
        points.push(TrajectoryPoint { t_ns: stamp_ns + 200_000_000 * t_ns, x, y, cos, sin });
        at = [x + 0.9 * dx, y + 0.9 * dy];
    }
    cycle.trajectory = Some(Trajectory { stamp_ns, points });
    cycle
}

/// H-07.7: of two roads the first heading of the turn is against one, 100 degrees off, though the other headings are
/// along both.
#[test]
fn one_heading_of_a_turn_may_be_against_the_road() {
    for turn in 0..24_u8 {
        let (sin, cos) = (15.0 * f64::from(turn)).to_radians().sin_cos();
        let frame = Frame { x: 0.0, y: 0.0, cos, sin };
        for (road, failure) in [(-50.0, None), (-70.0, Some((Rule::Direction, Some(0))))] {
            let cycle = turning_right(frame, road);
            for report in reports(&cycle) {
                let found = report.witness().map(|it| (it.rule, it.point));
                assert_eq!(found, failure, "{turn} {road}");
                assert_eq!(report.failed_stage.is_some(), failure.is_some(), "{turn} {road}");
            }
        }
    }
}

/// How far a point is from a segment of the reference path, rounded, m.
fn away(cycle: &Cycle, point: &TrajectoryPoint, segment: usize) -> f64 {
    let all = &cycle.route.cross_sections;
    let (a, b) = (&all[segment], &all[(segment + 1) % all.len()]);
    let ([ux, uy], [x, y]) = ([b.x - a.x, b.y - a.y], [point.x - a.x, point.y - a.y]);
    let part = ((x * ux + y * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
    (x - part * ux).hypot(y - part * uy)
}

/// SCHED-19: of a point that is too far from the reference path the witness names a nearest segment; where several are
/// equally near, any of them.
#[test]
fn the_segment_of_a_witness_is_a_nearest_one() {
    let named = std::cell::Cell::new(0);
    for generator in [map_validation::cycle, roads::cycle] {
        let cycles = tape().prop_map(|tape| generator(&mut Draw::new(&tape), Profile::PAPER));
        let result = runner().run(&cycles, |cycle| {
            let found = check_impl(&cycle).ok();
            let witness = found.as_ref().and_then(|it| it.witness());
            let Some(witness) = witness.filter(|it| it.rule == Rule::ThetaMap) else {
                return Ok(());
            };
            let points = cycle.trajectory.as_ref().map_or(&[][..], |it| &it.points);
            let (point, segment) = (witness.point.expect("a point"), witness.segment);
            let away = away(&cycle, &points[point], segment.expect("a segment"));
            // `conforming` asks that this is the least distance.
            let [least, _] = witness.compared;
            assert!((away - least).abs() <= 1e-6 * (1.0 + least), "{away}: {witness:?} {cycle:#?}");
            named.set(named.get() + u32::from(segment > Some(0)));
            Ok(())
        });
        assert_eq!(result, Ok(()));
    }
    assert!(named.get() > 10, "{}", named.get());
}

/// Two cross sections, of which one may have no width, or both one left corner; a kilometre beside the reference path.
/// The only point of the trajectory is within some last places of a side or a diagonal between them.
fn at_an_edge(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let mut cycle = base::cycle(draw, frame, profile, Configuration::PlanRemote);
    // Near 0 coordinates have more places than their products.
    let first = draw.pick(&[0.0, -8.0]);
    let mut corner = |x: f64, y: f64| [x + draw.range(-0.9, 0.9), y + draw.range(-0.9, 0.9)];
    let [mut a, mut b] = [first, first + 8.0].map(|x| CrossSection {
        x,
        y: 1000.0,
        left: corner(x, 1.0),
        right: corner(x, -1.0),
    });
    match draw.below(5) {
        0 => a.left = a.right,
        1 => b.left = b.right,
        2 => b.left = a.left,
        _ => {}
    }
    let corners = [a.left, a.right, b.right, b.left];
    cycle.route.cross_sections = vec![a, b];
    let from = draw.below(4);
    let [[ax, ay], [bx, by]] = [corners[from], corners[(from + draw.between(1, 2)) % 4]];
    let part = draw.pick(&[0.5, 0.25, 0.875, 0.0]) + draw.range(0.0, 0.125);
    let mut beside = |it: f64| if draw.below(2) == 0 { it } else { draw.ulps(it) };
    let [x, y] = [beside(ax + part * (bx - ax)), beside(ay + part * (by - ay))];
    if let Some(trajectory) = &mut cycle.trajectory {
        trajectory.points.truncate(1);
        trajectory.points.iter_mut().for_each(|it| (it.x, it.y) = (x, y));
    }
    cycle
}

/// IMPL-01, S2-02: the last place of a coordinate decides at each edge, that of two triangles and those of one.
#[test]
fn edges_of_the_corridor_are_exact() {
    agree("edges", Profile::PAPER, at_an_edge, near_threshold).assert_aimed(&["ii", "safe"]);
}
