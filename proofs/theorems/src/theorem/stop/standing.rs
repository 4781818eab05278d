//! The stop theorem for what stands: the premise is H-14's (`spec/hardened/H-14.md#requirements-failure`).

use std::cell::LazyCell;

use super::drive;
use super::motion::{Ahead, DOMAIN, Limits, at_least_zero, one_of};
use super::system::{every_step_keeps, stands_before};
use crate::claim::{Theorem, Wrong};
use crate::hardened::h14_fail_safe::meeting::{self, BesideRoute};
use crate::hardened::h14_fail_safe::motions::all_motions;
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::cycle::{Detection, DetectionList, Profile, Track, TrackList};
use crate::numbers::real::Real;
use crate::numbers::real::formula::{Formula, at_most, given, less};
use crate::numbers::real::hole::open_number;
use crate::services::configuration::Configuration;
use crate::theorem::base::{self, NOW_NS};

/// The theorems of this file.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "what_stands_in_the_way_of_a_CAV_that_passes_H-14_is_beyond_s_stop",
        statement: "H-14.7, H-14.45: if no place fails, the free way to a standing object is above s_stop, so that the stop \
                    invariant holds",
        domain: "a CAV at the origin along x, L = 4 m, W = 2 m, on a straight path; a track with w = 0 or an unexplained \
                 detection ahead of it, along x, any y, length and width that meet its way; tau = 0.25 s, a_max = 3, a_b = 8 m/s^2, s_stop at most 1 m",
        claim: || beyond_s_stop(0),
        wrong: Wrong { statement: "above s_stop + 1 cm", claim: || beyond_s_stop(1) },
    },
    Theorem {
        id: "every_transition_keeps_the_stop_invariant_of_what_stands",
        statement: "F-04: going on until brake_by, braking, a cycle that measures, passes, fails or is lost, a fallback, \
                    and a return to remote keep: s_stop(v, time left until brake_by) < free way",
        domain: DOMAIN,
        claim: || every_step_keeps(Ahead::Standing),
        wrong: Wrong {
            statement: "tau one period too small: a CAV that brakes fully 0.1 s after brake_by comes at most 10 cm too far",
            claim: || drive::stands_before(drive::LATE, Ahead::Standing, -10),
        },
    },
    Theorem {
        id: "with_the_stop_invariant_a_CAV_stands_before_what_stands",
        statement: "F-04: it has not reached it, and after braking for v / a_b from brake_by on it stands and has not",
        domain: DOMAIN,
        claim: || stands_before(Ahead::Standing),
        wrong: Wrong {
            statement: "brake_by ignored: a CAV that goes on for 0.5 s without a trajectory comes at most 10 cm too far",
            claim: || drive::stands_before(drive::IGNORED, Ahead::Standing, -10),
        },
    },
    Theorem {
        id: "a_CAV_that_keeps_brake_by_stands_before_what_stands",
        statement: "F-04: the same as one drive of a safe cycle, two that are lost, brake_by, and standstill",
        domain: "speeds from 5 to 15 m/s, tau = 0.25 s, a_max = 3, a_b = 8 m/s^2, any accelerations",
        claim: || drive::stands_before(drive::KEPT, Ahead::Standing, 0),
        wrong: Wrong {
            statement: "1 cm before it, always",
            claim: || drive::stands_before(drive::KEPT, Ahead::Standing, 1),
        },
    },
];

/// Where every place of H-14 passes, the free way is more than so much above s_stop.
fn beyond_s_stop(centimetres: i64) -> Formula {
    let mut cycle = base::cycle(Profile::HARDENED, Configuration::PlanRemote);
    let [x, y, length, width] = ["x", "y", "length", "width"].map(open_number);
    let (cos, sin) = (1.0, 0.0);
    if one_of(2) == 0 {
        let track = Track { id: 1, x, y, cos, sin, vx: 0.0, vy: 0.0, length, width };
        cycle.tracks = Some(TrackList { stamp_ns: NOW_NS, items: vec![track] });
    } else {
        let detection = Detection { x, y, cos, sin, length, width };
        cycle.detections = Some(DetectionList { stamp_ns: NOW_NS, items: vec![detection] });
    }
    let mut scene = base::scene(&cycle);
    let Limits { tau, a_max, a_b } = drive::limits();
    scene.ego.v_now = at_least_zero("v_now");
    (scene.parameters.tau, scene.parameters.a_max, scene.parameters.a_b) = (tau, a_max, a_b);
    let s_stop = Driving::of(&scene).s_stop();
    given(at_most(&s_stop, &Real::from_integer(1)));
    let [x, y, length, width] = ["x", "y", "length", "width"].map(Real::named);
    let two = Real::from_integer(2);
    let free = x - &length / &two - &two;
    let aside = Real::from_integer(1) + &width / two;
    for (less, more) in [(&Real::zero(), &free), (&Real::zero(), &length), (&Real::zero(), &width)]
    {
        given(at_most(less, more));
    }
    given(less(&-&aside, &y));
    given(less(&y, &aside));
    let trajectory = scene.trajectory.clone().unwrap_or_default();
    let beside_route = LazyCell::new(|| BesideRoute::new(&scene, &trajectory));
    if meeting::failure(&scene, &trajectory, &all_motions(&scene), &beside_route).is_some() {
        return Formula::Known(true);
    }
    less(&(s_stop + Real::ratio(centimetres, 100)), &free)
}
