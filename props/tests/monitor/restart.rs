//! Killed at any moment and started again, the vehicle reaches offloading anew, and uses nothing of its
//! earlier life.

use mufasa::monitor::{Decision, Inputs, Monitor, Settings};
use mufasa::services::configuration::Configuration;

use super::kit::{Buffers, MS, Points, Station, Tracks, World, at, message, road, route, settings};

/// A cycle on these elements; how many remote data come out.
fn cycle(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    world: &World,
    (tracks, points): (&Tracks, &Points),
) -> usize {
    let now = at(world.now_ns);
    let mut inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
    if let Some(tracks) = tracks {
        inputs = inputs.remote_tracks(tracks);
    }
    if let Some(points) = points {
        inputs = inputs.remote_trajectory(points);
    }
    let (decision, actions) = monitor.cycle(&inputs);
    station.take(&actions);
    match decision {
        Decision::Safe { tracks, trajectory, .. } => {
            usize::from(tracks.is_some()) + usize::from(trajectory.is_some())
        }
        Decision::Unsafe { report, .. } => panic!("{report:?}"),
    }
}

/// `spec/5-interfaces.md#monitor.7`, and `spec/5-interfaces.md#monitor.1`: until both groups are
/// confirmed again no remote data come out, neither those kept from before nor late messages of the
/// sessions before; then they do.
#[test]
fn killed_and_started_again_offloading_is_reached_anew() {
    let cross_sections = road();
    for killed_after in 0..12 {
        let mut buffers = Buffers::new(16, 40);
        let mut station = Station::default();
        let mut kept = (None, None);
        let mut sessions_before = 0;
        {
            let mut monitor = buffers.on(&cross_sections);
            for i in 0..killed_after {
                let world = World::at(100 * i * MS);
                kept = station.period(&mut monitor, &world);
                let out = cycle(&mut monitor, &mut station, &world, (&kept.0, &kept.1));
                assert_eq!(out, if i < 1 { 0 } else { 2 }, "requests, then data");
                sessions_before = monitor.requester().sessions();
            }
        }
        let settings = Settings { sessions_before, ..settings() };
        let mut monitor = buffers.monitor(settings).expect("a monitor");
        monitor.set_route(&route(&cross_sections)).expect("a route");
        let [old_mot, old_plan] = station.sessions;
        let mut station = Station::default();
        for i in killed_after..killed_after + 5 {
            let world = World::at(100 * i * MS);
            let now = at(world.now_ns);
            let fresh = station.period(&mut monitor, &world);
            for session in [old_mot, old_plan].into_iter().flatten() {
                let late = monitor.tracks(now, message(session, now, world.tracks.clone()));
                assert_eq!(station.accepted(late.expect("a station")).map(|_| ()), None);
                let late = monitor.trajectory(now, message(session, now, world.points.clone()));
                assert_eq!(station.accepted(late.expect("a station")).map(|_| ()), None);
            }
            assert_eq!(cycle(&mut monitor, &mut station, &world, (&kept.0, &kept.1)), 0);
            let again = (&fresh.0, &fresh.1);
            let out = cycle(&mut monitor, &mut station, &world, again);
            assert_eq!(out, if i < killed_after + 1 { 0 } else { 2 });
        }
        assert_eq!(monitor.configuration(), Configuration::AllRemote);
        assert_eq!(monitor.requester().sessions(), sessions_before + 2);
    }
}
