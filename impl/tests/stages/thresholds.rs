//! Stages at their thresholds near the origin, in UTM coordinates and at the border of the domain. The
//! vectors (`lab/conform/tests/vectors/implementation.rs`) have more thresholds, near the origin.

use crate::scene::{detection, scene, track};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [583_912.25, 5_361_004.5], [-1.6e7, 1.6e7]];

#[test]
fn a_cycle_in_order_is_safe() {
    for place in PLACES {
        for profile in [Profile::PAPER, Profile::HARDENED] {
            for configuration in [MotRemote, AllRemote, PlanRemote] {
                let report = scene(profile, configuration, place).report();
                assert_eq!(report.failed_stage, None, "{profile:?} {configuration:?} {report:?}");
            }
        }
    }
}

#[test]
fn the_mean_cost_has_to_be_below_the_threshold() {
    for [x, y] in PLACES {
        let mut scene = scene(Profile::PAPER, MotRemote, [x, y]);
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
        let mut scene = scene(Profile::PAPER, MotRemote, [x, y]);
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
fn touching_rectangles_collide() {
    for [x, y] in PLACES {
        let mut scene = scene(Profile::PAPER, PlanRemote, [x, y]);
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

#[test]
fn theta_map_and_the_corridor() {
    for [x, y] in PLACES {
        let mut scene = scene(Profile::PAPER, MotRemote, [x, y]);
        for section in &mut scene.cross_sections {
            section.left = [section.x, y + 0.25];
            section.right = [section.x, y - 0.25];
        }
        scene.parameters.theta_map = 0.125;
        let mut off = |away: f64| {
            scene.points[7].y = y + away;
            scene.failure().map(|(_, witness)| (witness.rule, witness.point))
        };
        assert_eq!(off(0.25), None);
        assert_eq!(off(0.25 + 1e-7), Some((Rule::ThetaMap, Some(7))));
        for section in &mut scene.cross_sections {
            (section.left, section.right) = ([section.x, y], [section.x, y]);
        }
        let mut off = |away: f64| {
            scene.points[7].y = y + away;
            scene.rule()
        };
        assert_eq!(off(0.125 - 1e-8), None);
        assert_eq!(off(0.125 + 1e-7), Some(Rule::ThetaMap));
    }
}
