//! H-14 counts its steps, and ends once there are too many (`spec/4-arithmetic.md#steps`).

use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::AllRemote;

use crate::scene::{Scene, scene, track};

/// Tracks that stand 6 nm beside all places of the CAV, so that each is asked about.
fn beside(count: i64) -> Scene {
    let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
    scene.tracks = Some((0..count).map(|id| track(id, 4.0, 1.95 + 6e-9)).collect());
    scene.detections = Some(Vec::new());
    scene
}

/// The least limit with which H-14 passes: the steps that it takes.
fn taken(scene: &mut Scene) -> i64 {
    let (mut fails, mut passes) = (0, 1 << 40);
    while passes - fails > 1 {
        let limit = (fails + passes) / 2;
        scene.parameters.work_limit = limit;
        match scene.failure_of_iv() {
            None => passes = limit,
            Some(witness) => {
                assert_eq!(witness.rule, Rule::WorkLimit);
                assert!(witness.compared[0] > witness.compared[1]);
                fails = limit;
            }
        }
    }
    passes
}

/// IMPL-10, H-14.51: the steps of twice as many tracks are twice as many, and never more than the most that
/// sizes say; a track costs a place at least.
#[test]
fn steps_are_counted_and_no_more_than_sizes_say() {
    let one = taken(&mut beside(1));
    assert!(one > 160 + 160, "{one}");
    for count in [2, 16, 100] {
        let mut scene = beside(count);
        assert_eq!(taken(&mut scene), one * count);
        scene.parameters.work_limit = i64::MAX;
        let most = scene.steps().fail_safe;
        assert!(one * count < i64::try_from(most).expect("steps"), "{most}");
    }
}
