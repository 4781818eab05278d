//! `spec/3-stages.md#invalid-input`, `spec/4-arithmetic.md#domain`

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, DetectionList, Profile};
use mufasa_model::report::{InvalidInput, Reading};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};

use crate::base::*;

type Change = fn(&mut Cycle);

/// What is wrong, with field and index: an error, or the reason of an unsafe cycle.
fn problem(configuration: Configuration, change: Change) -> Option<(bool, String, Option<usize>)> {
    let mut cycle = base(Profile::HARDENED, configuration);
    cycle.lead = lead(90.0, 10.0);
    cycle.detection_history =
        vec![DetectionList { stamp_ns: NOW - 1, items: vec![detection(60.0, 0.0)] }];
    change(&mut cycle);
    let local = |local: bool, p: InvalidInput| Some((local, p.field, p.index));
    match check(&cycle, Reading::Exact) {
        Err(problem) => local(true, problem),
        Ok(report) => report.input.and_then(|problem| local(false, problem)),
    }
}

macro_rules! list {
    ($cycle:ident . $list:ident) => {
        $cycle.$list.as_mut().expect("the list is there")
    };
}

/// INPUT-04, DOM-01: lists and numbers beyond the domain that no vector is.
#[test]
fn values_beyond_the_domain_are_invalid() {
    let cases: &[(Change, &str)] = &[
        (|c| c.parameters.n = 65, "parameters.n"),
        (|c| c.parameters.miss_budget = -1, "parameters.miss_budget"),
        (|c| c.parameters.work_limit = -1, "parameters.work_limit"),
        (|c| list!(c.detections).items = vec![detection(9.0, 9.0); 2049], "detections.items"),
        (|c| list!(c.trajectory).points = vec![at_time(0, 0.0, 0.0); 1025], "trajectory.points"),
        (|c| list!(c.lead).stamp_ns = NOW + 60_000_000_001, "lead.stamp_ns"),
    ];
    for (change, field) in cases {
        assert_eq!(problem(MotRemote, *change), Some((true, (*field).into(), None)));
    }
}

/// DOM-02: the ends of the domains are inside, and the norm check is exact.
#[test]
fn the_ends_of_the_domains_are_valid() {
    let cases: &[Change] = &[
        |c| c.parameters.theta_tr = 1e-3,
        |c| c.parameters.theta_map = 1e3,
        |c| c.parameters.a_b = 100.0,
        |c| c.parameters.safety_time = 0.0,
        |c| c.parameters.n = 64,
        |c| c.parameters.miss_budget = 64,
        |c| c.parameters.v_max = f64::from_bits(1),
        |c| c.parameters.delta = 1e-2,
        |c| c.ego.x = -16_777_216.0,
        |c| c.ego.speed = 150.0,
        |c| c.ego.cos = 1.000_000_4,
        |c| list!(c.lead).gap = 1e6,
        |c| list!(c.lead).stamp_ns = NOW + 60_000_000_000,
        |c| list!(c.grid).resolution = 0.01,
        |c| list!(c.detections).items = vec![detection(9.0, 9.0); 2048],
        |c| list!(c.tracks).items[0].vx = -150.0,
        |c| list!(c.tracks).items[0].id = i64::MIN,
        |c| list!(c.trajectory).points[50].t_ns = NOW + 60_000_000_000,
    ];
    for (i, change) in cases.iter().enumerate() {
        assert_eq!(problem(AllRemote, *change), None, "case {i}");
    }
}

/// SCHED-13: a local list older than 60 s counts as missing, but its values are
/// still checked; a remote one is invalid.
#[test]
fn old_local_data_are_missing_old_remote_data_invalid() {
    let old: Change = |c| {
        list!(c.detections).stamp_ns = i64::MIN;
        list!(c.grid).stamp_ns = NOW - 60_000_000_001;
        list!(c.lead).stamp_ns = i64::MIN;
        c.detection_history[0].stamp_ns = i64::MIN;
    };
    assert_eq!(problem(MotRemote, old), None);
    let old_and_wrong: Change = |c| {
        list!(c.detections).stamp_ns = i64::MIN;
        list!(c.detections).items[0].x = f64::NAN;
    };
    assert_eq!(
        problem(MotRemote, old_and_wrong),
        Some((true, "detections.items.x".into(), Some(0)))
    );
    let tracks: Change = |c| list!(c.tracks).stamp_ns = NOW - 60_000_000_001;
    assert_eq!(problem(PlanRemote, tracks), None);
    assert_eq!(problem(AllRemote, tracks), Some((false, "tracks.stamp_ns".into(), None)));
    let trajectory: Change = |c| {
        let trajectory = list!(c.trajectory);
        trajectory.stamp_ns = i64::MIN;
        trajectory.points.iter_mut().for_each(|point| point.t_ns -= 100_000_000_000);
    };
    assert_eq!(problem(MotRemote, trajectory), None);
    // The stamp decides: an old point under a fresh stamp is outside the domain.
    let old_point: Change = |c| list!(c.trajectory).points[0].t_ns = NOW - 60_000_000_001;
    let field = || "trajectory.points.t_ns".into();
    assert_eq!(problem(MotRemote, old_point), Some((true, field(), Some(0))));
    assert_eq!(problem(PlanRemote, old_point), Some((false, field(), Some(0))));
    let at_the_end: Change = |c| list!(c.trajectory).points[0].t_ns = NOW - 60_000_000_000;
    assert_eq!(problem(MotRemote, at_the_end), None);
    assert_eq!(problem(PlanRemote, trajectory), Some((false, "trajectory.stamp_ns".into(), None)));
}
