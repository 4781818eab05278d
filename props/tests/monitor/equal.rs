//! On any sequence of events and cycles the monitor answers as the plain calls do, and what comes out of
//! it is of the running session, with no unsafe cycle since it was accepted.

use std::cell::RefCell;

use mufasa::input::cycle::{Route, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{Accepted, Arrival, Decision, Message, Monitor, Settings};
use mufasa::offloading::requester::{EventKind, Group, GroupState, Groups, Source, StationRecord};
use mufasa::services::configuration::Configuration;
use mufasa_props::bridge::to_impl;
use mufasa_props::differential::runner;
use mufasa_props::strategy::draw::{Draw, long_tape, tape};
use mufasa_props::strategy::whole;

use super::kit::{Buffers, MS, at, place, road, settings};
use super::plain::{Ended, Own, Plain, Received};
use super::scene::{Base, inputs, same};

/// What the sequences reached.
#[derive(Debug, Default)]
struct Seen {
    cycles: u64,
    safe: u64,
    errors: u64,
    unsafe_while_remote: u64,
    tracks: u64,
    remote_trajectories: u64,
    local_trajectories: u64,
    not_the_last: u64,
    dropped: u64,
    with_history: u64,
}

/// An accepted element, a copy of it, and how many unsafe cycles there were before it.
struct Held<T> {
    token: Accepted<Vec<T>>,
    copy: Received<T>,
    fallbacks: u32,
}

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
}

impl Pair<'_, '_, '_> {
    fn event(&mut self, kind: EventKind) {
        let (now_ns, now) = (self.now_ns, at(self.now_ns));
        let monitor = &mut self.monitor;
        let actions = match kind {
            EventKind::Offer { station, groups } => monitor.offer(now, station, groups),
            EventKind::Withdraw { station } => monitor.withdraw(now, station),
            EventKind::Lost { station } => monitor.lost(now, station),
            EventKind::Area { groups } => Ok(monitor.area(now, groups)),
            EventKind::Tick => Ok(monitor.tick(now)),
            EventKind::Confirm { station, group, session } => {
                monitor.confirm(now, station, group, session)
            }
            EventKind::Reject { station, group, session } => {
                monitor.reject(now, station, group, session)
            }
            EventKind::Data { .. } | EventKind::Verdict { .. } => unreachable!("not events here"),
        };
        assert_eq!(actions.expect("a station").to_vec(), self.plain.step(now_ns, kind), "{kind:?}");
        self.same_state();
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
        if self.draw.one_in(12) {
            session = self.draw.pick(&[session - 1, session + 1, 1]);
        }
        let age_ns = if self.draw.one_in(20) {
            self.draw.pick(&[10 * MS, 50 * MS, 51 * MS, -1, 120 * MS])
        } else {
            0
        };
        let generated_ns = self.now_ns - age_ns;
        let scene = self.base.scene(self.now_ns);
        let stale_ns = if self.draw.one_in(20) {
            self.draw.pick(&[-1, 0, 100 * MS, 100 * MS + 1, 1_000 * MS])
        } else {
            0
        };
        let stamp = |stamp_ns: i64| stamp_ns - age_ns - stale_ns;
        match group {
            Group::Mot => {
                let (stamp_ns, mut items) = scene.tracks.unwrap_or((self.now_ns, Vec::new()));
                if self.draw.one_in(12) {
                    let off = self.draw.pick(&[3.0, 0.3, f64::NAN]);
                    items.iter_mut().for_each(|track| track.x += off);
                }
                let stamp_ns = stamp(stamp_ns);
                let copy = Received { session, generated_ns, stamp_ns, items };
                self.receive(station, group, copy, seen);
            }
            Group::Plan => {
                let (stamp_ns, mut items) = scene.points.unwrap_or((self.now_ns, Vec::new()));
                if self.draw.one_in(12) {
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
        let actions = self.plain.data(self.now_ns, (station, group), &copy);
        let (generated, stamp) = (at(generated_ns), at(stamp_ns));
        let items = copy.items.clone();
        match self.arrive(Message { station, session, generated, stamp, items }) {
            Arrival::Accepted(token) => {
                assert!(actions.is_empty(), "{actions:?}");
                let fallbacks = self.fallbacks;
                self.keep(Held { token, copy, fallbacks });
            }
            Arrival::Dropped { actions: dropped, .. } => {
                assert_eq!(dropped.to_vec(), actions);
                assert!(!actions.is_empty());
                seen.dropped += 1;
            }
        }
        self.same_state();
    }

    /// One cycle on both sides.
    fn cycle(&mut self, seen: &mut Seen) {
        let draw = &mut self.draw;
        let mut scene = self.base.scene(self.now_ns);
        if draw.one_in(40) {
            scene.ego.speed = draw.pick(&[f64::NAN, -1.0]);
        }
        if draw.one_in(10) {
            scene.detections = None;
        }
        if draw.one_in(10) {
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
        let ended = self.plain.cycle(&own, tracks.map(|it| &it.copy), points.map(|it| &it.copy));
        let is_remote = before != Configuration::Local;
        seen.cycles += 1;
        match self.monitor.cycle(&inputs) {
            Decision::Safe { tracks: out, trajectory, report, actions } => {
                assert!(same(&Ok(report), &ended.report), "{report:?} {:?}", ended.report);
                assert_eq!(actions.to_vec(), ended.actions);
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
                }
            }
            Decision::Unsafe { report, actions } => {
                assert!(same(&report, &ended.report), "{report:?} {:?}", ended.report);
                assert_eq!(actions.to_vec(), ended.actions);
                assert_eq!(self.monitor.configuration(), Configuration::Local);
                seen.errors += u64::from(report.is_err());
                seen.unsafe_while_remote += u64::from(is_remote);
                self.fallbacks += 1;
            }
        }
        seen.count(&ended, before, [tracks.is_some(), points.is_some()]);
        self.same_state();
    }

    /// What leads on: a tick, confirmations, data, a cycle.
    fn period(&mut self, seen: &mut Seen) {
        self.event(EventKind::Tick);
        for group in Group::ALL {
            if let GroupState::Requested { station, session, .. } =
                self.plain.requester.state(group)
            {
                self.event(EventKind::Confirm { station, group, session });
            }
        }
        Group::ALL.into_iter().for_each(|group| self.data(group, seen));
        self.cycle(seen);
    }

    fn any(&mut self, seen: &mut Seen) {
        let group = Group::ALL[self.draw.below(2)];
        let station = self.draw.pick(&[1, 2, 3]);
        let some = [Groups::ALL, Groups::from(Group::Mot), Groups::from(Group::Plan), Groups::NONE];
        let groups = self.draw.pick(&some);
        let session = self.plain.requester.sessions() - i64::from(self.draw.one_in(2));
        match self.draw.below(10) {
            0 => self.event(EventKind::Offer { station, groups }),
            1 => self.event(EventKind::Withdraw { station }),
            2 => self.event(EventKind::Lost { station }),
            3 => self.event(EventKind::Area { groups }),
            4 => self.event(EventKind::Reject { station, group, session }),
            5 => self.event(EventKind::Confirm { station, group, session }),
            6 | 7 => self.data(group, seen),
            _ => self.cycle(seen),
        }
    }
}

impl Seen {
    fn count(&mut self, ended: &Ended, before: Configuration, given: [bool; 2]) {
        let used = [ended.sessions.mot.is_some(), ended.sessions.plan.is_some()];
        let lost = Group::ALL
            .into_iter()
            .any(|group| before.is_remote(group) && given[place(group)] && !used[place(group)]);
        self.not_the_last += u64::from(lost && ended.report.is_ok());
        let examined = before.is_remote(Group::Plan) && used[1];
        self.with_history += u64::from(examined && ended.lists > 1);
    }
}

/// Where accepted elements go.
trait Keeps<T> {
    fn arrive(&mut self, message: Message<Vec<T>>) -> Arrival<Vec<T>>;
    fn keep(&mut self, held: Held<T>);
}

impl Keeps<Track> for Pair<'_, '_, '_> {
    fn arrive(&mut self, message: Message<Vec<Track>>) -> Arrival<Vec<Track>> {
        self.monitor.tracks(at(self.now_ns), message).expect("a station")
    }

    fn keep(&mut self, held: Held<Track>) {
        self.tracks.push(held);
    }
}

impl Keeps<TrajectoryPoint> for Pair<'_, '_, '_> {
    fn arrive(&mut self, message: Message<Vec<TrajectoryPoint>>) -> Arrival<Vec<TrajectoryPoint>> {
        self.monitor.trajectory(at(self.now_ns), message).expect("a station")
    }

    fn keep(&mut self, held: Held<TrajectoryPoint>) {
        self.points.push(held);
    }
}

/// Mostly the last one.
fn choose<'h, T>(draw: &mut Draw<'_>, held: &'h [Held<T>]) -> Option<&'h Held<T>> {
    match draw.below(8) {
        6 => held.get(draw.below(held.len().max(1))),
        7 => None,
        _ => held.last(),
    }
}

/// `spec/5-interfaces.md#monitor.1`, `spec/5-interfaces.md#monitor.2`,
/// `spec/5-interfaces.md#monitor.3`, `spec/5-interfaces.md#monitor.4`.
fn as_the_plain_calls(profile: Profile) {
    let seen = RefCell::new(Seen::default());
    let result = runner().run(&(tape(), long_tape()), |(scene, steps)| {
        let draw = &mut Draw::new(&scene);
        let (base, closed, cross_sections, start_ns, stages) = if draw.one_in(2) {
            (Base::Road, false, road(), 0, settings().stages)
        } else {
            let model_profile = match profile {
                Profile::Paper => mufasa_model::input::cycle::Profile::Paper,
                Profile::Hardened => mufasa_model::input::cycle::Profile::Hardened,
            };
            let mut cycle = whole::cycle(draw, model_profile);
            cycle.detection_history.clear();
            let owned = to_impl(&cycle);
            let it = owned.borrow(&[]);
            let (closed, sections) = (it.route.closed, it.route.cross_sections.to_vec());
            let (now_ns, stages) = (it.now_ns, it.parameters);
            (Base::Still(Box::new(owned)), closed, sections, now_ns, stages)
        };
        let mut buffers = Buffers::new(600, cross_sections.len());
        let mut settings = Settings { profile, stages, ..settings() };
        settings.requester.t_wait_ns = draw.pick(&[0, 150 * MS, 10_000 * MS]);
        // A draw that no monitor is made for, such as a parameter outside of its domain.
        let Ok(mut monitor) = buffers.monitor(settings) else { return Ok(()) };
        let route = Route { closed, cross_sections: &cross_sections };
        if monitor.set_route(&route).is_err() {
            return Ok(());
        }
        let mut table = vec![StationRecord::FREE; 8];
        let plain = Plain::new(settings, &mut table);
        let (tracks, points) = (Vec::new(), Vec::new());
        let (draw, fallbacks) = (Draw::new(&steps), 0);
        let now_ns = start_ns;
        let mut pair =
            Pair { monitor, plain, base: &base, route, draw, now_ns, tracks, points, fallbacks };
        let seen = &mut *seen.borrow_mut();
        pair.event(EventKind::Offer { station: 1, groups: Groups::ALL });
        for _ in 0..30 {
            pair.now_ns += pair.draw.pick(&[100 * MS, 100 * MS, 50 * MS, 30 * MS, 101 * MS, 0]);
            if pair.draw.one_in(60) {
                // The clock is set back; not before the domain of times.
                let back_ns = pair.draw.pick(&[2_000 * MS, 1_001 * MS, 999 * MS]);
                pair.now_ns = pair.now_ns.saturating_sub(back_ns);
            }
            match pair.draw.below(6) {
                0..=3 => pair.period(seen),
                4 => pair.any(seen),
                _ if pair.draw.one_in(4) => {
                    let end_ns = pair.plain.requester.hold_until_ns().unwrap_or(pair.now_ns);
                    pair.now_ns = pair.now_ns.max(end_ns);
                    pair.event(EventKind::Offer { station: 1, groups: Groups::ALL });
                }
                _ => pair.period(seen),
            }
        }
        Ok(())
    });
    let seen = seen.into_inner();
    println!("monitor, {profile:?}: {seen:?}");
    assert_eq!(result, Ok(()));
    let Seen { cycles, safe, errors, unsafe_while_remote, tracks, .. } = seen;
    let Seen { remote_trajectories, local_trajectories, not_the_last, dropped, .. } = seen;
    let often = [safe, errors, unsafe_while_remote, tracks, remote_trajectories, dropped];
    for count in often.into_iter().chain([not_the_last]) {
        assert!(100 * count >= cycles, "something hardly occurs: {seen:?}");
    }
    assert!(200 * local_trajectories >= cycles, "{seen:?}");
    let needs_history = profile == Profile::Hardened;
    assert!(!needs_history || 20 * seen.with_history >= cycles, "{seen:?}");
}

#[test]
fn the_monitor_answers_as_the_plain_calls_in_the_hardened_profile() {
    as_the_plain_calls(Profile::Hardened);
}

#[test]
fn the_monitor_answers_as_the_plain_calls_in_the_paper_profile() {
    as_the_plain_calls(Profile::Paper);
}
