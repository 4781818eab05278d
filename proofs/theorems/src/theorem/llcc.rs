//! Which objects the low-level collision check examines (H-03, F-03).

use crate::hardened::h03_circumradii::circumradius;
use crate::input::cycle::Profile;
use crate::input::scene::Object;
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, forget_of_what_roots_are, given, less};
use crate::numbers::vector::{Frame, Vector};
use crate::services::configuration::Configuration;
use crate::stages::llcc::llcc;
use crate::theorem::base::{self, any_cav, home};
use crate::theorem::lemma::{squares_order, triangle};
use crate::theorem::rectangle::vector;
use crate::theorem::{Theorem, Wrong};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "a_rectangle_lies_in_its_circumcircle",
        statement: "no point of a rectangle is farther from its centre than the circumradius of H-03",
        domain: "all sizes > 0, directions with |cos^2 + sin^2 - 1| <= 1e-6",
        claim: || {
            let object = object();
            let offset = offset_in("a", &object);
            let radius = circumradius(&object.length, &object.width);
            given(squares_order(&offset.length(), &radius));
            in_circumcircle(&offset, &object)
        },
        wrong: Wrong {
            statement: "nor than half the diagonal",
            claim: || {
                let object = object();
                let offset = offset_in("a", &object);
                let diagonal = (object.length.square() + object.width.square()).sqrt();
                at_most(&offset.length(), &(diagonal / Real::from_integer(2)))
            },
        },
    },
    Theorem {
        id: "the_hardened_LLCC_finds_every_object_that_shares_a_point",
        statement: "H-03: an object that shares a point with the CAV's rectangle is examined and a \
                    collision",
        domain: "all positions, sizes > 0, theta_obj; directions with |cos^2 + sin^2 - 1| <= 1e-6; \
                 the CAV at the origin along x",
        claim: || shared_point_is_found(Profile::Hardened),
        wrong: Wrong {
            statement: "F-03: the paper's LLCC with theta_obj = 5 m finds it, too (a 12 m lorry along x)",
            claim: paper_finds_a_lorry,
        },
    },
];

fn shared_point_is_found(profile: Profile) -> Formula {
    forget_of_what_roots_are();
    let mut scene = any_cav(profile);
    scene.parameters.theta_obj = Real::variable("theta_obj");
    let scale = Real::variable("scale");
    given(less(&Real::zero(), &scale));
    given(nearly_one(&scale.square()));
    let pose = home(&scale);
    let cav = Object {
        frame: pose.pose.clone(),
        length: scene.ego.length.clone(),
        width: scene.ego.width.clone(),
    };
    let mut object = object();
    for side in [&cav.length, &cav.width] {
        given(less(&Real::zero(), side));
    }
    let (in_cav, in_object) = (offset_in("CAV", &cav), offset_in("object", &object));
    object.frame.origin = &in_cav - &in_object;
    // From centre to centre over the shared point.
    given(in_circumcircle(&in_cav, &cav));
    given(in_circumcircle(&in_object, &object));
    given(triangle(&in_cav, &in_object.scaled(&Real::from_integer(-1))));
    Formula::from(llcc(&scene, &pose, &object).is_some())
}

fn paper_finds_a_lorry() -> Formula {
    let [length, width] = [12, 2].map(Real::from_integer);
    let mut lorry = Object { frame: home(&Real::from_integer(1)).pose, length, width };
    let scene = base::scene(&base::cycle(Profile::Paper, Configuration::PlanRemote));
    let pose = home(&Real::from_integer(1));
    let cav = Object {
        frame: pose.pose.clone(),
        length: scene.ego.length.clone(),
        width: scene.ego.width.clone(),
    };
    lorry.frame.origin = &offset_in("CAV", &cav) - &offset_in("lorry", &lorry);
    Formula::from(llcc(&scene, &pose, &lorry).is_some())
}

/// Any object.
fn object() -> Object {
    let direction = vector("direction");
    given(nearly_one(&direction.squared()));
    let [length, width] = ["length", "width"].map(Real::variable);
    for side in [&length, &width] {
        given(less(&Real::zero(), side));
    }
    Object { frame: Frame { origin: vector("object"), direction }, length, width }
}

/// The square of a direction's length is within the domain.
fn nearly_one(square: &Real) -> Formula {
    let (one, tolerance) = (Real::from_integer(1), Real::ratio(1, 1_000_000));
    Formula::All(vec![at_most(&(&one - &tolerance), square), at_most(square, &(&one + &tolerance))])
}

/// From the centre of the object's rectangle to any point of it.
fn offset_in(name: &str, object: &Object) -> Vector {
    let sides = [("along", &object.length), ("across", &object.width)];
    let [a, b] = sides.map(|(axis, side)| {
        let (coordinate, half) =
            (Real::variable(&format!("{axis} {name}")), side * Real::ratio(1, 2));
        given(at_most(&-&half, &coordinate));
        given(at_most(&coordinate, &half));
        coordinate
    });
    &object.frame.direction.scaled(&a) + &object.frame.direction.left().scaled(&b)
}

fn in_circumcircle(offset: &Vector, object: &Object) -> Formula {
    at_most(&offset.length(), &circumradius(&object.length, &object.width))
}
