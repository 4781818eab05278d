//! `mufasa::monitor::Monitor` as a Python object (`spec/monitor.md#monitor`).

use std::sync::Arc;
use std::time::Duration;

use mufasa::input::cycle::{CrossSection, Route, Track, TrajectoryPoint};
use mufasa::monitor::{
    Accepted, Advice, Arrival, DropReason, Message, Monitor as NativeMonitor, Settings, Stall,
    Time as NativeTime,
};
use mufasa::offloading::requester::{Action, Actions as NativeActions, Groups, RequesterError};
use mufasa_model::input::cycle::Profile;
use mufasa_props::bridge;
use mufasa_records::names;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::actions::{Actions, ToDo};
use crate::arguments::{
    CheckTime, GivenBack, MostStations, OneGroup, OneOfGroups, OneProfile, Period, Session,
    SessionsBefore, Station, StepPs,
};
use crate::decision::Decision;
use crate::errors::{ActionsNotTaken, UnreadableInputs, invalid, no_monitor, wrong};
use crate::inputs::{Given, Own};
use crate::items;
use crate::place::Place;
use crate::quantities::Time;
use crate::settings::overridden;
use crate::verified::{Calls, VerifiedTracks, VerifiedTrajectory};

/// No CAV meets more stations; memory of 5 MB.
const MOST_STATIONS: usize = 65_536;

/// The monitor of one CAV (``spec/monitor.md#monitor``): events go in, actions come out; remote data are handed in and
/// are out of reach until ``cycle`` has checked them.
///
/// ``period``: the nominal period of the cycles and of the remote's results. ``parameters``: overrides of single
/// defaults by the names of ``spec/`` (``theta_tr``, ``dt_max_ns``, ...); ``dt_max_ns``, two periods and 20 ms by
/// default, has to be above the period, and ``tau`` is three periods and 0.1 s by default. ``sessions_before``: at
/// least the last session of earlier lives, so that no message of one fits. ``most_stations``: that ever offer
/// something, at most 65,536. ``supervise_local``: whether the CAV's own plan is examined in Local, so that
/// ``Decision.brake`` says while it fails (F-48). ``stall``: the way, m, and the time after which planning that got no
/// farther is given back (F-45); never where it is not given. ``check_time``: how long a cycle may take, any time where
/// it is not given; it has memory for all of the domain. ``step_ps``: what a step costs here (``spec/4-arithmetic.md#steps``). ``meant``: names of
/// parameters that are meant although no road vehicle has such a value (``spec/4-arithmetic.md#usual-settings``).
///
/// Raises ``InvalidInput`` for settings that no monitor can keep. Every call raises ``ActionsNotTaken`` when the one
/// before gave actions that nobody has looked at, and ends what was verified before. An event that raises has changed
/// nothing else. Not to be called by two threads at once.
#[pyclass(module = "mufasa")]
pub struct Monitor {
    place: Place,
    calls: Calls,
    /// The last elements that the requester used: out of reach until a cycle has checked them.
    tracks: Option<Accepted<Vec<Track>>>,
    trajectory: Option<Accepted<Vec<TrajectoryPoint>>>,
    /// Of the last call.
    to_do: Option<Arc<ToDo>>,
    last: NativeTime,
}

#[pymethods]
impl Monitor {
    #[new]
    #[pyo3(signature = (
        period, *, profile = OneProfile(Profile::HARDENED), parameters = None,
        sessions_before = SessionsBefore(0), most_stations = MostStations(64), supervise_local = false,
        stall = None, check_time = None, step_ps = StepPs(1000), meant = Vec::new()
    ), text_signature = "(period, *, profile='hardened', parameters=None, sessions_before=0, most_stations=64, supervise_local=False, stall=None, check_time=None, step_ps=1000, meant=())")]
    fn new(
        period: Period,
        profile: OneProfile,
        parameters: Option<&Bound<'_, PyAny>>,
        sessions_before: SessionsBefore,
        most_stations: MostStations,
        supervise_local: bool,
        stall: Option<GivenBack>,
        check_time: Option<CheckTime>,
        step_ps: StepPs,
        meant: Vec<String>,
    ) -> PyResult<Self> {
        let settings = Settings::new(period.0);
        let mut settings = meant.iter().fold(settings, |it, field| it.meaning(field));
        settings.sessions_before = sessions_before.0;
        settings.supervise_local = supervise_local;
        settings.stall = stall.map(|GivenBack((way_m, time))| Stall { way_m, time });
        settings.check_time = check_time.map_or(Duration::MAX, |it| it.0);
        settings.step_ps = step_ps.0;
        settings.profile = bridge::profile_to_impl(profile.0);
        let settings = match parameters {
            Some(parameters) => overridden(settings, parameters)?,
            None => settings,
        };
        if most_stations.0 > MOST_STATIONS {
            let message = format!("must be at most {MOST_STATIONS}");
            return Err(invalid(wrong("most_stations", message)));
        }
        let place = Place::with(&settings, most_stations.0).map_err(no_monitor)?;
        let (tracks, trajectory, to_do, last) = (None, None, None, NativeTime::from_nanoseconds(0));
        Ok(Self { place, calls: Calls::default(), tracks, trajectory, to_do, last })
    }

    /// The CAV follows this route (``CrossSection``) from now on, of which a copy is kept. It has to lead up to s_stop.
    #[pyo3(signature = (cross_sections, *, closed = false))]
    fn set_route(
        &mut self,
        py: Python<'_>,
        cross_sections: &Bound<'_, PyAny>,
        closed: bool,
    ) -> PyResult<()> {
        self.begin(py)?;
        let cross_sections: Vec<CrossSection> =
            items::list(cross_sections, "route.stations").map_err(invalid)?;
        let route = Route { closed, cross_sections: &cross_sections };
        let set = self.place.with_dependent_mut(|_, monitor| monitor.set_route(&route));
        set.map_err(|problem| invalid(bridge::invalid_input_from_impl(&problem)))
    }

    /// A station, at least 1, offers groups; this replaces its previous offer.
    fn offer(
        &mut self,
        py: Python<'_>,
        now: Time,
        station: Station,
        groups: Vec<OneOfGroups>,
    ) -> PyResult<Py<Actions>> {
        let groups = set(&groups);
        self.event(py, now, |monitor, now| monitor.offer(now, station.0, groups))
    }

    /// A station withdraws its offer.
    fn withdraw(&mut self, py: Python<'_>, now: Time, station: Station) -> PyResult<Py<Actions>> {
        self.event(py, now, |monitor, now| monitor.withdraw(now, station.0))
    }

    /// A station can no longer be reached.
    fn lost(&mut self, py: Python<'_>, now: Time, station: Station) -> PyResult<Py<Actions>> {
        self.event(py, now, |monitor, now| monitor.lost(now, station.0))
    }

    /// A station confirms a session.
    fn confirm(
        &mut self,
        py: Python<'_>,
        now: Time,
        station: Station,
        group: OneGroup,
        session: Session,
    ) -> PyResult<Py<Actions>> {
        let group = bridge::group_to_impl(group.0);
        self.event(py, now, |monitor, now| monitor.confirm(now, station.0, group, session.0))
    }

    /// A station rejects a session.
    fn reject(
        &mut self,
        py: Python<'_>,
        now: Time,
        station: Station,
        group: OneGroup,
        session: Session,
    ) -> PyResult<Py<Actions>> {
        let group = bridge::group_to_impl(group.0);
        self.event(py, now, |monitor, now| monitor.reject(now, station.0, group, session.0))
    }

    /// From now on these groups may be offloaded (CODM).
    fn area(
        &mut self,
        py: Python<'_>,
        now: Time,
        groups: Vec<OneOfGroups>,
    ) -> PyResult<Py<Actions>> {
        let groups = set(&groups);
        self.event(py, now, |monitor, now| Ok(monitor.area(now, groups)))
    }

    /// Time passes: to be called in each period, before its cycle.
    fn tick(&mut self, py: Python<'_>, now: Time) -> PyResult<Py<Actions>> {
        self.event(py, now, |monitor, now| Ok(monitor.tick(now)))
    }

    /// What the calling program seems to get wrong, each told once (``spec/4-arithmetic.md#advice``); else ``None``.
    fn advice(&mut self) -> Option<&'static str> {
        self.place.with_dependent_mut(|_, monitor| monitor.advice()).map(Advice::message)
    }

    /// Tracks (``Track``) of a station arrive; they are copied. Used are those of the running session, in
    /// time, and newer than the last; of others the actions have a ``Drop`` that says why.
    #[pyo3(signature = (now, *, station, session, generated, stamp, items))]
    fn tracks(
        &mut self,
        py: Python<'_>,
        now: Time,
        station: Station,
        session: Session,
        generated: Time,
        stamp: Time,
        items: &Bound<'_, PyAny>,
    ) -> PyResult<Py<Actions>> {
        self.begin(py)?;
        let items = items::list(items, "tracks.items").map_err(invalid)?;
        let (generated, stamp, id) = (generated.time, stamp.time, session.0);
        let message = Message { station: station.0, session: id, generated, stamp, items };
        let arrival = self.place.with_dependent_mut(|_, it| it.tracks(now.time, message));
        let (to_do, why) = take(arrival.map_err(refused)?, &mut self.tracks);
        self.told(py, now.time, &to_do, why)
    }

    /// As ``tracks``, for a trajectory (``TrajectoryPoint``).
    #[pyo3(signature = (now, *, station, session, generated, stamp, points))]
    fn trajectory(
        &mut self,
        py: Python<'_>,
        now: Time,
        station: Station,
        session: Session,
        generated: Time,
        stamp: Time,
        points: &Bound<'_, PyAny>,
    ) -> PyResult<Py<Actions>> {
        self.begin(py)?;
        let items = items::list(points, "trajectory.points").map_err(invalid)?;
        let (generated, stamp, id) = (generated.time, stamp.time, session.0);
        let message = Message { station: station.0, session: id, generated, stamp, items };
        let arrival = self.place.with_dependent_mut(|_, it| it.trajectory(now.time, message));
        let (to_do, why) = take(arrival.map_err(refused)?, &mut self.trajectory);
        self.told(py, now.time, &to_do, why)
    }

    /// Decides on what the CAV measured and what stations sent, and tells the requester: to be called in each
    /// period, offloading or not. What is not given is missing.
    ///
    /// Raises ``UnreadableInputs`` when something is of the wrong kind; the monitor has fallen back then, at
    /// ``now`` (of the wrong kind itself: at the time of the last call), and the error has the actions.
    #[pyo3(signature = (
        now, ego, *, detections = None, lead = None, grid = None, local_tracks = None,
        local_trajectory = None
    ))]
    fn cycle(
        &mut self,
        now: &Bound<'_, PyAny>,
        ego: &Bound<'_, PyAny>,
        detections: Option<&Bound<'_, PyAny>>,
        lead: Option<&Bound<'_, PyAny>>,
        grid: Option<&Bound<'_, PyAny>>,
        local_tracks: Option<&Bound<'_, PyAny>>,
        local_trajectory: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Decision>> {
        let py = now.py();
        self.begin(py)?;
        let given = Given { now, ego, detections, lead, grid, local_tracks, local_trajectory };
        match Own::read(&given) {
            Ok(own) => self.decide(py, &own),
            Err(problem) => {
                let now = now.cast::<Time>().map_or(self.last, |now| now.get().time);
                let unsafe_cycle = self.decide(py, &Own::nowhere(now))?;
                let actions = unsafe_cycle.get().to_do(py).clone().unbind();
                let (field, index, message) = (problem.field, problem.index, problem.message);
                Err(UnreadableInputs::new_err((field, index, message, actions)))
            }
        }
    }

    /// The same data or decision, if they are of this monitor's last call.
    ///
    /// Raises ``OtherMonitor`` or ``Expired``.
    fn own<'py>(&self, verified: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(it) = verified.cast::<VerifiedTrajectory>() {
            it.get().call.is_last_of(&self.calls)?;
        } else if let Ok(it) = verified.cast::<VerifiedTracks>() {
            it.get().call.is_last_of(&self.calls)?;
        } else if let Ok(it) = verified.cast::<Decision>() {
            it.get().call.is_last_of(&self.calls)?;
        } else {
            return Err(PyTypeError::new_err("only what a cycle gave can be verified"));
        }
        Ok(verified.clone())
    }

    /// Which groups are remote.
    #[getter]
    fn configuration(&self) -> &'static str {
        let configuration = self.place.with_dependent(|_, monitor| monitor.configuration());
        names::configuration(bridge::configuration_from_impl(configuration))
    }

    /// The station whose results of a group may reach control; 0 is the CAV.
    fn source(&self, group: OneGroup) -> i64 {
        let group = bridge::group_to_impl(group.0);
        self.place.with_dependent(|_, monitor| monitor.source(group).station())
    }

    /// The running session of a group that is remote.
    fn session_of<'py>(
        &self,
        py: Python<'py>,
        group: OneGroup,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let group = bridge::group_to_impl(group.0);
        let running = self.place.with_dependent(|_, it| it.requester().session_of(group));
        let class = || py.import("mufasa._types")?.getattr("Session");
        running.map(|it| class()?.call1((it.station, it.session))).transpose()
    }

    /// The last session, for ``sessions_before`` of the next life.
    #[getter]
    fn sessions(&self) -> i64 {
        self.place.with_dependent(|_, monitor| monitor.requester().sessions())
    }

    fn __repr__(&self) -> String {
        let (configuration, sessions) = (self.configuration(), self.sessions());
        format!("Monitor(configuration={configuration:?}, sessions={sessions})")
    }

    /// No request is sent before this time; it stays when it has passed.
    #[getter]
    fn hold_until(&self) -> Option<Time> {
        let hold_ns = self.place.with_dependent(|_, it| it.requester().hold_until_ns());
        hold_ns.map(|ns| Time { time: NativeTime::from_nanoseconds(ns) })
    }
}

impl Monitor {
    /// A call begins: what was verified before has expired. Errors: actions of the last one are left.
    fn begin(&mut self, py: Python<'_>) -> PyResult<()> {
        self.calls.begin();
        match &self.to_do {
            Some(to_do) if !to_do.are_taken() => {
                let actions = Py::new(py, Actions::new(Arc::clone(to_do)))?;
                Err(ActionsNotTaken::new_err((actions,)))
            }
            _ => Ok(()),
        }
    }

    fn event(
        &mut self,
        py: Python<'_>,
        now: Time,
        call: impl FnOnce(&mut NativeMonitor<'_>, NativeTime) -> Result<NativeActions, RequesterError>,
    ) -> PyResult<Py<Actions>> {
        self.begin(py)?;
        let to_do = self.place.with_dependent_mut(|_, monitor| call(monitor, now.time));
        self.told(py, now.time, &to_do.map_err(refused)?, None)
    }

    /// What has to be done about a call that was taken, and why an element is of no use.
    fn told(
        &mut self,
        py: Python<'_>,
        now: NativeTime,
        to_do: &[Action],
        why: Option<DropReason>,
    ) -> PyResult<Py<Actions>> {
        self.last = now;
        let to_do = ToDo::new(to_do, why);
        self.to_do = Some(Arc::clone(&to_do));
        Py::new(py, Actions::new(to_do))
    }

    fn decide(&mut self, py: Python<'_>, own: &Own) -> PyResult<Py<Decision>> {
        self.last = own.now();
        let Self { place, calls, tracks, trajectory, to_do, .. } = self;
        let inputs = own.with(tracks.as_ref(), trajectory.as_ref());
        let decision = place.with_dependent_mut(|_, monitor| {
            let (decision, actions) = monitor.cycle(&inputs);
            let actions = ToDo::new(&actions, None);
            *to_do = Some(Arc::clone(&actions));
            Decision::new(py, calls, &decision, actions)
        })?;
        Py::new(py, decision)
    }
}

/// Keeps an element that was accepted; what has to be done, and why one was not.
fn take<L>(
    (arrival, actions): (Arrival<L>, NativeActions),
    last: &mut Option<Accepted<L>>,
) -> (Vec<Action>, Option<DropReason>) {
    let why = match arrival {
        Arrival::Accepted(element) => {
            *last = Some(element);
            None
        }
        Arrival::Dropped { why } => Some(why),
    };
    (actions.to_vec(), why)
}

fn set(groups: &[OneOfGroups]) -> Groups {
    groups.iter().fold(Groups::NONE, |set, group| set.with(bridge::group_to_impl(group.0)))
}

fn refused(error: RequesterError) -> PyErr {
    invalid(wrong("station", error.to_string()))
}
