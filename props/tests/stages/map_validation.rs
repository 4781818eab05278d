//! Stage ii of the implementation against the exact model
//! (`spec/3-stages.md#stage-ii-trajectory-to-map`, H-07, H-11, H-14).

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::report::{Reading, Rule};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::differential::{agree, conforming, near_threshold};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::{map_validation, roads};

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
            let [exact, strict] = [Reading::Exact, Reading::Strict].map(|it| check(&cycle, it));
            assert_eq!(conforming(&cycle, &exact, &strict), Ok(()), "{turn} {road}");
            for report in [exact, strict].map(|it| it.expect("valid")) {
                let found = report.witness().map(|it| (it.rule, it.point));
                assert_eq!(found, failure, "{turn} {road}");
                assert_eq!(report.failed_stage.is_some(), failure.is_some(), "{turn} {road}");
            }
        }
    }
}
