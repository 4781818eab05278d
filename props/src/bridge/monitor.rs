//! A monitor of the implementation that takes the events of the model's and answers in its types.

use std::time::Duration;

use mufasa::input::scratch::Row;
use mufasa::monitor as twin;
use mufasa::monitor::{
    Accepted, Arrival, DropReason, Gap, GridMap, Inputs, Message, Time, Verified as TwinVerified,
};
use mufasa::offloading::requester::{Actions, Source};
use mufasa_model::input::cycle::{Grid, Lead, TrackList, Trajectory};
use mufasa_model::monitor::messages::{
    Answer, Brake, Decision, Event, EventKind, Measured, Verified,
};
use mufasa_model::monitor::settings::{Memory, Settings, Stall};
use mufasa_model::offloading::requester::{Event as Told, EventKind as Kind};

use super::cycle::{
    cycle_parameters, detections_to_impl, ego_to_impl, point_to_impl, tracks_to_impl,
};
use super::profile::profile_to_impl;
use super::requester::{action_from_impl, event_to_impl, parameters_to_impl, state_from_impl};
use super::verdict::{
    failed_stage_from_impl, invalid_input_from_impl, report_from_impl, witness_from_impl,
};
use crate::{call, lent::Lent};

/// Stations that ever offer something, at most.
const STATIONS: usize = 8;

/// A monitor with the last elements that it accepted.
#[derive(Debug)]
pub struct Bridged<'a> {
    monitor: twin::Monitor<'a>,
    tracks: Option<Held<mufasa::input::cycle::Track>>,
    trajectory: Option<Held<mufasa::input::cycle::TrajectoryPoint>>,
}

/// The last element of a group that was accepted, of whatever session.
#[derive(Debug)]
struct Held<T> {
    station: i64,
    session: i64,
    token: Accepted<Vec<T>>,
    copy: Vec<T>,
}

/// Settings in the implementation's type; `None`: a time is negative, for which that has no value.
pub fn settings_to_impl(settings: &Settings) -> Option<twin::Settings> {
    let Settings {
        profile,
        parameters,
        requester,
        period_ns,
        last_session,
        supervise_local,
        stall,
        memory: _,
    } = settings;
    let span = |ns: i64| u64::try_from(ns).ok().map(Duration::from_nanos);
    let stall = match *stall {
        None => None,
        Some(Stall { way, time_ns }) => Some(twin::Stall { way_m: way, time: span(time_ns)? }),
    };
    let made = twin::Settings {
        profile: profile_to_impl(*profile),
        stages: cycle_parameters(parameters),
        requester: parameters_to_impl(requester),
        sessions_before: *last_session,
        supervise_local: *supervise_local,
        stall,
        ..twin::Settings::new(span(*period_ns)?)
    };
    // The model takes any time, and its whole domain.
    Some(made.in_any_time().in_any_range())
}

/// The memory of these settings.
pub fn lent(settings: &Settings) -> Lent {
    let Memory { tracks, detections, cross_sections } = settings.memory;
    let count = |places: i64| usize::try_from(places).unwrap_or(0);
    let lent = Lent::new(STATIONS, count(detections), count(cross_sections));
    Lent { rows: vec![Row::default(); count(tracks)], ..lent }
}

impl<'a> Bridged<'a> {
    /// Around a monitor that nothing was told of yet.
    pub const fn new(monitor: twin::Monitor<'a>) -> Self {
        Self { monitor, tracks: None, trajectory: None }
    }

    /// Takes one event, or decides one cycle. The answer names no drop reason; that of the implementation is
    /// beside it.
    ///
    /// # Panics
    /// With a station below 1, or more of them than there are places for.
    pub fn step(&mut self, event: &Event) -> (Answer, Option<DropReason>) {
        let now = Time::from_nanoseconds(event.t_ns);
        let (mut decision, mut dropped) = (None, None);
        let actions = match &event.kind {
            EventKind::Tracks { station, session, generated_ns, tracks } => {
                let message = message(*station, *session, *generated_ns, tracks_to_impl(tracks));
                let copy = message.items.clone();
                let (arrival, actions) = self.monitor.tracks(now, message).expect("a station");
                self.tracks = held(arrival, &mut dropped, (*station, *session), copy)
                    .or_else(|| self.tracks.take());
                actions
            }
            EventKind::Trajectory { station, session, generated_ns, trajectory } => {
                let Trajectory { stamp_ns, points } = trajectory;
                let list = (*stamp_ns, points.iter().map(point_to_impl).collect());
                let message = message(*station, *session, *generated_ns, list);
                let copy = message.items.clone();
                let (arrival, actions) = self.monitor.trajectory(now, message).expect("a station");
                self.trajectory = held(arrival, &mut dropped, (*station, *session), copy)
                    .or_else(|| self.trajectory.take());
                actions
            }
            EventKind::Cycle { measured } => {
                let (decided, actions) = self.cycle(now, measured);
                decision = Some(decided);
                actions
            }
            kind => {
                let kind = told(kind).expect("the others have contents");
                let kind = event_to_impl(&Told { t_ns: event.t_ns, kind }).kind;
                let actions = call::event(&mut self.monitor, now, kind).expect("no data");
                actions.expect("a station with a place")
            }
        };
        let requester = self.monitor.requester();
        let state = |group| state_from_impl(requester.state(group));
        let answer = Answer {
            mot: state(mufasa::services::configuration::Group::Mot),
            plan: state(mufasa::services::configuration::Group::Plan),
            hold_until_ns: requester.hold_until_ns(),
            actions: actions.iter().copied().map(action_from_impl).collect(),
            dropped: None,
            given_back_ns: self.monitor.given_back().map(Time::as_nanoseconds),
            decision,
        };
        (answer, dropped)
    }

    /// The next advice that nobody was told.
    pub fn advice(&mut self) -> Option<twin::Advice> {
        self.monitor.advice()
    }

    /// With the last elements that were accepted, of whatever session.
    fn cycle(&mut self, now: Time, measured: &Measured) -> (Decision, Actions) {
        let Measured { ego, trajectory, tracks, detections, lead, grid } = measured;
        let points = trajectory.as_ref().map(|Trajectory { stamp_ns, points }| {
            (*stamp_ns, points.iter().map(point_to_impl).collect::<Vec<_>>())
        });
        let tracks: Option<(i64, Vec<_>)> =
            tracks.as_ref().map(|list: &TrackList| tracks_to_impl(list));
        let detections = detections.as_ref().map(detections_to_impl);
        let mut inputs = Inputs::new(now, ego_to_impl(ego));
        if let Some((stamp_ns, items)) = &detections {
            inputs = inputs.detections(Time::from_nanoseconds(*stamp_ns), items);
        }
        if let Some((stamp_ns, items)) = &tracks {
            inputs = inputs.local_tracks(Time::from_nanoseconds(*stamp_ns), items);
        }
        if let Some((stamp_ns, items)) = &points {
            inputs = inputs.local_trajectory(Time::from_nanoseconds(*stamp_ns), items);
        }
        if let Some(Lead { stamp_ns, gap, speed }) = *lead {
            let stamp = Time::from_nanoseconds(stamp_ns);
            inputs = inputs.lead(stamp, Gap::between_bumpers(gap), speed);
        }
        if let Some(grid) = grid {
            let Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown } =
                grid;
            let map = GridMap {
                x: *x,
                y: *y,
                cos: *cos,
                sin: *sin,
                resolution: *resolution,
                width: *width,
                height: *height,
                occupied,
                unknown: unknown.as_deref(),
            };
            inputs = inputs.grid(Time::from_nanoseconds(*stamp_ns), map);
        }
        if let Some(held) = &self.tracks {
            inputs = inputs.remote_tracks(&held.token);
        }
        if let Some(held) = &self.trajectory {
            inputs = inputs.remote_trajectory(&held.token);
        }
        let (decision, actions) = self.monitor.cycle(&inputs);
        let decision = match decision {
            twin::Decision::Safe { tracks, trajectory, report, brake } => Decision {
                report: Ok(report_from_impl(&report)),
                tracks: tracks.map(|it| out(&it, it.stamp_ns, it.items, self.tracks.as_ref())),
                brake_by_ns: trajectory.and_then(|it| it.brake_by()).map(Time::as_nanoseconds),
                trajectory: trajectory
                    .map(|it| out(&it, it.stamp_ns, it.points, self.trajectory.as_ref())),
                brake: brake.map(brake_from_impl),
            },
            twin::Decision::Unsafe { report, brake } => Decision {
                report: match report {
                    Ok(report) => Ok(report_from_impl(&report)),
                    Err(problem) => Err(invalid_input_from_impl(&problem)),
                },
                tracks: None,
                trajectory: None,
                brake_by_ns: None,
                brake: brake.map(brake_from_impl),
            },
        };
        (decision, actions)
    }
}

/// What came out, which is what was accepted last if it is remote.
fn out<V, T: PartialEq + std::fmt::Debug>(
    verified: &TwinVerified<'_, V>,
    stamp_ns: i64,
    items: &[T],
    held: Option<&Held<T>>,
) -> Verified {
    let remote = match verified.source() {
        Source::Local => None,
        Source::Remote { station } => {
            let held = held.expect("it came out of nothing");
            assert_eq!((station, items), (held.station, &*held.copy));
            Some((held.station, held.session))
        }
    };
    Verified { stamp_ns, remote }
}

fn message<T>(
    station: i64,
    session: i64,
    generated_ns: i64,
    (stamp_ns, items): (i64, Vec<T>),
) -> Message<Vec<T>> {
    let [generated, stamp] = [generated_ns, stamp_ns].map(Time::from_nanoseconds);
    Message { station, session, generated, stamp, items }
}

fn held<T>(
    arrival: Arrival<Vec<T>>,
    dropped: &mut Option<DropReason>,
    (station, session): (i64, i64),
    copy: Vec<T>,
) -> Option<Held<T>> {
    match arrival {
        Arrival::Accepted(token) => Some(Held { station, session, token, copy }),
        Arrival::Dropped { why } => {
            *dropped = Some(why);
            None
        }
    }
}

/// An event that the requester knows; none of data and cycles, whose contents it does not.
fn told(kind: &EventKind) -> Option<Kind> {
    Some(match *kind {
        EventKind::Offer { station, groups } => Kind::Offer { station, groups },
        EventKind::Withdraw { station } => Kind::Withdraw { station },
        EventKind::Lost { station } => Kind::Lost { station },
        EventKind::Area { groups } => Kind::Area { groups },
        EventKind::Tick => Kind::Tick,
        EventKind::Confirm { station, group, session } => Kind::Confirm { station, group, session },
        EventKind::Reject { station, group, session } => Kind::Reject { station, group, session },
        EventKind::Tracks { .. } | EventKind::Trajectory { .. } | EventKind::Cycle { .. } => {
            return None;
        }
    })
}

/// The same reason.
pub fn brake_from_impl(brake: twin::Brake) -> Brake {
    match brake {
        twin::Brake::NoPlan => Brake::NoTrajectory,
        twin::Brake::Fails { stage, witness } => {
            Brake::Failed(failed_stage_from_impl(stage), witness.map(witness_from_impl))
        }
        twin::Brake::Invalid(problem) => Brake::Invalid(invalid_input_from_impl(&problem)),
    }
}
