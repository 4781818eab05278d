//! H-14: the mean motion of what the CAV saw itself is examined, whatever the remote side says.

use crate::claim::{Theorem, Wrong};
use crate::hardened::detection_history::{confirmed, stands_within, usable};
use crate::hardened::h14_fail_safe::motions::{Pair, pairs};
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::input::cycle::{Detection, DetectionList, Profile, Track, TrackList};
use crate::input::scene::Scene;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{
    Formula, at_most, equal, forget_of_what_roots_are, given, less, same,
};
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
        id: "the_motion_of_a_detection_that_every_list_shows_is_examined_whatever_tracks_say",
        statement: "H-14, F-38, F-42, F-57: if abs(d - d') <= v_object dt for d and d', items of the current and the \
                    reference list, and each other usable list has an item at distance <= 0.3 m + a_tyre dt' \
                    abs(dt' - dt)/2 from d - w dt', and d did not stand or moved evenly from d', (d, d') is \
                    examined as moving",
        domain: "all positions, velocities of the track along x and y, theta_track_max, theta_velocity, v_object \
                 > 0; one track, anywhere, d the only detection, d' the second of two items of 500 ms ago, one \
                 item of 300 ms ago and one of 800 ms ago",
        claim: || seen_to_come(true),
        wrong: Wrong {
            statement: "also where the list of 800 ms ago does not show it",
            claim: || seen_to_come(false),
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

/// A scene of MotRemote with these tracks, the detection d, the items a and b of 500 ms ago and s of 300 ms ago, this
/// list before them, and parameters above 0.
fn scene(tracks: Vec<Track>, before: Option<DetectionList>) -> Scene {
    let mut cycle = base::cycle(Profile::HARDENED, MotRemote);
    cycle.tracks = Some(TrackList { stamp_ns: NOW_NS, items: tracks });
    cycle.detections = Some(list(0, vec![anywhere("d")]));
    cycle.detection_history =
        vec![list(300, vec![anywhere("s")]), list(500, vec![anywhere("a"), anywhere("b")])];
    cycle.detection_history.extend(before);
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

/// Assumes that d is at most v_object dt from b, of 500 ms ago.
fn given_slow(scene: &Scene) {
    let moved = &place("d") - &place("b");
    given_within(&moved, &(&scene.parameters.v_object * Real::ratio(1, 2)));
}

/// Assumes that an item is at most this far, and what tyres let an object be off its mean, from where d was at its time,
/// `tenths` of a second ago.
fn given_near(scene: &Scene, limit: &Real, item: &str, tenths: i64) {
    let off = Real::ratio(tenths * (tenths - 5).abs(), 200);
    given_within(&from_then("b", item, tenths), &(limit + a_tyre(&scene.parameters.a_b) * off));
}

/// Where d was `tenths` of a second ago, d - w dt' with w = (d - d') / 0.5 s, from the item of that time.
fn from_then(before: &str, item: &str, tenths: i64) -> Vector {
    let [d, before, item] = ["d", before, item].map(place);
    let then = &d - &(&d - &before).scaled(&Real::ratio(tenths, 5));
    &then - &item
}

/// Assumes that d did not stand, being farther than 0.3 m from all items of a list, or moved evenly from that of 500 ms
/// ago.
fn given_not_stood(before: &str, others: &[(&str, i64)]) {
    let is_off = |item: &str| less(&stands_within(), &(&place("d") - &place(item)).length());
    let is_even = |(item, tenths): &(&str, i64)| {
        at_most(&from_then(before, item, *tenths).length(), &stands_within())
    };
    let moved_evenly = Formula::All(others.iter().map(is_even).collect());
    let of_reference = Formula::All(["a", "b"].map(is_off).into());
    let of_others = others.iter().map(|(item, _)| is_off(item));
    given(Formula::Any(of_others.chain([of_reference, moved_evenly]).collect()));
}

fn unexplained(supported: bool) -> Formula {
    forget_of_what_roots_are();
    let scene = scene(Vec::new(), None);
    given_slow(&scene);
    if supported {
        given_near(&scene, &scene.parameters.theta_track_max, "s", 3);
    }
    given_not_stood("b", &[("s", 3)]);
    Formula::from(is_examined(&scene, [0, 1]))
}

fn seen_to_come(by_each: bool) -> Formula {
    if by_each {
        forget_of_what_roots_are();
    }
    let scene = scene(vec![says()], Some(list(800, vec![anywhere("t")])));
    let limit = stands_within();
    given_slow(&scene);
    given_near(&scene, &limit, "s", 3);
    if by_each {
        given_near(&scene, &limit, "t", 8);
    } else {
        given_hidden([5, 0]);
    }
    given_not_stood("b", &[("s", 3), ("t", 8)]);
    Formula::from(is_examined(&scene, [0, 1]))
}

/// Assumes where b is, and that a track that stands at d has a and s for its origins: with all this given a
/// counterexample has real roots.
fn given_hidden(b: [i128; 2]) {
    for (name, [x, y]) in
        [("d", [0, 0]), ("s", [3, 0]), ("a", [0, 1]), ("b", b), ("p", [0, 0]), ("v", [0, 0])]
    {
        given(same(&place(name), &Vector { x: Real::from_integer(x), y: Real::from_integer(y) }));
    }
    for (name, value) in [("theta_track_max", 1), ("theta_velocity", 7), ("v_object", 70)] {
        given(equal(&Real::named(name), &Real::from_integer(value)));
    }
}

/// Whether the detection and the item of 500 ms ago are examined as moving.
fn is_examined(scene: &Scene, [detection, item]: [usize; 2]) -> bool {
    let Some(list) = &scene.detections else { return false };
    let lists = usable(scene);
    let confirmed = confirmed(scene);
    let is_it =
        |it: &Pair<'_>| (it.detection, it.item, it.list.age_ns) == (detection, item, 500_000_000);
    pairs(scene, list, &lists, &confirmed).any(|it| is_it(&it))
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

fn of_track(all: usize) -> Formula {
    let scene = scene(vec![says()], None);
    if all == 1 {
        given_hidden([0, 30]);
    }
    let confirmed = confirmed(&scene);
    let Some((_, seen)) = confirmed.first() else { return Formula::Known(true) };
    // Two lists: a backed track has its own origin in both.
    let (Some(d), Some(origin)) = (seen.detection, seen.own_origins[1]) else {
        return Formula::Known(false);
    };
    given_not_stood(["a", "b"][origin], &[("s", 3)]);
    let examined = |item: usize| is_examined(&scene, [d, item]);
    Formula::from(examined(origin) && (all == 0 || (0..2).all(examined)))
}
