//! H-14: the mean motion of what the CAV saw itself is examined, whatever the remote side says.

use crate::claim::{Theorem, Wrong};
use crate::hardened::detection_history::{confirmed, origin_limit, stands_within, usable};
use crate::hardened::h14_fail_safe::motions::{Pair, pairs};
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::input::cycle::{Detection, DetectionList, Profile, Track, TrackList};
use crate::input::scene::Scene;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, forget_of_what_roots_are, given, less};
use crate::numbers::real::hole::open_number;
use crate::numbers::vector::Vector;
use crate::services::configuration::Configuration::MotRemote;
use crate::theorem::base::{self, NOW_NS};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "the_mean_motion_of_an_unexplained_detection_is_examined",
        statement: "H-14: if d and d' are items of the current and the reference list, abs(d - d') <= \
                    v_object dt, d is unexplained and d' supported, and d did not stand or moved evenly from d', \
                    (d, d') is examined as moving",
        domain: "all positions, v_object, theta_track_max > 0; the remote list is empty; d the only detection, d' \
                 the second of two items of 500 ms ago, its support one item of 300 ms ago",
        claim: || unexplained(true),
        wrong: Wrong { statement: "also without support", claim: || unexplained(false) },
    },
    Theorem {
        id: "the_motion_of_a_confirmed_track_is_examined_whatever_the_track_says",
        statement: "H-14: if d is the detection of a confirmed track and d' its own origin in the list \
                    nearest to 500 ms of those that hold one, and d did not stand or moved evenly from d', \
                    (d, d') is examined as moving",
        domain: "all positions, velocities of the track along x and y, theta_track_max, theta_velocity, v_object \
                 > 0; one track, one detection, two items of 500 ms ago, one of 300 ms ago",
        claim: || of_track(0),
        wrong: Wrong { statement: "and so is (d, d'') for every item d''", claim: || of_track(1) },
    },
    Theorem {
        id: "the_motion_of_a_detection_whose_track_has_the_past_of_another_is_examined",
        statement: "H-14, F-42: if d is the detection of a confirmed track whose own origin is a, an \
                    unexplained detection may come from a, and d may come from b, and did not stand or moved \
                    evenly from b, (d, b) is examined as moving",
        domain: "all positions, velocities of the track along x, theta_track_max, theta_velocity, v_object > 0; one \
                 track at its detection, another detection farther than theta_track_max; a and b the items of \
                 500 ms ago, b too far from its past, one item of 300 ms ago",
        claim: || disputed(true),
        wrong: Wrong {
            statement: "although nothing that is unexplained may come from a",
            claim: || disputed(false),
        },
    },
];

/// A detection anywhere, not longer than 1 m: its direction is not asked for.
fn anywhere(name: &str) -> Detection {
    let coordinate = |axis: &str| open_number(&format!("{name} {axis}"));
    Detection {
        x: coordinate("x"),
        y: coordinate("y"),
        cos: 1.0,
        sin: 0.0,
        length: 1.0,
        width: 1.0,
    }
}

fn list(millis: i64, items: Vec<Detection>) -> DetectionList {
    DetectionList { stamp_ns: NOW_NS - millis * 1_000_000, items }
}

/// Where `anywhere` is.
fn place(name: &str) -> Vector {
    let [x, y] = ["x", "y"].map(|axis| Real::named(&format!("{name} {axis}")));
    Vector { x, y }
}

/// A scene of MotRemote with these tracks and detections, the items a and b of 500 ms ago and s of 300 ms ago,
/// and parameters above 0.
fn scene(tracks: Vec<Track>, detections: &[&str]) -> Scene {
    let mut cycle = base::cycle(Profile::HARDENED, MotRemote);
    cycle.tracks = Some(TrackList { stamp_ns: NOW_NS, items: tracks });
    cycle.detections = Some(list(0, detections.iter().copied().map(anywhere).collect()));
    cycle.detection_history =
        vec![list(300, vec![anywhere("s")]), list(500, vec![anywhere("a"), anywhere("b")])];
    let p = &mut cycle.parameters;
    for (name, parameter) in [
        ("theta_track_max", &mut p.theta_track_max),
        ("theta_velocity", &mut p.theta_velocity),
        ("v_object", &mut p.v_object),
    ] {
        *parameter = open_number(name);
        given(less(&Real::zero(), &Real::named(name)));
    }
    let scene = base::scene(&cycle);
    assert_eq!(scene.configuration, MotRemote, "tracks are received");
    scene
}

/// Assumes that abs(vector) <= limit.
fn given_within(vector: &Vector, limit: &Real) {
    given(at_most(&vector.length(), limit));
}

/// Assumes that the detection may come from the item of 500 ms ago, the support being that of 300 ms ago.
fn given_may_come_from(scene: &Scene, detection: &str, item: &str) {
    given_slow(scene, detection, item);
    // 0.3 s, and 0.2 s between the two lists.
    let bend = a_tyre(&scene.parameters.a_b) * Real::ratio(3, 100);
    given_within(&from_support(detection, item), &(&scene.parameters.theta_track_max + bend));
}

/// Assumes that the detection is at most v_object dt from the item of 500 ms ago.
fn given_slow(scene: &Scene, detection: &str, item: &str) {
    let moved = &place(detection) - &place(item);
    given_within(&moved, &(&scene.parameters.v_object * Real::ratio(1, 2)));
}

/// Where d was 300 ms ago, d - w dt' with w = (d - d') / 0.5 s and dt' = 0.3 s, from the item of that time.
fn from_support(detection: &str, item: &str) -> Vector {
    let [d, before, support] = [detection, item, "s"].map(place);
    let then = &d - &(&d - &before).scaled(&Real::ratio(3, 5));
    &then - &support
}

/// Assumes that the detection is not where the item of 300 ms ago was, or moved evenly from that of 500 ms ago.
fn given_not_stood(detection: &str, item: &str) {
    let from_there = (&place(detection) - &place("s")).length();
    let moved_evenly = at_most(&from_support(detection, item).length(), &stands_within());
    given(Formula::Any(vec![less(&stands_within(), &from_there), moved_evenly]));
}

fn unexplained(supported: bool) -> Formula {
    forget_of_what_roots_are();
    let scene = scene(Vec::new(), &["d"]);
    if supported {
        given_may_come_from(&scene, "d", "b");
    } else {
        given_slow(&scene, "d", "b");
    }
    given_not_stood("d", "b");
    Formula::from(is_examined(&scene, [0, 1]))
}

/// Whether the detection and the item of 500 ms ago are examined as moving.
fn is_examined(scene: &Scene, [detection, item]: [usize; 2]) -> bool {
    let Some(list) = &scene.detections else { return false };
    let lists = usable(scene);
    let examined = pairs(scene, list, &lists, &confirmed(scene));
    let is_it =
        |it: &Pair<'_>| (it.detection, it.item, it.list.age_ns) == (detection, item, 500_000_000);
    examined.iter().any(is_it)
}

/// A track anywhere, not longer than 1 m.
fn says() -> Track {
    Track {
        id: 1,
        x: open_number("p x"),
        y: open_number("p y"),
        cos: 1.0,
        sin: 0.0,
        vx: open_number("v x"),
        vy: open_number("v y"),
        length: 1.0,
        width: 1.0,
    }
}

fn disputed(by_another: bool) -> Formula {
    forget_of_what_roots_are();
    let track = Track { x: open_number("c x"), y: open_number("c y"), vy: 0.0, ..says() };
    let scene = scene(vec![track], &["c", "d"]);
    let p = &scene.parameters;
    let past = |dt: Real| {
        let v = Vector { x: Real::named("v x"), y: Real::zero() };
        &place("c") - &v.scaled(&dt)
    };
    // The track is confirmed: c is its detection, a and s are its origins.
    given(less(&p.theta_track_max, &(&place("c") - &place("d")).length()));
    given(less(
        &origin_limit(&scene, &Real::ratio(1, 2)),
        &(&past(Real::ratio(1, 2)) - &place("b")).length(),
    ));
    if by_another {
        given_may_come_from(&scene, "d", "a");
    }
    given_may_come_from(&scene, "c", "b");
    given_not_stood("c", "b");
    let is_confirmed =
        confirmed(&scene).first().is_some_and(|(_, seen)| seen.own_origins[1] == Some(0));
    Formula::from(!is_confirmed || is_examined(&scene, [0, 1]))
}

fn of_track(all: usize) -> Formula {
    let scene = scene(vec![says()], &["d"]);
    let confirmed = confirmed(&scene);
    let Some((_, seen)) = confirmed.first() else { return Formula::Known(true) };
    // Two lists: a backed track has its own origin in both.
    let (Some(d), Some(origin)) = (seen.detection, seen.own_origins[1]) else {
        return Formula::Known(false);
    };
    given_not_stood("d", ["a", "b"][origin]);
    let examined = |item: usize| is_examined(&scene, [d, item]);
    Formula::from(examined(origin) && (all == 0 || (0..2).all(examined)))
}
