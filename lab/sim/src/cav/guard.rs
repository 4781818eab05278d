//! What stands between the link and control: SOFOF's quality of service alone, or the monitor.

use mufasa::input::cycle::{Ego, Route, Track, TrajectoryPoint};
use mufasa::input::profile::Profile;
use mufasa::monitor::{
    Accepted, Arrival, Decision, Gap, GridMap, Inputs, Message, Monitor, MonitorError, Settings,
    Time,
};
use mufasa::offloading::requester::{
    Action, Actions, Event, EventKind, GroupState, Requester, RequesterError, Sessions,
    StationRecord,
};
use mufasa::report::InvalidInput;
use mufasa::services::configuration::{Configuration, Group};
use mufasa_props::call;

use super::assembled::{Chosen, Last, Stamped};
pub use super::decided::{Decided, Local};
use super::recorder::Recorder;
use super::sensing::Sensed;
use super::withheld::Withheld;
use crate::named::named;

named! {
    /// What is checked of remote data.
    Variant {
        /// Quality of service alone: latency and inter-arrival time.
        Sofof = "sofof",
        /// And the five stages, as the paper has them.
        Paper = "paper",
        /// And the five stages with the hardened rules.
        Hardened = "hardened",
    }
}

impl Variant {
    /// By which its stages check, if it has any.
    pub const fn profile(self) -> Option<Profile> {
        match self {
            Self::Sofof => None,
            Self::Paper => Some(Profile::PAPER),
            Self::Hardened => Some(Profile::HARDENED),
        }
    }
}

/// One of the variants.
#[derive(Debug)]
pub struct Guard<'a> {
    kind: Kind<'a>,
    /// A copy of what was accepted: the monitor lets nobody look at it.
    last: Last,
    recorder: Recorder,
    withheld: Option<Withheld>,
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

impl<'a> Guard<'a> {
    /// Nothing offered, everything local. The variant says which profile.
    ///
    /// Errors: settings that no monitor can keep.
    pub fn new(
        profile: Option<Profile>,
        settings: Settings,
        table: &'a mut [StationRecord],
        memory: mufasa::monitor::Memory<'a>,
    ) -> Result<Self, MonitorError> {
        let Some(profile) = profile else {
            let requester = Requester::new(Profile::PAPER, settings.requester, table)
                .map_err(MonitorError::Requester)?;
            return Ok(Self::of(Kind::Plain(requester)));
        };
        let monitor = Monitor::new(Settings { profile, ..settings }, memory)?;
        Ok(Self::of(Kind::Checked { monitor, tracks: None, points: None }))
    }

    fn of(kind: Kind<'a>) -> Self {
        Self { kind, last: Last::default(), recorder: Recorder::default(), withheld: None }
    }

    /// The same; of what the monitor decides this is recorded.
    pub fn recording(mut self, recorder: Recorder) -> Self {
        self.recorder = recorder;
        self
    }

    /// The same, after [`Self::recording`]; the stages do not get this.
    pub fn withholding(mut self, withheld: Option<Withheld>) -> Self {
        self.withheld = withheld;
        self.recorder.withhold(withheld);
        self
    }

    /// The stretch of the route that is followed from now on.
    ///
    /// Errors: a route that the monitor cannot keep.
    pub fn set_route(&mut self, route: &Route<'_>) -> Result<(), InvalidInput> {
        self.recorder.set_route(route);
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

    /// The requester, to look at.
    pub fn requester(&self) -> &Requester<'a> {
        match &self.kind {
            Kind::Plain(requester) => requester,
            Kind::Checked { monitor, .. } => monitor.requester(),
        }
    }

    /// The tracks of a station that the next cycle will have.
    pub(super) fn remote_tracks(&self) -> Option<Stamped<'_, Track>> {
        let none = Local { tracks: None, points: None };
        Chosen::new(self.requester(), &self.last, none).tracks
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
                actions
            }
        };
        actions.map(|actions| actions.to_vec())
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
                Ok(accept(monitor.tracks(time(t_ns), message)?, tracks, copy, last))
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
                Ok(accept(monitor.trajectory(time(t_ns), message)?, points, copy, last))
            }
        }
    }

    /// Decides a cycle.
    pub fn decide(&mut self, t_ns: i64, ego: Ego, sensed: &Sensed, local: Local<'_>) -> Decided {
        let (last, recorder, withheld) = (&self.last, &mut self.recorder, self.withheld);
        match &mut self.kind {
            Kind::Plain(requester) => unchecked(requester, t_ns, last, local),
            Kind::Checked { monitor, tracks, points } => {
                let chosen = Chosen::new(monitor.requester(), last, local);
                let record = recorder.cycle(monitor.requester(), (t_ns, ego), sensed, chosen);
                let inputs = inputs(t_ns, ego, (sensed, withheld), local);
                let configuration = monitor.requester().configuration();
                let is_list = chosen.tracks.is_none_or(|(_, items)| {
                    withheld.is_none_or(|it| !it.is_no_list(configuration, items.len()))
                });
                let inputs = tracks.iter().filter(|_| is_list).fold(inputs, Inputs::remote_tracks);
                let inputs = points.iter().fold(inputs, Inputs::remote_trajectory);
                let (decision, actions) = monitor.cycle(&inputs);
                let decided = match decision {
                    Decision::Safe { tracks, trajectory, report, brake } => Decided {
                        is_safe: true,
                        report: Some(Ok(report)),
                        brake_by_ns: trajectory
                            .and_then(|it| it.brake_by())
                            .map(Time::as_nanoseconds),
                        brake,
                        trajectory: trajectory.map(|it| it.points.to_vec()),
                        tracks: tracks.map(|it| (it.stamp_ns, it.items.to_vec())),
                        actions: actions.to_vec(),
                        record,
                    },
                    Decision::Unsafe { report, brake } => Decided {
                        is_safe: false,
                        report: Some(report),
                        trajectory: None,
                        brake_by_ns: None,
                        brake,
                        tracks: None,
                        actions: actions.to_vec(),
                        record,
                    },
                };
                if matches!(decided.report, Some(Ok(_))) {
                    recorder.see(sensed);
                }
                decided
            }
        }
    }
}

/// SOFOF: what came last in time is used, however old it is by now.
fn unchecked(
    requester: &mut Requester<'_>,
    t_ns: i64,
    Last { tracks, points }: &Last,
    local: Local<'_>,
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
        (None, _) => local.points.map(|(_, points)| points.to_vec()),
    };
    let kind = EventKind::Verdict { safe: true, sessions };
    let tracks = tracks.as_ref().filter(|_| sessions.mot.is_some());
    let tracks = tracks.map(|it| (it.stamp.as_nanoseconds(), it.items.clone()));
    let actions =
        requester.step(&Event { t_ns, kind }).map_or_else(|_| Vec::new(), |it| it.to_vec());
    Decided {
        is_safe: true,
        report: None,
        trajectory,
        brake_by_ns: None,
        brake: None,
        tracks,
        actions,
        record: None,
    }
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

fn inputs<'c>(
    t_ns: i64,
    ego: Ego,
    (sensed, withheld): (&'c Sensed, Option<Withheld>),
    local: Local<'c>,
) -> Inputs<'c> {
    let stamp = time(sensed.stamp_ns);
    let grid = sensed.grid.borrow(true);
    let map = GridMap {
        x: grid.x,
        y: grid.y,
        cos: grid.cos,
        sin: grid.sin,
        resolution: grid.resolution,
        width: grid.width,
        height: grid.height,
        occupied: grid.occupied,
        unknown: grid.unknown,
    };
    let mut inputs = Inputs::new(time(t_ns), ego);
    if withheld != Some(Withheld::Detections) {
        inputs = inputs.detections(stamp, &sensed.detections);
    }
    if withheld != Some(Withheld::Grid) {
        inputs = inputs.grid(stamp, map);
    }
    if let Some(lead) = sensed.lead {
        inputs = inputs.lead(stamp, Gap::between_bumpers(lead.gap), lead.speed);
    }
    if let Some((stamp_ns, tracks)) = local.tracks {
        inputs = inputs.local_tracks(time(stamp_ns), tracks);
    }
    if let Some((stamp_ns, points)) = local.points {
        inputs = inputs.local_trajectory(time(stamp_ns), points);
    }
    inputs
}

fn time(ns: i64) -> Time {
    Time::from_nanoseconds(ns)
}
