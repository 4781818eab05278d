//! The stages at their thresholds, near the origin and at the border of the domain.

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::Lead;
use mufasa::input::profile::Profile::{Hardened, Paper};
use mufasa::report::{FailedStage, Input, Outcome, Reason, Rule, Stage};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [583_912.25, 5_361_004.5], [-1.6e7, 1.6e7]];

#[test]
fn a_cycle_in_order_is_safe() {
    for place in PLACES {
        for profile in [Paper, Hardened] {
            for configuration in [MotRemote, AllRemote, PlanRemote] {
                let report = scene(profile, configuration, place).report();
                assert_eq!(report.failed_stage, None, "{profile:?} {configuration:?} {report:?}");
            }
        }
    }
}

#[test]
fn stages_run_as_the_table_says() {
    use Outcome::{NotApplicable, NotScheduled, Passed, Skipped};
    let other = Skipped(Reason::OtherStageRan);
    let outcomes =
        |profile, configuration| scene(profile, configuration, PLACES[0]).report().stages;
    assert_eq!(outcomes(Paper, MotRemote), [Passed, Passed, NotScheduled, Passed, Passed]);
    assert_eq!(outcomes(Paper, AllRemote), [Passed, Passed, Passed, other, other]);
    assert_eq!(outcomes(Paper, PlanRemote), [NotScheduled, Passed, Passed, other, NotScheduled]);
    assert_eq!(outcomes(Hardened, AllRemote), [Passed, Passed, Passed, Passed, other]);
    assert_eq!(outcomes(Hardened, PlanRemote), [NotScheduled, Passed, Passed, other, other]);

    let blind = Scene { detections: None, occupied: None, ..scene(Paper, MotRemote, PLACES[0]) };
    let missing = Skipped(Reason::NoCurrent(Input::Detections));
    let (no_detections, no_grid) = (NotApplicable(Input::Detections), NotApplicable(Input::Grid));
    assert_eq!(blind.report().stages, [no_detections, Passed, NotScheduled, missing, no_grid]);
    assert_eq!(blind.report().failed_stage, None);
    let blind = Scene { profile: Hardened, ..blind };
    assert_eq!(blind.report().failed_stage, Some(FailedStage::NoObstacleCheck));
}

/// H-02: in `AllRemote` unchecked tracks are examined, but are no obstacle check.
#[test]
fn unchecked_tracks_are_no_obstacle_check() {
    let unchecked =
        Scene { detections: None, occupied: None, ..scene(Hardened, AllRemote, PLACES[0]) };
    assert_eq!(unchecked.report().failed_stage, Some(FailedStage::NoObstacleCheck));
    let [_, _, third, _, _] = unchecked.report().stages;
    assert_eq!(third, Outcome::Passed);
    let mut ahead = unchecked;
    ahead.tracks = Some(vec![track(1, 7.0, 0.0)]);
    assert_eq!(ahead.rule(), Some(Rule::Collision));
}

#[test]
fn the_mean_cost_has_to_be_below_the_threshold() {
    for [x, y] in PLACES {
        let mut scene = scene(Paper, MotRemote, [x, y]);
        // Mean of 0.125 and 0.275 is the threshold itself; all distances are exact.
        scene.parameters.theta_tr = 0.1875;
        let (near, far) = (track(1, x + 30.0, y), track(2, x, y + 30.0));
        scene.tracks = Some(vec![near, far]);
        scene.detections =
            Some(vec![detection(x + 30.125, y), detection(x, y + 30.25), detection(x - 60.0, y)]);
        assert_eq!(scene.rule(), Some(Rule::MeanCost));
        scene.parameters.theta_tr = 0.1875 + 1e-8;
        assert_eq!(scene.rule(), None);
    }
}

#[test]
fn tracks_at_the_border_of_the_field_of_view_are_gated() {
    for [x, y] in PLACES {
        let mut scene = scene(Paper, MotRemote, [x, y]);
        scene.ego.x = x;
        // 3-4-5: exactly as far as the farthest detection, which is 1 m from no track.
        scene.detections = Some(vec![detection(x + 50.0, y)]);
        scene.tracks = Some(vec![track(1, x + 30.0, y - 40.0)]);
        assert_eq!(scene.rule(), Some(Rule::MeanCost));
        scene.tracks = Some(vec![track(1, x + 30.0, y - 40.000_000_1)]);
        assert_eq!(scene.rule(), None);
    }
}

#[test]
fn every_gated_track_needs_a_detection_of_its_own() {
    let mut scene = scene(Hardened, MotRemote, PLACES[0]);
    scene.detections = Some(vec![detection(0.0, 30.0), detection(0.0, 60.0)]);
    scene.tracks = Some(vec![track(1, 0.0, 30.0), track(2, 0.0, 30.0)]);
    let (stage, witness) = scene.failure().expect("two tracks near one detection");
    assert_eq!((stage, witness.rule, witness.track), (Stage::I, Rule::NoAssignment, None));
    assert_eq!(witness.compared.map(f64::to_bits), [1.0, 2.0].map(f64::to_bits));
    scene.parameters.miss_budget = 1;
    assert_eq!(scene.rule(), None);
    scene.tracks = Some(vec![track(1, 0.0, 30.0), track(2, 0.0, 40.0), track(3, 0.0, 50.0)]);
    assert_eq!(scene.failure().and_then(|(_, witness)| witness.track), Some(2));
}

/// `spec/3-stages.md#stage-i-track-validation.5`: two tracks compete for a detection, so that only
/// the assignment tells; 2^2 * 3 steps are below the limit or not. Without competition the pairs
/// are found at once, whatever the limit.
#[test]
fn no_assignment_of_more_work_than_the_limit_is_begun() {
    for profile in [Paper, Hardened] {
        let mut scene = scene(profile, MotRemote, PLACES[0]);
        let places = [30.0, 30.3, 60.0];
        scene.detections = Some(places.map(|y| detection(0.0, y)).to_vec());
        scene.tracks = Some(vec![track(1, 0.0, 30.16), track(2, 0.0, 30.3)]);
        scene.parameters.work_limit = 12;
        assert_eq!(scene.rule(), None, "{profile:?}");
        scene.parameters.work_limit = 11;
        let (stage, witness) = scene.failure().expect("too much work");
        assert_eq!((stage, witness.rule), (Stage::I, Rule::WorkLimit));
        assert_eq!(witness.compared.map(f64::to_bits), [12.0, 11.0].map(f64::to_bits));
        scene.tracks = Some(vec![track(1, 0.0, 30.0), track(2, 0.0, 30.3)]);
        scene.parameters.work_limit = 0;
        assert_eq!(scene.rule(), None, "{profile:?}");
    }
}

#[test]
fn a_gap_equal_to_s_follow_fails() {
    let at = |gap: f64, profile| {
        let mut scene = scene(profile, AllRemote, PLACES[0]);
        scene.detections = Some(Vec::new());
        scene.tracks = Some(Vec::new());
        scene.parameters.safety_time = 1.75;
        scene.change = match gap {
            8.75 => |cycle| cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 8.75, speed: 5.0 }),
            _ => |cycle| cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 8.8, speed: 5.0 }),
        };
        scene.failure().map(|(stage, witness)| (stage, witness.rule, witness.compared))
    };
    // In the paper profile stage iii ran, so that stage iv is not run.
    assert_eq!(at(8.75, Paper), None);
    assert_eq!(at(8.75, Hardened), Some((Stage::Iv, Rule::Gap, [8.75, 8.75])));
    assert_eq!(at(8.8, Hardened), None);
}

#[test]
fn touching_rectangles_collide() {
    for [x, y] in PLACES {
        let mut scene = scene(Paper, PlanRemote, [x, y]);
        scene.ego.center_offset = 1.5;
        scene.ego.width = 2.0;
        // Beside the first point: half widths 1 and 1.
        scene.tracks = Some(vec![track(9, x + 1.5, y + 2.0)]);
        let (stage, witness) = scene.failure().expect("the sides touch");
        assert_eq!((stage, witness.rule), (Stage::Iii, Rule::Collision));
        assert_eq!((witness.point, witness.track), (Some(0), Some(9)));
        scene.tracks = Some(vec![track(9, x + 1.5, y + 2.0 + 1e-7)]);
        assert_eq!(scene.rule(), None);
    }
}

/// H-03: a long vehicle whose centre is farther than `theta_obj`.
#[test]
fn a_truck_is_examined_up_to_the_sum_of_the_circumradii() {
    let truck = |profile| {
        let mut scene = scene(profile, PlanRemote, PLACES[0]);
        let mut truck = track(3, 1.4 + 8.0, 0.0);
        truck.length = 12.0;
        scene.tracks = Some(vec![truck]);
        scene.points.truncate(1);
        scene.ego.speed = 0.0;
        scene.failure().map(|(_, witness)| witness.rule)
    };
    assert_eq!(truck(Paper), None);
    assert_eq!(truck(Hardened), Some(Rule::Collision));
}

#[test]
fn theta_map_and_the_corridor() {
    for [x, y] in PLACES {
        let mut scene = scene(Paper, MotRemote, [x, y]);
        for station in &mut scene.cross_sections {
            station.left = [station.x, y + 0.25];
            station.right = [station.x, y - 0.25];
        }
        scene.parameters.theta_map = 0.125;
        let mut off = |away: f64| {
            scene.points[7].y = y + away;
            scene.failure().map(|(_, witness)| (witness.rule, witness.point))
        };
        assert_eq!(off(0.25), None);
        assert_eq!(off(0.25 + 1e-7), Some((Rule::ThetaMap, Some(7))));
        for station in &mut scene.cross_sections {
            (station.left, station.right) = ([station.x, y], [station.x, y]);
        }
        let mut off = |away: f64| {
            scene.points[7].y = y + away;
            scene.rule()
        };
        assert_eq!(off(0.125 - 1e-8), None);
        assert_eq!(off(0.125 + 1e-7), Some(Rule::ThetaMap));
    }
}

/// H-07, H-11, H-12: one change each, and the rule that it breaks.
#[test]
fn a_trajectory_has_to_fit_route_and_car() {
    type Change = fn(&mut Scene);
    let changes: [(Change, Rule); 11] = [
        (|scene| scene.ego.x -= 2.1, Rule::StartPosition),
        (|scene| scene.points.iter_mut().for_each(|p| p.t_ns += 100_000_001), Rule::StartTime),
        (|scene| scene.cross_sections[2].left[1] -= 3.0, Rule::Corridor),
        (|scene| scene.points.iter_mut().for_each(|p| p.cos = -1.0), Rule::Direction),
        (|scene| scene.parameters.step_max_ns = 99_999_999, Rule::StepTime),
        (|scene| scene.ego.length = 0.499, Rule::StepLength),
        (|scene| scene.parameters.v_max = 4.999, Rule::StepSpeed),
        (|scene| scene.points[3].x -= 0.6, Rule::StepForward),
        (|scene| scene.points[3].y += 0.96, Rule::StepLateral),
        (|scene| (scene.points[3].cos, scene.points[3].sin) = (0.8, 0.6), Rule::StepTurn),
        (|scene| scene.points.truncate(6), Rule::EndsTooSoon),
    ];
    for (change, rule) in changes {
        let mut scene = scene(Hardened, MotRemote, PLACES[0]);
        change(&mut scene);
        assert_eq!(scene.rule(), Some(rule));
    }
    let at_speed = |speed: f64| {
        let mut scene = scene(Hardened, MotRemote, PLACES[0]);
        scene.ego.speed = speed;
        scene.rule()
    };
    assert_eq!(at_speed(15.0), Some(Rule::ArcTooShort));
    assert_eq!(at_speed(0.0), Some(Rule::ArcTooLong));
}

/// The end of a trajectory is a time: no margin, `v_lo` / `a_b` = 0.625 s to the nanosecond.
#[test]
fn the_last_point_may_be_exactly_at_standstill() {
    let ends = |last_ns: i64| {
        let mut scene = scene(Hardened, MotRemote, PLACES[0]);
        scene.points.truncate(8);
        scene.points[7].t_ns = NOW_NS + last_ns;
        scene.points[6].t_ns = NOW_NS + 610_000_000;
        scene.rule()
    };
    assert_eq!(ends(625_000_000), None);
    assert_eq!(ends(624_999_999), Some(Rule::EndsTooSoon));
}

/// The first disk is at x = 1.4 - 4.5 * 3/8, its radius 1.105...
#[test]
fn disks_meet_cells() {
    let with = |profile, column: usize, row: usize| {
        let mut scene = scene(profile, MotRemote, PLACES[0]);
        let mut bits = vec![0; 5000];
        bits[(row * 200 + column) / 8] |= 1 << (column % 8);
        scene.occupied = Some(bits);
        scene.failure().map(|(_, witness)| (witness.rule, witness.cell))
    };
    // In hardened the whole footprint at the first point reaches x = -1.4 and y = -1.1 .. 1.1.
    assert_eq!(with(Hardened, 98, 99), Some((Rule::Occupied, Some((98, 99)))));
    assert_eq!(with(Hardened, 100, 98), Some((Rule::Occupied, Some((100, 98)))));
    assert_eq!(with(Hardened, 100, 97), None);
    assert_eq!(with(Hardened, 97, 99), None);
    // In the paper profile the cell of the disk centre has to be marked: r is one cell.
    assert_eq!(with(Paper, 99, 98), Some((Rule::Occupied, Some((99, 98)))));
    assert_eq!(with(Paper, 98, 98), None);
}

#[test]
fn beyond_the_grid_counts_as_occupied_unless_stage_iv_ran() {
    let mut scene = scene(Hardened, MotRemote, PLACES[0]);
    scene.change = |cycle| {
        if let Some(grid) = &mut cycle.grid {
            grid.x = -0.5;
        }
    };
    assert_eq!(scene.rule(), None);
    scene.detections = None;
    let (stage, witness) = scene.failure().expect("the rear is beyond the grid");
    assert_eq!((stage, witness.rule), (Stage::V, Rule::Outside));
    assert_eq!((witness.disk, witness.cell), (Some(0), None));
}
