//! A run as an MCAP log, which Foxglove shows and `mufasa check` reads: the cycles as records, the verdicts, what
//! was to be done, and the scene in Foxglove's own messages.

mod foxglove;

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{WriteOptions, Writer};
use mufasa::input::cycle::{Detection, Track, TrajectoryPoint};
use mufasa::offloading::requester::Action;
use mufasa::services::configuration::Group;
use mufasa_drives::readers::mcap::{CYCLE, JSON};
use mufasa_model::report::{Outcome, Stage};
use mufasa_props::bridge;
use mufasa_records::{cycle_to_line, names};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::Decided;
use mufasa_sim::pose::{Point, Pose, Rectangle};
use mufasa_sim::run::Cycle;
use mufasa_sim::snapshot::{Object, Snapshot};
use mufasa_sim::traffic::agent::Kind;
use serde_json::{Value, json};

use self::foxglove::{Color, Scene};
use crate::ended::said;

/// The channels, in the order of their ids from 0.
const CHANNELS: [Channel; 6] = [
    Channel::Cycle,
    Channel::Verdict,
    Channel::Actions,
    Channel::Ego,
    Channel::Objects,
    Channel::Believed,
];
/// Height of what is drawn, m: the simulation knows none.
const HEIGHT: f64 = 1.5;

const EGO: Color = Color(0.12, 0.44, 0.82, 1.0);
const VEHICLE: Color = Color(0.36, 0.40, 0.44, 1.0);
const PERSON: Color = Color(0.71, 0.33, 0.11, 1.0);
const REMOTE: Color = Color(0.76, 0.09, 0.36, 0.4);
const LOCAL: Color = Color(0.0, 0.51, 0.56, 0.4);
const DETECTION: Color = Color(0.90, 0.49, 0.0, 0.5);
const TRAJECTORY: Color = Color(0.04, 0.43, 0.31, 1.0);
const REJECTED: Color = Color(0.84, 0.16, 0.16, 1.0);

#[derive(Clone, Copy)]
enum Channel {
    Cycle,
    Verdict,
    Actions,
    Ego,
    Objects,
    Believed,
}

impl Channel {
    const fn topic(self) -> &'static str {
        match self {
            Self::Cycle => "/cycle",
            Self::Verdict => "/verdict",
            Self::Actions => "/actions",
            Self::Ego => "/ego",
            Self::Objects => "/objects",
            Self::Believed => "/believed",
        }
    }

    /// Name and text of its schema. That of records is written by `mufasa schemas`; readers of logs, which know
    /// fewer words of JSON Schema, only learn that it is an object.
    fn schema(self) -> (&'static str, Value) {
        let plain = |properties: Value| json!({"type": "object", "properties": properties});
        let text = json!({"type": "string"});
        match self {
            Self::Cycle => (CYCLE, plain(json!({"kind": text, "id": text}))),
            Self::Verdict => {
                let mut properties = json!({
                    "timestamp": foxglove::time_schema(), "verdict": text, "failed_stage": text,
                    "configuration": text, "attacked": {"type": "boolean"},
                    "speed_mps": {"type": "number"}, "nearest_m": {"type": "number"},
                });
                for stage in Stage::ALL {
                    properties[format!("stage_{}", names::stage(stage))] = text.clone();
                }
                ("mufasa.Verdict", plain(properties))
            }
            Self::Actions => {
                let actions = json!({"type": "array", "items": text});
                let timestamp = foxglove::time_schema();
                ("mufasa.Actions", plain(json!({"timestamp": timestamp, "actions": actions})))
            }
            Self::Ego => ("foxglove.PoseInFrame", foxglove::pose_in_frame_schema()),
            Self::Objects | Self::Believed => ("foxglove.SceneUpdate", foxglove::scene_schema()),
        }
    }
}

/// The log of a run while it is made.
pub(super) struct Log {
    name: String,
    writer: Writer<Cursor<Vec<u8>>>,
    ids: [u16; 6],
    count: u32,
    /// The first failure of writing.
    failure: Option<String>,
}

impl Log {
    /// The log of a run of this name, without a message yet. Errors: none that is to be expected.
    pub(super) fn new(name: &str) -> Result<Self, String> {
        let options = WriteOptions::new().compression(None).library("mufasa");
        let mut writer = options.create(Cursor::new(Vec::new())).map_err(said)?;
        let mut ids = [0; 6];
        for (id, channel) in ids.iter_mut().zip(CHANNELS) {
            let (name, schema) = channel.schema();
            let schema = schema.to_string();
            let schema = writer.add_schema(name, "jsonschema", schema.as_bytes()).map_err(said)?;
            let added = writer.add_channel(schema, channel.topic(), JSON, &BTreeMap::new());
            *id = added.map_err(said)?;
        }
        Ok(Self { name: name.to_owned(), writer, ids, count: 0, failure: None })
    }

    /// Adds a cycle; its record where there is one.
    pub(super) fn cycle(
        &mut self,
        truth: &Snapshot,
        cav: &Cav<'_>,
        decided: &Decided,
        cycle: &Cycle,
    ) {
        let at_ns = truth.time_ns;
        if let Some(record) = &decided.record {
            let id = format!("{}#{}", self.name, self.count);
            self.put(Channel::Cycle, at_ns, &cycle_to_line(&id, record));
        }
        self.put(Channel::Verdict, at_ns, &verdict(at_ns, decided, cycle).to_string());
        let actions: Vec<String> = decided.actions.iter().map(words).collect();
        let message = json!({"timestamp": foxglove::time(at_ns), "actions": actions});
        self.put(Channel::Actions, at_ns, &message.to_string());
        let pose = foxglove::pose_in_frame(at_ns, truth.ego.rectangle.pose);
        self.put(Channel::Ego, at_ns, &pose.to_string());
        self.put(Channel::Objects, at_ns, &objects(truth).message(at_ns).to_string());
        self.put(Channel::Believed, at_ns, &believed(cav, cycle).message(at_ns).to_string());
        self.count += 1;
    }

    fn put(&mut self, channel: Channel, at_ns: i64, message: &str) {
        let time = u64::try_from(at_ns).unwrap_or(0);
        let header = MessageHeader {
            channel_id: self.ids[channel as usize],
            sequence: self.count,
            log_time: time,
            publish_time: time,
        };
        let written = self.writer.write_to_known_channel(&header, message.as_bytes());
        if let Err(error) = written {
            self.failure.get_or_insert(error.to_string());
        }
    }

    /// The whole file. Errors: a message could not be added.
    pub(super) fn finish(mut self) -> Result<Vec<u8>, String> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        self.writer.finish().map_err(said)?;
        Ok(self.writer.into_inner().into_inner())
    }
}

fn verdict(at_ns: i64, decided: &Decided, cycle: &Cycle) -> Value {
    let remote = match cycle.remote {
        1 => "MotRemote",
        2 => "PlanRemote",
        3 => "AllRemote",
        _ => "Local",
    };
    let mut message = json!({
        "timestamp": foxglove::time(at_ns), "configuration": remote, "attacked": cycle.attacked,
        "speed_mps": cycle.speed, "failed_stage": "",
    });
    if let Some(nearest) = cycle.nearest {
        message["nearest_m"] = nearest.into();
    }
    message["verdict"] = match &decided.report {
        None => "not checked".into(),
        Some(Err(_)) => "error".into(),
        Some(Ok(_)) => names::verdict(decided.is_safe).into(),
    };
    if let Some(Ok(report)) = &decided.report {
        let report = bridge::report_from_impl(report);
        let failed = report.failed_stage.map(names::failed_stage);
        message["failed_stage"] = failed.unwrap_or_default().into();
        for (stage, outcome) in Stage::ALL.into_iter().zip(&report.stages) {
            message[format!("stage_{}", names::stage(stage))] = outcome_in_words(outcome).into();
        }
    }
    message
}

const fn outcome_in_words(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Passed => "passed",
        Outcome::Failed(_) => "failed",
        Outcome::Skipped(_) => "skipped",
        Outcome::NotApplicable(_) => "not applicable",
        Outcome::NotScheduled => "not scheduled",
    }
}

fn words(action: &Action) -> String {
    let name = |group: &Group| match group {
        Group::Mot => "MOT",
        Group::Plan => "PLAN",
    };
    match action {
        Action::Request { station, group, session } => {
            format!("request {} of station {station}, session {session}", name(group))
        }
        Action::Release { station, group, session } => {
            format!("release {} of station {station}, session {session}", name(group))
        }
        Action::Activate(group) => format!("start {}", name(group)),
        Action::Deactivate(group) => format!("stop {}", name(group)),
        Action::Drop(group) => format!("drop {}", name(group)),
    }
}

/// Everybody, as it is.
fn objects(truth: &Snapshot) -> Scene {
    let mut scene = Scene::new("objects");
    scene.cube(&truth.ego.rectangle, HEIGHT, EGO);
    for Object { id, kind, rectangle, .. } in &truth.objects {
        let color = match kind {
            Kind::Ego | Kind::Car | Kind::Truck => VEHICLE,
            Kind::Pedestrian | Kind::Bicycle => PERSON,
        };
        scene.cube(rectangle, HEIGHT, color);
        scene.text(rectangle.pose, HEIGHT, &id.to_string());
    }
    scene
}

/// What the CAV has of it, what control follows, and what was rejected.
fn believed(cav: &Cav<'_>, cycle: &Cycle) -> Scene {
    let mut scene = Scene::new("believed");
    for detection in cav.sensed().map_or(&[][..], |it| &it.detections) {
        scene.cube(&of_detection(detection), HEIGHT / 2.0, DETECTION);
    }
    if let Some((is_remote, tracks)) = cav.tracks() {
        let color = if is_remote { REMOTE } else { LOCAL };
        tracks.iter().for_each(|track| scene.cube(&of_track(track), HEIGHT, color));
    }
    scene.line(&places(cav.points()), TRAJECTORY);
    if cycle.failed > 0 {
        let (tracks, points) = cav.guard().accepted();
        let tracks = tracks.filter(|_| cycle.remote & 1 != 0).unwrap_or(&[]);
        tracks.iter().for_each(|track| scene.cube(&of_track(track), HEIGHT, REJECTED));
        let points = points.filter(|_| cycle.remote & 2 != 0).unwrap_or(&[]);
        scene.line(&places(points), REJECTED);
    }
    scene
}

fn of_track(track: &Track) -> Rectangle {
    let Track { x, y, cos, sin, length, width, .. } = *track;
    Rectangle { pose: Pose { at: Point::new(x, y), cos, sin }, length, width }
}

fn of_detection(detection: &Detection) -> Rectangle {
    let Detection { x, y, cos, sin, length, width } = *detection;
    Rectangle { pose: Pose { at: Point::new(x, y), cos, sin }, length, width }
}

fn places(points: &[TrajectoryPoint]) -> Vec<[f64; 2]> {
    points.iter().map(|it| [it.x, it.y]).collect()
}
