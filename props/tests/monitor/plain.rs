//! What the monitor does, by the plain calls: the requester, the stages without any index, and a list of
//! lists (`spec/monitor.md#monitor`).

use mufasa::cycle::check;
use mufasa::input::cycle::{
    Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::monitor::{Brake, Settings};
use mufasa::offloading::requester::{
    Action, Event, EventKind, Requester, Sessions, StationRecord, Suspended,
};
use mufasa::report::{InvalidInput, Outcome, Problem, Report};
use mufasa::services::configuration::{Configuration, Group, Groups};

use super::kit::{MS, place};

/// A remote list as it was received.
#[derive(Clone, Debug, PartialEq)]
pub struct Received<T> {
    pub session: i64,
    pub generated_ns: i64,
    pub stamp_ns: i64,
    pub items: Vec<T>,
}

/// What the CAV has of its own in a cycle.
#[derive(Clone)]
pub struct Own<'c> {
    pub now_ns: i64,
    pub ego: Ego,
    pub detections: Option<(i64, &'c [Detection])>,
    pub lead: Option<Lead>,
    pub grid: Option<Grid<'c>>,
    pub tracks: Option<(i64, &'c [Track])>,
    pub trajectory: Option<(i64, &'c [TrajectoryPoint])>,
    pub route: Route<'c>,
}

/// What a cycle ended in.
pub struct Ended {
    pub report: Result<Report, InvalidInput>,
    pub actions: Vec<Action>,
    /// Whether tracks and trajectory come out.
    pub verified: [bool; 2],
    /// Of remote data.
    pub sessions: Sessions,
    /// Of the history.
    pub lists: usize,
    /// Of the CAV's own plan.
    pub brake: Option<Brake>,
}

/// The plain calls and what they need.
pub struct Plain<'a> {
    settings: Settings,
    pub requester: Requester<'a>,
    /// Session and generation time of the last element that was used.
    last: [Option<(i64, i64)>; 2],
    /// Of the running sessions.
    pub service: [Option<Service>; 2],
    kept: Vec<(i64, Vec<Detection>)>,
    /// The last tick since the last cycle.
    tick_ns: Option<i64>,
    brake: Option<Brake>,
    /// The cycles since the CAV was last elsewhere: when, and whether PLAN was remote.
    stood: ([f64; 2], Vec<(i64, bool)>),
    pub given_back: u64,
    pub waits: Waits,
}

/// How many sessions ended with which wait, none behind a longer hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct Waits {
    /// Nothing to take from it.
    pub whole: u64,
    /// Less the time of use.
    pub shortened: u64,
    /// Nothing left.
    pub none: u64,
}

/// What a session has been good for.
#[derive(Clone, Copy)]
pub struct Service {
    pub session: i64,
    /// The last cycle with a current element; before the first one the confirmation.
    since_ns: i64,
    /// The first cycle with a current element, by the clock of the last one.
    first_ns: Option<i128>,
    /// As the last cycle left it.
    pub starved: bool,
}

impl<'a> Plain<'a> {
    pub fn new(settings: Settings, table: &'a mut [StationRecord]) -> Self {
        let fresh = Requester::new(settings.profile, settings.requester, table);
        let mut parts = fresh.expect("a requester").suspend().parts();
        parts.sessions = settings.sessions_before;
        let requester = Requester::resume(Suspended::from_parts(&parts), table);
        let (last, service, kept) = ([None; 2], [None; 2], Vec::new());
        let (tick_ns, brake, stood, given_back) = (None, None, ([0.0; 2], Vec::new()), 0);
        let waits = Waits::default();
        Self { settings, requester, last, service, kept, tick_ns, brake, stood, given_back, waits }
    }

    /// By when control has to brake along what a cycle at this time verified, ns.
    pub fn brake_by(&self, now_ns: i64) -> Option<i64> {
        let tau_ns = format!("{:.0}", (self.settings.stages.tau * 1e9).floor());
        let by_ns = now_ns.saturating_add(tau_ns.parse().expect("in the domain"));
        (self.settings.profile == Profile::HARDENED).then_some(by_ns)
    }

    /// An element arrives; of one that is in time, but too old for any cycle or of a group that is
    /// starved, the requester hears no session.
    pub fn data<T>(
        &mut self,
        t_ns: i64,
        (station, group): (i64, Group),
        received: &Received<T>,
    ) -> Vec<Action> {
        let &Received { session, generated_ns, stamp_ns, .. } = received;
        let oldest_ns = i128::from(t_ns) - i128::from(self.settings.stages.max_age_ns);
        let starved = self.service[place(group)].is_some_and(|it| it.starved);
        let usable = i128::from(stamp_ns) >= oldest_ns && !starved;
        let latency_ns = i128::from(t_ns) - i128::from(generated_ns);
        let late = latency_ns < 0 || latency_ns > i128::from(self.settings.requester.l_max_ns);
        let session = if usable || late { session } else { 0 };
        self.step(t_ns, EventKind::Data { station, group, session, generated_ns })
    }

    pub fn step(&mut self, t_ns: i64, kind: EventKind) -> Vec<Action> {
        let event = Event { t_ns, kind };
        let is_tick = kind == EventKind::Tick;
        self.tick_ns = if is_tick { Some(t_ns) } else { self.tick_ns };
        let before = if is_tick { self.give_back(t_ns) } else { Vec::new() };
        for group in self.returning(&event) {
            self.hold(t_ns, group);
        }
        if kind == EventKind::Tick && !self.has_seen_enough(t_ns) {
            self.requester.hold(t_ns.saturating_add(1));
        }
        let actions = self.requester.step(&event).expect("a station").to_vec();
        let actions = [before, actions].concat();
        if let EventKind::Data { group, session, generated_ns, .. } = kind
            && !actions.contains(&Action::Drop(group))
        {
            self.last[place(group)] = Some((session, generated_ns));
        }
        for group in Group::ALL {
            let service = &mut self.service[place(group)];
            let running = self.requester.session_of(group).map(|it| it.session);
            if service.map(|it| it.session) != running {
                let fresh =
                    |session| Service { session, since_ns: t_ns, first_ns: None, starved: false };
                *service = running.map(fresh);
            }
        }
        actions
    }

    /// Leaves a station that plans while the CAV stands.
    fn give_back(&mut self, t_ns: i64) -> Vec<Action> {
        let pairs = self.stood.1.windows(2).filter(|it| it[0].1 && it[1].1);
        let stood_ns: i128 =
            pairs.map(|it| (i128::from(it[1].0) - i128::from(it[0].0)).max(0)).sum();
        let is_remote = self.requester.session_of(Group::Plan).is_some();
        let least_ns =
            self.settings.stall.map(|it| i128::try_from(it.time.as_nanos()).expect("a time"));
        if least_ns.is_none_or(|it| stood_ns < it) || !is_remote {
            return Vec::new();
        }
        self.given_back += 1;
        self.stood.1.drain(..self.stood.1.len() - 1);
        let groups = self.requester.suspend().parts().area;
        let without = Groups { plan: false, ..groups };
        let mut actions = self.step(t_ns, EventKind::Area { groups: without });
        actions.extend(self.step(t_ns, EventKind::Area { groups }));
        self.requester.hold(t_ns.saturating_add(self.settings.requester.t_wait_ns));
        actions
    }

    /// A cycle ended: what it says of the CAV's own plan, and where the CAV is.
    fn look_on(&mut self, own: &Own<'_>, as_remote: &Cycle<'_>, is_led: bool) {
        let [x, y] = self.stood.0;
        let way = (own.ego.x - x).hypot(own.ego.y - y);
        if self.settings.stall.is_some_and(|it| way > it.way_m) {
            let last = self.stood.1.pop();
            self.stood = ([own.ego.x, own.ego.y], last.into_iter().collect());
        }
        self.stood.1.push((own.now_ns, self.requester.configuration().is_remote(Group::Plan)));
        let is_local = self.requester.configuration() == Configuration::Local;
        match (self.settings.supervise_local, is_local, as_remote.trajectory) {
            (false, ..) => {}
            (true, false, _) => self.brake = self.brake.filter(|_| !is_led),
            (true, true, None) => self.brake = Some(Brake::NoPlan),
            (true, true, Some(_)) => {
                self.brake = match check_plainly(as_remote) {
                    Err(problem) | Ok(Report { input: Some(problem), .. }) => {
                        Some(Brake::Invalid(problem))
                    }
                    Ok(Report { failed_stage, stages, .. }) => failed_stage.map(|stage| {
                        let mut witnesses = stages.into_iter().filter_map(|it| match it {
                            Outcome::Failed(witness) => Some(witness),
                            _ => None,
                        });
                        Brake::Fails { stage, witness: witnesses.next_back() }
                    }),
                }
            }
        }
    }

    /// Whether H-14 would have a list to judge motion by.
    fn has_seen_enough(&self, t_ns: i64) -> bool {
        let age_ns = |stamp_ns: i64| i128::from(t_ns) - i128::from(stamp_ns);
        let usable = i128::from(500 * MS)..=i128::from(1000 * MS);
        self.settings.profile == Profile::PAPER
            || self.kept.iter().any(|(stamp_ns, _)| usable.contains(&age_ns(*stamp_ns)))
    }

    /// The groups that are remote before an event and not after it, or then by another session.
    fn returning(&self, event: &Event) -> Vec<Group> {
        let mut table = self.requester.stations().to_vec();
        table.push(StationRecord::default());
        let mut copy = Requester::resume(self.requester.suspend(), &mut table);
        copy.step(event).expect("a station").as_slice();
        let session = |of: &Requester<'_>, group| of.session_of(group).map(|it| it.session);
        let before = |group: &Group| session(&self.requester, *group);
        let ends =
            |group: &Group| before(group).is_some() && before(group) != session(&copy, *group);
        Group::ALL.into_iter().filter(ends).collect()
    }

    /// After a session: nine times as long as it was of no use, of which a period is the least, less the
    /// time that it was of use.
    fn hold(&mut self, t_ns: i64, group: Group) {
        let service = self.service[place(group)].expect("a running session");
        let [t_ns, last_ns] = [t_ns, service.since_ns].map(i128::from);
        let least_ns = i128::try_from(self.settings.period.as_nanos()).expect("a period");
        let unused_ns = (t_ns - last_ns).max(least_ns);
        let used_ns = service.first_ns.map_or(0, |first_ns| last_ns - first_ns);
        let wait_ns = 9 * unused_ns - used_ns;
        let before_ns = self.requester.hold_until_ns().map(i128::from);
        if wait_ns > 0 {
            let until_ns = i64::try_from(t_ns + wait_ns).unwrap_or(i64::MAX);
            self.requester.hold(until_ns);
        }
        let counts = before_ns.is_none_or(|before_ns| before_ns < t_ns + wait_ns.max(1));
        self.waits.whole += u64::from(counts && used_ns == 0);
        self.waits.shortened += u64::from(counts && used_ns > 0 && wait_ns > 0);
        self.waits.none += u64::from(counts && wait_ns <= 0);
    }

    /// A cycle looked at its groups, and this is what was current of the remote ones.
    fn serve(&mut self, now_ns: i64, is_current: [bool; 2]) {
        let dt_max_ns = i128::from(self.settings.requester.dt_max_ns);
        for (service, is_current) in self.service.iter_mut().zip(is_current) {
            let Some(service) = service else { continue };
            if now_ns < service.since_ns {
                // The clock was set back: nothing was of use later than now.
                service.first_ns = service.first_ns.map(|first_ns| first_ns.min(now_ns.into()));
                service.since_ns = now_ns;
            }
            if is_current {
                service.first_ns.get_or_insert(i128::from(now_ns));
                service.since_ns = now_ns;
            }
            let since_ns = i128::from(now_ns) - i128::from(service.since_ns);
            service.starved = !is_current && since_ns > dt_max_ns;
        }
    }

    /// A cycle with the lists that were received, whether the requester used them or not.
    pub fn cycle(
        &mut self,
        own: &Own<'_>,
        tracks: Option<&Received<Track>>,
        points: Option<&Received<TrajectoryPoint>>,
    ) -> Ended {
        let [mot, plan] = Group::ALL.map(|group| self.requester.session_of(group).is_some());
        let tracks = tracks.filter(|it| self.is_last(Group::Mot, it.session, it.generated_ns));
        let points = points.filter(|it| self.is_last(Group::Plan, it.session, it.generated_ns));
        let used_tracks = if mot { tracks.map(|it| (it.stamp_ns, &*it.items)) } else { own.tracks };
        let used_points =
            if plan { points.map(|it| (it.stamp_ns, &*it.items)) } else { own.trajectory };
        let history = self.history(own);
        let history: Vec<_> =
            history.iter().map(|(stamp_ns, items)| list(*stamp_ns, items)).collect();
        let cycle = Cycle {
            profile: self.settings.profile,
            parameters: self.settings.stages,
            now_ns: own.now_ns,
            configuration: self.requester.configuration(),
            ego: own.ego,
            trajectory: used_points.map(|(stamp_ns, points)| Trajectory { stamp_ns, points }),
            tracks: used_tracks.map(|(stamp_ns, items)| TrackList { stamp_ns, items }),
            detections: own.detections.map(|(stamp_ns, items)| list(stamp_ns, items)),
            lead: own.lead,
            route: own.route,
            grid: own.grid,
            detection_history: &history,
        };
        let (checked, lists) = (check_plainly(&cycle), history.len());
        let no_tick = InvalidInput { field: "tick", index: None, problem: Problem::NoTick };
        let age_ns = self.tick_ns.map(|tick_ns| i128::from(own.now_ns) - i128::from(tick_ns));
        let dt_max_ns = i128::from(self.settings.requester.dt_max_ns);
        let blind = !age_ns.is_some_and(|it| 0 <= it && it <= dt_max_ns) && (mot || plan);
        let report = checked.and_then(|report| if blind { Err(no_tick) } else { Ok(report) });
        self.tick_ns = None;
        let safe = report.is_ok_and(|report| report.failed_stage.is_none());
        let max_age_ns = i128::from(self.settings.stages.max_age_ns);
        let current = |stamp_ns: i64| {
            let age_ns = i128::from(own.now_ns) - i128::from(stamp_ns);
            (0..=max_age_ns).contains(&age_ns)
        };
        let ran_i = own.detections.is_some_and(|it| current(it.0));
        let is_out = |stamp: Option<i64>| safe && stamp.is_some_and(current);
        let arrived = [tracks.map(|it| it.stamp_ns), points.map(|it| it.stamp_ns)];
        self.serve(own.now_ns, arrived.map(|stamp| stamp.is_some_and(current)));
        let verified = [
            mot && ran_i && is_out(used_tracks.map(|it| it.0)),
            (mot || plan) && is_out(used_points.map(|it| it.0)),
        ];
        let sessions = Sessions {
            mot: tracks.filter(|_| verified[0]).map(|it| it.session),
            plan: points.filter(|_| plan && verified[1]).map(|it| it.session),
        };
        if checked.is_ok()
            && let Some((stamp_ns, items)) = own.detections.filter(|it| current(it.0))
        {
            self.keep(stamp_ns, items);
        }
        let actions = self.step(own.now_ns, EventKind::Verdict { safe, sessions });
        let plan = own.trajectory.filter(|it| current(it.0));
        let later = self.history(own);
        let later: Vec<_> = later.iter().map(|(stamp_ns, items)| list(*stamp_ns, items)).collect();
        let as_remote = Cycle {
            configuration: Configuration::PlanRemote,
            tracks: own.tracks.map(|(stamp_ns, items)| TrackList { stamp_ns, items }),
            trajectory: plan.map(|(stamp_ns, points)| Trajectory { stamp_ns, points }),
            detection_history: &later,
            ..cycle
        };
        self.look_on(own, &as_remote, verified[1]);
        Ended { report, actions, verified, sessions, lists, brake: self.brake }
    }

    fn is_last(&self, group: Group, session: i64, generated_ns: i64) -> bool {
        let running = self.requester.session_of(group).map(|running| running.session);
        running == Some(session) && self.last[place(group)] == Some((session, generated_ns))
    }

    /// The lists nearest to 300, 500 and 800 ms, the youngest first.
    fn history(&self, own: &Own<'_>) -> Vec<(i64, Vec<Detection>)> {
        let (Some((now_ns, _)), Profile::HARDENED) = (own.detections, self.settings.profile) else {
            return Vec::new();
        };
        let age = |stamp_ns: i64| now_ns.saturating_sub(stamp_ns);
        let mut found: Vec<(i64, Vec<Detection>)> = Vec::new();
        for wanted_ns in [300 * MS, 500 * MS, 800 * MS] {
            let usable = self.kept.iter().filter(|it| (200 * MS..=1000 * MS).contains(&age(it.0)));
            let nearest =
                usable.min_by_key(|it| ((age(it.0) - wanted_ns).unsigned_abs(), age(it.0)));
            found.extend(nearest.cloned());
        }
        found.sort_by_key(|it| std::cmp::Reverse(it.0));
        found.dedup_by_key(|it| it.0);
        found
    }

    fn keep(&mut self, stamp_ns: i64, items: &[Detection]) {
        let last_ns = self.kept.iter().map(|it| it.0).max();
        if let Some(last_ns) = last_ns {
            let since_ns = stamp_ns.saturating_sub(last_ns);
            if since_ns < -1000 * MS {
                self.kept.clear();
            } else if since_ns < 83_333_334 {
                return;
            }
        }
        self.kept.push((stamp_ns, items.to_vec()));
        let many = self.kept.len().saturating_sub(12);
        self.kept.drain(..many);
    }
}

fn list(stamp_ns: i64, items: &[Detection]) -> DetectionList<'_> {
    DetectionList { stamp_ns, items }
}

/// The stages with scratch of the size that the cycle asks for.
pub fn check_plainly(cycle: &Cycle<'_>) -> Result<Report, InvalidInput> {
    let sizes = Sizes::for_cycle(cycle);
    let mut rows = vec![Row::default(); sizes.rows];
    let mut columns = vec![Column::default(); sizes.columns];
    check(cycle, &mut Scratch::new(&mut rows, &mut columns))
}
