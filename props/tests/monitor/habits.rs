//! Stations that have a habit: what they do in each session, period by period, and what it costs the CAV.

use mufasa::input::profile::Profile;
use mufasa::monitor::{Decision, Message, Monitor, Settings};
use mufasa::offloading::requester::{Groups, Source};
use mufasa::services::configuration::Group;

use super::kit::{
    Buffers, MS, Points, Station, Tracks, World, at, inputs, message, place, road, route, settings,
};

pub const PERIOD_NS: i64 = 100 * MS;

/// What a station does in one period of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    Good,
    Silent,
    /// 1 ms later than l_max.
    Late,
    /// Stamped so many periods ahead: of use to that cycle, if nothing comes between.
    Ahead(i64),
    /// 1 ms too old when it arrives.
    Old,
    /// Withdraws its offer and offers again, in time for this period's tick.
    Withdraws,
    /// The same after the link was lost.
    Lost,
}

impl Deed {
    /// By which time its results were made and stamped before they arrive, ns.
    fn ages(self) -> Option<(i64, i64)> {
        match self {
            Self::Good => Some((0, 0)),
            Self::Late => Some((51 * MS, 51 * MS)),
            Self::Ahead(periods) => Some((0, -periods * PERIOD_NS)),
            Self::Old => Some((0, 101 * MS)),
            Self::Silent | Self::Withdraws | Self::Lost => None,
        }
    }
}

/// What a station does in each session.
#[derive(Clone, Debug)]
pub struct Habit {
    /// For tracks and for the trajectory: what is done, and from then on the last of it.
    pub deeds: [Vec<Deed>; 2],
    /// Results come after the cycle of their period.
    pub is_after: bool,
}

impl Habit {
    /// The same for both.
    pub fn of(deeds: Vec<Deed>) -> Self {
        Self { deeds: [deeds.clone(), deeds], is_after: false }
    }

    fn now(&self, sent: [usize; 2]) -> [Deed; 2] {
        let of = |i: usize| self.deeds[i].get(sent[i]).or(self.deeds[i].last());
        [0, 1].map(|i| of(i).copied().expect("a deed"))
    }
}

/// What came of it for a group.
#[derive(Clone, Copy, Debug, Default)]
pub struct Share {
    /// For how long it was the station's to give and nothing came, from the last cycle with something, or the
    /// confirmation: to the session's end; in gaps that ended before they were longer than dt_max; in longer ones.
    pub at_end_ns: i64,
    pub in_short_gaps_ns: i64,
    pub in_long_gaps_ns: i64,
    /// The longest of the gaps.
    pub longest_gap_ns: i64,
    pub sessions: i64,
    /// Least time from the end of a session to the next request.
    pub pause_ns: Option<i64>,
    last_ns: i64,
    /// Of the time since then: whether some cycle had nothing, and one more than dt_max later.
    is_gap: bool,
    is_long: bool,
    running: Option<i64>,
    ended_ns: Option<i64>,
}

impl Share {
    /// However that ends.
    pub const fn without_ns(&self) -> i64 {
        self.at_end_ns + self.in_short_gaps_ns + self.in_long_gaps_ns
    }

    fn ends(&mut self, now_ns: i64) {
        if self.running.is_some() {
            self.at_end_ns += now_ns - self.last_ns;
            self.ended_ns = Some(now_ns);
        }
        (self.is_gap, self.is_long) = (false, false);
    }

    /// The session that runs at a time.
    fn session(&mut self, now_ns: i64, running: Option<i64>) {
        if self.running != running {
            self.ends(now_ns);
            self.running = running;
            self.last_ns = now_ns;
        }
    }

    fn requested(&mut self, now_ns: i64) {
        self.sessions += 1;
        let pause_ns = self.ended_ns.map(|ended_ns| now_ns - ended_ns);
        self.pause_ns = self.pause_ns.into_iter().chain(pause_ns).min();
    }

    fn cycle(&mut self, now_ns: i64, is_out: bool) {
        let since_ns = now_ns - self.last_ns;
        if is_out {
            if self.is_gap {
                let gaps_ns = if self.is_long {
                    &mut self.in_long_gaps_ns
                } else {
                    &mut self.in_short_gaps_ns
                };
                *gaps_ns += since_ns;
                self.longest_gap_ns = self.longest_gap_ns.max(since_ns);
            }
            (self.is_gap, self.is_long, self.last_ns) = (false, false, now_ns);
        } else if self.running.is_some() {
            self.is_gap = true;
            self.is_long |= since_ns > settings().requester.dt_max_ns;
        }
    }
}

/// An element with its stamp.
#[derive(Default)]
struct Held<L> {
    element: L,
    stamp_ns: i64,
}

impl<T> Held<Option<T>> {
    fn or(self, new: Self, now_ns: i64) -> Self {
        let is_kept = new.element.is_none() && self.stamp_ns >= now_ns;
        if is_kept { self } else { new }
    }
}

/// Nothing moves, so that tracks are where they are seen whatever their stamp.
fn still(now_ns: i64) -> World {
    let mut world = World { now_ns, ..World::at(0) };
    world.ego.speed = 0.0;
    world.tracks.iter_mut().for_each(|it| (it.vx, it.vy) = (0.0, 0.0));
    let x = world.ego.x;
    world.points.iter_mut().for_each(|it| (it.t_ns, it.x) = (it.t_ns + now_ns, x));
    world
}

/// So many periods with a habit; of tracks and trajectory what came of it.
pub fn drive(profile: Profile, habit: &Habit, periods: i64) -> [Share; 2] {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.monitor(Settings { profile, ..settings() }).expect("a monitor");
    monitor.set_route(&route(&cross_sections)).expect("a route");
    let (mut station, mut shares, mut sent) = (Station::default(), [Share::default(); 2], [0; 2]);
    // What was accepted last is used again while its stamp is not past, or in the next cycle.
    let mut held: (Held<Tracks>, Held<Points>) = Default::default();
    for i in 0..periods {
        let now_ns = i * PERIOD_NS;
        let oldest_ns = if habit.is_after { now_ns - PERIOD_NS } else { now_ns };
        let deeds = habit.now(sent);
        events(&mut monitor, &mut station, now_ns, deeds, &mut shares);
        for is_cycle in [habit.is_after, !habit.is_after] {
            if is_cycle {
                let (tracks, points) = (&held.0.element, &held.1.element);
                let world = still(now_ns);
                let is_out = cycle(&mut monitor, &mut station, &world, tracks, points);
                for group in Group::ALL {
                    shares[place(group)].cycle(now_ns, is_out[place(group)]);
                }
            } else {
                let new = data(&mut monitor, &mut station, now_ns, deeds, &mut sent);
                held = (held.0.or(new.0, oldest_ns), held.1.or(new.1, oldest_ns));
                seen(&monitor, now_ns, &mut shares);
            }
        }
        for group in Group::ALL {
            if monitor.requester().session_of(group).is_none() {
                sent[place(group)] = 0;
            }
        }
    }
    shares.iter_mut().for_each(|it| it.ends((periods - 1) * PERIOD_NS));
    shares
}

fn seen(monitor: &Monitor<'_>, now_ns: i64, shares: &mut [Share; 2]) {
    for group in Group::ALL {
        let running = monitor.requester().session_of(group);
        shares[place(group)].session(now_ns, running.map(|it| it.session));
    }
}

/// Offers, confirmations, and the tick.
fn events(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    now_ns: i64,
    deeds: [Deed; 2],
    shares: &mut [Share; 2],
) {
    let now = at(now_ns);
    let does = |monitor: &Monitor<'_>, deed| {
        let runs = |group| monitor.requester().session_of(group).is_some();
        Group::ALL.into_iter().any(|group| deeds[place(group)] == deed && runs(group))
    };
    if does(monitor, Deed::Withdraws) {
        station.take(&monitor.withdraw(now, 1).expect("a station"));
    }
    if does(monitor, Deed::Lost) {
        station.take(&monitor.lost(now, 1).expect("a station"));
    }
    seen(monitor, now_ns, shares);
    station.take(&monitor.offer(now, 1, Groups::ALL).expect("a station"));
    for (group, session) in std::mem::take(&mut station.asked) {
        station.take(&monitor.confirm(now, 1, group, session).expect("a station"));
    }
    seen(monitor, now_ns, shares);
    station.take(&monitor.tick(now));
    seen(monitor, now_ns, shares);
    for (group, _) in &station.asked {
        shares[place(*group)].requested(now_ns);
    }
}

/// The results of a period.
fn data(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    now_ns: i64,
    deeds: [Deed; 2],
    sent: &mut [usize; 2],
) -> (Held<Tracks>, Held<Points>) {
    let [mot, plan] = Group::ALL.map(|group| {
        let session = monitor.requester().session_of(group)?.session;
        sent[place(group)] += 1;
        let (made_ns, stamped_ns) = deeds[place(group)].ages()?;
        Some((session, at(now_ns - made_ns), now_ns - stamped_ns))
    });
    let mut held: (Held<Tracks>, Held<Points>) = Default::default();
    if let Some((session, generated, stamp_ns)) = mot {
        let items = still(now_ns).tracks;
        let new = Message { stamp: at(stamp_ns), ..message(session, generated, items) };
        let arrival = monitor.tracks(at(now_ns), new).expect("a station");
        held.0 = Held { element: station.accepted(arrival), stamp_ns };
    }
    if let Some((session, generated, stamp_ns)) = plan {
        let items = still(now_ns).points;
        let new = Message { stamp: at(stamp_ns), ..message(session, generated, items) };
        let arrival = monitor.trajectory(at(now_ns), new).expect("a station");
        held.1 = Held { element: station.accepted(arrival), stamp_ns };
    }
    held
}

/// Whether tracks and a trajectory of the station come out.
fn cycle(
    monitor: &mut Monitor<'_>,
    station: &mut Station,
    world: &World,
    tracks: &Tracks,
    points: &Points,
) -> [bool; 2] {
    let (decision, actions) = monitor.cycle(&inputs(world, tracks, points));
    let Decision::Safe { tracks, trajectory, .. } = decision else {
        panic!("an unsafe cycle at {}", world.now_ns);
    };
    let is_out = [tracks.is_some(), trajectory.is_some_and(|it| it.source() != Source::Local)];
    station.take(&actions);
    is_out
}
