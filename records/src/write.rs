//! A cycle back to its record (`spec/5-interfaces.md#cycle`).

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Grid, Lead, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;

use crate::names;

/// The record of a cycle on one line, without the newline. Doubles are shortest decimals that
/// read back to themselves, or `"nan"`, `"inf"`, `"-inf"`; parameters at their default are left
/// out. Reading the line gives the same cycle again, bit for bit except for the payload of NaN.
pub fn cycle_to_line(id: &str, cycle: &Cycle) -> String {
    let mut record = Object::new();
    record.put("kind", "\"cycle\"");
    record.put("id", &string(id));
    record.put("profile", &string(names::profile(cycle.profile)));
    record.put("parameters", &parameters(&cycle.parameters));
    record.integer("now_ns", cycle.now_ns);
    record.put("configuration", &string(names::configuration(cycle.configuration)));
    let ego = &cycle.ego;
    record.put(
        "ego",
        &floats(&[
            ("x", ego.x),
            ("y", ego.y),
            ("cos", ego.cos),
            ("sin", ego.sin),
            ("speed", ego.speed),
            ("length", ego.length),
            ("width", ego.width),
            ("center_offset", ego.center_offset),
        ])
        .close(),
    );
    record.nullable("trajectory", cycle.trajectory.as_ref(), trajectory);
    record.nullable("tracks", cycle.tracks.as_ref(), tracks);
    record.nullable("detections", cycle.detections.as_ref(), detections);
    record.nullable("lead", cycle.lead.as_ref(), lead);
    let mut route = Object::new();
    route.put("closed", if cycle.route.closed { "true" } else { "false" });
    route.put("stations", &list(&cycle.route.cross_sections, station));
    record.put("route", &route.close());
    record.nullable("grid", cycle.grid.as_ref(), grid);
    record.nullable("previous_tracks", cycle.previous_tracks.as_ref(), tracks);
    record.close()
}

/// An object under construction.
struct Object(String);

impl Object {
    fn new() -> Self {
        Self(String::from("{"))
    }

    /// `json` is the value as JSON text.
    fn put(&mut self, key: &str, json: &str) {
        if self.0.len() > 1 {
            self.0.push_str(", ");
        }
        // Writing to a string cannot fail.
        let _ = write!(self.0, "\"{key}\": {json}");
    }

    fn integer(&mut self, key: &str, value: i64) {
        self.put(key, &value.to_string());
    }

    fn floats(&mut self, fields: &[(&str, f64)]) {
        for (key, value) in fields {
            self.put(key, &float(*value));
        }
    }

    fn nullable<T>(&mut self, key: &str, value: Option<&T>, json: impl Fn(&T) -> String) {
        self.put(key, &value.map_or(String::from("null"), json));
    }

    fn close(mut self) -> String {
        self.0.push('}');
        self.0
    }
}

fn parameters(parameters: &Parameters) -> String {
    let default = Parameters::default();
    let mut object = Object::new();
    for ((key, value), (_, usual)) in
        float_parameters(parameters).into_iter().zip(float_parameters(&default))
    {
        if value.to_bits() != usual.to_bits() {
            object.put(key, &float(value));
        }
    }
    for ((key, value), (_, usual)) in
        integer_parameters(parameters).into_iter().zip(integer_parameters(&default))
    {
        if value != usual {
            object.integer(key, value);
        }
    }
    object.close()
}

fn float_parameters(parameters: &Parameters) -> [(&'static str, f64); 12] {
    [
        ("theta_tr", parameters.theta_tr),
        ("theta_map", parameters.theta_map),
        ("theta_obj", parameters.theta_obj),
        ("a_b", parameters.a_b),
        ("safety_time", parameters.safety_time),
        ("theta_track_max", parameters.theta_track_max),
        ("tau", parameters.tau),
        ("a_max", parameters.a_max),
        ("start_tolerance", parameters.start_tolerance),
        ("v_max", parameters.v_max),
        ("theta_velocity", parameters.theta_velocity),
        ("delta", parameters.delta),
    ]
}

fn integer_parameters(parameters: &Parameters) -> [(&'static str, i64); 5] {
    [
        ("max_age_ns", parameters.max_age_ns),
        ("n", parameters.n),
        ("miss_budget", parameters.miss_budget),
        ("step_max_ns", parameters.step_max_ns),
        ("work_limit", parameters.work_limit),
    ]
}

fn trajectory(trajectory: &Trajectory) -> String {
    stamped(trajectory.stamp_ns, "points", &trajectory.points, point)
}

fn point(point: &TrajectoryPoint) -> String {
    let mut object = Object::new();
    object.integer("t_ns", point.t_ns);
    object.floats(&[("x", point.x), ("y", point.y), ("cos", point.cos), ("sin", point.sin)]);
    object.close()
}

fn tracks(list: &TrackList) -> String {
    stamped(list.stamp_ns, "items", &list.items, track)
}

fn track(track: &Track) -> String {
    let mut object = Object::new();
    object.integer("id", track.id);
    object.floats(&[
        ("x", track.x),
        ("y", track.y),
        ("cos", track.cos),
        ("sin", track.sin),
        ("vx", track.vx),
        ("vy", track.vy),
        ("length", track.length),
        ("width", track.width),
    ]);
    object.close()
}

fn detections(list: &DetectionList) -> String {
    stamped(list.stamp_ns, "items", &list.items, detection)
}

fn detection(detection: &Detection) -> String {
    floats(&[
        ("x", detection.x),
        ("y", detection.y),
        ("cos", detection.cos),
        ("sin", detection.sin),
        ("length", detection.length),
        ("width", detection.width),
    ])
    .close()
}

fn lead(lead: &Lead) -> String {
    let mut object = Object::new();
    object.integer("stamp_ns", lead.stamp_ns);
    object.floats(&[("gap", lead.gap), ("speed", lead.speed)]);
    object.close()
}

fn station(station: &CrossSection) -> String {
    let mut object = floats(&[("x", station.x), ("y", station.y)]);
    object.put("left", &list(&station.left, |number| float(*number)));
    object.put("right", &list(&station.right, |number| float(*number)));
    object.close()
}

fn grid(grid: &Grid) -> String {
    let mut object = Object::new();
    object.integer("stamp_ns", grid.stamp_ns);
    object.floats(&[
        ("x", grid.x),
        ("y", grid.y),
        ("cos", grid.cos),
        ("sin", grid.sin),
        ("resolution", grid.resolution),
    ]);
    object.integer("width", grid.width);
    object.integer("height", grid.height);
    object.put("occupied", &bitmap(&grid.occupied));
    object.nullable("unknown", grid.unknown.as_ref(), |bytes| bitmap(bytes));
    object.close()
}

fn bitmap(bytes: &[u8]) -> String {
    format!("\"{}\"", STANDARD.encode(bytes))
}

fn stamped<T>(stamp_ns: i64, key: &str, items: &[T], item: impl Fn(&T) -> String) -> String {
    let mut object = Object::new();
    object.integer("stamp_ns", stamp_ns);
    object.put(key, &list(items, item));
    object.close()
}

fn list<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(item).collect::<Vec<_>>().join(", "))
}

fn floats(fields: &[(&str, f64)]) -> Object {
    let mut object = Object::new();
    object.floats(fields);
    object
}

fn float(value: f64) -> String {
    if value.is_nan() {
        return String::from("\"nan\"");
    }
    if value.is_infinite() {
        return String::from(if value > 0.0 { "\"inf\"" } else { "\"-inf\"" });
    }
    // `Debug` changes to exponents where `Display` would write hundreds of digits.
    let shortest = format!("{value:?}");
    shortest.strip_suffix(".0").map_or(shortest.clone(), String::from)
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
