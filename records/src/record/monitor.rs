//! The monitor (`spec/5-interfaces.md#monitor`).

use mufasa_model::input::cycle::Route as ModelRoute;
use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::messages as model;
use mufasa_model::monitor::settings;
use mufasa_model::services::configuration::Group;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cycle::{DetectionList, Ego, Grid, Lead, Route, TrackList, Trajectory, hardened};
use super::event::{bounded, events};
use super::offloading::GroupList;
use super::parameters::{All, MonitorParameters};
use super::value::{Integer, Number, Word};
use super::{Recorded, record};

/// What one monitor lives through.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: All,
    /// The nominal period, ns.
    pub period_ns: i64,
    /// Sessions are numbered on from this number.
    pub last_session: i64,
    /// Whether the CAV's own trajectory is examined where everything is local.
    pub supervise_local: bool,
    /// When PLAN is given back.
    pub stall: Option<settings::Stall>,
    /// How much fits.
    pub memory: settings::Memory,
    /// The route.
    pub route: ModelRoute,
    /// Events and cycles in order.
    pub events: Vec<model::Event>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "a word")]
pub enum MonitorKind {
    #[default]
    Monitor,
}

record! {
    /// What one monitor lives through.
    Monitor = Sequence {
        /// Hardened when it is absent.
        #[serde(default = "hardened")]
        profile: Word<Profile>,
        /// Defaults where they are absent.
        #[serde(default)]
        parameters: MonitorParameters,
        /// The nominal period of cycles and results.
        period_ns: Integer,
        /// Sessions are numbered on from this number; 0 when it is absent.
        #[serde(default = "none_yet")]
        last_session: Integer,
        /// Whether the CAV's own trajectory is examined where everything is local; not when it is absent.
        #[serde(default)]
        supervise_local: bool,
        /// When PLAN is given back; null or absent is never.
        stall: Option<Stall>,
        /// How much fits; all that the domain allows when it is absent.
        #[serde(default = "the_domain")]
        memory: Memory,
        /// The route.
        route: Route,
        /// Events and cycles in order.
        #[serde(deserialize_with = "bounded")]
        events: Vec<Event>,
    } + {
        /// The kind of the record.
        kind: MonitorKind,
        /// Names the record in its answer.
        id: String,
    }

    /// A way and a time: PLAN is given back where the CAV gets no farther in this time.
    Stall = settings::Stall {
        /// The way, m.
        way: Number,
        /// The time.
        time_ns: Integer,
    }

    /// Places of the memory that is lent.
    Memory = settings::Memory {
        /// For the tracks of a list.
        tracks: Integer<0>,
        /// For the detections of a list.
        detections: Integer<0>,
        /// For the cross sections of the route.
        cross_sections: Integer<0>,
    }

    /// What the CAV measured, and what its own services gave.
    Measured = model::Measured {
        /// The CAV itself.
        ego: Ego,
        /// The trajectory of its own planner; null or absent is a missing input, here and below.
        trajectory: Option<Trajectory>,
        /// The tracks of its own tracking.
        tracks: Option<TrackList>,
        /// The detections of all local detectors.
        detections: Option<DetectionList>,
        /// The leading vehicle.
        lead: Option<Lead>,
        /// The occupancy grid map.
        grid: Option<Grid>,
    }
}

events! {
    "MonitorEvent": "What happens at the monitor."
    fields {
        station: Integer<1>,
        group: Word<Group>,
        session: Integer,
        generated_ns: Integer,
        groups: GroupList,
        trajectory: Trajectory,
        tracks: TrackList,
        measured: Box<Measured>,
    }
    Offer = "offer" { station: Integer<1>, groups: GroupList }
    Withdraw = "withdraw" { station: Integer<1> }
    Lost = "lost" { station: Integer<1> }
    Area = "area" { groups: GroupList }
    Tick = "tick" {}
    Confirm = "confirm" { station: Integer<1>, group: Word<Group>, session: Integer }
    Reject = "reject" { station: Integer<1>, group: Word<Group>, session: Integer }
    Tracks = "tracks" { station: Integer<1>, session: Integer, generated_ns: Integer, tracks: TrackList }
    Trajectory = "trajectory" { station: Integer<1>, session: Integer, generated_ns: Integer, trajectory: Trajectory }
    Cycle = "cycle" { measured: Box<Measured> }
}

impl Monitor {
    /// The record of a sequence with all its parameters, those at their default too: it stays what it is
    /// when defaults change.
    pub fn whole(id: &str, sequence: &Sequence) -> Self {
        let mut record = Self { id: id.to_owned(), ..Self::of_model(sequence) };
        record.parameters.whole = true;
        record
    }
}

impl Sequence {
    /// What the monitor is started with.
    pub fn settings(&self) -> settings::Settings {
        settings::Settings {
            profile: self.profile,
            parameters: self.parameters.stages(),
            requester: self.parameters.protocol(),
            period_ns: self.period_ns,
            last_session: self.last_session,
            supervise_local: self.supervise_local,
            stall: self.stall,
            memory: self.memory,
        }
    }
}

fn none_yet() -> Integer {
    Integer(0)
}

/// Sizes of `spec/4-arithmetic.md#domain`.
fn the_domain() -> Memory {
    Memory { tracks: Integer(1024), detections: Integer(2048), cross_sections: Integer(8192) }
}
