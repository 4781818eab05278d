//! H-14: the places of the CAV on its path (`spec/hardened/H-14.md#requirements-the-path`).

use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::path::{
    Place, ahead, greatest_length, places, places_by_length,
};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::cycle::Profile;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, less};
use crate::numbers::vector::{Frame, Vector};
use crate::stages::llcc::cav;
use crate::theorem::base::{NOW_NS, any_cav};
use crate::theorem::rectangle::{point_of, vector};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_CAV_has_a_progress_of_at_most_what_it_has_driven",
        statement: "H-14: whatever it steers: after a step a and a step b, (x - p) . h <= abs(a) + abs(b)",
        domain: "all p and steps, h any unit vector",
        claim: || progress(&Real::from_integer(1)),
        wrong: Wrong {
            statement: "at most 99 % of what it has driven",
            claim: || progress(&Real::ratio(99, 100)),
        },
    },
    Theorem {
        id: "the_last_place_is_at_s_stop_and_a_path_is_no_longer_than_its_length",
        statement: "H-14: progress and length of the first place are 0; the progress of the last one is s_stop, or its length \
                    above 2 s_stop + 1 m; from place to place the length grows by at least their distance; a place knows \
                    the length at the place after it, and its least progress is at most that of it and its neighbours, or 0",
        domain: "a CAV at the origin along x, of 1/4 m and more; a point with any heading, at most 1/4 m in x and in y \
                 from what is before; s_stop at most 1/4 m; tau = 0; the list without an end by distance",
        claim: || measures(at_most),
        wrong: Wrong { statement: "by more than their distance", claim: || measures(less) },
    },
    Theorem {
        id: "places_that_follow_each_other_are_at_most_d_apart",
        statement: "H-14: in x and in y",
        domain: "a CAV at the origin along x, of 1/4 m and more; a point with any heading, at most 1/2 m in x and in y \
                 from what is before; s_stop at most 1/4 m; tau = 0; the list without an end by distance",
        claim: || apart(&Real::ratio(1, 4)),
        wrong: Wrong { statement: "d/2 apart", claim: || apart(&Real::ratio(1, 8)) },
    },
    Theorem {
        id: "of_a_CAV_between_two_places_of_a_straight_path_every_point_is_in_its_rectangle_at_one_of_them",
        statement: "H-14: so that nothing lies between the places; that the CAV is examined at both whenever it is between \
                    them, the_window_of_a_place_holds_when_the_CAV_is_there_and_at_its_neighbours says",
        domain: "a CAV at the origin with any heading, of 3/8 m and more; a point straight ahead, at most 1/2 m; s_stop at most \
                 1/2 m; tau = 0",
        claim: || between_places(&Real::ratio(3, 8)),
        wrong: Wrong {
            statement: "a CAV of 1/4 m and more: across x and y places are up to 0.354 m apart",
            claim: || between_places(&Real::ratio(1, 4)),
        },
    },
];

/// A scene and a trajectory of points of these names, each at most so far in x and in y from what is before.
fn any<const N: usize>(names: [&str; N], most: &Real) -> (Scene, [Point; N]) {
    let mut scene = any_cav(Profile::HARDENED);
    given(at_most(&Real::zero(), &scene.ego.v_now));
    given(at_most(&Real::ratio(1, 4), &scene.ego.length));
    scene.parameters.tau = Real::zero();
    let mut origin = scene.ego.position.clone();
    let trajectory = names.map(|name| {
        let step = vector(name);
        given(is_within(&step, most));
        origin = &origin + &step;
        let [x, y] = Real::unit(name);
        let pose = Frame { origin: origin.clone(), direction: Vector { x, y } };
        Point { t_ns: NOW_NS, pose }
    });
    (scene, trajectory)
}

fn is_within(vector: &Vector, most: &Real) -> Formula {
    let sides = [&vector.x, &vector.y];
    Formula::All(
        sides.iter().flat_map(|side| [at_most(side, most), at_most(&-most, side)]).collect(),
    )
}

/// All places where s_stop is at most so much.
fn all_places(scene: &Scene, trajectory: &[Point], most: &Real) -> Vec<Place> {
    given(at_most(&Driving::of(scene).s_stop(), most));
    places(scene, trajectory).collect()
}

/// The same without an end by distance (H-14.60), of which those places are the first ones.
fn all_by_length(scene: &Scene, trajectory: &[Point], most: &Real) -> Vec<Place> {
    given(at_most(&Driving::of(scene).s_stop(), most));
    places_by_length(scene, trajectory).collect()
}

/// The progress after two steps, each any along h and across it, is at most this share of what was driven.
fn progress(share: &Real) -> Formula {
    let mut scene = any_cav(Profile::HARDENED);
    let [x, y] = Real::unit("h");
    let (p, h) = (vector("p"), Vector { x, y });
    let [a, b] = ["a", "b"].map(|name| {
        let Vector { x: along, y: across } = vector(name);
        &h.scaled(&along) + &h.left().scaled(&across)
    });
    (scene.ego.position, scene.ego.heading) = (p.clone(), h);
    let x = &(&p + &a) + &b;
    at_most(&ahead(&scene, &x), &(share * (a.length() + b.length())))
}

fn measures(order: fn(&Real, &Real) -> Formula) -> Formula {
    let (scene, trajectory) = any(["1"], &Real::ratio(1, 4));
    let places = all_by_length(&scene, &trajectory, &Real::ratio(1, 4));
    let (first, last) = (&places[0], &places[places.len() - 1]);
    let zero = Real::zero();
    let mut claims = vec![
        equal(&first.progress, &zero),
        equal(&first.length, &zero),
        Formula::Any(vec![
            equal(&last.progress, &Driving::of(&scene).s_stop()),
            less(&greatest_length(&scene), &last.length),
        ]),
        Formula::from(last.length_after.is_none()),
    ];
    let no_more = |a: &Place, b: &Place| {
        Formula::Any(vec![equal(&a.least, &zero), at_most(&a.least, &b.progress)])
    };
    for pair in places.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let after = a.length_after.as_ref();
        let after = after.map_or(Formula::Known(false), |length| equal(length, &b.length));
        let grows = &b.length - &a.length;
        let distance = (&b.pose.origin - &a.pose.origin).squared();
        claims.extend([at_most(&zero, &grows), order(&distance, &grows.square()), after]);
        claims.extend([no_more(a, a), no_more(a, b), no_more(b, a), no_more(b, b)]);
    }
    Formula::All(claims)
}

fn apart(most: &Real) -> Formula {
    let (scene, trajectory) = any(["1"], &Real::ratio(1, 2));
    let places = all_by_length(&scene, &trajectory, &Real::ratio(1, 4));
    let near = |pair: &[Place]| is_within(&(&pair[1].pose.origin - &pair[0].pose.origin), most);
    Formula::All(places.windows(2).map(near).collect())
}

fn between_places(least: &Real) -> Formula {
    let mut scene = any_cav(Profile::HARDENED);
    let [x, y] = Real::unit("heading");
    let heading = Vector { x, y };
    scene.ego.heading = heading.clone();
    scene.parameters.tau = Real::zero();
    let (far, share) = (Real::variable("far"), Real::variable("share"));
    for number in [&scene.ego.v_now, &scene.ego.width, &far, &share] {
        given(at_most(&Real::zero(), number));
    }
    given(at_most(least, &scene.ego.length));
    given(at_most(&far, &Real::ratio(1, 2)));
    given(at_most(&share, &Real::from_integer(1)));
    let pose = Frame { origin: heading.scaled(&far), direction: heading };
    let places = all_places(&scene, &[Point { t_ns: NOW_NS, pose }], &Real::ratio(1, 2));
    let covered = |pair: &[Place]| {
        let [o, q] = [0, 1].map(|k| &pair[k].pose);
        let between = &o.origin + &(&q.origin - &o.origin).scaled(&share);
        let here = cav(&scene, &Frame { origin: between, direction: o.direction.clone() });
        let point = point_of("CAV", &here);
        let is_at = |pose: &Frame| {
            let at = cav(&scene, pose);
            let off = &point - &at.frame.origin;
            let along = off.dot(&at.frame.direction);
            let across = off.cross(&at.frame.direction);
            let within = |part: &Real, most: &Real| [at_most(part, most), at_most(&-most, part)];
            let sides = [within(&along, &at.half_length), within(&across, &at.half_width)];
            Formula::All(sides.concat())
        };
        Formula::Any(vec![is_at(o), is_at(q)])
    };
    Formula::All(places.windows(2).map(covered).collect())
}
