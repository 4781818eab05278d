//! What stands between link and control, by hand: nothing of an ended session is used.

use mufasa::input::cycle::{Route, TrackList, TrajectoryPoint};
use mufasa::monitor::{Message, Time};
use mufasa::offloading::requester::{Action, EventKind, Parameters, StationRecord};
use mufasa::services::configuration::{Group, Groups};
use mufasa_props::lent::Lent;
use mufasa_sim::cav::guard::{Guard, Results, Variant};
use mufasa_sim::cav::sensing::{Sensors, ego};
use mufasa_sim::map::streets::town;
use mufasa_sim::run::Settings;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::services::detectors::Errors;
use mufasa_sim::world::World;

const MS: i64 = 1_000_000;
const STATION: i64 = 10;
/// Of one cycle from the next, ns.
const PERIOD: i64 = 100 * MS;

fn session_of(actions: &[Action], wanted: Group) -> i64 {
    let session = |action: &Action| match *action {
        Action::Request { group, session, .. } if group == wanted => Some(session),
        _ => None,
    };
    actions.iter().find_map(session).expect("a request")
}

/// Offers, asks for PLAN and confirms it, a little after `at`. Returns the session.
fn begin(guard: &mut Guard<'_>, at: i64) -> i64 {
    let groups = Groups::of(&[Group::Plan]);
    let mut actions =
        guard.happens(at, EventKind::Offer { station: STATION, groups }).expect("an offer");
    actions.extend(guard.happens(at, EventKind::Area { groups }).expect("an area"));
    actions.extend(guard.happens(at, EventKind::Tick).expect("a tick"));
    let session = session_of(&actions, Group::Plan);
    let kind = EventKind::Confirm { station: STATION, group: Group::Plan, session };
    guard.happens(at, kind).expect("a confirmation");
    session
}

#[test]
fn nothing_of_an_ended_session_is_used() {
    let town = town();
    let route = town.ego_routes().next().expect("a route");
    let mut scenario = Scenario::draw(&town, route, 0, 0);
    scenario.actors.clear();
    scenario.walkers.clear();
    for variant in Variant::ALL {
        let world = World::new(&town, &scenario, 0);
        let truth = world.snapshot();
        let cross_sections = world.route().cross_sections(0.0, f64::INFINITY);
        let (mut table, mut lent) = (vec![StationRecord::FREE; 4], Lent::new(4, 128, 2048));
        let requester = Parameters { t_wait_ns: 0, dt_max_ns: 150 * MS, ..Parameters::default() };
        let settings = Settings { requester, ..Settings::new(variant, Groups::ALL, 0) };
        let corridor = Route { closed: false, cross_sections: &cross_sections };
        let mut guard =
            Guard::new(&settings, &mut table, lent.memory(), &corridor).expect("settings");
        guard.set_route(&corridor).expect("a route");
        let mut sensors = Sensors::new(0, world.body(), Errors::default());
        let mut sensed = |at: i64| sensors.sense(&truth, world.route(), world.body(), at);
        let me = ego(&truth, world.body());
        // Stands where it is: safe wherever the road is free.
        let stands = |from: i64| -> Vec<TrajectoryPoint> {
            let point = |step: i64| TrajectoryPoint {
                t_ns: from + step * PERIOD,
                x: me.x,
                y: me.y,
                cos: me.cos,
                sin: me.sin,
            };
            (0..50).map(point).collect()
        };
        let trajectory = |session: i64, at: i64| Message {
            station: STATION,
            session,
            generated: Time::from_nanoseconds(at),
            stamp: Time::from_nanoseconds(at),
            items: stands(at),
        };
        let still = mufasa::input::cycle::Ego { speed: 0.0, ..me };
        let mut decide = |guard: &mut Guard<'_>, at: i64| {
            let tracks = Some(TrackList { stamp_ns: at, items: &[] });
            let local = Results { tracks, trajectory: None };
            guard.decide(at, still, &sensed(at), local)
        };
        // A station is asked when half a second was seen.
        for at in 1..6 {
            assert!(decide(&mut guard, at * PERIOD).is_safe, "{variant:?}");
        }
        let from = 6 * PERIOD;
        let first = begin(&mut guard, from);
        guard.trajectory(from, trajectory(first, from)).expect("a station");
        let decided = decide(&mut guard, from);
        assert!(decided.trajectory.is_some(), "{variant:?}: of the running session: {decided:?}");

        // And again nine periods after a session that was of use in one cycle.
        guard.happens(7 * PERIOD, EventKind::Lost { station: STATION }).expect("a loss");
        for at in 7..16 {
            assert!(decide(&mut guard, at * PERIOD).is_safe, "{variant:?}");
        }
        let from = 16 * PERIOD;
        let second = begin(&mut guard, from);
        assert_ne!(first, second);
        let actions = guard.trajectory(from, trajectory(first, from)).expect("a station");
        assert!(actions.contains(&Action::Drop(Group::Plan)), "{variant:?}: {actions:?}");
        let decided = decide(&mut guard, from);
        assert_eq!(decided.trajectory, None, "{variant:?}: of an ended session");

        // And at once after one that was of use for nine periods.
        for at in (17..=26).map(|i| i * PERIOD) {
            guard.happens(at, EventKind::Tick).expect("a tick");
            guard.trajectory(at, trajectory(second, at)).expect("a station");
            assert!(decide(&mut guard, at).trajectory.is_some(), "{variant:?}: at {at}");
        }
        let from = 27 * PERIOD;
        guard.happens(from, EventKind::Lost { station: STATION }).expect("a loss");
        assert_ne!(begin(&mut guard, from), second);
    }
}
