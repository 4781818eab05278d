//! The fail-safe rule on both sides of each clause (H-14, `spec/hardened/H-14.md`). The CAV drives at
//! 5 m/s along y = 0; its rectangle reaches 3.65 m ahead of its position and 0.95 m to either side.
//! `s_stop` is 2.270_625 m, T is 0.7625 s, and from `s_b`, 1.5625 m, on it may stand.

use crate::scene::{NOW_NS, Scene, scene, track};
use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::report::{Rule, Stage};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

const MS: i64 = 1_000_000;
const S_STOP: f64 = 2.270_625;
const TAU: f64 = 0.1;
const T: f64 = 0.7625;
/// Lists are so old, s.
pub(crate) const AGE: f64 = 0.01;
/// Half the lengths of the CAV, with its offset, and of a track.
pub(crate) const FRONT: f64 = 1.4 + 2.25 + 2.0;
/// Half the widths of both.
pub(crate) const BESIDE: f64 = 0.95 + 1.0;

/// A scene without stage i and stage iii, with these as tracks alone.
pub(crate) fn with(tracks: Vec<Track>) -> Scene {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    (scene.tracks, scene.detections) = (Some(tracks), None);
    scene
}

pub(crate) fn moving(x: f64, y: f64, [vx, vy]: [f64; 2]) -> Track {
    Track { vx, vy, ..track(1, x, y) }
}

pub(crate) fn met(scene: &Scene) -> bool {
    scene.fails_by(Rule::FailSafe)
}

/// Whether one track is met, 1e-7 m less and more than at a place.
fn sides(at: impl Fn(f64) -> Track) -> [bool; 2] {
    [-1e-7, 1e-7].map(|off| met(&with(vec![at(off)])))
}

#[test]
fn what_stands_is_met_up_to_s_stop() {
    assert_eq!(sides(|off| track(1, S_STOP + FRONT + off, 0.0)), [true, false]);
    assert_eq!(sides(|off| track(1, 1.0, BESIDE + off)), [true, false]);
    let scene = with(vec![track(1, S_STOP + FRONT - 1e-7, 0.0)]);
    let (stage, witness) = scene.failure().expect("the last place");
    assert_eq!((stage, witness.rule, witness.track), (Stage::Iv, Rule::FailSafe, Some(1)));
    // 30 points; p, and 9 places of 0.25 m up to 2.25 m, and the last one.
    assert_eq!(witness.point, Some(30 + 10));
    assert!(witness.compared.iter().all(|way| (way - S_STOP).abs() < 1e-12));
    let mut paper = scene;
    paper.profile = Profile::PAPER;
    assert_eq!(paper.rule(), None);
}

#[test]
fn in_every_configuration_it_is_a_failure_of_stage_iv() {
    for configuration in [MotRemote, AllRemote, PlanRemote] {
        let mut scene = with(vec![moving(6.0, -8.0, [0.0, 8.0])]);
        scene.configuration = configuration;
        scene.parameters.safety_time = 0.0;
        let failure = scene.failure().map(|(stage, it)| (stage, it.rule, it.track));
        assert_eq!(failure, Some((Stage::Iv, Rule::FailSafe, Some(1))), "{configuration:?}");
        scene.tracks = Some(Vec::new());
        assert_eq!(scene.rule(), None);
        scene.detections = Some(Vec::new());
        assert_eq!(scene.rule(), None, "nothing is there");
    }
}

/// A trajectory that ends at once: straight on. One that begins behind the CAV or at most 1/8 m ahead:
/// from the first point on that is farther.
#[test]
fn the_path_goes_straight_on_and_begins_ahead() {
    let touching = |scene: &mut Scene, off: f64| {
        scene.tracks = Some(vec![track(1, S_STOP + FRONT + off, 0.0)]);
        met(scene)
    };
    let mut scene = with(Vec::new());
    scene.points.truncate(1);
    assert!(touching(&mut scene, -1e-7) && !touching(&mut scene, 1e-7));
    // The way aside to a second point is none when that is no node: it is 1/8 m ahead.
    for (ahead, aside) in [(0.125, 0.0), (0.125 + 1e-6, 0.05)] {
        let mut scene = with(vec![track(1, 1.0, BESIDE + 0.04)]);
        scene.points = vec![point(0.0, 0.0), point(ahead, 0.05)];
        scene.points[1].t_ns += 50 * MS;
        assert_eq!(met(&scene), aside > 0.04, "{ahead}");
    }
}

fn point(x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: NOW_NS, x, y, cos: 1.0, sin: 0.0 }
}

/// Aside by a of the first point, half the CAV is wider by a, to both sides.
#[test]
fn beside_its_trajectory_the_cav_is_wider() {
    for side in [1.0, -1.0] {
        let [inner, outer] = [-1e-7, 1e-7].map(|off| {
            // The path leads from y = 0.3 m to y = 0.
            let from = if side > 0.0 { 0.3 } else { 0.0 };
            let mut scene = with(vec![track(1, 0.5, from + side * (BESIDE + 0.3 + off))]);
            scene.ego.y = 0.3;
            met(&scene)
        });
        assert!(inner && !outer, "{side}");
    }
}

/// The way of a place is what decides, and the last one is where it is `s_stop`: a trajectory along an
/// arc, far from every place but the last.
#[test]
fn places_are_those_of_the_text() {
    let mut scene = with(Vec::new());
    for section in &mut scene.cross_sections {
        (section.left[1], section.right[1]) = (40.0, -40.0);
    }
    let (radius, step) = (20.0_f64, 0.5_f64);
    for (i, it) in scene.points.iter_mut().enumerate() {
        let angle = step * i as f64 / radius;
        (it.sin, it.cos) = angle.sin_cos();
        (it.x, it.y) = (radius * it.sin, radius * (1.0 - it.cos));
    }
    // Pieces of 0.499_99 m, each of two places; the last place is on the fifth.
    let nodes: Vec<_> = scene.points[..6].to_vec();
    let (mut way, mut last) = (0.0, None);
    for pair in nodes.windows(2) {
        let (u, v) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        let advance = u * pair[0].cos + v * pair[0].sin;
        if way + advance > S_STOP && last.is_none() {
            let share = (S_STOP - way) / advance;
            last = Some((pair[0].x + share * u, pair[0].y + share * v, pair[0]));
        }
        way += advance;
    }
    let (x, y, node) = last.expect("a way beyond s_stop");
    for (off, expected) in [(-1e-7, true), (1e-7, false)] {
        let ahead = FRONT + off;
        let there = track(1, x + ahead * node.cos, y + ahead * node.sin);
        scene.tracks = Some(vec![Track { cos: node.cos, sin: node.sin, ..there }]);
        assert_eq!(met(&scene), expected, "{off}");
    }
    let (_, witness) = {
        let there = track(1, x + (FRONT - 1e-7) * node.cos, y + (FRONT - 1e-7) * node.sin);
        scene.tracks = Some(vec![Track { cos: node.cos, sin: node.sin, ..there }]);
        scene.failure().expect("the last place")
    };
    // p, one place on each of four pieces and their ends, and one on the fifth before the last one.
    assert_eq!(witness.point, Some(30 + 10));
}

/// What drives across before the CAV gets there, and leaves: it sweeps the places ahead before their
/// windows begin.
#[test]
fn windows_begin_when_the_cav_may_be_near() {
    // At 8.5 m ahead of p nothing of the CAV is before s_stop; at x the CAV is when its front is.
    let first = |f: f64| {
        let (v_tau, s_tau) = (5.3, 0.515);
        0.1 + (v_tau - (v_tau * v_tau - 16.0 * (f - s_tau)).sqrt()) / 8.0
    };
    // The rear edge of the track, 2 m wide along x, is at 5.25 m: of the places from 1.75 m on, which
    // follows that of 1.5 m. The rear of a track that goes on leaves at 0.95 m.
    let x = 1.75 + FRONT - 2.0 + 1.0;
    let leaves = first(1.5) + AGE;
    let speed = 20.0;
    // It brakes as hard as a_b: where it is at least.
    let gone = speed * leaves - 4.0 * leaves * leaves;
    let crossing = |off: f64| Track {
        cos: 0.0,
        sin: 1.0,
        ..moving(x - 1e-7, 0.95 + 2.0 - gone - off, [0.0, speed])
    };
    assert_eq!(sides(crossing), [false, true]);
}

/// What comes late, to a place that the CAV passes: its window ends when the CAV has left the next one,
/// braking at once.
#[test]
fn windows_end_where_the_cav_cannot_stand() {
    // The rear edge of the CAV is at -0.85 m + way. A track 2 m wide along x reaches to 0.15 m: it is
    // touched up to the place of 1 m; the next one is left at last(1.25 m).
    let last = (5.0 - (25.0_f64 - 16.0 * 1.25).sqrt()) / 8.0;
    let x = -0.85 + 1.0 - 1.0;
    let speed = 10.0;
    let comes = (last + AGE) * speed;
    let crossing = |off: f64| Track {
        cos: 0.0,
        sin: 1.0,
        ..moving(x + 1e-7, -0.95 - 2.0 - comes + off, [0.0, speed])
    };
    assert_eq!(sides(crossing), [false, true]);
}

/// Where the CAV may stand: until tau + 2 s and as long as the other one needs to stop at 3 m/s^2, and
/// until T at least; up to T where it comes across the CAV as it is now.
#[test]
fn who_comes_late_can_stop() {
    let speed = 6.0;
    for (t_yield, a_yield) in [(2.0, 3.0), (0.0, 100.0), (30.0, 1.0)] {
        let latest = T.max(TAU + t_yield + speed / (2.0 * a_yield));
        let comes = (latest + AGE) * speed;
        // Only the last places reach 4.9 m + 1 m.
        let found = [-1e-7, 1e-7].map(|off| {
            let y = -0.95 - 2.0 - comes + off;
            let crossing = Track { cos: 0.0, sin: 1.0, ..moving(6.5, y, [0.0, speed]) };
            let mut scene = with(vec![crossing]);
            (scene.parameters.t_yield, scene.parameters.a_yield) = (t_yield, a_yield);
            met(&scene)
        });
        assert_eq!(found, [false, true], "{t_yield}");
    }
}

/// From the side into the CAV as it is now: at its place it is met up to T alone, less 0.3 m on each side.
#[test]
fn who_comes_across_is_met_up_to_t() {
    let speed = 6.0;
    let latest = |inside: f64, seconds: f64| {
        let found = [-1e-7, 1e-7].map(|off| {
            let comes = (seconds + AGE) * speed;
            // Its side is so far inside of the CAV's front, 3.65 m; it is 2 m wide along x.
            let (x, y) = (3.65 - inside + 1.0, -0.95 - 2.0 - comes + off);
            met(&with(vec![Track { cos: 0.0, sin: 1.0, ..moving(x, y, [0.0, speed]) }]))
        });
        found == [false, true]
    };
    let late = TAU + 2.0 + speed / 6.0;
    assert!(latest(0.3 + 1e-6, T) && !latest(0.3 + 1e-6, late));
    assert!(latest(0.3 - 1e-6, late) && !latest(0.3 - 1e-6, T));
}

/// A leader that brakes at a_b from when it was seen: where it stops it is met, or not.
#[test]
fn an_object_may_brake() {
    for speed in [2.0_f64, 3.0] {
        let stops = speed * speed / 16.0;
        let found = sides(|off| moving(S_STOP + FRONT - stops + off, 0.0, [speed, 0.0]));
        assert_eq!(found, [true, false], "{speed}");
    }
}

/// Behind the CAV's rear, which is at -0.85 m, and in its way or to 45 degrees: it keeps its distance.
#[test]
fn who_follows_is_not_examined() {
    let rear = -0.85 - 2.0;
    for (x, expected) in [(rear - 0.1 - 1e-6, false), (rear - 0.1 + 1e-6, true)] {
        // Moved by its age, at 10 m/s.
        assert_eq!(met(&with(vec![moving(x, 0.0, [10.0, 0.0])])), expected, "{x}");
    }
    // To 45 degrees from afar, if it comes across.
    for (across, expected) in [(30.0 - 1e-5, false), (30.0 + 1e-5, true)] {
        let scene = with(vec![moving(-15.4, -13.4, [30.0, across])]);
        assert_eq!(met(&scene), expected, "{across}");
    }
    // From 7.5 m on as far as it goes along: a sine of 0.3.
    for (off, expected) in [(-1e-6, false), (1e-6, true)] {
        let (along, across) = (20.0 * (1.0 - 0.09_f64).sqrt(), 20.0 * (0.3 + off));
        let scene = with(vec![moving(-7.5 - AGE * along, -AGE * across, [along, across])]);
        assert_eq!(met(&scene), expected, "{off}");
    }
    // Not what comes from before it or beside it.
    assert!(met(&with(vec![moving(6.0, -6.0, [-3.0, 6.0])])));
    assert!(met(&with(vec![moving(1.0, -4.0, [1.0, 6.0])])));
}

/// Behind a CAV that goes to the left of its lane, with a lane of its own there: beside the path as the
/// reference path has it, though not along straight lines. (`naive` has roads that bend.)
#[test]
fn who_keeps_beside_the_path_is_not_examined() {
    // The CAV goes to the left by 0.05 in 1, and reaches farther there than to its side.
    let sin = 0.05_f64;
    let cos = (1.0 - sin * sin).sqrt();
    let pass = |at: Track, change: &dyn Fn(&mut Scene)| {
        let mut scene = with(vec![at]);
        for section in &mut scene.cross_sections {
            (section.left[1], section.right[1]) = (20.0, -20.0);
        }
        (scene.ego.sin, scene.ego.cos) = (sin, cos);
        for (point, i) in scene.points.iter_mut().zip(0..) {
            let way = 0.5 * f64::from(i);
            (point.x, point.y, point.sin, point.cos) = (way * cos, way * sin, sin, cos);
        }
        change(&mut scene);
        !met(&scene)
    };
    // D_k + E_k of the last place.
    let least = (S_STOP + 1.4) * sin + 0.5 * (cos * 1.9 + sin * 4.5);
    // Behind, what drifts by a tenth of its way or less keeps to its lane. It passes the CAV as that is
    // now, and comes before it farther on.
    let behind = |drift: f64| Track {
        vy: -drift,
        ..moving(-6.0, least + 2.15 + drift * AGE, [(400.0 - drift * drift).sqrt(), 0.0])
    };
    assert!(pass(behind(2.0 - 1e-6), &|_| ()));
    assert!(!pass(behind(2.0 + 1e-6), &|_| ()));
    // There is nothing beside a path beyond the ends of the route, nor beside one that turns off.
    for (off, expected) in [(-1e-6, true), (1e-6, false)] {
        let begins = |scene: &mut Scene| {
            scene.cross_sections.remove(1);
            scene.cross_sections[0].x = -6.0 + (400.0_f64 - 3.61).sqrt() * AGE + off;
        };
        assert_eq!(pass(behind(1.9), &begins), expected, "{off}");
        let ends = |scene: &mut Scene| {
            scene.cross_sections.truncate(3);
            let last = &mut scene.cross_sections[2];
            last.x = (S_STOP + 1.4) * cos - off;
            (last.left[0], last.right[0]) = (40.0, 40.0);
        };
        assert_eq!(pass(behind(1.9), &ends), expected, "{off}");
        // At the way of 0.5 m 0.05 and 0.5 / 30.
        let turns = |scene: &mut Scene| {
            let most = 0.05 + 0.5 / 30.0 + off;
            let angle = sin.asin() + most.asin();
            (scene.points[1].sin, scene.points[1].cos) = angle.sin_cos();
        };
        assert_eq!(pass(behind(1.9), &turns), expected, "{off}");
    }
}

/// The line of the CAV's heading: 0.5 m and 0.17 of f, and 5.75 m/s^2 of the square of the time to there
/// when it brakes.
#[test]
fn the_path_has_to_be_within_reach() {
    let (f, mut found) = (1.0_f64, Vec::new());
    let t = (5.0 - (25.0 - 16.0 * f).sqrt()) / 8.0;
    let bound = 0.5 + 0.17 * f + 5.75 * t * t;
    for off in [-1e-7, 1e-7] {
        let mut scene = with(Vec::new());
        scene.ego.width = 4.0;
        for section in &mut scene.cross_sections {
            (section.left[1], section.right[1]) = (40.0, -40.0);
        }
        // The heading of the first piece is that of the CAV, and leads to a point aside; what follows is
        // farther than s_b.
        scene.points =
            vec![point(f, bound + off), point(1.6, bound + off), point(2.5, bound + off)];
        for (point, i) in scene.points.iter_mut().zip(0..) {
            point.t_ns += i * 100 * MS;
        }
        scene.parameters.lateral_tolerance = 5.0;
        found.push(scene.failure().map(|(stage, it)| (stage, it.rule, it.point)));
        // At s_b it does not matter any more.
        scene.points.remove(0);
        assert_eq!(scene.rule(), None);
    }
    // 1.029 m to the side are five places, to that of the first point.
    assert_eq!(found[0], None);
    let (stage, rule, at) = found[1].expect("out of reach");
    assert_eq!((stage, rule), (Stage::Ii, Rule::Reach));
    assert_eq!(at, Some(3 + 5));
}

#[test]
fn the_witness_is_the_first_in_the_order_place_then_motion() {
    // Both are met at p; the first track is the first motion, whoever is seen first.
    let beside = |id, x| Track { id, ..track(0, x, BESIDE - 1e-3) };
    let first = |tracks: Vec<Track>| {
        let (_, witness) = with(tracks).failure().expect("it is met");
        (witness.point, witness.track)
    };
    assert_eq!(first(vec![beside(7, 0.0), beside(8, 1.0)]), (Some(30), Some(7)));
    assert_eq!(first(vec![beside(8, 1.0), beside(7, 0.0)]), (Some(30), Some(8)));
    let far = |id| Track { id, ..track(0, S_STOP + FRONT - 1e-3, 0.0) };
    assert_eq!(first(vec![far(9), beside(7, 0.0)]), (Some(30), Some(7)));
}

/// 11 places and 30 points for each track.
#[test]
fn its_work_is_limited() {
    let limited = Some((Stage::Iv, Rule::WorkLimit));
    let mut scene = with(vec![track(1, 50.0, 30.0), track(2, 60.0, 30.0)]);
    assert_eq!(scene.failure_with_work(2 * 41), None);
    assert_eq!(scene.failure_with_work(2 * 41 - 1), limited);
}
