//! A station that is of no use again and again takes the plan away for a tenth of the time at most
//! (`spec/5-interfaces.md#monitor.10`, finding F-43).

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{Accepted, Decision, Inputs, Message, Monitor, Settings};
use mufasa::offloading::requester::{Groups, Source};
use mufasa::services::configuration::Group;

use super::kit::{
    Buffers, MS, Points, Station, Tracks, World, at, message, road, route, seconds, settings,
};

const PERIOD_NS: i64 = 100 * MS;
/// Ten minutes.
const PERIODS: i64 = 6_000;

/// What a station does in its sessions; each begins with so many results that are good.
#[derive(Clone, Copy, Debug)]
enum Habit {
    Silent { good: usize },
    Late { good: usize },
    Ahead { good: usize },
    Old { good: usize },
    Withdraws { good: usize },
    Useful,
}

impl Habit {
    fn good(self) -> usize {
        match self {
            Self::Silent { good }
            | Self::Late { good }
            | Self::Ahead { good }
            | Self::Old { good }
            | Self::Withdraws { good } => good,
            Self::Useful => usize::MAX,
        }
    }
}

/// What came of it.
#[derive(Debug, Default)]
struct Share {
    /// Periods in which the trajectory is the station's to give, and none comes out.
    without: i64,
    with: i64,
    sessions: i64,
    /// Least time from the end of a session to the next request.
    pause_ns: Option<i64>,
}

/// What stands in a message of a habit, after its good results: ns by which it was made and stamped
/// before its arrival; `None`: there is none.
fn ages(habit: Habit, sent: usize) -> Option<(i64, i64)> {
    match habit {
        _ if sent < habit.good() => Some((0, 0)),
        Habit::Silent { .. } | Habit::Withdraws { .. } => None,
        Habit::Late { .. } => Some((51 * MS, 51 * MS)),
        Habit::Ahead { .. } => Some((0, -1_000 * MS)),
        Habit::Old { .. } => Some((0, 101 * MS)),
        Habit::Useful => Some((0, 0)),
    }
}

fn drive(profile: Profile, habit: Habit) -> Share {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.monitor(Settings { profile, ..settings() }).expect("a monitor");
    monitor.set_route(&route(&cross_sections)).expect("a route");
    let (mut station, mut share, mut sent) = (Station::default(), Share::default(), 0);
    let mut ended_ns = None;
    for i in 0..PERIODS {
        let world = World { now_ns: i * PERIOD_NS, ..World::at(i % 20 * PERIOD_NS) };
        let released = station.released;
        let (tracks, points) =
            events(&mut monitor, &mut station, &world, (profile, habit, &mut sent));
        let is_out = cycle(&mut monitor, &mut station, &world, tracks.as_ref(), points.as_ref());
        if station.released > released {
            ended_ns = Some(world.now_ns);
            sent = 0;
        }
        if !station.asked.is_empty() {
            share.sessions += 1;
            let pause_ns = ended_ns.map(|ended_ns| world.now_ns - ended_ns);
            share.pause_ns = share.pause_ns.into_iter().chain(pause_ns).min();
        }
        share.with += i64::from(is_out);
        // In the hardened profile the CAV's own planner goes on until a result was used.
        share.without += i64::from(monitor.source(Group::Plan) != Source::Local && !is_out);
    }
    share
}

/// Offers, confirmations, the tick, and results.
fn events(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    world: &World,
    (profile, habit, sent): (Profile, Habit, &mut usize),
) -> (Tracks, Points) {
    let now = at(world.now_ns);
    if matches!(habit, Habit::Withdraws { good } if *sent > good) {
        station.take(&monitor.withdraw(now, 1).expect("a station"));
    }
    station.take(&monitor.offer(now, 1, Groups::ALL).expect("a station"));
    for (group, session) in std::mem::take(&mut station.asked) {
        station.take(&monitor.confirm(now, 1, group, session).expect("a station"));
    }
    station.take(&monitor.tick(now));
    let ages = ages(habit, *sent);
    let [mot, plan] = station.sessions;
    if mot.is_some() && plan.is_some() && station.asked.is_empty() {
        *sent += 1;
    }
    let Some((made_ns, stamped_ns)) = ages.filter(|_| station.asked.is_empty()) else {
        return (None, None);
    };
    let (generated, stamp) = (at(world.now_ns - made_ns), at(world.now_ns - stamped_ns));
    let tracks = mot.and_then(|session| {
        let mut items = world.tracks.clone();
        // Tracks far from their detections are a failure. Only the hardened profile predicts them.
        if profile == Profile::Hardened {
            items.iter_mut().for_each(|it| it.x -= it.vx * seconds(stamped_ns));
        }
        let new = Message { stamp, ..message(session, generated, items) };
        station.accepted(monitor.tracks(now, new).expect("a station"))
    });
    let points = plan.and_then(|session| {
        let mut points = world.points.clone();
        points.iter_mut().enumerate().for_each(|(i, it)| {
            it.t_ns = world.now_ns + i64::try_from(i).expect("a few") * 100 * MS;
        });
        let new = Message { stamp, ..message(session, generated, points) };
        station.accepted(monitor.trajectory(now, new).expect("a station"))
    });
    (tracks, points)
}

/// Whether a trajectory of the station comes out.
fn cycle(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    world: &World,
    tracks: Option<&Accepted<Vec<Track>>>,
    points: Option<&Accepted<Vec<TrajectoryPoint>>>,
) -> bool {
    let now = at(world.now_ns);
    let mut inputs = Inputs::new(now, world.ego).detections(now, &world.detections);
    if let Some(tracks) = tracks {
        inputs = inputs.remote_tracks(tracks);
    }
    if let Some(points) = points {
        inputs = inputs.remote_trajectory(points);
    }
    let (decision, actions) = monitor.cycle(&inputs);
    let Decision::Safe { trajectory, .. } = decision else {
        panic!("an unsafe cycle at {}", world.now_ns);
    };
    let is_out = trajectory.is_some_and(|it| it.source() != Source::Local);
    station.take(&actions);
    is_out
}

/// The bound of the rule, and that sessions begin again at all.
#[test]
fn a_station_of_no_use_takes_the_plan_for_a_tenth_of_the_time_at_most() {
    for profile in [Profile::Paper, Profile::Hardened] {
        for good in [0, 1, 2] {
            for habit in [
                Habit::Silent { good },
                Habit::Late { good },
                Habit::Ahead { good },
                Habit::Old { good },
                Habit::Withdraws { good },
            ] {
                let share = drive(profile, habit);
                let least_ns = 9 * PERIOD_NS;
                assert!(10 * share.without <= PERIODS, "{profile:?}, {habit:?}: {share:?}");
                assert!(share.sessions > 50, "{profile:?}, {habit:?}: {share:?}");
                let pause_ns = share.pause_ns.expect("more than one session");
                assert!(pause_ns >= least_ns, "{profile:?}, {habit:?}: {share:?}");
                assert!((share.with > 0) == (good > 0), "{profile:?}, {habit:?}: {share:?}");
                println!("{profile:?}, {habit:?}: {share:?}");
            }
        }
    }
}

/// The rule has no price where sessions do not end.
#[test]
fn a_station_of_use_is_kept() {
    for profile in [Profile::Paper, Profile::Hardened] {
        let share = drive(profile, Habit::Useful);
        assert_eq!((share.sessions, share.without), (1, 0), "{profile:?}: {share:?}");
        assert!(share.with > PERIODS - 10, "{profile:?}: {share:?}");
    }
}
