//! `spec/3-stages.md#invalid-input`, `spec/4-arithmetic.md#domain`

use mufasa_model::input::cycle::{Cycle, Profile, TrackList};
use mufasa_model::report::{FailedStage, InvalidInput, Outcome, Reading, Reason, Stage};
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, Local, MotRemote, PlanRemote,
};
use mufasa_model::stages::check;

use crate::base::*;

type Change = fn(&mut Cycle);

/// What is wrong, with field and index: an error, or the reason of an unsafe cycle.
fn problem(configuration: Configuration, change: Change) -> Option<(bool, String, Option<usize>)> {
    let mut cycle = base(Profile::Hardened, configuration);
    cycle.lead = lead(90.0, 10.0);
    cycle.previous_tracks = Some(TrackList { stamp_ns: NOW - 1, items: vec![track(1, 60.0, 0.0)] });
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

/// spec/4-arithmetic.md#conformance-of-an-implementation.4, spec/3-stages.md#invalid-input.2: every
/// quantity beyond the ends of its domain, NaN and infinite.
#[test]
fn values_outside_the_domain_are_invalid() {
    let cases: &[(Change, &str, Option<usize>)] = &[
        (|c| c.parameters.theta_tr = 0.9e-3, "parameters.theta_tr", None),
        (|c| c.parameters.theta_map = 1e3f64.next_up(), "parameters.theta_map", None),
        (|c| c.parameters.theta_obj = f64::NAN, "parameters.theta_obj", None),
        (|c| c.parameters.a_b = 0.1f64.next_down(), "parameters.a_b", None),
        (|c| c.parameters.safety_time = -f64::MIN_POSITIVE, "parameters.safety_time", None),
        (|c| c.parameters.max_age_ns = 60_000_000_001, "parameters.max_age_ns", None),
        (|c| c.parameters.n = 0, "parameters.n", None),
        (|c| c.parameters.n = 65, "parameters.n", None),
        (|c| c.parameters.theta_track_max = f64::INFINITY, "parameters.theta_track_max", None),
        (|c| c.parameters.miss_budget = 65, "parameters.miss_budget", None),
        (|c| c.parameters.tau = 60.0f64.next_up(), "parameters.tau", None),
        (|c| c.parameters.a_max = 100.0f64.next_up(), "parameters.a_max", None),
        (|c| c.parameters.start_tolerance = 0.0, "parameters.start_tolerance", None),
        (|c| c.parameters.v_max = 0.0, "parameters.v_max", None),
        (|c| c.parameters.step_max_ns = -1, "parameters.step_max_ns", None),
        (|c| c.parameters.theta_velocity = 0.0, "parameters.theta_velocity", None),
        (|c| c.parameters.delta = 1e-8f64.next_down(), "parameters.delta", None),
        (|c| c.ego.x = 16_777_216.0f64.next_up(), "ego.x", None),
        (|c| c.ego.y = f64::NAN, "ego.y", None),
        (|c| c.ego.cos = 1.000_001, "ego.cos", None),
        (|c| c.ego.sin = f64::NEG_INFINITY, "ego.sin", None),
        (|c| c.ego.speed = 150.0f64.next_up(), "ego.speed", None),
        (|c| c.ego.speed = -f64::MIN_POSITIVE, "ego.speed", None),
        (|c| c.ego.length = 0.01f64.next_down(), "ego.length", None),
        (|c| c.ego.width = 100.0f64.next_up(), "ego.width", None),
        (|c| c.ego.center_offset = -100.0f64.next_up(), "ego.center_offset", None),
        (|c| list!(c.lead).gap = -1e-300, "lead.gap", None),
        (|c| list!(c.lead).speed = f64::NAN, "lead.speed", None),
        (|c| list!(c.lead).stamp_ns = NOW + 60_000_000_001, "lead.stamp_ns", None),
        (|c| c.route.cross_sections[1].y = f64::NAN, "route.stations.y", Some(1)),
        (|c| c.route.cross_sections[1].left[1] = f64::INFINITY, "route.stations.left", Some(1)),
        (|c| c.route.cross_sections[0].right[0] = 1e9, "route.stations.right", Some(0)),
        (|c| c.route.cross_sections.truncate(1), "route.stations", None),
        (
            |c| c.route.cross_sections[1] = c.route.cross_sections[0].clone(),
            "route.stations.x",
            Some(1),
        ),
        (|c| list!(c.grid).resolution = 10.0f64.next_up(), "grid.resolution", None),
        (|c| list!(c.grid).width = 0, "grid.width", None),
        (|c| list!(c.grid).height = 32769, "grid.height", None),
        (|c| list!(c.grid).occupied.truncate(3), "grid.occupied", None),
        (|c| list!(c.grid).unknown = Some(vec![]), "grid.unknown", None),
        (|c| list!(c.grid).cos = 0.0, "grid.cos", None),
        (|c| list!(c.detections).items[0].x = f64::NAN, "detections.items.x", Some(0)),
        (|c| list!(c.detections).items[0].width = 0.0, "detections.items.width", Some(0)),
        (|c| list!(c.detections).items = vec![detection(9.0, 9.0); 2049], "detections.items", None),
        (|c| list!(c.detections).stamp_ns = i64::MAX, "detections.stamp_ns", None),
        (|c| list!(c.previous_tracks).items[0].vx = 151.0, "previous_tracks.items.vx", Some(0)),
        (|c| list!(c.tracks).items[0].vy = -151.0, "tracks.items.vy", Some(0)),
        (|c| list!(c.tracks).items.push(track(1, 0.0, 0.0)), "tracks.items.id", Some(1)),
        (|c| list!(c.tracks).items = vec![track(1, 0.0, 0.0); 1025], "tracks.items", None),
        (|c| list!(c.trajectory).points.clear(), "trajectory.points", None),
        (|c| list!(c.trajectory).points[4].sin = 0.01, "trajectory.points.cos", Some(4)),
        (|c| list!(c.trajectory).points[4].t_ns = NOW, "trajectory.points.t_ns", Some(4)),
        (
            |c| list!(c.trajectory).points[50].t_ns += 56_000_000_000,
            "trajectory.points.t_ns",
            Some(50),
        ),
    ];
    for (change, field, index) in cases {
        for configuration in [Local, MotRemote, AllRemote, PlanRemote] {
            let found = problem(configuration, *change);
            let remote = match configuration {
                Local => false,
                MotRemote => field.starts_with("tracks"),
                AllRemote => field.starts_with("tracks") || field.starts_with("trajectory"),
                PlanRemote => field.starts_with("trajectory"),
            };
            assert_eq!(found, Some((!remote, (*field).into(), *index)), "{configuration:?}");
        }
    }
}

/// spec/4-arithmetic.md#domain.1: the ends of the domains are inside, and the norm check is exact.
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

/// spec/3-stages.md#invalid-input.2: the first in the order parameters, ego, lead, route, grid,
/// detections, previous tracks, tracks, trajectory; within a list by item.
#[test]
fn the_first_problem_is_named() {
    let spoil: &[(&str, Change)] = &[
        ("parameters.n", |c| c.parameters.n = 0),
        ("ego.x", |c| c.ego.x = f64::NAN),
        ("lead.gap", |c| list!(c.lead).gap = -1.0),
        ("route.stations.x", |c| c.route.cross_sections[0].x = f64::NAN),
        ("grid.x", |c| list!(c.grid).x = f64::NAN),
        ("detections.items.x", |c| list!(c.detections).items[0].x = f64::NAN),
        ("previous_tracks.items.x", |c| list!(c.previous_tracks).items[0].x = f64::NAN),
        ("tracks.items.x", |c| list!(c.tracks).items[0].x = f64::NAN),
        ("trajectory.points.x", |c| list!(c.trajectory).points[7].x = f64::NAN),
    ];
    for first in 0..spoil.len() {
        let mut cycle = base(Profile::Paper, Local);
        cycle.lead = lead(90.0, 10.0);
        cycle.previous_tracks = tracks(vec![track(1, 60.0, 0.0)]);
        spoil[first..].iter().for_each(|(_, change)| change(&mut cycle));
        let found = check(&cycle, Reading::Exact).expect_err("local input is invalid");
        assert_eq!(found.field, spoil[first].0);
    }
}

/// spec/3-stages.md#invalid-input.3: local problems are errors even when remote data, earlier in
/// the order, are invalid as well; remote ones make the cycle unsafe.
#[test]
fn local_problems_come_before_remote_ones() {
    let tracks: Change = |c| list!(c.tracks).items[0].x = f64::NAN;
    let both: Change = |c| {
        list!(c.tracks).items[0].x = f64::NAN;
        list!(c.trajectory).points[0].x = f64::NAN;
    };
    assert_eq!(problem(MotRemote, both), Some((true, "trajectory.points.x".into(), Some(0))));
    assert_eq!(problem(AllRemote, both), Some((false, "tracks.items.x".into(), Some(0))));
    assert_eq!(problem(PlanRemote, both), Some((true, "tracks.items.x".into(), Some(0))));
    let mut cycle = base(Profile::Hardened, MotRemote);
    tracks(&mut cycle);
    let report = report(&cycle);
    assert_eq!(report.failed_stage, Some(FailedStage::Input));
    let skipped = Outcome::Skipped(Reason::AfterFailure);
    for stage in Stage::ALL {
        let expected = if stage == Stage::Iii { &Outcome::NotScheduled } else { &skipped };
        assert_eq!(&report.stages[stage as usize], expected);
    }
}

/// spec/3-stages.md#schedule.6: a local list older than 60 s counts as missing, but its values are
/// still checked; a remote one is invalid.
#[test]
fn old_local_data_are_missing_old_remote_data_invalid() {
    let old: Change = |c| {
        list!(c.detections).stamp_ns = i64::MIN;
        list!(c.grid).stamp_ns = NOW - 60_000_000_001;
        list!(c.lead).stamp_ns = i64::MIN;
        list!(c.previous_tracks).stamp_ns = i64::MIN;
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

/// The last and the first reference point of a closed route may be equal, consecutive ones not.
#[test]
fn a_closed_route_may_end_where_it_begins() {
    let closed: Change = |c| {
        c.route.closed = true;
        let first = c.route.cross_sections[0].clone();
        c.route.cross_sections.push(first);
    };
    assert_eq!(problem(PlanRemote, closed), None);
}
