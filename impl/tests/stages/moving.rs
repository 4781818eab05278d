//! Detections that move as the CAV saw them move (H-13 of `spec/3-stages.md#hardened-profile`), on
//! both sides of the thresholds. The CAV drives at 5 m/s along y = 0; it is 3.65 m long ahead of its
//! position and 0.95 m wide to either side, and its motion is examined for 3.8 m and a point.

use crate::scene::{Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track};
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::{Rule, Stage};
use mufasa::services::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};

const MS: i64 = 1_000_000;

/// A car that comes from the right at 8 m/s and is 6 m aside now.
fn crossing(configuration: Configuration) -> Scene {
    let mut scene = scene(Hardened, configuration, [0.0, 0.0]);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -6.0)]);
    scene.history = vec![(300 * MS, vec![before(0.3)]), (500 * MS, vec![before(0.5)])];
    scene
}

fn before(seconds: f64) -> Detection {
    detection(5.0, -6.0 - 8.0 * seconds)
}

fn collides(scene: &Scene) -> bool {
    scene.fails_by(Rule::CollisionMoving)
}

#[test]
fn a_car_that_crosses_and_is_left_out_is_met() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut scene = crossing(configuration);
        if configuration == PlanRemote {
            scene.tracks = None;
        }
        let (stage, witness) = scene.failure().expect("it crosses");
        assert_eq!((stage, witness.rule), (Stage::Iv, Rule::CollisionMoving), "{configuration:?}");
        // 4.05 m at 8 m/s; the first point is 10 ms after the detections.
        assert_eq!((witness.point, witness.detection), (Some(5), Some(1)));
        assert_eq!((witness.item, witness.age_ns), (Some(0), Some(500 * MS)));
        scene.history.clear();
        assert!(!collides(&scene), "standing, it is beside the road");
    }
    // With current tracks stage iii runs, and stage iv does not.
    let mut scene = crossing(PlanRemote);
    scene.tracks = Some(vec![track(1, 3.0, 50.0)]);
    assert!(!collides(&scene));
}

/// The last point examined is that after `s_stop`, 2.27 m: at 0.5 s, 0.51 s after the detections.
#[test]
fn it_is_where_it_moves_to() {
    for (aside, met) in [(1e-7, true), (-1e-7, false)] {
        let mut scene = crossing(MotRemote);
        scene.parameters.tau_motion = 0.0;
        // The rectangles are 1.95 m wide to the side together.
        let at = |seconds: f64| detection(5.0, -1.95 + aside + 4.0 * (seconds - 0.51));
        scene.detections = Some(vec![detection(3.0, 50.1), at(0.0)]);
        scene.history = [300, 500].map(|ms| (ms * MS, vec![at(ms as f64 * -1e-3)])).to_vec();
        assert_eq!(collides(&scene), met, "{aside}");
    }
}

#[test]
fn another_list_has_to_support_it() {
    for (off, met) in [(1.0 - 1e-7, true), (1.0 + 1e-7, false)] {
        let mut scene = crossing(MotRemote);
        scene.history[0].1[0].x += off;
        assert_eq!(collides(&scene), met, "{off}");
        scene.history.insert(1, (400 * MS, vec![before(0.4)]));
        assert!(collides(&scene), "one of two");
    }
    let mut alone = crossing(MotRemote);
    alone.history.remove(0);
    assert!(collides(&alone), "there is no other list");
    alone.history.insert(0, (300 * MS, vec![]));
    assert!(!collides(&alone), "there is, and it is empty");
}

#[test]
fn nothing_faster_than_v_object_is_looked_for() {
    for (v_object, met) in [(8.0 + 1e-6, true), (8.0 - 1e-6, false)] {
        let mut scene = crossing(MotRemote);
        scene.parameters.v_object = v_object;
        assert_eq!(collides(&scene), met, "{v_object}");
    }
}

/// The reference list is the one nearest to 500 ms, the younger of two: an item of another list,
/// with which the car would stand, is none of it.
#[test]
fn the_reference_list_is_nearest_to_500_ms() {
    for (ages_ms, reference) in
        [([300, 500], 500), ([400, 600], 400), ([399, 600], 600), ([250, 700], 700)]
    {
        let mut scene = crossing(MotRemote);
        scene.history = ages_ms.map(|ms| (ms * MS, vec![before(ms as f64 * 1e-3)])).to_vec();
        let (_, witness) = scene.failure().expect("it crosses");
        assert_eq!(witness.age_ns, Some(reference * MS), "{ages_ms:?}");
    }
}

/// Motion is examined `tau_motion` `v_now` farther than `s_stop`, which is 2.27 m.
#[test]
fn tau_motion_looks_farther() {
    // It gets to the CAV's way after 0.51 s, when the CAV has driven 2.5 m; and only 6.1 m ahead.
    for (tau_motion, met) in [(0.3, true), (0.0, false)] {
        let mut scene = crossing(MotRemote);
        scene.parameters.tau_motion = tau_motion;
        let shifted = |item: &Detection| Detection { x: item.x + 3.3, ..*item };
        scene.detections = Some(vec![detection(3.0, 50.1), shifted(&detection(5.0, -6.0))]);
        for (_, items) in &mut scene.history {
            items[0] = shifted(&items[0]);
        }
        assert_eq!(collides(&scene), met, "{tau_motion}");
    }
}

/// The car, as a track that is confirmed: seen where it was, and nowhere else.
fn confirmed(velocity: f64) -> Scene {
    let mut scene = crossing(MotRemote);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -4.5)]);
    let car = Track { vy: velocity, ..track(2, 5.0, -4.5) };
    scene.tracks = Some(vec![track(1, 3.0, 50.0), Track { cos: 0.0, sin: 1.0, ..car }]);
    scene.history = [300, 500]
        .map(|ms| (ms * MS, vec![detection(5.0, -4.5 - velocity * ms as f64 * 1e-3)]))
        .to_vec();
    scene
}

/// What a confirmed track explains is not looked for in every item: a thing 4 m farther half a
/// second ago, with support, would be a car that crosses.
#[test]
fn an_explained_detection_comes_from_its_past_alone() {
    let with_others = |mut scene: Scene| {
        for (age_ns, items) in &mut scene.history {
            items.push(detection(5.0, -4.5 - 8.0 * *age_ns as f64 * 1e-9));
        }
        scene
    };
    let scene = with_others(confirmed(0.0));
    assert!(!collides(&scene));
    let mut unexplained = with_others(confirmed(0.0));
    unexplained.tracks = Some(vec![track(1, 3.0, 50.0)]);
    assert!(collides(&unexplained));
    // A list that is not current explains nothing.
    let mut old = with_others(confirmed(0.0));
    old.track_age_ns = 91 * MS;
    assert!(collides(&old));
    // A detection is the evidence of one track.
    let mut shared = with_others(confirmed(0.0));
    shared.parameters.theta_tr = 0.5;
    shared.tracks.as_mut().expect("tracks").push(track(3, 5.0, -5.4));
    shared.detections.as_mut().expect("detections").push(detection(5.0, -6.35));
    assert!(collides(&shared));
}

/// 2 m/s and a tenth of the speed across the direction of the detection, which is along x: away from
/// the road.
#[test]
fn what_moves_across_its_detection_is_not_confirmed() {
    for (speed, explained) in [(20.0 / 9.0 - 1e-7, true), (20.0 / 9.0 + 1e-7, false)] {
        let mut scene = confirmed(-speed);
        for (age_ns, items) in &mut scene.history {
            items.push(detection(5.0, -4.5 - 8.0 * *age_ns as f64 * 1e-9));
        }
        scene.detections.as_mut().expect("detections")[1].length = 4.0;
        assert_eq!(!collides(&scene), explained, "{speed}");
        scene.detections.as_mut().expect("detections")[1].length = 1.0;
        assert!(!collides(&scene), "no direction that is known");
    }
    let mut scene = confirmed(-20.0 / 9.0);
    scene.detections.as_mut().expect("detections")[1].length = 4.0;
    assert_eq!(scene.rule(), Some(Rule::Ambiguous));
}

/// (a): from each item as near to the past as an origin may be, 2 m at 500 ms.
#[test]
fn a_confirmed_track_may_come_from_every_item_near_its_past() {
    for (away, met) in [(2.0 - 1e-7, true), (2.0 + 1e-7, false)] {
        let mut scene = confirmed(0.0);
        // 2.5 m in 0.61 s.
        scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -4.4)]);
        scene.tracks = Some(vec![track(1, 3.0, 50.0), track(2, 5.0, -4.4)]);
        scene.history = vec![
            (300 * MS, vec![detection(5.0, -4.4)]),
            (500 * MS, vec![detection(5.0, -4.4 - away), detection(5.0, -4.3)]),
        ];
        assert_eq!(collides(&scene), met, "{away}");
        if met {
            let (_, witness) = scene.failure().expect("it crosses");
            let at = (witness.detection, witness.item, witness.age_ns);
            assert_eq!(at, (Some(1), Some(0), Some(500 * MS)));
        }
        // The list nearest to 500 ms that holds its own origin: here the other one.
        let mut other = scene.clone();
        other.history[1].1[1] = detection(5.0, -4.3 + 9.0);
        other.history[1].1[0] = detection(5.0, -4.4 - 2.1);
        other.history.push((800 * MS, vec![detection(5.0, -4.4)]));
        assert!(!collides(&other));
    }
}

#[test]
fn its_work_is_limited() {
    let mut scene = crossing(MotRemote);
    scene.detections = Some(vec![detection(3.0, 50.1), detection(5.0, -60.0)]);
    scene.tracks = Some(vec![]);
    scene.parameters.work_limit = 1_000;
    assert_eq!(scene.rule(), None);
    scene.parameters.work_limit = 2;
    assert_eq!(
        scene.failure().map(|(stage, it)| (stage, it.rule)),
        Some((Stage::Iv, Rule::WorkLimit))
    );
    // Two detections, one item in each of two lists, 30 points.
    scene.parameters.work_limit = 2 * (2 + 30);
    assert_eq!(scene.rule(), None);
    scene.parameters.work_limit -= 1;
    assert_eq!(scene.rule(), Some(Rule::WorkLimit));
    // A detection that a confirmed track explains is work, too (a).
    let mut scene = confirmed(3.0);
    scene.parameters.work_limit = i64::MAX;
    assert_eq!(scene.rule(), None);
    scene.parameters.work_limit = 1;
    assert_eq!(scene.rule(), Some(Rule::WorkLimit));
}

/// (c): the car from the right, at 8 m/s, is in the CAV's way from 1.01 s on, so that it is met at
/// the tenth point. In any case the points up to the eighth are examined, at 4 m.
fn later(x: f64) -> Scene {
    let mut scene = scene(Hardened, MotRemote, [0.0, 0.0]);
    let at = |seconds: f64| detection(x, -1.5 + 8.0 * (seconds - 1.01));
    scene.detections = Some(vec![detection(3.0, 50.1), at(0.0)]);
    scene.history = [300, 500].map(|ms| (ms * MS, vec![at(ms as f64 * -1e-3)])).to_vec();
    scene
}

/// The front is at 7.65 m then; the car is 2 m long to either side of its way.
#[test]
fn what_the_cav_may_wait_for_is_not_examined_on() {
    for (x, met) in [(9.65 - 1e-7, true), (9.65 + 1e-7, false)] {
        let scene = later(x);
        assert_eq!(collides(&scene), met, "{x}");
        let (stage, witness) = later(9.0).failure().expect("it comes into the way");
        assert_eq!((stage, witness.rule), (Stage::Iv, Rule::CollisionMoving));
        assert_eq!((witness.point, witness.detection), (Some(10), Some(1)));
        assert_eq!((witness.item, witness.age_ns), (Some(0), Some(500 * MS)));
    }
    // Where the front is when the trajectory ends there.
    let mut short = later(9.0);
    short.points.truncate(9);
    assert_eq!(short.failure_of_iv(), None);
    short = later(9.0);
    short.points.truncate(11);
    assert!(short.failure_of_iv().is_some());
    // It drives away from where the CAV would wait.
    let mut away = later(9.0);
    for (_, items) in &mut away.history {
        let now = away.detections.as_ref().expect("detections")[1];
        items.iter_mut().for_each(|item| item.y = 2.0 * now.y - item.y);
    }
    assert!(!collides(&away));
}

/// The front is at 3.65 m now: what comes where the CAV is already is not helped by a refusal.
#[test]
fn what_the_cav_may_not_wait_for_at_first_is_not_examined_on() {
    for (x, met) in [(5.65 + 1e-7, true), (5.65 - 1e-7, false)] {
        assert_eq!(collides(&later(x)), met, "{x}");
    }
    // From behind, faster: it is there at 1.1 s.
    let mut behind = scene(Hardened, MotRemote, [0.0, 0.0]);
    let at = |seconds: f64| detection(2.5 + 13.0 * (seconds - 1.11), 0.0);
    behind.detections = Some(vec![detection(3.0, 50.1), at(0.0)]);
    behind.history = [300, 500].map(|ms| (ms * MS, vec![at(ms as f64 * -1e-3)])).to_vec();
    assert!(!collides(&behind));
}

/// One point after the other, as long as the CAV may not wait at the one before: here at the ninth.
#[test]
fn it_is_examined_until_the_cav_may_wait() {
    // It is met at the tenth point and not at the ninth, 10 m back.
    let mut back = later(9.0);
    assert_eq!(back.failure_of_iv().and_then(|witness| witness.point), Some(10));
    back.points[9].x = -10.0;
    assert_eq!(back.failure_of_iv(), None);
    // The ninth is examined in any case.
    let mut sooner = later(9.0);
    for item in sooner.detections.iter_mut().chain(sooner.history.iter_mut().map(|(_, it)| it)) {
        item.last_mut().expect("the car").y += 0.8;
    }
    let mut back = sooner.clone();
    assert_eq!(sooner.failure_of_iv().and_then(|witness| witness.point), Some(9));
    back.points[10].x = -10.0;
    back.points[8].y = 1e-3;
    assert_eq!(back.failure_of_iv().and_then(|witness| witness.point), Some(9));
}

/// Where something stands, but for less than any rounding, its velocity has a direction.
#[test]
fn the_least_velocity_counts() {
    for least in [f64::from_bits(1), 1e-300, 1e-100] {
        // Towards the road of the CAV, and away from it where it starts; else it never comes to where
        // the CAV would wait, or to where it starts, too.
        for (before, met) in
            [([1.0, -1.0], true), ([-1.0, -1.0], false), ([1.0, 0.0], false), ([0.0, 0.0], false)]
        {
            // At the eighth point the front is 0.35 m before it, at the ninth within.
            let mut scene = scene(Hardened, MotRemote, [-9.0, 0.0]);
            let at = |x: f64, y: f64| Detection { length: 2.0, ..detection(x, y) };
            scene.detections = Some(vec![detection(3.0, 50.1), at(0.0, 0.0)]);
            let [x, y] = before.map(|it: f64| it * least);
            scene.history = vec![(500 * MS, vec![at(x, y)])];
            scene.tracks = Some(vec![]);
            assert_eq!(collides(&scene), met, "{x:e} {y:e}");
        }
    }
}
