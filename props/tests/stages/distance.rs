//! `s_follow` at its own last places: the implementation against the exact model over the whole
//! domain of speeds and parameters (`spec/3-stages.md#distances`).

use mufasa_model::input::cycle::{Cycle, DetectionList, Lead, Profile};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Rule};
use mufasa_model::services::configuration::Configuration;
use mufasa_model::stages::distances::s_follow;
use mufasa_props::bridge::check_impl;
use mufasa_props::conformance::Answer;
use mufasa_props::differential::{cases, conforming, hold, near_threshold};
use mufasa_props::strategy::base;
use mufasa_props::strategy::draw::Draw;

/// A standing trajectory, no objects, and a lead whose gap is the double nearest to `s_follow`, or
/// a few units in the last place beside it.
fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let mut cycle = base::cycle(draw, frame, profile, Configuration::PlanRemote);
    let speed = |draw: &mut Draw<'_>| match draw.below(3) {
        0 => draw.pick(&[0.0, 150.0, 13.9, 8.0, 28.8]),
        _ => draw.range(0.0, 150.0),
    };
    if draw.below(2) == 0 {
        cycle.parameters.a_b = draw.range(0.1, 100.0);
        cycle.parameters.safety_time = draw.range(0.0, 60.0);
    }
    let (v_now, v_lead) = (speed(draw), speed(draw));
    // The hardened profile would ask for a trajectory that fits the speed: one that lasts.
    cycle.ego.speed = if profile == Profile::PAPER { v_now } else { 0.1 * v_now / 150.0 };
    let exact = exact_s_follow(&cycle, v_lead).to_f64();
    let gap = match draw.below(4) {
        0 => exact,
        1 => exact + draw.offset(),
        _ => draw.ulps(exact),
    };
    let stamp_ns = cycle.now_ns;
    let gap = gap.clamp(0.0, 1e6);
    cycle.lead = Some(Lead { stamp_ns, gap, speed: v_lead });
    cycle.detections = Some(DetectionList { stamp_ns, items: Vec::new() });
    let ego = cycle.ego.clone();
    let mut standing = ego.clone();
    standing.speed = ego.speed.min(0.1);
    cycle.trajectory = Some(base::straight(&standing, frame, stamp_ns, &cycle.parameters));
    cycle
}

fn exact_s_follow(cycle: &Cycle, v_lead: f64) -> Real {
    let real = Real::from_double;
    let p = &cycle.parameters;
    s_follow(&real(cycle.ego.speed), &real(v_lead), &real(p.a_b), &real(p.safety_time))
}

/// Conformance, and a witness whose `s_follow` is the exact one within a part in 10^12.
fn conforming_and_close(cycle: &Cycle, exact: &Answer, strict: &Answer) -> Result<(), String> {
    conforming(cycle, exact, strict)?;
    let Ok(report) = check_impl(cycle) else { return Ok(()) };
    let Some(lead) = &cycle.lead else { return Ok(()) };
    for outcome in &report.stages {
        if let Outcome::Failed(witness) = outcome
            && witness.rule == Rule::Gap
        {
            let [gap, found] = witness.compared;
            let s_follow = exact_s_follow(cycle, lead.speed).to_f64();
            if gap.to_bits() != lead.gap.to_bits() || (found - s_follow).abs() > 1e-12 * s_follow {
                return Err(format!("compared {gap} with {found}, s_follow is {s_follow}"));
            }
        }
    }
    Ok(())
}

#[test]
fn paper() {
    hold(cases(), "s_follow", Profile::PAPER, cycle, near_threshold, conforming_and_close)
        .assert_aimed(&["iv", "safe"]);
}

#[test]
fn hardened() {
    hold(cases(), "s_follow", Profile::HARDENED, cycle, near_threshold, conforming_and_close)
        .assert_aimed(&["iv", "safe"]);
}
