//! The distances (`spec/3-stages.md#distances`) as far as a verdict shows them: a gap of 0 is
//! always refused and names `s_follow`, and the trajectory points that stage iv examines show
//! `s_valid`.

use mufasa::cycle::check;
use mufasa::input::cycle::{Cycle, DetectionList, Lead, Route, Trajectory, TrajectoryPoint};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Scratch};
use mufasa::report::{Outcome, Report, Witness};
use mufasa::services::configuration::Configuration;

use super::any::within;
use super::scene::{CROSS_SECTIONS, EGO, NOW_NS, alone};
#[cfg(not(kani))]
use crate::kani;
use crate::law::distances::{
    a_larger_gap_is_never_worse, next_below, s_follow_falls_with_v_lead,
    s_follow_is_never_below_s_cav,
};

/// `s_follow` is finite, not negative, at most what braking from `v_now` and `s_CAV` are together to
/// within 1e-15 of it (or the least normal double), and not below the double before `s_CAV` computed
/// in doubles, whose product may have been rounded up.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: its
/// value, which differential tests compare with the model.
pub fn verify_s_follow_is_never_below_s_cav() {
    let (parameters, v_now, v_lead) = (parameters(), speed(), speed());
    let s_follow = s_follow(parameters, v_now, v_lead);
    let s_cav = parameters.safety_time * v_now;
    let s_b = v_now * v_now / (2.0 * parameters.a_b);
    assert!(s_follow.is_finite() && s_follow >= 0.0);
    assert!(s_follow >= next_below(s_cav));
    // The three operations of this line round, and lose a little below the normal doubles.
    assert!(s_follow <= (s_cav + s_b) * (1.0 + 1e-15) + f64::MIN_POSITIVE);
    kani::cover!(s_follow > s_cav, "longer than s_CAV");
    kani::cover!(v_lead >= v_now && s_follow > 0.0, "s_CAV alone");
    kani::cover!(s_follow <= 0.0, "standing still");
}

/// `s_follow` does not rise with the speed of the lead, and is `s_CAV` from `v_now` on, to within one
/// double of `s_CAV` computed in doubles.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`. Not covered: growth
/// with `v_now`.
pub fn verify_s_follow_falls_with_v_lead() {
    let (parameters, v_now) = (parameters(), speed());
    let (slower, faster) = (speed(), speed());
    kani::assume(slower <= faster);
    let (far, near) = (s_follow(parameters, v_now, slower), s_follow(parameters, v_now, faster));
    assert!(near <= far);
    if faster >= v_now {
        let s_cav = parameters.safety_time * v_now;
        assert!(next_below(s_cav) <= near && next_below(near) <= s_cav);
    }
    kani::cover!(near < far, "falls");
    kani::cover!(slower >= v_now && near > 0.0, "stays at s_CAV");
}

/// The laws of the gap: no gap up to the double before `s_CAV` computed in doubles passes, a larger
/// gap is never worse, and a faster lead is not with a gap larger by 1e-15 of it and 1e-15 m.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`, gaps to 900 km. Not
/// covered: larger gaps.
pub fn verify_gap_keeps_its_laws() {
    let (parameters, v_now) = (parameters(), speed());
    let (gap, v_lead) = (within(0.0, 9e5), speed());
    let (larger, faster) = (within(0.0, 9e5), speed());
    kani::assume(gap <= larger && v_lead <= faster);
    let with =
        |gap: f64, speed: f64| behind(parameters, v_now, Lead { stamp_ns: NOW_NS, gap, speed });
    let cycle = with(gap, v_lead);
    let report = judged(&cycle);
    assert!(s_follow_is_never_below_s_cav(&cycle, &report));
    assert!(a_larger_gap_is_never_worse(&report, &judged(&with(larger, v_lead))));
    // The bound on the rounding error of s_b(v_lead) stays when max(.., 0) takes the 0, so that
    // right above s_CAV a slower lead may be accepted and a faster one not (found by this harness
    // at v_now = 0, gap = 1e-116 m); one more ulp and femtometre make up for it.
    let farther = gap * (1.0 + 1e-15) + 1e-15;
    assert!(s_follow_falls_with_v_lead(&report, &judged(&with(farther, faster))));
    kani::cover!(matches!(report.stages[3], Outcome::Failed(_)), "too near");
    kani::cover!(report.stages[3] == Outcome::Passed, "far enough");
}

/// `s_valid` is `s_follow` behind a lead and `s_b(v_now)` without one: an object at the trajectory
/// point that is d ahead is seen when d is less and not when d is more, to within 1e-9 of it.
///
/// Domain: all speeds, `a_b` and `safety_time` of `spec/4-arithmetic.md#domain`, d from 10 m to 1 km,
/// no lead or one 1000 km ahead, paper profile. Not covered: equality.
pub fn verify_s_valid_is_s_follow_or_s_b() {
    let (parameters, v_now, d) = (parameters(), speed(), within(10.0, 1e3));
    let v_lead: Option<f64> = super::any::option(speed);
    let s_b = |v: f64| v * v / (2.0 * parameters.a_b);
    let s_valid = match v_lead {
        Some(v_lead) => (s_b(v_now) - s_b(v_lead)).max(0.0) + parameters.safety_time * v_now,
        None => s_b(v_now),
    };
    let lead = v_lead.map(|speed| Lead { stamp_ns: NOW_NS, gap: 1e6, speed });
    let points = [point(0, 0.0), point(1, d)];
    let object = mufasa::input::cycle::Detection {
        x: d,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        length: 4.0,
        width: 2.0,
    };
    let items = [object];
    let mut cycle = behind(parameters, v_now, Lead { stamp_ns: NOW_NS, gap: 1e6, speed: 0.0 });
    cycle.lead = lead;
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW_NS, points: &points });
    cycle.detections = Some(DetectionList { stamp_ns: NOW_NS, items: &items });
    let seen = matches!(judged(&cycle).stages[3], Outcome::Failed(_));
    if d < s_valid * (1.0 - 1e-9) {
        assert!(seen);
    }
    if d > s_valid * (1.0 + 1e-9) {
        assert!(!seen);
    }
    kani::cover!(seen && v_lead.is_some(), "seen behind a lead");
    kani::cover!(seen && v_lead.is_none(), "seen without a lead");
    kani::cover!(!seen && v_lead.is_some(), "not seen behind a lead");
    kani::cover!(!seen && v_lead.is_none(), "not seen without a lead");
}

/// `s_follow`, as the witness of a gap of 0 names it, m.
fn s_follow(parameters: Parameters, v_now: f64, v_lead: f64) -> f64 {
    let lead = Lead { stamp_ns: NOW_NS, gap: 0.0, speed: v_lead };
    let report = judged(&behind(parameters, v_now, lead));
    let Outcome::Failed(Witness { compared: [_, s_follow], .. }) = report.stages[3] else {
        unreachable!("a gap of 0 is never above s_follow")
    };
    s_follow
}

/// A CAV behind a lead on a straight road, with nothing else to be seen.
fn behind(parameters: Parameters, v_now: f64, lead: Lead) -> Cycle<'static> {
    const HERE: [TrajectoryPoint; 1] = [point(0, 0.0)];
    let mut ego = EGO;
    ego.speed = v_now;
    Cycle {
        configuration: Configuration::PlanRemote,
        trajectory: Some(Trajectory { stamp_ns: NOW_NS, points: &HERE }),
        detections: Some(DetectionList { stamp_ns: NOW_NS, items: &[] }),
        lead: Some(lead),
        route: Route { closed: false, cross_sections: &CROSS_SECTIONS },
        ..alone(Profile::PAPER, parameters, ego, NOW_NS)
    }
}

const fn point(later_ns: i64, x: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: NOW_NS + later_ns, x, y: 0.0, cos: 1.0, sin: 0.0 }
}

fn judged(cycle: &Cycle<'_>) -> Report {
    let mut columns = [Column::default(); 1];
    let Ok(report) = check(cycle, &mut Scratch::new(&mut [], &mut columns)) else {
        unreachable!("the input is valid")
    };
    report
}

fn speed() -> f64 {
    within(0.0, 150.0)
}

fn parameters() -> Parameters {
    let theta_map = 1e3;
    Parameters {
        a_b: within(0.1, 100.0),
        safety_time: within(0.0, 60.0),
        theta_map,
        ..Parameters::default()
    }
}
