//! The fail-safe rule at the limits of the domain: nothing panics, and it ends
//! (`spec/4-arithmetic.md#domain`).

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{CrossSection, Detection, Grid, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::{AllRemote, PlanRemote};

/// `s_stop` is 9.2e6 m, in places of 1 cm, and the road goes on beyond it.
fn farthest() -> Scene {
    let mut scene = scene(Profile::HARDENED, PlanRemote, [0.0, 0.0]);
    (scene.ego.speed, scene.ego.length, scene.ego.width) = (150.0, 0.01, 0.01);
    let parameters = &mut scene.parameters;
    (parameters.a_b, parameters.a_max, parameters.tau) = (0.1, 20.0, 60.0);
    (parameters.t_yield, parameters.a_yield) = (60.0, 0.1);
    scene.points.truncate(1);
    let x = 1.6e7;
    let end = CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
    scene.cross_sections.push(end);
    (scene.tracks, scene.detections) = (None, None);
    scene
}

#[test]
fn many_places_are_no_work_where_a_box_tells() {
    let mut scene = farthest();
    // The path leaves the grid, which counts only without current detections.
    assert_eq!(scene.rule(), Some(Rule::Outside));
    scene.detections = Some(Vec::new());
    assert_eq!(scene.rule(), None);
    scene.detections = Some(vec![detection(0.0, 9e6)]);
    assert_eq!(scene.rule(), None);
    scene.detections = Some(vec![detection(9e6, 0.0)]);
    let (_, witness) = scene.failure().expect("it is on the way");
    assert_eq!(witness.rule, Rule::FailSafe);
    // 1 cm a place, and half a car less: one point before them.
    let way = 9e6 - 2.0 - 0.005 - 1.4;
    assert!((witness.compared[0] - way).abs() < 0.011, "{witness:?}");
    // H-14.50, H-14.9
    assert!((witness.compared[1] - 9_157_500.0).abs() < 1e-3, "{witness:?}");
    let place = witness.point.expect("a place") - scene.points.len();
    assert!((place as f64 * 0.01 - way).abs() < 0.02, "{witness:?}");
}

/// Behind the CAV, before the end of the path, everywhere and nowhere, with whatever velocity.
#[test]
fn nothing_panics() {
    let far = f64::from(1 << 24) - 200.0;
    for ego in [[0.0, 0.0], [far, -far]] {
        for (speed, length, width) in
            [(0.0, 0.01, 100.0), (150.0, 100.0, 0.01), (f64::MIN_POSITIVE, 4.5, 1.9)]
        {
            for velocity in [[0.0, 0.0], [5e-324, 0.0], [1e-100, -1e-170], [150.0, -150.0]] {
                let mut scene = scene(Profile::HARDENED, AllRemote, ego);
                (scene.ego.speed, scene.ego.length, scene.ego.width) = (speed, length, width);
                scene.ego.center_offset = -100.0;
                (scene.parameters.v_object, scene.parameters.a_max) = (1e3, 0.1);
                (scene.parameters.start_tolerance, scene.parameters.lateral_tolerance) = (1e3, 1e3);
                let [x, y] = ego.map(|at: f64| -at);
                let [vx, vy] = velocity;
                scene.tracks = Some(vec![Track { vx, vy, length: 0.01, ..track(1, x, y) }]);
                scene.detections = Some(vec![detection(x, y), detection(ego[0], ego[1])]);
                let earlier = vec![detection(x, y), Detection { x: -x, ..detection(x, -y) }];
                scene.history = vec![(300_000_000, earlier.clone()), (500_000_000, earlier)];
                scene.failure_of_iv();
                scene.tracks = None;
                scene.failure_of_iv();
                assert!(scene.check().is_ok());
            }
        }
    }
}

/// 1024 points at one place, at places across the CAV's way, and back and forth as far as there are any.
#[test]
fn whatever_the_points_are_it_ends() {
    let far = f64::from(1 << 24);
    for turn in [0.0_f64, 0.5, 1.6, 3.1] {
        for step in [[0.0, 0.0], [0.0, 0.3], [1e-300, 1e-300], [-0.2, 0.1]] {
            for ahead in [0.2, far] {
                let mut scene = scene(Profile::HARDENED, PlanRemote, [0.0, 0.0]);
                let (sin, cos) = turn.sin_cos();
                let point = |i: u32| {
                    let [x, y] = step.map(|it| it * f64::from(i));
                    let t_ns = NOW_NS + i64::from(i) * 1_000_000;
                    TrajectoryPoint { t_ns, x: ahead - x.abs(), y, cos, sin }
                };
                scene.points = (0..1024).map(point).collect();
                scene.tracks = None;
                let is_met = |scene: &Scene| {
                    scene.failure_of_iv().is_some_and(|it| it.rule != Rule::Collision)
                };
                scene.detections = Some(vec![detection(-8.0, 60.0)]);
                is_met(&scene);
                // What stands in the CAV is met at p, whatever follows.
                scene.detections = Some(vec![detection(1.4, 0.0)]);
                assert!(scene.failure_of_iv().is_some(), "{turn} {step:?} {ahead}");
            }
        }
    }
}

/// The grid is what ends the search of stage v on a path of 9.2e6 m.
#[test]
fn a_cell_at_the_end_of_the_grid_is_found() {
    let mut scene = farthest();
    scene.detections = Some(vec![]);
    // The grid begins 100 m behind and beside the CAV.
    scene.parameters.n = 64;
    scene.occupied = Some(vec![0; 5000]);
    let bit: usize = 10 * 200 + 199;
    scene.occupied.as_mut().expect("a grid")[bit / 8] |= 1 << (bit % 8);
    scene.change = |cycle| {
        if let Some(Grid { resolution, .. }) = &mut cycle.grid {
            *resolution = 10.0;
        }
    };
    let (_, witness) = scene.failure().expect("a cell on the way");
    assert_eq!((witness.rule, witness.cell), (Rule::Occupied, Some((199, 10))));
}

/// INPUT-04: neighbouring points of the reference path have to differ; how far apart they are does not matter.
#[test]
fn points_of_the_route_may_be_hardly_apart() {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    let first = scene.cross_sections[2];
    assert_eq!((first.x, first.y, scene.rule()), (0.0, 0.0, None));
    scene.cross_sections.insert(3, CrossSection { x: 1e-80, ..first });
    assert_eq!(scene.rule(), None);
    scene.points[0].y = 2.5;
    assert_eq!(scene.rule(), Some(Rule::ThetaMap), "2.5 m beside the reference path");
}
