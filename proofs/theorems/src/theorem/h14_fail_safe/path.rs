//! H-14: the places of the CAV on its path (`spec/7-fail-safe.md#the-path`).

use crate::hardened::h14_fail_safe::path::{Place, places};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::cycle::Profile;
use crate::input::scene::{Point, Scene};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, equal, given, less};
use crate::numbers::vector::{Frame, Vector};
use crate::theorem::base::{NOW_NS, any_cav};
use crate::theorem::rectangle::vector;
use crate::theorem::{Theorem, Wrong};

const DOMAIN: &str = "a CAV at the origin along x, of 1/4 m and more, one point at most 1/2 m from it in x and in y with any \
                      heading, s_stop at most 1/2 m behind the way of that; all v_now, tau = 0, a_b = 8 m/s^2";

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "the_last_place_is_at_s_stop_and_the_ways_of_places_do_not_fall",
        statement: "H-14: the way of the first place is 0, that of the last one s_stop, and of any two that follow each \
                    other the second is not less; a place knows the ways of both its neighbours",
        domain: DOMAIN,
        claim: || ways(at_most),
        wrong: Wrong { statement: "is greater", claim: || ways(less) },
    },
    Theorem {
        id: "places_that_follow_each_other_are_at_most_d_apart",
        statement: "H-14: in x and in y",
        domain: DOMAIN,
        claim: || apart(&Real::ratio(1, 4)),
        wrong: Wrong { statement: "d/2 apart", claim: || apart(&Real::ratio(1, 8)) },
    },
];

/// A scene and a trajectory of one point.
fn any() -> (Scene, [Point; 1]) {
    let mut scene = any_cav(Profile::Hardened);
    given(at_most(&Real::zero(), &scene.ego.v_now));
    given(at_most(&Real::ratio(1, 4), &scene.ego.length));
    scene.parameters.tau = Real::zero();
    let origin = vector("point");
    given(is_within(&origin, &Real::ratio(1, 2)));
    let [x, y] = Real::unit("point");
    let pose = Frame { origin, direction: Vector { x, y } };
    (scene, [Point { t_ns: NOW_NS, pose }])
}

fn is_within(vector: &Vector, most: &Real) -> Formula {
    let sides = [&vector.x, &vector.y];
    Formula::All(
        sides.iter().flat_map(|side| [at_most(side, most), at_most(&-most, side)]).collect(),
    )
}

fn all_places(scene: &Scene, trajectory: &[Point]) -> Vec<Place> {
    let s_stop = Driving::of(scene).s_stop();
    let end = &trajectory[0].pose.origin.x;
    given(at_most(&s_stop, &(end.clone().max(Real::zero()) + Real::ratio(1, 2))));
    places(scene, trajectory).collect()
}

fn ways(order: fn(&Real, &Real) -> Formula) -> Formula {
    let (scene, trajectory) = any();
    let places = all_places(&scene, &trajectory);
    let (first, last) = (&places[0], &places[places.len() - 1]);
    let mut claims = vec![
        equal(&first.way, &Real::zero()),
        equal(&first.way_before, &Real::zero()),
        equal(&last.way, &Driving::of(&scene).s_stop()),
        Formula::from(last.way_after.is_none()),
    ];
    for pair in places.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let after = a.way_after.as_ref().map_or(Formula::Known(false), |way| equal(way, &b.way));
        claims.extend([order(&a.way, &b.way), equal(&b.way_before, &a.way), after]);
    }
    Formula::All(claims)
}

fn apart(most: &Real) -> Formula {
    let (scene, trajectory) = any();
    let places = all_places(&scene, &trajectory);
    let near = |pair: &[Place]| is_within(&(&pair[1].pose.origin - &pair[0].pose.origin), most);
    Formula::All(places.windows(2).map(near).collect())
}
