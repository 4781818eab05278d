//! The laws of the distances over every pair of speeds of a grid, and wrong reports that refute
//! them (`spec/3-stages.md#distances`).
//!
//! Domain: speeds 0 to 150 m/s in steps of 2.5, gaps at and around `s_CAV` and `s_follow`.

use mufasa::cycle::check;
use mufasa::input::cycle::{
    CrossSection, Cycle, DetectionList, Ego, Lead, Route, Trajectory, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::Scratch;
use mufasa::report::{Outcome, Report};
use mufasa::services::configuration::Configuration;
use mufasa_proofs::law::distances::{
    a_larger_gap_is_never_worse, failed_by_gap, next_below, s_follow_falls_with_v_lead,
    s_follow_is_never_below_s_cav,
};

const CROSS_SECTIONS: [CrossSection; 2] = [
    CrossSection { x: -10.0, y: 0.0, left: [-10.0, 3.0], right: [-10.0, -3.0] },
    CrossSection { x: 10.0, y: 0.0, left: [10.0, 3.0], right: [10.0, -3.0] },
];
const POINTS: [TrajectoryPoint; 1] =
    [TrajectoryPoint { t_ns: 0, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }];

fn cycle(v_now: f64, v_lead: f64, gap: f64) -> Cycle<'static> {
    let ego = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: v_now,
        length: 4.0,
        width: 2.0,
        center_offset: 0.0,
    };
    Cycle {
        profile: Profile::PAPER,
        parameters: Parameters::default(),
        now_ns: 0,
        configuration: Configuration::PlanRemote,
        ego,
        trajectory: Some(Trajectory { stamp_ns: 0, points: &POINTS }),
        tracks: None,
        detections: Some(DetectionList { stamp_ns: 0, items: &[] }),
        lead: Some(Lead { stamp_ns: 0, gap, speed: v_lead }),
        route: Route { closed: false, cross_sections: &CROSS_SECTIONS },
        grid: None,
        detection_history: &[],
    }
}

fn report(cycle: &Cycle<'_>) -> Report {
    check(cycle, &mut Scratch::new(&mut [], &mut [])).expect("the input is valid")
}

/// Speeds in m/s from 0 to 150.
fn speeds() -> impl Iterator<Item = f64> {
    (0..=60_i32).map(|i| 2.5 * f64::from(i))
}

fn next_above(value: f64) -> f64 {
    f64::from_bits(value.to_bits() + 1)
}

/// Gaps at `s_CAV`, at the braking distances' difference above it, and one place beside.
fn gaps(v_now: f64, v_lead: f64) -> [f64; 6] {
    let s_cav = 1.8 * v_now;
    let s_follow = ((v_now * v_now - v_lead * v_lead) / 16.0).max(0.0) + s_cav;
    [0.0, next_below(s_cav), s_cav, next_above(s_cav), s_follow, s_follow + 2e-9]
}

#[test]
fn s_follow_is_never_below_s_cav_and_moves_the_right_way() {
    let (mut failed, mut passed) = (0_u32, 0_u32);
    for v_now in speeds() {
        for v_lead in speeds() {
            let mut last: Option<(f64, Report)> = None;
            for gap in gaps(v_now, v_lead) {
                let cycle = cycle(v_now, v_lead, gap);
                let report = report(&cycle);
                assert!(s_follow_is_never_below_s_cav(&cycle, &report), "{cycle:#?} {report:#?}");
                if let Some((nearer, before)) = last {
                    assert!(nearer > gap || a_larger_gap_is_never_worse(&before, &report));
                }
                let faster = self::report(&self::cycle(v_now, (v_lead + 2.5).min(150.0), gap));
                assert!(s_follow_falls_with_v_lead(&report, &faster), "{cycle:#?}");
                if failed_by_gap(&report) {
                    failed += 1;
                } else {
                    passed += 1;
                }
                last = Some((gap, report));
            }
        }
    }
    println!("{failed} gaps failed, {passed} passed");
    assert!(failed > 1000 && passed > 1000);
}

#[test]
fn every_law_is_refuted_by_a_wrong_report() {
    let near = cycle(10.0, 150.0, 17.9);
    let mut wrong = report(&near);
    assert!(failed_by_gap(&wrong) && s_follow_is_never_below_s_cav(&near, &wrong));
    // As if s_follow were s_b(v_now) - s_b(v_lead) + s_CAV without the max.
    wrong.stages[3] = Outcome::Passed;
    assert!(!s_follow_is_never_below_s_cav(&near, &wrong));
    let passing = report(&cycle(10.0, 10.0, 50.0));
    let failing = report(&cycle(10.0, 10.0, 1.0));
    assert!(!a_larger_gap_is_never_worse(&passing, &failing));
    assert!(!s_follow_falls_with_v_lead(&passing, &failing));
}
