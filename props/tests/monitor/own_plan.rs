//! The CAV's own plan in `Local` (MON-47, MON-51, finding
//! F-48), and planning that gets nowhere (MON-54, finding F-45).

use std::time::Duration;

use mufasa::monitor::{Brake, Decision, Inputs, Monitor, MonitorError, Settings, Stall};
use mufasa::offloading::requester::{Action, Group, Groups};
use mufasa::report::{FailedStage, Rule, Stage};
use mufasa::services::configuration::Configuration;

use super::kit::{Buffers, MS, Points, Station, Tracks, World, at, inputs, look_around, message};
use super::kit::{road, route, seconds, settings};

fn supervised() -> Settings {
    Settings { supervise_local: true, ..settings() }
}

/// What the decision says of the CAV's own plan.
fn brake(monitor: &mut Monitor<'_>, inputs: &Inputs<'_>) -> Option<Brake> {
    let (Decision::Safe { brake, .. } | Decision::Unsafe { brake, .. }) = monitor.cycle(inputs).0;
    brake
}

/// On the road with these settings, everything local, with half a second seen.
fn on_road(settings: Settings, then: impl FnOnce(Monitor<'_>)) {
    beside(settings, World::at, then);
}

fn beside<T>(
    settings: Settings,
    world: impl Fn(i64) -> World,
    then: impl FnOnce(Monitor<'_>) -> T,
) -> T {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, cross_sections.len());
    let mut monitor = buffers.monitor(settings).expect("a monitor");
    monitor.set_route(&route(&cross_sections)).expect("a route");
    look_around(&mut monitor, 0, world);
    then(monitor)
}

/// Somebody stands 6 m ahead of the front, which is within the way to a stop.
fn blocked(now_ns: i64) -> World {
    let mut world = World::at(now_ns);
    let x = world.ego.x + 1.4 + 2.25 + 2.0;
    world.add([x + 2.25, 0.0], [1.0, 0.0], [0.0, 0.0]);
    world
}

fn own(world: &World, stamp_ns: i64) -> Inputs<'_> {
    inputs(world, &None, &None)
        .local_tracks(at(world.now_ns), &world.tracks)
        .local_trajectory(at(stamp_ns), &world.points)
}

/// MON-50, MON-53.
#[test]
fn an_own_plan_that_fails_has_to_be_braked_for_until_one_passes() {
    on_road(supervised(), |mut monitor| {
        let (free, ahead) = (World::at(0), blocked(100 * MS));
        assert_eq!(brake(&mut monitor, &own(&free, 0)), None);
        let said = brake(&mut monitor, &own(&ahead, ahead.now_ns));
        let Some(Brake::Fails { stage, witness: Some(witness) }) = said else { panic!("{said:?}") };
        assert_eq!((stage, witness.rule), (FailedStage::Stage(Stage::Iii), Rule::Collision));
        let free = World::at(200 * MS);
        assert_eq!(brake(&mut monitor, &own(&free, free.now_ns)), None);
        // The requester has heard of nothing: a station is asked.
        let mut station = Station::default();
        let _none = station.period(&mut monitor, &World::at(300 * MS));
        assert_eq!(station.asked.len(), 2);
    });
}

/// MON-50, MON-51.
#[test]
fn who_has_no_current_plan_or_invalid_input_brakes() {
    on_road(supervised(), |mut monitor| {
        let world = World::at(0);
        assert_eq!(brake(&mut monitor, &inputs(&world, &None, &None)), Some(Brake::NoPlan));
        // 100 ms is the oldest that is current.
        assert_eq!(brake(&mut monitor, &own(&world, -100 * MS)), None);
        for stamp_ns in [1, -100 * MS - 1] {
            assert_eq!(brake(&mut monitor, &own(&world, stamp_ns)), Some(Brake::NoPlan));
        }
        let mut invalid = world.clone();
        invalid.ego.speed = f64::NAN;
        let said = brake(&mut monitor, &own(&invalid, 0));
        assert!(matches!(said, Some(Brake::Invalid(it)) if it.field == "ego.speed"), "{said:?}");
    });
}

/// MON-49.
#[test]
fn nothing_is_said_where_nothing_was_asked_for() {
    on_road(settings(), |mut monitor| {
        let ahead = blocked(0);
        assert_eq!(brake(&mut monitor, &own(&ahead, 0)), None);
        assert_eq!(brake(&mut monitor, &inputs(&ahead, &None, &None)), None);
    });
}

/// F-48: the plan that stage iv has just rejected in MotRemote. And what is braked for lasts over a session until a
/// trajectory comes out. MON-47, MON-48, MON-52.
#[test]
fn the_plan_that_was_rejected_is_examined_in_the_same_cycle() {
    let mut settings = supervised();
    settings.requester.t_wait_ns = 0;
    on_road(settings, |mut monitor| {
        let mut station = Station::default();
        let _none = monitor.area(at(0), Groups::from(Group::Mot));
        let mut period = |monitor: &mut Monitor<'_>, world: &World, has_plan: bool| {
            let (tracks, points): (Tracks, Points) = station.period(monitor, world);
            let now = at(world.now_ns);
            let mut inputs = inputs(world, &tracks, &points);
            if has_plan {
                inputs = inputs.local_trajectory(now, &world.points);
            }
            let is_remote = monitor.configuration() != Configuration::Local;
            let (decision, actions) = monitor.cycle(&inputs);
            let said = match decision {
                Decision::Safe { brake, trajectory, .. } => (true, trajectory.is_some(), brake),
                Decision::Unsafe { brake, .. } => (false, false, brake),
            };
            station.take(&actions);
            (is_remote, said)
        };
        assert_eq!(period(&mut monitor, &World::at(0), true), (false, (true, false, None)));
        assert_eq!(period(&mut monitor, &World::at(100 * MS), true), (true, (true, true, None)));
        let (is_remote, (safe, _, said)) = period(&mut monitor, &blocked(200 * MS), true);
        assert!(is_remote && !safe && matches!(said, Some(Brake::Fails { .. })), "{said:?}");
        let free = |i: i64| World::at(i * 100 * MS);
        // After the wait of a period everything is remote again; nothing has come that may be followed.
        let mut i = 3;
        while !period(&mut monitor, &free(i), false).0 {
            i += 1;
            assert!(i < 40, "no station is asked");
        }
        let (is_remote, (safe, comes_out, said)) = period(&mut monitor, &free(i + 1), false);
        assert_eq!((is_remote, safe, comes_out, said), (true, true, false, Some(Brake::NoPlan)));
        assert_eq!(period(&mut monitor, &free(i + 2), true), (true, (true, true, None)));
    });
}

/// The CAV gets on by this much in each cycle, m, and all others stay beside it.
fn creeping(now_ns: i64, step_m: f64) -> World {
    let mut world = World::at(now_ns);
    let x = step_m * 10.0 * seconds(now_ns);
    let back = x - world.ego.x;
    (world.ego.x, world.ego.speed) = (x, step_m * 10.0);
    world.points.iter_mut().for_each(|it| it.x = x);
    world.detections.iter_mut().for_each(|it| it.x += back);
    world.tracks.iter_mut().for_each(|it| it.x += back);
    world
}

/// In which of so many cycles planning was given back.
fn given_back(stall: Option<Stall>, groups: Groups, step_m: f64, cycles: i64) -> Vec<i64> {
    given_back_unless(stall, groups, step_m, cycles, None)
}

/// And the area for planning is left before a cycle.
fn given_back_unless(
    stall: Option<Stall>,
    groups: Groups,
    step_m: f64,
    cycles: i64,
    left_at: Option<i64>,
) -> Vec<i64> {
    let world = |now_ns: i64| creeping(now_ns, step_m);
    beside(Settings { stall, ..settings() }, world, |mut monitor| {
        let mut found = Vec::new();
        let _none = monitor.area(at(0), groups);
        let mut station = Station::default();
        for i in 0..cycles {
            let world = world(i * 100 * MS);
            let now = at(world.now_ns);
            if left_at == Some(i) {
                let _drops = monitor.area(now, Groups::from(Group::Mot));
            }
            let before = monitor.requester().session_of(Group::Plan);
            let (tracks, points) = station.period(&mut monitor, &world);
            if monitor.given_back() == Some(now) {
                found.push(i);
                let hold_ns = world.now_ns + settings().requester.t_wait_ns;
                assert!(before.is_some() && monitor.requester().session_of(Group::Plan).is_none());
                assert_eq!(monitor.requester().hold_until_ns(), Some(hold_ns));
                assert_eq!(monitor.requester().suspend().parts().area, groups);
            }
            let all = inputs(&world, &tracks, &points).local_trajectory(now, &world.points);
            let all = if tracks.is_none() { all.local_tracks(now, &world.tracks) } else { all };
            let (decision, actions) = monitor.cycle(&all);
            assert!(matches!(decision, Decision::Safe { .. }), "{decision:?}");
            station.take(&actions);
        }
        found
    })
}

const STALL: Option<Stall> = Some(Stall { way_m: 1.0, time: Duration::from_secs(3) });

/// Confirmed in the second cycle, 3 s after it it is given back; asked again 10 s later, confirmed in the cycle after. MON-54, MON-58, MON-59.
#[test]
fn planning_that_gets_nowhere_is_given_back_and_asked_for_again_after_the_wait() {
    for groups in [Groups::ALL, Groups::from(Group::Plan)] {
        assert_eq!(given_back(STALL, groups, 0.0, 200), [32, 164], "{groups:?}");
    }
}

/// MON-55, MON-56.
#[test]
fn planning_that_gets_on_is_not_given_back_nor_that_of_the_cav_itself() {
    assert_eq!(given_back(STALL, Groups::ALL, 0.05, 200), [0; 0]);
    assert_eq!(given_back(STALL, Groups::from(Group::Mot), 0.0, 200), [0; 0]);
    assert_eq!(given_back(None, Groups::ALL, 0.0, 200), [0; 0]);
    // Planning that has just become local is not given back, however long it got nowhere.
    assert_eq!(given_back_unless(STALL, Groups::ALL, 0.0, 40, Some(32)), [0; 0]);
    // 1 m in 3.03 s is too slow.
    assert_eq!(given_back(STALL, Groups::ALL, 0.033, 70), [61]);
}

/// MON-60.
#[test]
fn what_is_no_way_or_no_time_is_refused() {
    let with = |way_m, ms| {
        let stall = Some(Stall { way_m, time: Duration::from_millis(ms) });
        Settings { stall, ..settings() }.check()
    };
    assert_eq!(with(0.0, 1_000), Ok(()));
    for (way_m, ms) in [(f64::NAN, 30_000), (-1.0, 30_000), (f64::INFINITY, 30_000), (1.0, 999)] {
        assert!(matches!(with(way_m, ms), Err(MonitorError::Stall { .. })), "{way_m} {ms}");
    }
    let default = Stall { way_m: 1.0, time: Duration::from_secs(30) };
    assert_eq!(Stall::default(), default);
    assert_eq!(Settings::new(Duration::from_millis(50)).stall, None);
}

/// The release and the start of the local planner come out of the tick, with those of MOT's own silence in the order
/// of one event. MON-57, FALL-13.
#[test]
fn the_tick_names_release_and_start() {
    let stands = |now_ns: i64| creeping(now_ns, 0.0);
    beside(Settings { stall: STALL, ..settings() }, stands, |mut monitor| {
        let mut station = Station::default();
        for i in 0..32 {
            let world = stands(i * 100 * MS);
            let (tracks, points) = station.period(&mut monitor, &world);
            let (decision, actions) = monitor.cycle(&inputs(&world, &tracks, &points));
            assert!(matches!(decision, Decision::Safe { .. }), "{i}: {decision:?}");
            station.take(&actions);
        }
        let [mot, plan] = station.sessions.map(|it| it.expect("a session"));
        let _late = monitor.tracks(at(3_150 * MS), message(mot, at(3_150 * MS), Vec::new()));
        let actions = monitor.tick(at(3_310 * MS));
        let release = |group, session| Action::Release { station: 1, group, session };
        let expected = [
            release(Group::Mot, mot),
            release(Group::Plan, plan),
            Action::Activate(Group::Mot),
            Action::Activate(Group::Plan),
        ];
        assert_eq!(actions.to_vec(), expected);
    });
}
