//! The calls of the CAV's monitor, and what control does, as a log for `mufasa integrate`.

use std::fmt;

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa::monitor::Message;
use mufasa::offloading::requester::{Action, EventKind as Told};
use mufasa_model::input::cycle::{Cycle, TrackList, Trajectory};
use mufasa_model::monitor::messages::{Event, EventKind, Measured};
use mufasa_model::monitor::settings::Memory;
use mufasa_model::services::configuration::Groups;
use mufasa_props::bridge;
use mufasa_records::Sequence;
use mufasa_records::calls::{Call, Follows, Line, Made, Sender};
use mufasa_records::monitor_answer::VerifiedAnswer;
use mufasa_records::offloading_answer::ActionAnswer;
use mufasa_records::record::Recorded;
use mufasa_records::record::monitor::{self, Monitor};
use mufasa_records::record::parameters::All;
use serde_json::{Value, json};

use super::decided::Decided;
use crate::settings::Settings;

/// The lines of a run.
#[derive(Clone, Debug, Default)]
pub struct Calls {
    /// In order.
    pub lines: Vec<Line>,
    follows: Option<Follows>,
}

impl fmt::Display for Calls {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{}", json!(line)))
    }
}

impl Calls {
    /// A call, with its actions and the rest of the answer. The simulator's monitor takes no time.
    pub(super) fn add(
        &mut self,
        (t_ns, kind): (i64, EventKind),
        actions: &[Action],
        decision: &Value,
    ) {
        let action = |it: &Action| ActionAnswer::new(bridge::action_from_impl(*it));
        let actions: Vec<_> = actions.iter().map(action).collect();
        let answer = json!({"actions": actions, "decision": decision});
        let event = monitor::Event::of_model(&Event { t_ns, kind });
        let sender = Sender::handed(&json!(event));
        self.lines.push(Line::Call(Box::new(Call {
            event,
            sender,
            took_ns: 0,
            answer,
            advice: None,
        })));
    }

    /// A cycle, with what came out of it; before the first one, with what the monitor was made.
    pub(super) fn cycle(
        &mut self,
        settings: &Settings,
        cycle: Cycle,
        (decided, released): (&Decided, Option<VerifiedAnswer>),
        advice: Option<String>,
    ) {
        if !matches!(self.lines.first(), Some(Line::Made(_))) {
            self.lines.insert(0, Line::Made(Box::new(made(settings, &cycle))));
        }
        let decision = json!({
            "verdict": if decided.is_safe { "safe" } else { "unsafe" },
            "trajectory": released,
            "brake_by_ns": decided.brake_by_ns,
        });
        let Cycle { now_ns, ego, trajectory, tracks, detections, lead, grid, .. } = cycle;
        let measured = Box::new(Measured { ego, trajectory, tracks, detections, lead, grid });
        self.add((now_ns, EventKind::Cycle { measured }), &decided.actions, &decision);
        if let Some(Line::Call(call)) = self.lines.last_mut() {
            call.advice = Some(advice);
        }
    }

    /// What control does from now on.
    pub(super) fn control(&mut self, t_ns: i64, follows: Follows) {
        if self.follows.replace(follows) != Some(follows) {
            self.lines.push(Line::Control { t_ns, follows });
        }
    }
}

/// An event that is no data; none of data and verdicts.
pub(super) fn told(kind: Told) -> Option<EventKind> {
    let set = |it: mufasa::services::configuration::Groups| Groups { mot: it.mot, plan: it.plan };
    let group = bridge::group_from_impl;
    Some(match kind {
        Told::Offer { station, groups } => EventKind::Offer { station, groups: set(groups) },
        Told::Withdraw { station } => EventKind::Withdraw { station },
        Told::Lost { station } => EventKind::Lost { station },
        Told::Area { groups } => EventKind::Area { groups: set(groups) },
        Told::Tick => EventKind::Tick,
        Told::Confirm { station, group: of, session } => {
            EventKind::Confirm { station, group: group(of), session }
        }
        Told::Reject { station, group: of, session } => {
            EventKind::Reject { station, group: group(of), session }
        }
        Told::Data { .. } | Told::Verdict { .. } => return None,
    })
}

pub(super) fn tracks(it: &Message<Vec<Track>>) -> EventKind {
    let items = it.items.iter().map(bridge::track_from_impl).collect();
    let (stamp_ns, generated_ns) = (it.stamp.as_nanoseconds(), it.generated.as_nanoseconds());
    let tracks = TrackList { stamp_ns, items };
    EventKind::Tracks { station: it.station, session: it.session, generated_ns, tracks }
}

pub(super) fn trajectory(it: &Message<Vec<TrajectoryPoint>>) -> EventKind {
    let points = it.items.iter().map(bridge::point_from_impl).collect();
    let (stamp_ns, generated_ns) = (it.stamp.as_nanoseconds(), it.generated.as_nanoseconds());
    let trajectory = Trajectory { stamp_ns, points };
    EventKind::Trajectory { station: it.station, session: it.session, generated_ns, trajectory }
}

/// What the CAV's monitor was made with, which takes no time in the simulator.
fn made(settings: &Settings, cycle: &Cycle) -> Made {
    let requester = bridge::parameters_from_impl(&settings.requester);
    let sequence = Sequence {
        profile: cycle.profile,
        parameters: All::of(&cycle.parameters, &requester),
        period_ns: settings.period_ns,
        last_session: 0,
        supervise_local: settings.supervise_local.is_some(),
        stall: None,
        memory: Memory { tracks: 1024, detections: 128, cross_sections: 2048 },
        route: cycle.route.clone(),
        events: Vec::new(),
    };
    let record = Monitor::whole("loop", &sequence);
    let check_time_ns = settings.period_ns.unsigned_abs();
    Made { record, check_time_ns, step_ps: 0, meant: u32::MAX, stations: 256 }
}
