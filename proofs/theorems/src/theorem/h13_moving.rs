//! H-13: the mean motion of what the CAV saw itself is examined, whatever the remote side says.

use crate::hardened::detection_history::{confirmed, usable};
use crate::hardened::h13_moving::pairs;
use crate::input::cycle::{Detection, DetectionList, Profile, Track, TrackList};
use crate::input::scene::Scene;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, forget_of_what_roots_are, given, less};
use crate::numbers::real::hole::open_number;
use crate::numbers::vector::Vector;
use crate::services::configuration::Configuration::MotRemote;
use crate::theorem::base::{self, NOW_NS};
use crate::theorem::{Theorem, Wrong};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "the_mean_motion_of_an_unexplained_detection_is_examined",
        statement: "H-13 (b): if d and d' are items of the current and the reference list, abs(d - d') <= \
                    v_object dt, d is unexplained and d' supported, (d, d') is examined as moving",
        domain: "all positions, v_object, theta_track_max > 0; the remote list is empty; d the second of two \
                 detections, d' the second of two items of 500 ms ago, its support one item of 300 ms ago",
        claim: || unexplained(true),
        wrong: Wrong { statement: "also without support", claim: || unexplained(false) },
    },
    Theorem {
        id: "the_motion_of_a_confirmed_track_is_examined_whatever_the_track_says",
        statement: "H-13 (a): if d is the detection of a confirmed track and d' its own origin in the list \
                    nearest to 500 ms of those that hold one, (d, d') is examined as moving",
        domain: "all positions, velocities of the track along x and y, theta_track_max, theta_velocity, v_object \
                 > 0; one track, two detections, two items of 500 ms ago, one of 300 ms ago",
        claim: || of_track(0),
        wrong: Wrong { statement: "and so is (d, d'') for every item d''", claim: || of_track(1) },
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

/// A scene of MotRemote with these tracks, two detections c and d, the items a and b of 500 ms ago and s of
/// 300 ms ago, and parameters above 0.
fn scene(tracks: Vec<Track>) -> Scene {
    let mut cycle = base::cycle(Profile::Hardened, MotRemote);
    cycle.tracks = Some(TrackList { stamp_ns: NOW_NS, items: tracks });
    cycle.detections = Some(list(0, vec![anywhere("c"), anywhere("d")]));
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

fn unexplained(supported: bool) -> Formula {
    forget_of_what_roots_are();
    let scene = scene(Vec::new());
    let [d, before, support] = ["d", "b", "s"].map(place);
    let moved = &d - &before;
    given_within(&moved, &(&scene.parameters.v_object * Real::ratio(1, 2)));
    if supported {
        // d - w dt' with w = (d - d') / 0.5 s, dt' = 0.3 s.
        let then = &d - &moved.scaled(&Real::ratio(3, 5));
        given_within(&(&then - &support), &scene.parameters.theta_track_max);
    }
    let lists = usable(&scene);
    let detections = &scene.detections.as_ref().expect("they are current").items;
    let is_it = |detection, item| (detection, item) == (1, 1);
    let pairs = pairs(&scene, &lists, detections);
    Formula::from(
        pairs.iter().any(|it| is_it(it.detection, it.item) && it.list.age_ns == 500_000_000),
    )
}

fn of_track(all: usize) -> Formula {
    let says = Track {
        id: 1,
        x: open_number("p x"),
        y: open_number("p y"),
        cos: 1.0,
        sin: 0.0,
        vx: open_number("v x"),
        vy: open_number("v y"),
        length: 1.0,
        width: 1.0,
    };
    let scene = scene(vec![says]);
    let confirmed = confirmed(&scene);
    let Some((_, seen)) = confirmed.first() else { return Formula::Known(true) };
    // Two lists: a backed track has its own origin in both.
    let (Some(d), Some(origin)) = (seen.detection, seen.own_origins[1]) else {
        return Formula::Known(false);
    };
    let lists = usable(&scene);
    let detections = &scene.detections.as_ref().expect("they are current").items;
    let pairs = pairs(&scene, &lists, detections);
    let is_examined = |item: usize| {
        let mut all = pairs.iter();
        all.any(|it| (it.detection, it.item, it.list.age_ns) == (d, item, 500_000_000))
    };
    Formula::from(is_examined(origin) && (all == 0 || (0..2).all(is_examined)))
}
