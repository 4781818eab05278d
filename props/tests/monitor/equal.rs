//! On any sequence of events and cycles the monitor answers as the plain calls do, and what comes out of
//! it is of the running session, with no unsafe cycle since it was accepted.

use std::cell::RefCell;

use mufasa::input::cycle::{Route, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{Arrival, Decision, Message, Monitor, Settings};
use mufasa::offloading::requester::{
    Actions, EventKind, Group, GroupState, Groups, Source, StationRecord,
};
use mufasa::report::Problem;
use mufasa::services::configuration::Configuration;
use mufasa_props::call;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, long_tape, tape};

use super::held::{Held, choose};
use super::kit::{Buffers, MS, at, place, settings};
use super::plain::{Own, Plain, Received};
use super::scene::{Base, Start, inputs, same, start, with_rules};
use super::seen::{Seen, starved};

/// Both sides, and what came to the monitor.
struct Pair<'a, 'd, 't> {
    monitor: Monitor<'a>,
    plain: Plain<'a>,
    base: &'d Base,
    route: Route<'d>,
    draw: Draw<'t>,
    now_ns: i64,
    tracks: Vec<Held<Track>>,
    points: Vec<Held<TrajectoryPoint>>,
    fallbacks: u32,
    /// For how many periods still stamps are so far ahead, and cycles so late.
    habit: (usize, i64, i64),
    /// How much rarer what is odd about messages and cycles is: long sessions are of use for long.
    calm: usize,
}

/// Stamps ahead of the cycle that comes with them, of the next one too, of every one; or too old by a
/// cycle that comes later.
const HABITS: [(i64, i64); 4] = [(60 * MS, 0), (150 * MS, 0), (1_000 * MS, 0), (-90 * MS, 20 * MS)];

impl Pair<'_, '_, '_> {
    fn event(&mut self, kind: EventKind, seen: &mut Seen) {
        let (now_ns, now) = (self.now_ns, at(self.now_ns));
        let actions = call::event(&mut self.monitor, now, kind).expect("no data");
        let before = starved(&self.plain);
        assert_eq!(actions.expect("a station").to_vec(), self.plain.step(now_ns, kind), "{kind:?}");
        self.same_state();
        let is_silence = kind == EventKind::Tick;
        before.iter().zip(starved(&self.plain)).for_each(|(before, after)| {
            seen.starved_and_left += u64::from(is_silence && before.is_some() && after.is_none());
        });
    }

    fn same_state(&self) {
        let [own, plain] = [self.monitor.requester(), &self.plain.requester];
        assert_eq!(own.suspend().parts(), plain.suspend().parts());
        assert_eq!(own.stations(), plain.stations());
    }

    /// A message, mostly of the running session and fresh.
    fn data(&mut self, group: Group, seen: &mut Seen) {
        let (station, mut session) = match self.plain.requester.state(group) {
            GroupState::Remote { station, session }
            | GroupState::Requested { station, session, .. } => (station, session),
            GroupState::Local => (1, self.plain.requester.sessions()),
        };
        if self.draw.one_in(12 * self.calm) {
            session = self.draw.pick(&[session - 1, session + 1, 1]);
        }
        // Late more often of a starved group, which has few left.
        let is_starved = starved(&self.plain)[place(group)].is_some();
        let rare = if is_starved { 10 } else { 20 * self.calm };
        let age_ns = if self.draw.one_in(rare) {
            self.draw.pick(&[10 * MS, 50 * MS, 51 * MS, -1, 120 * MS])
        } else {
            0
        };
        let generated_ns = self.now_ns.saturating_sub(age_ns);
        let scene = self.base.scene(self.now_ns);
        let stale_ns = if self.draw.one_in(20 * self.calm) {
            self.draw.pick(&[-1, 0, 100 * MS, 100 * MS + 1, 1_000 * MS])
        } else {
            0
        };
        let ahead_ns = self.habit.1;
        let stamp =
            |stamp_ns: i64| stamp_ns.saturating_sub(age_ns + stale_ns).saturating_add(ahead_ns);
        match group {
            Group::Mot => {
                let (stamp_ns, mut items) = scene.tracks.unwrap_or((self.now_ns, Vec::new()));
                if self.draw.one_in(12 * self.calm) {
                    let off = self.draw.pick(&[3.0, 0.3, f64::NAN]);
                    items.iter_mut().for_each(|track| track.x += off);
                }
                let stamp_ns = stamp(stamp_ns);
                let copy = Received { session, generated_ns, stamp_ns, items };
                self.receive(station, group, copy, seen);
            }
            Group::Plan => {
                let (stamp_ns, mut items) = scene.points.unwrap_or((self.now_ns, Vec::new()));
                if self.draw.one_in(12 * self.calm) {
                    items.truncate(self.draw.below(3));
                }
                let stamp_ns = stamp(stamp_ns);
                let copy = Received { session, generated_ns, stamp_ns, items };
                self.receive(station, group, copy, seen);
            }
        }
    }

    fn receive<T: Clone>(&mut self, station: i64, group: Group, copy: Received<T>, seen: &mut Seen)
    where
        Self: Keeps<T>,
    {
        let Received { session, generated_ns, stamp_ns, .. } = copy;
        let is_starved = starved(&self.plain)[place(group)].is_some();
        let actions = self.plain.data(self.now_ns, (station, group), &copy);
        let is_still = starved(&self.plain)[place(group)].is_some();
        let (generated, stamp) = (at(generated_ns), at(stamp_ns));
        let items = copy.items.clone();
        let (arrival, taken) = self.arrive(Message { station, session, generated, stamp, items });
        assert_eq!(taken.to_vec(), actions);
        match arrival {
            Arrival::Accepted(token) => {
                assert!(actions.is_empty(), "{actions:?}");
                let fallbacks = self.fallbacks;
                self.keep(Held { token, copy, fallbacks });
            }
            Arrival::Dropped { .. } => {
                assert!(!actions.is_empty());
                seen.dropped += 1;
                seen.starved_and_dropped += u64::from(is_starved && is_still);
                seen.starved_and_late += u64::from(is_starved && !is_still);
            }
        }
        self.same_state();
    }

    /// One cycle on both sides.
    fn cycle(&mut self, seen: &mut Seen) {
        let draw = &mut self.draw;
        let mut scene = self.base.scene(self.now_ns);
        if draw.one_in(40 * self.calm) {
            scene.ego.speed = draw.pick(&[f64::NAN, -1.0]);
        }
        if draw.one_in(10 * self.calm) {
            scene.detections = None;
        }
        if draw.one_in(10 * self.calm) {
            scene.points = None;
        }
        let (tracks, points) = (choose(draw, &self.tracks), choose(draw, &self.points));
        let own = Own {
            now_ns: self.now_ns,
            ego: scene.ego,
            detections: scene.detections.as_ref().map(|(stamp_ns, items)| (*stamp_ns, &**items)),
            lead: scene.lead,
            grid: scene.grid,
            tracks: scene.tracks.as_ref().map(|(stamp_ns, items)| (*stamp_ns, &**items)),
            trajectory: scene.points.as_ref().map(|(stamp_ns, items)| (*stamp_ns, &**items)),
            route: self.route,
        };
        let mut inputs = inputs(&own);
        if let Some(held) = tracks {
            inputs = inputs.remote_tracks(&held.token);
        }
        if let Some(held) = points {
            inputs = inputs.remote_trajectory(&held.token);
        }
        let before = self.plain.requester.configuration();
        let running = Group::ALL.map(|group| self.plain.requester.session_of(group));
        let [copy_of_tracks, copy_of_points] =
            [tracks.map(|held| held.copy.session), points.map(|held| held.copy.session)];
        let starved_before = starved(&self.plain);
        let ended = self.plain.cycle(&own, tracks.map(|it| &it.copy), points.map(|it| &it.copy));
        let is_remote = before != Configuration::Local;
        seen.cycles += 1;
        let (decision, actions) = self.monitor.cycle(&inputs);
        assert_eq!(actions.to_vec(), ended.actions);
        seen.own(&decision, ended.brake);
        match decision {
            Decision::Safe { tracks: out, trajectory, report, .. } => {
                assert!(same(&Ok(report), &ended.report), "{report:?} {:?}", ended.report);
                assert_eq!([out.is_some(), trajectory.is_some()], ended.verified);
                seen.safe += 1;
                if let (Some(out), Some(held)) = (out, tracks) {
                    seen.tracks += 1;
                    assert_eq!((out.stamp_ns, out.items), (held.copy.stamp_ns, &*held.copy.items));
                    assert_eq!(copy_of_tracks, running[0].map(|it| it.session));
                    assert_eq!(held.fallbacks, self.fallbacks, "accepted before an unsafe cycle");
                    assert_ne!(out.source(), Source::Local);
                }
                if let Some(out) = trajectory {
                    assert!(is_remote);
                    let expected = match (running[1], points) {
                        (Some(running), Some(held)) => {
                            seen.remote_trajectories += 1;
                            assert_eq!(copy_of_points, Some(running.session));
                            assert_eq!(held.fallbacks, self.fallbacks);
                            (held.copy.stamp_ns, &*held.copy.items)
                        }
                        (Some(_), None) => panic!("a trajectory out of nothing"),
                        (None, _) => {
                            seen.local_trajectories += 1;
                            own.trajectory.expect("a local trajectory")
                        }
                    };
                    assert_eq!((out.stamp_ns, out.points), expected);
                    assert_eq!(out.brake_by(), self.plain.brake_by(own.now_ns).map(at));
                }
            }
            Decision::Unsafe { report, .. } => {
                assert!(same(&report, &ended.report), "{report:?} {:?}", ended.report);
                assert_eq!(self.monitor.configuration(), Configuration::Local);
                seen.errors += u64::from(report.is_err());
                seen.no_tick += u64::from(report.is_err_and(|it| it.problem == Problem::NoTick));
                seen.unsafe_while_remote += u64::from(is_remote);
                self.fallbacks += 1;
            }
        }
        seen.starvation(starved_before, &self.plain, ended.sessions, self.habit);
        seen.count(&ended, before, [tracks.is_some(), points.is_some()]);
        self.same_state();
    }

    /// What leads on: a tick, confirmations, data, a cycle.
    fn period(&mut self, seen: &mut Seen) {
        self.event(EventKind::Tick, seen);
        for group in Group::ALL {
            if let GroupState::Requested { station, session, .. } =
                self.plain.requester.state(group)
            {
                self.event(EventKind::Confirm { station, group, session }, seen);
            }
        }
        if self.habit.0 == 0 {
            let (ahead_ns, late_ns) = self.draw.pick(&HABITS);
            let periods = 2 + self.draw.below(5);
            self.habit = if self.draw.one_in(8 * self.calm) {
                (periods, ahead_ns, late_ns)
            } else {
                (0, 0, 0)
            };
        } else {
            self.habit.0 -= 1;
        }
        Group::ALL.into_iter().for_each(|group| self.data(group, seen));
        self.now_ns += self.habit.2;
        self.cycle(seen);
    }

    fn any(&mut self, seen: &mut Seen) {
        let group = Group::ALL[self.draw.below(2)];
        let station = self.draw.pick(&[1, 2, 3]);
        let some = [Groups::ALL, Groups::from(Group::Mot), Groups::from(Group::Plan), Groups::NONE];
        let groups = self.draw.pick(&some);
        let session = self.plain.requester.sessions() - i64::from(self.draw.one_in(2));
        match self.draw.below(10) {
            0 => self.event(EventKind::Offer { station, groups }, seen),
            1 => self.event(EventKind::Withdraw { station }, seen),
            2 => self.event(EventKind::Lost { station }, seen),
            3 => self.event(EventKind::Area { groups }, seen),
            4 => self.event(EventKind::Reject { station, group, session }, seen),
            5 => self.event(EventKind::Confirm { station, group, session }, seen),
            6 | 7 => self.data(group, seen),
            _ => {
                if !self.draw.one_in(8) {
                    self.event(EventKind::Tick, seen);
                }
                self.cycle(seen);
            }
        }
    }
}

/// Where accepted elements go.
trait Keeps<T> {
    fn arrive(&mut self, message: Message<Vec<T>>) -> (Arrival<Vec<T>>, Actions);
    fn keep(&mut self, held: Held<T>);
}

impl Keeps<Track> for Pair<'_, '_, '_> {
    fn arrive(&mut self, message: Message<Vec<Track>>) -> (Arrival<Vec<Track>>, Actions) {
        self.monitor.tracks(at(self.now_ns), message).expect("a station")
    }

    fn keep(&mut self, held: Held<Track>) {
        self.tracks.push(held);
    }
}

impl Keeps<TrajectoryPoint> for Pair<'_, '_, '_> {
    fn arrive(
        &mut self,
        message: Message<Vec<TrajectoryPoint>>,
    ) -> (Arrival<Vec<TrajectoryPoint>>, Actions) {
        self.monitor.trajectory(at(self.now_ns), message).expect("a station")
    }

    fn keep(&mut self, held: Held<TrajectoryPoint>) {
        self.points.push(held);
    }
}

/// MON-01, MON-02, MON-04, MON-05, MON-06, MON-07, MON-08,
/// MON-10, MON-11, PROTO-07, MON-12, MON-13, MON-14, MON-15, MON-16, MON-17, MON-39.
fn as_the_plain_calls(profile: Profile) {
    let seen = RefCell::new(Seen::default());
    let result = runner().run(&(tape(), long_tape()), |(scene, steps)| {
        let draw = &mut Draw::new(&scene);
        let Start { base, closed, cross_sections, now_ns, stages } = start(draw, profile);
        let mut buffers = Buffers::new(600, cross_sections.len());
        let mut settings = Settings { profile, stages, ..settings() };
        if stages.tau <= settings.period.as_secs_f64() {
            settings.stages.tau += 0.25;
        }
        settings.requester.t_wait_ns = draw.pick(&[0, 1_000 * MS, 10_000 * MS]);
        with_rules(&mut settings, draw);
        // A draw that no monitor is made for, such as a parameter outside of its domain.
        let Ok(mut monitor) = buffers.monitor(settings) else { return Ok(()) };
        let route = Route { closed, cross_sections: &cross_sections };
        if monitor.set_route(&route).is_err() {
            return Ok(());
        }
        let mut table = vec![StationRecord::FREE; 8];
        let plain = Plain::new(settings, &mut table);
        let (tracks, points) = (Vec::new(), Vec::new());
        let calm = if draw.one_in(2) { 20 } else { 1 };
        let (base, draw, fallbacks, habit) = (&base, Draw::new(&steps), 0, (0, 0, 0));
        let mut pair = Pair {
            monitor,
            plain,
            base,
            route,
            draw,
            now_ns,
            tracks,
            points,
            fallbacks,
            habit,
            calm,
        };
        let seen = &mut *seen.borrow_mut();
        pair.event(EventKind::Offer { station: 1, groups: Groups::ALL }, seen);
        for _ in 0..40 {
            if pair.now_ns > i64::MAX / 2 {
                break;
            }
            pair.now_ns += pair.draw.pick(&[100 * MS, 100 * MS, 50 * MS, 30 * MS, 101 * MS, 0]);
            if pair.draw.one_in(40) {
                // The clock is set back; not before the domain of times.
                let back_ns = pair.draw.pick(&[2_000 * MS, 1_001 * MS, 999 * MS]);
                pair.now_ns = pair.now_ns.saturating_sub(back_ns);
                if !pair.draw.one_in(4) {
                    pair.event(EventKind::Tick, seen);
                    pair.cycle(seen);
                }
            }
            let end_ns = pair.plain.requester.hold_until_ns().unwrap_or(pair.now_ns);
            let left_ns = end_ns.saturating_sub(pair.now_ns);
            if (1..20_000 * MS).contains(&left_ns) && pair.draw.one_in(2) {
                // To the end of the hold; up to it cycles go on, so that a history is there. They are not
                // counted: mostly nothing is remote.
                for before_ns in [600, 400, 200].map(|ms| ms * MS) {
                    pair.now_ns = pair.now_ns.max(end_ns.saturating_sub(before_ns));
                    pair.cycle(&mut Seen::default());
                }
                pair.now_ns = end_ns;
            }
            match pair.draw.below(6) {
                0..=3 => pair.period(seen),
                4 => pair.any(seen),
                _ if pair.draw.one_in(4) => {
                    pair.event(EventKind::Offer { station: 1, groups: Groups::ALL }, seen);
                }
                _ => pair.period(seen),
            }
        }
        seen.add(&pair.plain);
        Ok(())
    });
    let seen = seen.into_inner();
    println!("monitor, {profile:?}: {seen:?}");
    assert_eq!(result, Ok(()));
    seen.is_enough(profile);
}

#[test]
fn the_monitor_answers_as_the_plain_calls_in_the_hardened_profile() {
    as_the_plain_calls(Profile::HARDENED);
}

#[test]
fn the_monitor_answers_as_the_plain_calls_in_the_paper_profile() {
    as_the_plain_calls(Profile::PAPER);
}
