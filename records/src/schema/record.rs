//! The records of `spec/5-interfaces.md` as types, for their schemas and to write traces and
//! tasks.
#![expect(missing_docs, reason = "fields are documented at the types of `mufasa_model`")]

use std::borrow::Cow;

use mufasa_model::input::parameters::Parameters as StageDefaults;
use mufasa_model::offloading::requester::Parameters as ProtocolDefaults;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;

/// A number, or a word for what JSON cannot write. Read as the nearest double.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(transparent)]
pub struct Number(pub f64);

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, read as the nearest double, or what JSON cannot write.",
            "anyOf": [{"type": "number"}, {"enum": ["nan", "inf", "-inf"]}],
        })
    }
}

/// A signed 64-bit integer, without fraction or exponent.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(transparent)]
pub struct Integer(pub i64);

impl JsonSchema for Integer {
    fn schema_name() -> Cow<'static, str> {
        "Integer".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A signed 64-bit integer; written with a fraction or an exponent it is \
                            an error.",
            "type": "integer",
            "minimum": i64::MIN,
            "maximum": i64::MAX,
        })
    }
}

/// Which rules apply.
#[derive(Clone, Copy, Debug, Default, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    Paper,
    #[default]
    Hardened,
}

#[derive(Clone, Copy, Debug, JsonSchema)]
pub enum Configuration {
    Local,
    MotRemote,
    AllRemote,
    PlanRemote,
}

#[derive(Clone, Copy, Debug, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CycleKind {
    Cycle,
}

/// What the CAV knows when it decides: m, m/s, ns, directions as cos and sin.
#[derive(Clone, Debug, JsonSchema)]
pub struct Cycle {
    pub kind: CycleKind,
    pub id: String,
    #[serde(default)]
    pub profile: Profile,
    #[serde(default)]
    pub parameters: StageParameters,
    pub now_ns: Integer,
    pub configuration: Configuration,
    pub ego: Ego,
    pub trajectory: Option<Trajectory>,
    pub tracks: Option<TrackList>,
    pub detections: Option<DetectionList>,
    pub lead: Option<Lead>,
    pub route: Route,
    pub grid: Option<Grid>,
    pub previous_tracks: Option<TrackList>,
}

/// Overrides of single defaults; the times of the protocol mean nothing for a cycle.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(default)]
pub struct StageParameters {
    pub theta_tr: Number,
    pub theta_map: Number,
    pub theta_obj: Number,
    pub a_b: Number,
    pub safety_time: Number,
    pub max_age_ns: Integer,
    pub n: Integer,
    pub theta_track_max: Number,
    pub miss_budget: Integer,
    pub tau: Number,
    pub a_max: Number,
    pub start_tolerance: Number,
    pub v_max: Number,
    pub step_max_ns: Integer,
    pub theta_velocity: Number,
    pub work_limit: Integer,
    pub delta: Number,
    pub t_wait_ns: Integer,
    pub request_timeout_ns: Integer,
    pub l_max_ns: Integer,
    pub dt_max_ns: Integer,
}

impl Default for StageParameters {
    fn default() -> Self {
        let (stages, protocol) = (StageDefaults::default(), ProtocolDefaults::default());
        Self {
            theta_tr: Number(stages.theta_tr),
            theta_map: Number(stages.theta_map),
            theta_obj: Number(stages.theta_obj),
            a_b: Number(stages.a_b),
            safety_time: Number(stages.safety_time),
            max_age_ns: Integer(stages.max_age_ns),
            n: Integer(stages.n),
            theta_track_max: Number(stages.theta_track_max),
            miss_budget: Integer(stages.miss_budget),
            tau: Number(stages.tau),
            a_max: Number(stages.a_max),
            start_tolerance: Number(stages.start_tolerance),
            v_max: Number(stages.v_max),
            step_max_ns: Integer(stages.step_max_ns),
            theta_velocity: Number(stages.theta_velocity),
            work_limit: Integer(stages.work_limit),
            delta: Number(stages.delta),
            t_wait_ns: Integer(protocol.t_wait_ns),
            request_timeout_ns: Integer(protocol.request_timeout_ns),
            l_max_ns: Integer(protocol.l_max_ns),
            dt_max_ns: Integer(protocol.dt_max_ns),
        }
    }
}

#[derive(Clone, Debug, JsonSchema)]
pub struct Ego {
    pub x: Number,
    pub y: Number,
    pub cos: Number,
    pub sin: Number,
    pub speed: Number,
    pub length: Number,
    pub width: Number,
    pub center_offset: Number,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct Trajectory {
    pub stamp_ns: Integer,
    pub points: Vec<TrajectoryPoint>,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct TrajectoryPoint {
    pub t_ns: Integer,
    pub x: Number,
    pub y: Number,
    pub cos: Number,
    pub sin: Number,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct TrackList {
    pub stamp_ns: Integer,
    pub items: Vec<Track>,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct Track {
    pub id: Integer,
    pub x: Number,
    pub y: Number,
    pub cos: Number,
    pub sin: Number,
    pub vx: Number,
    pub vy: Number,
    pub length: Number,
    pub width: Number,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct DetectionList {
    pub stamp_ns: Integer,
    pub items: Vec<Detection>,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct Detection {
    pub x: Number,
    pub y: Number,
    pub cos: Number,
    pub sin: Number,
    pub length: Number,
    pub width: Number,
}

/// The leading vehicle.
#[derive(Clone, Debug, JsonSchema)]
pub struct Lead {
    pub stamp_ns: Integer,
    pub gap: Number,
    pub speed: Number,
}

#[derive(Clone, Debug, JsonSchema)]
pub struct Route {
    pub closed: bool,
    pub stations: Vec<Station>,
}

/// A reference point with its boundary points.
#[derive(Clone, Debug, JsonSchema)]
pub struct Station {
    pub x: Number,
    pub y: Number,
    pub left: [Number; 2],
    pub right: [Number; 2],
}

/// Bitmaps are RFC 4648 base64 with padding: bit row * width + column, least significant first.
#[derive(Clone, Debug, JsonSchema)]
pub struct Grid {
    pub stamp_ns: Integer,
    pub x: Number,
    pub y: Number,
    pub cos: Number,
    pub sin: Number,
    pub resolution: Number,
    pub width: Integer,
    pub height: Integer,
    pub occupied: String,
    pub unknown: Option<String>,
}

#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum OffloadingKind {
    Offloading,
}

/// What one requester lives through.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Offloading {
    pub kind: OffloadingKind,
    pub id: String,
    #[serde(default)]
    pub profile: Profile,
    #[serde(default)]
    pub parameters: ProtocolParameters,
    pub events: Vec<Event>,
}

/// Overrides of single defaults; times in ns from 0 on.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(default)]
pub struct ProtocolParameters {
    pub t_wait_ns: Integer,
    pub request_timeout_ns: Integer,
    pub l_max_ns: Integer,
    pub dt_max_ns: Integer,
    pub qos_hold: bool,
}

impl From<ProtocolDefaults> for ProtocolParameters {
    fn from(parameters: ProtocolDefaults) -> Self {
        let ProtocolDefaults { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold } =
            parameters;
        Self {
            t_wait_ns: Integer(t_wait_ns),
            request_timeout_ns: Integer(request_timeout_ns),
            l_max_ns: Integer(l_max_ns),
            dt_max_ns: Integer(dt_max_ns),
            qos_hold,
        }
    }
}

impl Default for ProtocolParameters {
    fn default() -> Self {
        ProtocolDefaults::default().into()
    }
}

#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    Mot,
    Plan,
}

#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CycleVerdict {
    Safe,
    Unsafe,
}

/// A station other than the CAV.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(transparent)]
pub struct RemoteStation(pub i64);

impl JsonSchema for RemoteStation {
    fn schema_name() -> Cow<'static, str> {
        "RemoteStation".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A station other than the CAV.",
            "type": "integer",
            "minimum": 1,
            "maximum": i64::MAX,
        })
    }
}

/// What happens at the requester.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Event {
    Offer {
        t_ns: Integer,
        station: RemoteStation,
        groups: Vec<Group>,
    },
    Withdraw {
        t_ns: Integer,
        station: RemoteStation,
    },
    Lost {
        t_ns: Integer,
        station: RemoteStation,
    },
    Area {
        t_ns: Integer,
        groups: Vec<Group>,
    },
    Tick {
        t_ns: Integer,
    },
    Confirm {
        t_ns: Integer,
        station: RemoteStation,
        group: Group,
        session: Integer,
    },
    Reject {
        t_ns: Integer,
        station: RemoteStation,
        group: Group,
        session: Integer,
    },
    Data {
        t_ns: Integer,
        station: RemoteStation,
        group: Group,
        session: Integer,
        generated_ns: Integer,
    },
    Verdict {
        t_ns: Integer,
        verdict: CycleVerdict,
        groups: Vec<Group>,
    },
}

#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CompositionKind {
    Composition,
}

/// What the orchestrator is asked.
#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Composition {
    pub kind: CompositionKind,
    pub id: String,
    pub services: Vec<Service>,
    pub goal: String,
    #[serde(default)]
    pub same_station: Vec<Vec<String>>,
    #[serde(default)]
    pub local_only: Vec<String>,
}

#[derive(Clone, Debug, JsonSchema, Serialize)]
pub struct Service {
    pub id: String,
    pub requires: Vec<String>,
    pub guarantees: Vec<String>,
    pub station: Integer,
}
