//! Mistakes that the plain calls take without a word, and what the monitor makes of them.

use mufasa::cycle::check;
use mufasa::input::cycle::{Cycle, DetectionList, Lead, TrackList, Trajectory, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::monitor::{Arrival, Decision, DropReason, Gap, Inputs, Message, Monitor, Time};
use mufasa::offloading::requester::{
    Event, EventKind, Group, Groups, Requester, Source, StationRecord,
};
use mufasa::report::{FailedStage, InvalidInput, Outcome, Report, Rule, Stage};
use mufasa::services::configuration::Configuration;

use super::kit::{
    Buffers, MS, Station, World, at, inputs, look_around, message, road, route, seconds, settings,
};

/// The plain record of a world, without history.
fn record<'w>(
    world: &'w World,
    cross_sections: &'w [mufasa::input::cycle::CrossSection],
    configuration: Configuration,
) -> Cycle<'w> {
    let stamp_ns = world.now_ns;
    Cycle {
        profile: Profile::HARDENED,
        parameters: settings().stages,
        now_ns: stamp_ns,
        configuration,
        ego: world.ego,
        trajectory: Some(Trajectory { stamp_ns, points: &world.points }),
        tracks: Some(TrackList { stamp_ns, items: &world.tracks }),
        detections: Some(DetectionList { stamp_ns, items: &world.detections }),
        lead: None,
        route: route(cross_sections),
        grid: None,
        detection_history: &[],
    }
}

/// A station after so many safe periods.
pub fn driven(monitor: &mut Monitor<'_>, periods: i64) -> Station {
    let mut station = Station::default();
    for i in 0..periods {
        assert_eq!(period(monitor, &mut station, &World::at(100 * i * MS)), None);
    }
    station
}

/// A period with a station: what the cycle says, as stage and rule; none while it is safe.
fn period(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    world: &World,
) -> Option<(FailedStage, Option<Rule>)> {
    let (tracks, points) = station.period(monitor, world);
    let (decision, actions) = monitor.cycle(&inputs(world, &tracks, &points));
    station.take(&actions);
    match decision {
        Decision::Safe { .. } => None,
        Decision::Unsafe { report, .. } => {
            let report = report.expect("valid input");
            let rule = report.stages.iter().find_map(|outcome| match outcome {
                Outcome::Failed(witness) => Some(witness.rule),
                Outcome::Passed
                | Outcome::Skipped(_)
                | Outcome::NotApplicable(_)
                | Outcome::NotScheduled => None,
            });
            Some((report.failed_stage.expect("unsafe"), rule))
        }
    }
}

/// The world with the tracks of the remote 3 m aside.
fn forged(now_ns: i64) -> World {
    let mut world = World::at(now_ns);
    world.tracks[0].y = 3.0;
    world
}

/// `check(..)?` and `is_ok()` accept an unsafe cycle; a decision has no such answer, and what was
/// checked is not in the unsafe branch. MON-01, FALL-03, SCHED-18.
#[test]
fn an_unsafe_cycle_is_not_taken_for_a_safe_one() {
    let cross_sections = road();
    let plain = forged(1_000 * MS);
    assert!(check_plainly(&record(&plain, &cross_sections, Configuration::AllRemote)).is_ok());

    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = driven(&mut monitor, 10);
    assert_eq!(monitor.configuration(), Configuration::AllRemote);
    let failed = period(&mut monitor, &mut station, &forged(1_000 * MS));
    assert_eq!(failed.map(|(stage, _)| stage), Some(FailedStage::Stage(Stage::I)));
}

/// `step(&verdict).unwrap();` throws the fallback away, or nobody calls it; after `cycle` the requester
/// has fallen back, whatever is done with the decision. MON-10.
#[test]
fn a_fallback_cannot_be_thrown_away() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = driven(&mut monitor, 10);
    let world = forged(1_000 * MS);
    let now = at(world.now_ns);
    let (tracks, points) = station.period(&mut monitor, &world);
    let (tracks, points) = (tracks.expect("accepted"), points.expect("accepted"));
    let inputs = Inputs::new(now, world.ego)
        .detections(now, &world.detections)
        .remote_tracks(&tracks)
        .remote_trajectory(&points);
    let _ = monitor.cycle(&inputs);
    assert_eq!(monitor.configuration(), Configuration::Local);
    assert_eq!(Group::ALL.map(|group| monitor.source(group)), [Source::Local; 2]);
    assert_eq!(monitor.requester().hold_until_ns(), Some(world.now_ns + 10_000 * MS));
    // The same data again: of an ended session, they count as missing.
    match monitor.cycle(&inputs).0 {
        Decision::Safe { tracks: None, trajectory: None, report, .. } => {
            assert!(report.stages.iter().all(|stage| *stage == Outcome::NotScheduled));
        }
        decision => panic!("{decision:?}"),
    }
}

/// With `Configuration::Local` every record is safe; the monitor knows which groups are remote.
/// MON-06.
#[test]
fn a_wrong_configuration_cannot_be_given() {
    let (cross_sections, world) = (road(), forged(1_000 * MS));
    let local = check_plainly(&record(&world, &cross_sections, Configuration::Local));
    assert_eq!(local.map(|report| report.failed_stage), Ok(None));
    // `an_unsafe_cycle_is_not_taken_for_a_safe_one`: the same data are unsafe in the monitor.
}

/// A car that crosses the road at 5 m/s, 6.5 m ahead of the CAV at `end_ns`, and a track of it that
/// stands.
fn crossing(now_ns: i64, end_ns: i64) -> World {
    let mut world = World::at(now_ns);
    let x = World::at(end_ns).ego.x + 6.5;
    let y = 4.7 + 5.0 * seconds(end_ns - now_ns);
    world.add([x, y], [0.0, -1.0], [0.0, 0.0]);
    world
}

/// A car crosses at 5 m/s, and the remote says that it stands: without the lists kept between cycles
/// that is safe in every cycle, and the monitor, which has them, sees the car move.
/// MON-15.
#[test]
fn forged_velocities_are_not_accepted_for_lack_of_a_history() {
    let (end_ns, cross_sections) = (1_500 * MS, road());
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = Station::default();
    let mut found = None;
    for i in 0..=15 {
        let world = crossing(100 * i * MS, end_ns);
        let forgotten = check_plainly(&record(&world, &cross_sections, Configuration::AllRemote));
        assert_eq!(forgotten.map(|report| report.failed_stage), Ok(None), "at {i}");
        found = found.or(period(&mut monitor, &mut station, &world));
    }
    assert_eq!(found, Some((FailedStage::Stage(Stage::Iv), Some(Rule::FailSafe))));
}

/// Detections that were not current are no history: in the same drive with late scans until its last cycle
/// no station is asked. MON-12, MON-43.
#[test]
fn detections_that_were_not_current_are_not_kept() {
    let (end_ns, cross_sections) = (1_100 * MS, road());
    for (late_ns, is_safe) in [(100 * MS, false), (100 * MS + 1, true)] {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.started_on(&cross_sections);
        let mut station = Station::default();
        let mut last = None;
        for i in 0..=11 {
            let world = crossing(100 * i * MS, end_ns);
            let stamp_ns = world.now_ns - if i < 11 { late_ns } else { 0 };
            let scanned = crossing(stamp_ns, end_ns).detections;
            // Only the last cycle has anything to check: the station comes as late as that.
            let (tracks, points) =
                if i < 9 { (None, None) } else { station.period(&mut monitor, &world) };
            let now = at(world.now_ns);
            let mut inputs = Inputs::new(now, world.ego).detections(at(stamp_ns), &scanned);
            if let (11, Some(tracks), Some(points)) = (i, &tracks, &points) {
                inputs = inputs.remote_tracks(tracks).remote_trajectory(points);
            }
            let (decision, actions) = monitor.cycle(&inputs);
            last = Some(matches!(decision, Decision::Safe { .. }));
            station.take(&actions);
        }
        assert_eq!(last, Some(is_safe), "{late_ns} ns late");
        assert_eq!(station.sessions, [None; 2], "released, or never asked");
        assert_eq!(monitor.requester().sessions() == 0, is_safe, "{late_ns} ns late");
    }
}

/// Microseconds for nanoseconds: data five seconds old are 5 ms old to the plain requester. A bare number
/// is no `Time`, and one that says its unit is right. MON-07.
#[test]
fn data_five_seconds_old_are_not_fresh_in_microseconds() {
    let (now_us, generated_us) = (10_000_000, 5_000_000);
    let mut table = [StationRecord::FREE; 1];
    let mut requester =
        Requester::new(Profile::HARDENED, settings().requester, &mut table).expect("a requester");
    let confirm = EventKind::Confirm { station: 1, group: Group::Mot, session: 1 };
    let offer = EventKind::Offer { station: 1, groups: Groups::ALL };
    let (group, session) = (Group::Mot, 1);
    let data = EventKind::Data { station: 1, group, session, generated_ns: generated_us };
    let mut last = None;
    for kind in [offer, EventKind::Tick, confirm, data] {
        last = Some(requester.step(&Event { t_ns: now_us, kind }).expect("a station").to_vec());
    }
    assert_eq!(last, Some(Vec::new()), "the plain requester uses it");

    let mut buffers = Buffers::new(16, 40);
    let cross_sections = road();
    let mut monitor = buffers.on(&cross_sections);
    let now = Time::from_microseconds(now_us).expect("a time");
    look_around(&mut monitor, now.as_nanoseconds(), World::at);
    let generated = Time::from_microseconds(generated_us).expect("a time");
    let _none = monitor.offer(now, 1, Groups::ALL).expect("a station");
    let _requests = monitor.tick(now);
    let _none = monitor.confirm(now, 1, Group::Mot, 1).expect("a station");
    let old = Message { generated, ..message(1, now, Vec::new()) };
    let (arrival, actions) = monitor.tracks(now, old).expect("a station");
    assert!(matches!(arrival, Arrival::Dropped { .. }), "{arrival:?}");
    assert_eq!(actions.len(), 2, "dropped and released");
}

/// A gap of 2 m bumper to bumper, below s_react at 5 m/s behind a car that stands, is 5.65 m from the
/// rear axle, above it. `Gap` says from where; a bare number does not compile.
#[test]
fn a_gap_from_the_rear_axle_is_not_taken_for_one_between_bumpers() {
    let (cross_sections, world) = (road(), World::at(1_000 * MS));
    let lead = |gap| Some(Lead { stamp_ns: world.now_ns, gap, speed: 0.0 });
    let verdict = |gap| {
        let mut cycle = record(&world, &cross_sections, Configuration::AllRemote);
        cycle.lead = lead(gap);
        check_plainly(&cycle).expect("valid").failed_stage
    };
    let (free, measured) = (2.0, 5.65);
    assert_eq!((verdict(measured), verdict(free)), (None, Some(FailedStage::Stage(Stage::Iv))));
    let gap = Gap::from_reference_point(measured, &world.ego).metres();
    assert!((gap - free).abs() < 1e-9, "{gap}");
    assert_eq!(verdict(gap), Some(FailedStage::Stage(Stage::Iv)));
}

/// Late, repeated, of another session, of an older element, empty: what becomes of each.
/// MON-07, MON-08.
#[test]
fn what_was_dropped_or_passed_over_is_missing_in_a_cycle() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = driven(&mut monitor, 3);
    let session = station.sessions[1].expect("PLAN is remote");
    let world = World::at(300 * MS);
    let now = at(world.now_ns);
    let (_, first) = station.period(&mut monitor, &world);
    let first = first.expect("accepted");
    let repeated = message(session, now, world.points.clone());
    let repeated = monitor.trajectory(now, repeated).expect("a station");
    assert!(matches!(repeated.0, Arrival::Dropped { why: DropReason::NotNewer }), "twice");
    let other = message(session + 7, now, world.points.clone());
    let other = monitor.trajectory(now, other).expect("a station");
    assert!(
        matches!(other.0, Arrival::Dropped { why: DropReason::OtherSession }),
        "of another session"
    );
    let world = World::at(320 * MS);
    let now = at(world.now_ns);
    let newer = monitor.trajectory(now, message(session, now, world.points.clone()));
    let Ok((Arrival::Accepted(newer), _)) = newer else { panic!("in time and newer") };
    let come_out = |monitor: &mut Monitor<'_>, token| {
        let own = Inputs::new(now, world.ego).detections(now, &world.detections);
        assert!(monitor.tick(now).is_empty());
        match monitor.cycle(&own.remote_trajectory(token)).0 {
            Decision::Safe { trajectory, .. } => trajectory.map(|it| it.stamp_ns),
            Decision::Unsafe { report, .. } => panic!("{report:?}"),
        }
    };
    assert_eq!(come_out(&mut monitor, &first), None, "passed over for the older one");
    assert_eq!(come_out(&mut monitor, &newer), Some(world.now_ns));
    let now = at(400 * MS);
    let nothing = message(session, now, Vec::<TrajectoryPoint>::new());
    let arrival = monitor.trajectory(now, nothing);
    let Ok((Arrival::Accepted(nothing), _)) = arrival else { panic!("empty") };
    let inputs = Inputs::new(now, world.ego).remote_trajectory(&nothing);
    assert!(monitor.tick(now).is_empty());
    match monitor.cycle(&inputs).0 {
        Decision::Unsafe { report: Ok(report), .. } => {
            assert_eq!(report.failed_stage, Some(FailedStage::Input), "empty");
        }
        decision => panic!("{decision:?}"),
    }
}

/// What a monitor accepted of one station is no result of another's session, although number and time are the same.
#[test]
fn what_another_monitor_accepted_is_missing() {
    let cross_sections = road();
    let [mut mine, mut others] = [(); 2].map(|()| Buffers::new(16, cross_sections.len()));
    let mut accepted = Vec::new();
    let world = World::at(0);
    for (buffers, station) in [(&mut mine, 1), (&mut others, 2)] {
        let mut monitor = buffers.on(&cross_sections);
        let _request = monitor.offer(at(0), station, Groups::from(Group::Plan)).expect("a station");
        let asked = monitor.tick(at(0));
        assert_eq!(asked.len(), 1, "{asked:?}");
        let _done = monitor.confirm(at(0), station, Group::Plan, 1).expect("a station");
        let message = Message { station, ..message(1, at(0), world.points.clone()) };
        let (arrival, _none) = monitor.trajectory(at(0), message).expect("a station");
        let Arrival::Accepted(element) = arrival else { panic!("{arrival:?}") };
        accepted.push(element);
        let mut given = accepted.iter().map(|it| {
            let now = at(world.now_ns);
            let inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
            let inputs = inputs.remote_trajectory(it);
            let _none = monitor.tick(now);
            let (decision, _) = monitor.cycle(&inputs);
            matches!(decision, Decision::Safe { trajectory: Some(_), .. })
        });
        let given: Vec<bool> = given.by_ref().collect();
        assert_eq!(given, if station == 1 { vec![true] } else { vec![false, true] });
    }
}

/// Both are numbers from 1 on. Nothing comes of them in the other's place.
#[test]
fn station_and_session_swapped_give_nothing() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let (station, session) = (7, 1);
    let _none = monitor.offer(at(0), station, Groups::ALL).expect("a station");
    let _requests = monitor.tick(at(0));
    let _none = monitor.confirm(at(0), session, Group::Mot, station).expect("a station");
    assert_eq!(monitor.configuration(), Configuration::Local);
    let _none = monitor.confirm(at(0), station, Group::Mot, session).expect("a station");
    assert_eq!(monitor.configuration(), Configuration::MotRemote);
    let tracks = Message { station: session, ..message(station, at(0), World::at(0).tracks) };
    let (arrival, _drop) = monitor.tracks(at(0), tracks).expect("a station");
    assert!(matches!(arrival, Arrival::Dropped { why: DropReason::OtherSession }));
}

/// What no type and no check notices (`docs/misuse.md`): the vehicle's program has to keep it.
#[test]
fn what_compiles_and_is_a_duty() {
    let (cross_sections, world) = (road(), World::at(300 * MS));
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let station = driven(&mut monitor, 3);
    let now = at(world.now_ns);
    let _ = monitor.tick(now);
    monitor.offer(now, 2, Groups::ALL).ok();
    // Made 40 ms ago for now, and told as made now for 40 ms ago.
    let (before, session) = (at(world.now_ns - 40 * MS), station.sessions[1].expect("PLAN"));
    let right = Message { generated: before, ..message(session, now, world.points.clone()) };
    let driven_unchecked = right.items.clone();
    let swapped = Message { generated: right.stamp, stamp: right.generated, ..right };
    let (arrival, _none) = monitor.trajectory(now, swapped).expect("a station");
    let Arrival::Accepted(accepted) = arrival else { panic!("{arrival:?}") };
    let inputs = Inputs::new(now, world.ego)
        .detections(now, &world.detections)
        .local_trajectory(now, &driven_unchecked)
        .remote_trajectory(&accepted);
    let Decision::Safe { trajectory: Some(verified), .. } = monitor.cycle(&inputs).0 else {
        panic!("safe")
    };
    assert!(verified.brake_by().is_some() && verified.points.to_vec() == driven_unchecked);
}

/// The stages with scratch of the size that the cycle asks for.
fn check_plainly(cycle: &Cycle<'_>) -> Result<Report, InvalidInput> {
    let sizes = Sizes::for_cycle(cycle);
    let mut rows = vec![Row::default(); sizes.rows];
    let mut columns = vec![Column::default(); sizes.columns];
    check(cycle, &mut Scratch::new(&mut rows, &mut columns))
}
