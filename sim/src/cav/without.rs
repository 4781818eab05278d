//! The hardened rules without one of them, for experiments that ask what the rule is good for.
//!
//! The implementation has no switch for a rule, and is given none: a vehicle could be built with it. So this
//! guard is put together here from the functions beneath the monitor, of the requester and of a cycle. In a cycle
//! that the rule may decide, the stages are put together once more, from the functions of the model and without it
//! (`stages`); H-08 is a rule of the requester, which is the paper's then. With `Without::Nothing` it decides as the
//! monitor does (tested: `sim/tests/loop/without.rs`), but for what cannot happen to this CAV, which ticks before each
//! cycle and has current detections in each: a cycle without a tick (F-43), and tracks that nothing was compared with (F-18).

pub mod rule;
pub mod stages;

use mufasa::input::cycle::{Cycle, Ego, Route, Track, TrajectoryPoint};
use mufasa::input::parameters::Parameters as StageParameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::monitor::{Message, Time};
use mufasa::offloading::requester::{
    Action, Event, EventKind, Parameters, Requester, RequesterError, Sessions, StationRecord,
};
use mufasa::report::{InvalidInput, Report};
use mufasa::services::configuration::{Configuration, Group};
use mufasa::stages::check;
use mufasa_props::bridge::{self, report_from_impl, report_to_impl};

pub use self::rule::Without;
use super::assembled::{self, Chosen, Fixed, Last};
use super::decided::{Decided, Local};
use super::seen::Seen;
use super::sensing::Sensed;

#[derive(Clone, Copy, Debug, Default)]
struct Served {
    session: Option<i64>,
    first_ns: Option<i64>,
    last_ns: i64,
    is_starved: bool,
}

/// A session that no message is of.
const NO_SESSION: i64 = 0;

/// The hardened rules without one.
#[derive(Debug)]
pub struct Rules<'a> {
    without: Without,
    fixed: Fixed,
    requester_parameters: Parameters,
    /// Nominal, of the results.
    period_ns: i64,
    /// Which group runs where.
    pub(super) requester: Requester<'a>,
    /// For either group: the session that runs, its first cycle with anything current, since when no cycle
    /// had any, ns, and whether that is too long (F-43).
    served: [Served; 2],
    seen: Seen,
    rows: Vec<Row>,
    columns: Vec<Column>,
    pub(super) last: Last,
}

impl<'a> Rules<'a> {
    /// Nothing offered, everything local.
    ///
    /// Errors: parameters that no requester can keep.
    pub fn new(
        without: Without,
        parameters: StageParameters,
        (requester, period_ns): (Parameters, i64),
        table: &'a mut [StationRecord],
    ) -> Result<Self, RequesterError> {
        let profile = match without {
            Without::H08 => Profile::Paper,
            _ => Profile::Hardened,
        };
        Ok(Self {
            without,
            fixed: Fixed { profile: Profile::Hardened, parameters, route: (false, Vec::new()) },
            requester_parameters: requester,
            period_ns,
            requester: Requester::new(profile, requester, table)?,
            served: [Served::default(); 2],
            seen: Seen::default(),
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
            last: Last::default(),
        })
    }

    pub(super) fn set_route(&mut self, route: &Route<'_>) {
        self.fixed.route = (route.closed, route.cross_sections.to_vec());
    }

    /// Something happened.
    pub(super) fn step(
        &mut self,
        t_ns: i64,
        kind: EventKind,
    ) -> Result<Vec<Action>, RequesterError> {
        let event = Event { t_ns, kind };
        if kind == EventKind::Tick && !self.seen.reaches_back(t_ns) {
            self.requester.hold(t_ns + 1);
        }
        for (served, group) in self.served.into_iter().zip(Group::ALL) {
            if self.ends(group, &event)? {
                let unused_ns = (t_ns - served.last_ns).max(self.period_ns);
                let used_ns = served.first_ns.map_or(0, |first_ns| served.last_ns - first_ns);
                if 9 * unused_ns > used_ns {
                    self.requester.hold(t_ns + 9 * unused_ns - used_ns);
                }
            }
        }
        let actions = self.requester.step(&event)?.to_vec();
        for (served, group) in self.served.iter_mut().zip(Group::ALL) {
            let session = self.requester.session_of(group).map(|it| it.session);
            if served.session != session {
                *served = Served { session, first_ns: None, last_ns: t_ns, is_starved: false };
            }
        }
        Ok(actions)
    }

    /// Whether a group that is remote is not so after the event.
    fn ends(&self, group: Group, event: &Event) -> Result<bool, RequesterError> {
        let Some(before) = self.requester.session_of(group) else { return Ok(false) };
        let mut table = self.requester.stations().to_vec();
        table.push(StationRecord::FREE);
        let mut after = Requester::resume(self.requester.suspend(), &mut table);
        let _actions = after.step(event)?;
        Ok(after.session_of(group).is_none_or(|it| it.session != before.session))
    }

    pub(super) fn tracks(
        &mut self,
        t_ns: i64,
        message: Message<Vec<Track>>,
    ) -> Result<Vec<Action>, RequesterError> {
        let actions = self.arrives(t_ns, Group::Mot, &message)?;
        if !actions.contains(&Action::Drop(Group::Mot)) {
            self.last.tracks = Some(message);
        }
        Ok(actions)
    }

    pub(super) fn trajectory(
        &mut self,
        t_ns: i64,
        message: Message<Vec<TrajectoryPoint>>,
    ) -> Result<Vec<Action>, RequesterError> {
        let actions = self.arrives(t_ns, Group::Plan, &message)?;
        if !actions.contains(&Action::Drop(Group::Plan)) {
            self.last.points = Some(message);
        }
        Ok(actions)
    }

    /// What is too old for any cycle, or of a group that no cycle gets anything of, is no arrival.
    fn arrives<T>(
        &mut self,
        t_ns: i64,
        group: Group,
        message: &Message<T>,
    ) -> Result<Vec<Action>, RequesterError> {
        let [generated_ns, stamp_ns] = [message.generated, message.stamp].map(Time::as_nanoseconds);
        let is_in_time = (0..=self.requester_parameters.l_max_ns).contains(&(t_ns - generated_ns));
        let is_too_old = t_ns - stamp_ns > self.fixed.parameters.max_age_ns;
        let is_starved = self.served[place(group)].is_starved;
        let is_none = is_in_time && (is_too_old || is_starved);
        let session = if is_none { NO_SESSION } else { message.session };
        let station = message.station;
        self.step(t_ns, EventKind::Data { station, group, session, generated_ns })
    }

    /// Decides a cycle.
    pub(super) fn decide(
        &mut self,
        t_ns: i64,
        ego: Ego,
        sensed: &Sensed,
        local: Local<'_>,
    ) -> Decided {
        let [mot, plan] = Group::ALL.map(|group| self.requester.session_of(group));
        let chosen = Chosen::new(&self.requester, &self.last, local);
        let Chosen { tracks, points } = chosen;
        let history = self.seen.history(sensed.stamp_ns);
        let moment = (t_ns, ego);
        let cycle = assembled::cycle(
            &self.fixed,
            self.requester.configuration(),
            moment,
            sensed,
            chosen,
            &history,
        );
        let scratch = &mut Scratch::new(&mut self.rows, &mut self.columns);
        let (report, is_overruled) = report(self.without, &cycle, scratch);
        let is_safe = report.as_ref().is_ok_and(|report| report.failed_stage.is_none());
        let max_age_ns = self.fixed.parameters.max_age_ns;
        let is_current = |stamp_ns: &i64| (0..=max_age_ns).contains(&(t_ns - stamp_ns));
        let has_current = [tracks.map(|it| it.0), points.map(|it| it.0)]
            .map(|stamp_ns| stamp_ns.is_some_and(|it| is_current(&it)));
        let dt_max_ns = self.requester_parameters.dt_max_ns;
        for (served, has_current) in self.served.iter_mut().zip(has_current) {
            if has_current {
                served.first_ns.get_or_insert(t_ns);
                served.last_ns = t_ns;
            }
            served.is_starved = t_ns - served.last_ns > dt_max_ns;
        }
        let is_checked = is_safe && self.requester.configuration() != Configuration::Local;
        let tracks =
            tracks.filter(|(stamp_ns, _)| is_safe && mot.is_some() && is_current(stamp_ns));
        let points = points.filter(|(stamp_ns, _)| is_checked && is_current(stamp_ns));
        let sessions = Sessions {
            mot: mot.filter(|_| tracks.is_some()).map(|running| running.session),
            plan: plan.filter(|_| points.is_some()).map(|running| running.session),
        };
        let tracks = tracks.map(|(stamp_ns, items)| (stamp_ns, items.to_vec()));
        let trajectory = points.map(|(_, points)| points.to_vec());
        if report.is_ok() {
            self.seen.see(sensed.stamp_ns, &sensed.detections);
        }
        let kind = EventKind::Verdict { safe: is_safe, sessions };
        let actions = self.step(t_ns, kind).unwrap_or_default();
        let report = Some(report);
        #[expect(clippy::cast_possible_truncation, reason = "tau of seconds")]
        let tau_ns = (self.fixed.parameters.tau * 1e9) as i64;
        let brake_by_ns = trajectory.as_ref().map(|_| t_ns + tau_ns);
        let record = None;
        Decided { is_safe, report, is_overruled, trajectory, brake_by_ns, tracks, actions, record }
    }
}

/// The report of a cycle without the rule, as it is with all of them, unless the rule may change it; and whether
/// it changes the verdict.
fn report(
    without: Without,
    cycle: &Cycle<'_>,
    scratch: &mut Scratch<'_>,
) -> (Result<Report, InvalidInput>, bool) {
    let report = match check(cycle, scratch) {
        Ok(report) => report,
        Err(problem) => return (Err(problem), false),
    };
    if report.input.is_some() || !without.may_change(&report_from_impl(&report)) {
        return (Ok(report), false);
    }
    let decided = stages::decide(without, &bridge::from_impl(cycle));
    let decided = report_to_impl(&decided).unwrap_or(report);
    (Ok(decided), decided.failed_stage.is_none() != report.failed_stage.is_none())
}

const fn place(group: Group) -> usize {
    match group {
        Group::Mot => 0,
        Group::Plan => 1,
    }
}
