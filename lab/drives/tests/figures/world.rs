//! Cycles to be drawn: records that say what differs from a CAV on a straight road.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::input::scene::Scene;
use mufasa_model::numbers::vector::Frame;
use mufasa_model::report::{Outcome, Reading, Stage};
use mufasa_records::{Record, parse};
use serde_json::{Value, json};

/// Now in every figure, ns.
pub const NOW_NS: i64 = 1_000_000_000;

/// A cycle; `changes` replaces fields of the record.
pub fn cycle(changes: &Value) -> Cycle {
    let record = json!({
        "kind": "cycle", "id": "figure", "profile": "hardened", "parameters": {}, "now_ns": NOW_NS,
        "configuration": "AllRemote", "ego": ego(10.0),
        "trajectory": null, "tracks": null, "detections": null, "lead": null,
        "route": {"closed": false, "stations": [station(-100.0, 0.0, 1.0, 0.0), station(200.0, 0.0, 1.0, 0.0)]},
        "grid": null, "detection_history": []
    });
    match parse(merged(record, changes).to_string().as_bytes(), 1) {
        Ok(Record::Cycle { cycle, .. }) => *cycle,
        other => panic!("{other:?}"),
    }
}

/// A record with fields of another in the place of its own.
pub fn merged(mut of: Value, with: &Value) -> Value {
    for (name, value) in with.as_object().into_iter().flatten() {
        of[name] = value.clone();
    }
    of
}

/// The frame of the CAV.
pub fn own(scene: &Scene) -> Frame {
    Frame { origin: scene.ego.position.clone(), direction: scene.ego.heading.clone() }
}

/// The same in the exact numbers of the model.
pub fn scene(changes: &Value) -> Scene {
    Scene::new(&cycle(changes), Reading::Exact)
}

/// A CAV at 0 that drives along x.
pub fn ego(speed: f64) -> Value {
    json!({"x": 0, "y": 0, "cos": 1, "sin": 0, "speed": speed, "length": 4.8, "width": 1.9, "center_offset": 1.4})
}

/// A cross section 6 m wide.
pub fn station(x: f64, y: f64, cos: f64, sin: f64) -> Value {
    json!({"x": x, "y": y, "left": [x - 3.0 * sin, y + 3.0 * cos], "right": [x + 3.0 * sin, y - 3.0 * cos]})
}

/// A list of detections, seconds before now; each [x, y, angle, length, width].
pub fn seen(age: f64, items: &[[f64; 5]]) -> Value {
    let item = |[x, y, angle, length, width]: &[f64; 5]| {
        let [cos, sin] = [angle.cos(), angle.sin()];
        json!({"x": x, "y": y, "cos": cos, "sin": sin, "length": length, "width": width})
    };
    json!({"stamp_ns": before(age), "items": items.iter().map(item).collect::<Vec<_>>()})
}

/// A list of tracks, seconds before now; each [x, y, angle, length, width] and velocity, ids from 1.
pub fn tracks(age: f64, items: &[([f64; 5], [f64; 2])]) -> Value {
    let item = |(i, ([x, y, angle, length, width], [vx, vy])): (usize, &([f64; 5], [f64; 2]))| {
        let [cos, sin] = [angle.cos(), angle.sin()];
        json!({"id": i + 1, "x": x, "y": y, "cos": cos, "sin": sin, "vx": vx, "vy": vy,
               "length": length, "width": width})
    };
    json!({"stamp_ns": before(age), "items": items.iter().enumerate().map(item).collect::<Vec<_>>()})
}

/// A trajectory of [x, y, angle], a point each `step_ns`.
pub fn trajectory(step_ns: i64, points: &[[f64; 3]]) -> Value {
    let point = |(t, [x, y, angle]): (i64, &[f64; 3])| {
        let [cos, sin] = [angle.cos(), angle.sin()];
        json!({"t_ns": NOW_NS + t * step_ns, "x": x, "y": y, "cos": cos, "sin": sin})
    };
    let points: Vec<_> = (0..).zip(points).map(point).collect();
    json!({"stamp_ns": NOW_NS, "points": points})
}

fn before(age: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "at most a few seconds")]
    let age_ns = (age * 1e9).round() as i64;
    NOW_NS - age_ns
}

/// What a stage says in the exact model.
pub fn outcome(changes: &Value, stage: Stage) -> Outcome {
    let report = check(&cycle(changes), Reading::Exact).expect("valid local input");
    let at = Stage::ALL.iter().position(|it| *it == stage).expect("one of five");
    report.stages[at].clone()
}
