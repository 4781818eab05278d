//! What stands between the link and control: SOFOF's quality of service alone, or the monitor.

use mufasa::input::cycle::{Ego, Route, Track, TrackList, Trajectory, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{
    Accepted, Arrival, Decision, Inputs, Memory, Message, Monitor, MonitorError, Time,
};
use mufasa::offloading::requester::{
    Action, Actions, Event, EventKind, GroupState, Requester, RequesterError, Running, Sessions,
    Source, StationRecord,
};
use mufasa::report::InvalidInput;
use mufasa::services::configuration::{Configuration, Group};
use mufasa_link::vehicle::tell::Given;
use mufasa_props::call;
use mufasa_records::calls::Follows;
use mufasa_records::monitor_answer::VerifiedAnswer;
use serde_json::Value;

use super::assembled::Known;
pub use super::assembled::Results;
use super::calls::{self, Calls};
pub use super::decided::Decided;
use super::recorder::Recorder;
use super::sensing::Sensed;
use crate::settings::Settings;
pub use crate::settings::Variant;
use crate::withheld::Withheld;

/// One of the variants.
#[derive(Debug)]
pub struct Guard<'a> {
    kind: Kind<'a>,
    /// A copy of what was accepted: the monitor lets nobody look at it.
    last: Last,
    recorder: Recorder<'a>,
    withheld: Option<Withheld>,
    settings: &'a Settings,
    /// What the loop around the monitor does, where it is logged.
    calls: Option<Calls>,
    /// The trajectory that came out last.
    released: Option<VerifiedAnswer>,
}

#[derive(Debug)]
#[expect(clippy::large_enum_variant, reason = "there is one in a run")]
enum Kind<'a> {
    Plain(Requester<'a>),
    Checked {
        monitor: Monitor<'a>,
        tracks: Option<Accepted<Vec<Track>>>,
        points: Option<Accepted<Vec<TrajectoryPoint>>>,
    },
}

/// The last results of stations that the requester used.
#[derive(Clone, Debug, Default)]
struct Last {
    tracks: Option<Message<Vec<Track>>>,
    points: Option<Message<Vec<TrajectoryPoint>>>,
}

impl Last {
    /// The results of a cycle: of a station where a group is remote, the CAV's own where it is not.
    fn or<'c>(&'c self, local: Results<'c>, requester: &Requester<'_>) -> Results<'c> {
        let [mot, plan] = Group::ALL.map(|group| requester.session_of(group));
        let tracks = |(stamp_ns, items)| TrackList { stamp_ns, items };
        let trajectory = |(stamp_ns, points)| Trajectory { stamp_ns, points };
        Results {
            tracks: mot.map_or(local.tracks, |it| used(&it, self.tracks.as_ref()).map(tracks)),
            trajectory: plan
                .map_or(local.trajectory, |it| used(&it, self.points.as_ref()).map(trajectory)),
        }
    }
}

/// The message that the requester used last, if it is the one that is kept: its stamp, ns, and its items.
fn used<'m, T>(running: &Running, kept: Option<&'m Message<Vec<T>>>) -> Option<(i64, &'m [T])> {
    let is_it = |it: &&Message<Vec<T>>| {
        (Some(it.generated.as_nanoseconds()), it.session) == (running.last_used_ns, running.session)
    };
    kept.filter(is_it).map(|it| (it.stamp.as_nanoseconds(), it.items.as_slice()))
}

impl<'a> Guard<'a> {
    /// Nothing offered, everything local.
    ///
    /// Errors: settings that no monitor can keep.
    pub fn new(
        settings: &'a Settings,
        table: &'a mut [StationRecord],
        memory: Memory<'a>,
        route: &Route<'_>,
    ) -> Result<Self, MonitorError> {
        let kind = match settings.profile {
            None => Kind::Plain(
                Requester::new(Profile::PAPER, settings.requester, table)
                    .map_err(MonitorError::Requester)?,
            ),
            Some(profile) => {
                let monitor = Monitor::new(settings.monitor(profile), memory)?;
                Kind::Checked { monitor, tracks: None, points: None }
            }
        };
        let recorder = Recorder::new(settings, route.cross_sections);
        Ok(Self {
            kind,
            last: Last::default(),
            recorder,
            withheld: settings.withheld,
            settings,
            calls: settings.logged.then(Calls::default),
            released: None,
        })
    }

    /// The stretch of the route that is followed from now on.
    ///
    /// Errors: a route that the monitor cannot keep.
    pub fn set_route(&mut self, route: &Route<'_>) -> Result<(), InvalidInput> {
        match &mut self.kind {
            Kind::Plain(_) => Ok(()),
            Kind::Checked { monitor, .. } => monitor.set_route(route),
        }
    }

    /// The configuration now.
    pub fn configuration(&self) -> Configuration {
        self.requester().configuration()
    }

    /// The state of a group.
    pub fn state(&self, group: Group) -> GroupState {
        self.requester().state(group)
    }

    /// The requester: for who looks on.
    pub fn requester(&self) -> &Requester<'a> {
        match &self.kind {
            Kind::Plain(requester) => requester,
            Kind::Checked { monitor, .. } => monitor.requester(),
        }
    }

    /// The tracks of a station that the next cycle will have.
    pub(super) fn remote_tracks(&self) -> Option<TrackList<'_>> {
        self.last.or(Results::default(), self.requester()).tracks
    }

    /// The last results of stations that were accepted, whatever became of them: for who looks on.
    pub fn accepted(&self) -> (Option<&[Track]>, Option<&[TrajectoryPoint]>) {
        let Last { tracks, points } = &self.last;
        let tracks = tracks.as_ref().map(|it| it.items.as_slice());
        (tracks, points.as_ref().map(|it| it.items.as_slice()))
    }

    /// Something happened that is no data.
    ///
    /// Errors: a station below 1, or no place for another one.
    pub fn happens(&mut self, t_ns: i64, kind: EventKind) -> Result<Vec<Action>, RequesterError> {
        let now = time(t_ns);
        let actions = match &mut self.kind {
            Kind::Plain(requester) => requester.step(&Event { t_ns, kind }),
            Kind::Checked { monitor, .. } => {
                let Some(actions) = call::event(monitor, now, kind) else { return Ok(Vec::new()) };
                if let (Some(calls), Ok(actions), Some(kind)) =
                    (&mut self.calls, &actions, calls::told(kind))
                {
                    calls.add((t_ns, kind), actions, &Value::Null);
                }
                actions
            }
        };
        actions.map(|actions| actions.to_vec())
    }

    /// Control does this at a time, ns.
    pub(super) fn control(&mut self, t_ns: i64, follows: Follows) {
        if let Some(calls) = &mut self.calls {
            calls.control(t_ns, follows);
        }
    }

    /// The log of the loop, where it is made.
    pub fn calls(&self) -> Option<&Calls> {
        self.calls.as_ref()
    }

    /// The trajectory that came out last.
    pub(super) fn released(&self) -> Option<VerifiedAnswer> {
        self.released
    }

    /// Tracks arrive.
    ///
    /// Errors: a station below 1.
    pub fn tracks(
        &mut self,
        t_ns: i64,
        message: Message<Vec<Track>>,
    ) -> Result<Vec<Action>, RequesterError> {
        let last = &mut self.last.tracks;
        match &mut self.kind {
            Kind::Plain(requester) => keep(requester, t_ns, Group::Mot, message, last),
            Kind::Checked { monitor, tracks, .. } => {
                let copy = message.clone();
                let kind = self.calls.as_ref().map(|_| calls::tracks(&message));
                let actions = accept(monitor.tracks(time(t_ns), message)?, tracks, copy, last);
                if let (Some(calls), Some(kind)) = (&mut self.calls, kind) {
                    calls.add((t_ns, kind), &actions, &Value::Null);
                }
                Ok(actions)
            }
        }
    }

    /// A trajectory arrives.
    ///
    /// Errors: a station below 1.
    pub fn trajectory(
        &mut self,
        t_ns: i64,
        message: Message<Vec<TrajectoryPoint>>,
    ) -> Result<Vec<Action>, RequesterError> {
        let last = &mut self.last.points;
        match &mut self.kind {
            Kind::Plain(requester) => keep(requester, t_ns, Group::Plan, message, last),
            Kind::Checked { monitor, points, .. } => {
                let copy = message.clone();
                let kind = self.calls.as_ref().map(|_| calls::trajectory(&message));
                let actions = accept(monitor.trajectory(time(t_ns), message)?, points, copy, last);
                if let (Some(calls), Some(kind)) = (&mut self.calls, kind) {
                    calls.add((t_ns, kind), &actions, &Value::Null);
                }
                Ok(actions)
            }
        }
    }

    /// Decides a cycle; `local`: the results of the CAV's own services, as far as they run.
    pub fn decide(&mut self, t_ns: i64, ego: Ego, sensed: &Sensed, local: Results<'_>) -> Decided {
        let (last, recorder, withheld) = (&self.last, &mut self.recorder, self.withheld);
        let (monitor, tracks, points) = match &mut self.kind {
            Kind::Plain(requester) => return unchecked(requester, t_ns, last, local),
            Kind::Checked { monitor, tracks, points } => (monitor, tracks, points),
        };
        let results = last.or(local, monitor.requester());
        let known = Known::of(monitor.configuration(), (t_ns, ego), sensed);
        let record = recorder.cycle(&known, results);
        let logged = self.calls.as_mut().and_then(|it| Some((it, recorder.local(&known, local)?)));
        let is_list = results.tracks.is_none_or(|list| {
            withheld.is_none_or(|it| !it.is_no_list(known.configuration, list.items.len()))
        });
        let given = Given {
            detections: Some(known.detections).filter(|_| withheld != Some(Withheld::Detections)),
            lead: known.lead,
            grid: known.grid.filter(|_| withheld != Some(Withheld::Grid)),
            tracks: local.tracks,
            trajectory: local.trajectory,
        };
        let inputs = given.inputs(Inputs::new(time(t_ns), ego), 0);
        let inputs = tracks.iter().filter(|_| is_list).fold(inputs, Inputs::remote_tracks);
        let inputs = points.iter().fold(inputs, Inputs::remote_trajectory);
        let (decision, actions) = monitor.cycle(&inputs);
        let actions = actions.to_vec();
        let session = last.points.as_ref().map(|it| it.session);
        let released = match &decision {
            Decision::Safe { trajectory: Some(it), .. } => Some(match it.source() {
                Source::Local => {
                    VerifiedAnswer { stamp_ns: it.stamp_ns, station: 0, session: None }
                }
                Source::Remote { station } => {
                    VerifiedAnswer { stamp_ns: it.stamp_ns, station, session }
                }
            }),
            Decision::Safe { .. } | Decision::Unsafe { .. } => None,
        };
        self.released = released.or(self.released);
        let decided = match decision {
            Decision::Safe { tracks, trajectory, report, brake } => Decided {
                is_safe: true,
                report: Some(Ok(report)),
                brake_by_ns: trajectory.and_then(|it| it.brake_by()).map(Time::as_nanoseconds),
                brake,
                trajectory: trajectory.map(|it| it.points.to_vec()),
                tracks: tracks.map(|it| (it.stamp_ns, it.items.to_vec())),
                actions,
                record,
            },
            Decision::Unsafe { report, brake } => {
                Decided { report: Some(report), brake, actions, record, ..Decided::default() }
            }
        };
        if let Some((calls, cycle)) = logged {
            let advice = monitor.advice().map(|it| it.to_string());
            calls.cycle(self.settings, cycle, (&decided, released), advice);
        }
        if matches!(decided.report, Some(Ok(_))) {
            recorder.see(sensed);
        }
        decided
    }
}

/// SOFOF: what came last in time is used, however old it is by now.
fn unchecked(
    requester: &mut Requester<'_>,
    t_ns: i64,
    Last { tracks, points }: &Last,
    local: Results<'_>,
) -> Decided {
    let session = |group| requester.session_of(group).map(|it| it.session);
    let [mot, plan] = Group::ALL.map(session);
    let used = |of: Option<i64>, by: Option<i64>| of.filter(|_| of == by);
    let sessions = Sessions {
        mot: used(mot, tracks.as_ref().map(|it| it.session)),
        plan: used(plan, points.as_ref().map(|it| it.session)),
    };
    let trajectory = match (plan, sessions.plan) {
        (Some(_), Some(_)) => points.as_ref().map(|it| it.items.clone()),
        (Some(_), None) => None,
        (None, _) => local.trajectory.map(|it| it.points.to_vec()),
    };
    let kind = EventKind::Verdict { safe: true, sessions };
    let tracks = tracks.as_ref().filter(|_| sessions.mot.is_some());
    let tracks = tracks.map(|it| (it.stamp.as_nanoseconds(), it.items.clone()));
    let actions =
        requester.step(&Event { t_ns, kind }).map_or_else(|_| Vec::new(), |it| it.to_vec());
    Decided { is_safe: true, trajectory, tracks, actions, ..Decided::default() }
}

fn keep<T>(
    requester: &mut Requester<'_>,
    t_ns: i64,
    group: Group,
    message: Message<Vec<T>>,
    kept: &mut Option<Message<Vec<T>>>,
) -> Result<Vec<Action>, RequesterError> {
    let Message { station, session, generated, .. } = message;
    let generated_ns = generated.as_nanoseconds();
    let kind = EventKind::Data { station, group, session, generated_ns };
    let actions = requester.step(&Event { t_ns, kind })?.to_vec();
    if !actions.contains(&Action::Drop(group)) {
        *kept = Some(message);
    }
    Ok(actions)
}

fn accept<T>(
    (arrival, actions): (Arrival<Vec<T>>, Actions),
    kept: &mut Option<Accepted<Vec<T>>>,
    copy: Message<Vec<T>>,
    last: &mut Option<Message<Vec<T>>>,
) -> Vec<Action> {
    if let Arrival::Accepted(element) = arrival {
        *kept = Some(element);
        *last = Some(copy);
    }
    actions.to_vec()
}

fn time(ns: i64) -> Time {
    Time::from_nanoseconds(ns)
}
