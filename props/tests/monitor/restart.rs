//! Killed at any moment and started again, the vehicle reaches offloading anew, and uses nothing of its
//! earlier life.

use mufasa::monitor::{Decision, Monitor, Settings};
use mufasa::offloading::requester::Groups;
use mufasa::services::configuration::Configuration;

use super::kit::{
    Buffers, MS, Points, Station, Tracks, World, at, inputs, message, road, route, settings,
};

/// The station, and what is left of the vehicle's earlier lives.
#[derive(Default)]
struct Left {
    station: Station,
    /// Of the life before, which the station goes on with for a while.
    sessions: [Option<i64>; 2],
    kept: (Tracks, Points),
}

impl Left {
    /// A life from one ms to another, in periods of 100 ms from its start on: when a cycle first had remote
    /// data of both groups, ms. What is of the life before is never used.
    fn live(&mut self, monitor: &mut Monitor<'_>, [from, to]: [i64; 2]) -> Option<i64> {
        let (mut fresh, mut first): ((Tracks, Points), _) = ((None, None), None);
        for ms in from..to {
            let world = World::at(ms * MS);
            let now = at(world.now_ns);
            match (ms - from) % 100 {
                0 => {
                    let actions = monitor.offer(now, 1, Groups::ALL).expect("a station");
                    self.station.take(&actions);
                }
                10 => {
                    for (group, session) in std::mem::take(&mut self.station.asked) {
                        let actions = monitor.confirm(now, 1, group, session).expect("a station");
                        self.station.take(&actions);
                    }
                }
                20 => self.station.take(&monitor.tick(now)),
                30 => fresh = self.results(monitor, &world),
                60 => {
                    let kept = std::mem::take(&mut self.kept);
                    assert_eq!(self.cycle(monitor, &world, &kept), 0, "of the life before");
                    self.kept = kept;
                    if monitor.configuration() != Configuration::Local {
                        self.station.take(&monitor.tick(now));
                    }
                    match self.cycle(monitor, &world, &fresh) {
                        0 => assert_eq!(first, None, "offloaded, and at {ms} not any more"),
                        out => first = first.or((out == 2).then_some(ms)),
                    }
                }
                _ => {}
            }
        }
        self.sessions = std::mem::take(&mut self.station).sessions;
        self.kept = fresh;
        first
    }

    /// What comes of the sessions before, and of the running ones.
    fn results(&mut self, monitor: &mut Monitor<'_>, world: &World) -> (Tracks, Points) {
        let [[old_mot, old_plan], [mot, plan]] = [self.sessions, self.station.sessions];
        let mut come = |mot: Option<i64>, plan: Option<i64>| {
            let now = at(world.now_ns);
            let tracks = mot.map(|it| message(it, now, world.tracks.clone()));
            let tracks = tracks.map(|it| monitor.tracks(now, it).expect("a station"));
            let points = plan.map(|it| message(it, now, world.points.clone()));
            let points = points.map(|it| monitor.trajectory(now, it).expect("a station"));
            let station = &mut self.station;
            let tracks = tracks.and_then(|it| station.accepted(it));
            (tracks, points.and_then(|it| station.accepted(it)))
        };
        assert!(matches!(come(old_mot, old_plan), (None, None)), "of the life before");
        come(mot, plan)
    }

    /// A cycle on these elements; how many remote data come out.
    fn cycle(
        &mut self,
        monitor: &mut Monitor<'_>,
        world: &World,
        (tracks, points): &(Tracks, Points),
    ) -> usize {
        let (decision, actions) = monitor.cycle(&inputs(world, tracks, points));
        self.station.take(&actions);
        match decision {
            Decision::Safe { tracks, trajectory, .. } => {
                usize::from(tracks.is_some()) + usize::from(trajectory.is_some())
            }
            Decision::Unsafe { report, .. } => panic!("{report:?}"),
        }
    }
}

/// MON-28, and MON-01: killed at each ms of a period, and
/// again in the same way, each life reaches offloading as soon as the first: asked at its tick after
/// half a second was seen, confirmed in the next period.
#[test]
fn killed_at_any_ms_and_started_again_offloading_is_reached_anew() {
    let cross_sections = road();
    for killed_at in 0..100 {
        let mut buffers = Buffers::new(16, 40);
        let mut left = Left::default();
        let mut sessions_before = 0;
        for life in 0..3 {
            let from = life * (1_000 + killed_at);
            let settings = Settings { sessions_before, ..settings() };
            let mut monitor = buffers.monitor(settings).expect("a monitor");
            monitor.set_route(&route(&cross_sections)).expect("a route");
            let first = left.live(&mut monitor, [from, from + 1_000 + killed_at]);
            assert_eq!(first, Some(from + 760), "life {life}, killed at {killed_at}");
            assert_eq!(monitor.configuration(), Configuration::AllRemote);
            sessions_before += 2;
            assert_eq!(monitor.requester().sessions(), sessions_before);
        }
    }
}

/// Killed before anything was offloaded, while it was asked for, and after: the next life does not mind.
#[test]
fn killed_before_it_is_offloaded_it_is_offloaded_in_the_next_life() {
    let cross_sections = road();
    for killed_at in (0..1_000).step_by(7) {
        let mut buffers = Buffers::new(16, 40);
        let mut left = Left::default();
        let mut monitor = buffers.started_on(&cross_sections);
        let first = left.live(&mut monitor, [0, killed_at]);
        assert_eq!(first, (killed_at > 760).then_some(760));
        let sessions_before = monitor.requester().sessions();
        let settings = Settings { sessions_before, ..settings() };
        let mut monitor = buffers.monitor(settings).expect("a monitor");
        monitor.set_route(&route(&cross_sections)).expect("a route");
        let first = left.live(&mut monitor, [killed_at, killed_at + 1_000]);
        assert_eq!(first, Some(killed_at + 760), "killed at {killed_at}");
    }
}
