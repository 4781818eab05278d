//! The refinement check: the implementation does what the model does, step by step.
//!
//! [`Pair::step`] is the one function through which every event of the exploration, of a replayed
//! trace and of a random walk goes.

mod monitor;

pub use self::monitor::Monitors;

use std::fmt;

use crate::bridge;
use mufasa::offloading::requester as twin;
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, Groups, Parameters, Requester,
};

/// Places of the implementation's table: stations that may ever offer something.
pub const PLACES: usize = 8;

/// Stations whose offers are compared at every step, used or not: those of the explored worlds.
const COMPARED: usize = 4;

/// A requester twice, the model's and the implementation's.
#[derive(Clone, Debug)]
pub struct Pair {
    model: Requester,
    implementation: twin::Suspended,
    table: [twin::StationRecord; PLACES],
}

/// Where the two differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// After which event; `None` at the start.
    pub event: Option<Event>,
    /// In what.
    pub what: &'static str,
    /// What the model says.
    pub model: String,
    /// What the implementation says.
    pub implementation: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { event, what, model, implementation } = self;
        match event {
            None => write!(f, "at the start")?,
            Some(event) => write!(f, "after {:?} at {} ns", event.kind, event.t_ns)?,
        }
        write!(f, " the {what} of the model is {model}, of the implementation {implementation}")
    }
}

impl std::error::Error for Difference {}

impl Pair {
    /// Both at their start. Errors: the implementation refuses the parameters.
    pub fn new(profile: Profile, parameters: Parameters) -> Result<Self, Box<Difference>> {
        let mut table = [twin::StationRecord::FREE; PLACES];
        let model = Requester::new(profile, parameters);
        let to_impl = bridge::parameters_to_impl(&parameters);
        let started = twin::Requester::new(bridge::profile_to_impl(profile), to_impl, &mut table);
        let implementation = match started {
            Ok(requester) => requester.suspend(),
            Err(error) => return Err(Box::new(refused(None, &error))),
        };
        let mut pair = Self { model, implementation, table };
        pair.compare(None)?;
        Ok(pair)
    }

    /// Both take the event; the actions of both, in order. Errors: they differ in an action, or
    /// in anything that either remembers afterwards.
    pub fn step(&mut self, event: &Event) -> Result<Vec<Action>, Box<Difference>> {
        let expected = self.model.step(event);
        let mut requester = twin::Requester::resume(self.implementation, &mut self.table);
        let taken = requester.step(&bridge::event_to_impl(event));
        self.implementation = requester.suspend();
        let actions: Vec<Action> = match taken {
            Ok(actions) => actions.iter().copied().map(bridge::action_from_impl).collect(),
            Err(error) => return Err(Box::new(refused(Some(*event), &error))),
        };
        same(Some(*event), "list of actions", &expected, &actions)?;
        self.compare(Some(*event))?;
        Ok(expected)
    }

    /// The model's side.
    pub fn model(&self) -> &Requester {
        &self.model
    }

    /// Whether both sides are in a state that their rules allow.
    pub fn is_valid(&mut self) -> bool {
        self.model.is_valid() && self.implementation().is_valid()
    }

    fn implementation(&mut self) -> twin::Requester<'_> {
        twin::Requester::resume(self.implementation, &mut self.table)
    }

    /// Everything that decides anything later is the same on both sides.
    fn compare(&mut self, event: Option<Event>) -> Result<(), Box<Difference>> {
        let Self { model, implementation, table } = self;
        let twin = twin::Requester::resume(*implementation, table);
        for group in Group::ALL {
            let of = bridge::group_to_impl(group);
            same(event, "state", &model.state(group), &bridge::state_from_impl(twin.state(of)))?;
            let source = bridge::source_from_impl(twin.source(of));
            same(event, "source", &model.source(group), &source)?;
            let session = model.session_of(group).map(|it| {
                let arrivals = (it.last_arrival_ns, it.last_used_generated_ns);
                (it.station, it.number, arrivals, it.local_computes)
            });
            let running = twin.session_of(of).map(|it| {
                let arrivals = (it.last_arrival_ns, it.last_used_ns);
                (it.station, it.session, arrivals, it.local_computes)
            });
            same(event, "running session", &session, &running)?;
        }
        let configuration = bridge::configuration_from_impl(twin.configuration());
        same(event, "configuration", &model.configuration(), &configuration)?;
        same(event, "hold_until_ns", &model.hold_until_ns(), &twin.hold_until_ns())?;
        same(event, "area", &bridge::groups_to_impl(model.in_area()), &twin.area())?;
        let dropped = Group::ALL.into_iter().map(|it| twin.dropped(bridge::group_to_impl(it)));
        same(event, "count of foreign data", &model.foreign_data(), &dropped.sum())?;
        same(event, "last session", &model.last_session(), &twin.sessions())?;
        let known = twin.stations().iter().filter_map(twin::StationRecord::station);
        let named = event.and_then(|event| station(&event.kind));
        for station in (1..).take(COMPARED).chain(known).chain(named) {
            let record = twin.stations().iter().find(|it| it.station() == Some(station));
            let record = record.copied().unwrap_or_default();
            let offered = bridge::groups_to_impl(model.offered(station));
            same(event, "offer", &offered, &record.offer())?;
            for group in Group::ALL {
                let asked = record.last_request(bridge::group_to_impl(group));
                same(event, "last request", &model.last_asked(group, station), &asked)?;
            }
        }
        Ok(())
    }
}

/// The station that an event names.
fn station(kind: &EventKind) -> Option<i64> {
    match *kind {
        EventKind::Offer { station, groups: Groups { .. } }
        | EventKind::Withdraw { station }
        | EventKind::Lost { station }
        | EventKind::Confirm { station, .. }
        | EventKind::Reject { station, .. }
        | EventKind::Data { station, .. } => Some(station),
        EventKind::Area { .. } | EventKind::Tick | EventKind::Verdict { .. } => None,
    }
}

fn same<T: PartialEq + fmt::Debug>(
    event: Option<Event>,
    what: &'static str,
    model: &T,
    implementation: &T,
) -> Result<(), Box<Difference>> {
    if model == implementation {
        return Ok(());
    }
    let (model, implementation) = (format!("{model:?}"), format!("{implementation:?}"));
    Err(Box::new(Difference { event, what, model, implementation }))
}

fn refused(event: Option<Event>, error: &twin::RequesterError) -> Difference {
    let implementation = format!("refused: {error}");
    Difference { event, what: "answer", model: String::from("taken"), implementation }
}
