//! The gap where stage iv is silent, on both sides of `s_react` + `s_since` (H-04 of `spec/hardened/H-04.md`).
//! The CAV drives at 5 m/s.

use crate::scene::{NOW_NS, Scene, scene};
use mufasa::input::cycle::{Cycle, Lead};
use mufasa::input::profile::Profile;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::AllRemote;

/// What the CAV needs behind a lead of that speed, whose gap was measured so long ago, m.
fn needed(cycle: &Cycle<'_>, v_lead: f64, age: f64) -> f64 {
    let (v, it) = (cycle.ego.speed, &cycle.parameters);
    let (v_tau, a_tyre) = (v + it.a_max * it.tau, it.a_b.max(11.5));
    let s_tau = v * it.tau + it.a_max * it.tau * it.tau / 2.0;
    let s_stop = s_tau + v_tau * v_tau / (2.0 * it.a_b);
    let s_react = (s_stop - v_lead * v_lead / (2.0 * a_tyre)).max(0.0);
    s_react + v * age + a_tyre * age * age / 2.0
}

/// Behind a lead of that speed, measured so long ago, with so much more gap than is needed.
fn behind<const V_LEAD: i32, const AGE_MS: i32, const MORE_NM: i32>(cycle: &mut Cycle<'_>) {
    cycle.parameters.max_age_ns = 1_000_000_000;
    let (speed, age) = (f64::from(V_LEAD), 1e-3 * f64::from(AGE_MS));
    let gap = needed(cycle, speed, age) + 1e-9 * f64::from(MORE_NM);
    let stamp_ns = NOW_NS - i64::from(AGE_MS) * 1_000_000;
    cycle.lead = Some(Lead { stamp_ns, gap, speed });
}

#[test]
fn a_gap_has_to_be_above_what_the_cav_needs_and_has_driven_since() {
    let cases: [[fn(&mut Cycle<'_>); 2]; 4] = [
        [behind::<3, 0, -10>, behind::<3, 0, 10>],
        [behind::<3, 400, -10>, behind::<3, 400, 10>],
        [behind::<0, 1000, -10>, behind::<0, 1000, 10>],
        // s_react is 0.
        [behind::<30, 400, -10>, behind::<30, 400, 10>],
    ];
    for ((case, [less, more]), a_b) in
        cases.into_iter().enumerate().flat_map(|it| [(it, 8.0), (it, 20.0)])
    {
        let mut scene = Scene { change: less, ..scene(Profile::HARDENED, AllRemote, [0.0, 0.0]) };
        scene.parameters.a_b = a_b;
        assert_eq!(scene.rule(), Some(Rule::Gap), "{case} {a_b}");
        let (_, witness) = scene.failure().expect("too close");
        let [gap, needed] = witness.compared;
        assert!((needed - gap - 1e-8).abs() < 1e-9, "{case} {a_b}: {needed} {gap}");
        scene.change = more;
        assert!(!scene.fails_by(Rule::Gap), "{case} {a_b}");
    }
}
