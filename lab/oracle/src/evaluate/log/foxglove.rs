//! Messages by the names and fields that Foxglove knows (`foxglove.PoseInFrame`, `foxglove.SceneUpdate`), and
//! their schemas, without references: its reader follows none.

use mufasa_sim::pose::{Pose, Rectangle};
use serde_json::{Value, json};

/// The only frame.
const FRAME: &str = "town";
/// Width of a line, m, and size of letters, m.
const LINE: f64 = 0.25;
const LETTERS: f64 = 1.0;
/// A line through its points: `LINE_STRIP`.
const STRIP: u8 = 0;
/// The kinds of primitives of an entity.
const PRIMITIVES: [&str; 8] =
    ["arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"];

/// Red, green, blue and opacity, 0 to 1.
#[derive(Clone, Copy)]
pub(super) struct Color(pub f64, pub f64, pub f64, pub f64);

impl Color {
    fn message(self) -> Value {
        let Self(r, g, b, a) = self;
        json!({"r": r, "g": g, "b": b, "a": a})
    }
}

/// One entity, which takes the place of the one before it.
pub(super) struct Scene {
    id: &'static str,
    cubes: Vec<Value>,
    lines: Vec<Value>,
    texts: Vec<Value>,
}

impl Scene {
    pub(super) const fn new(id: &'static str) -> Self {
        Self { id, cubes: Vec::new(), lines: Vec::new(), texts: Vec::new() }
    }

    /// A box on the road. What cannot be drawn is left out.
    pub(super) fn cube(&mut self, rectangle: &Rectangle, height: f64, color: Color) {
        let &Rectangle { pose, length, width } = rectangle;
        let all = [pose.at.x, pose.at.y, pose.cos, pose.sin, length, width];
        if all.iter().all(|it| it.is_finite()) {
            self.cubes.push(json!({
                "pose": pose_at(pose, height / 2.0), "size": vector(length, width, height),
                "color": color.message(),
            }));
        }
    }

    /// A line on the road; points that are no numbers are left out.
    pub(super) fn line(&mut self, points: &[[f64; 2]], color: Color) {
        let finite = points.iter().filter(|[x, y]| x.is_finite() && y.is_finite());
        let points: Vec<Value> = finite.map(|[x, y]| vector(*x, *y, 0.1)).collect();
        if points.len() > 1 {
            self.lines.push(json!({
                "type": STRIP, "pose": pose_at(NOWHERE, 0.0), "thickness": LINE,
                "scale_invariant": false, "points": points, "color": color.message(),
                "colors": [], "indices": [],
            }));
        }
    }

    /// Words over a place.
    pub(super) fn text(&mut self, pose: Pose, above: f64, text: &str) {
        self.texts.push(json!({
            "pose": pose_at(pose, above + LETTERS), "billboard": true, "font_size": LETTERS,
            "scale_invariant": false, "color": Color(0.1, 0.1, 0.1, 1.0).message(), "text": text,
        }));
    }

    /// As `foxglove.SceneUpdate`.
    pub(super) fn message(self, at_ns: i64) -> Value {
        let Self { id, cubes, lines, texts } = self;
        let mut entity = json!({
            "timestamp": time(at_ns), "frame_id": FRAME, "id": id, "lifetime": {"sec": 0, "nsec": 0},
            "frame_locked": false, "metadata": [],
        });
        for kind in PRIMITIVES {
            entity[kind] = json!([]);
        }
        entity["cubes"] = cubes.into();
        entity["lines"] = lines.into();
        entity["texts"] = texts.into();
        json!({"deletions": [], "entities": [entity]})
    }
}

/// Where a frame is in itself.
const NOWHERE: Pose = Pose { at: mufasa_sim::pose::Point { x: 0.0, y: 0.0 }, cos: 1.0, sin: 0.0 };

/// A time, ns, from 0 on.
pub(super) fn time(at_ns: i64) -> Value {
    json!({"sec": at_ns.div_euclid(1_000_000_000), "nsec": at_ns.rem_euclid(1_000_000_000)})
}

/// As `foxglove.PoseInFrame`.
pub(super) fn pose_in_frame(at_ns: i64, pose: Pose) -> Value {
    json!({"timestamp": time(at_ns), "frame_id": FRAME, "pose": pose_at(pose, 0.0)})
}

/// On the road, turned about the upright axis: half of the angle, as a quaternion has it.
fn pose_at(pose: Pose, z: f64) -> Value {
    let half = |share: f64| (f64::midpoint(1.0, share)).max(0.0).sqrt();
    let turn = half(-pose.cos).copysign(pose.sin);
    json!({
        "position": vector(pose.at.x, pose.at.y, z),
        "orientation": {"x": 0.0, "y": 0.0, "z": turn, "w": half(pose.cos)},
    })
}

fn vector(x: f64, y: f64, z: f64) -> Value {
    json!({"x": x, "y": y, "z": z})
}

/// Its title says to Foxglove what it is.
pub(super) fn time_schema() -> Value {
    let properties = json!({
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999_999_999},
    });
    json!({"type": "object", "title": "time", "properties": properties})
}

pub(super) fn pose_in_frame_schema() -> Value {
    let properties = json!({
        "timestamp": time_schema(), "frame_id": {"type": "string"}, "pose": pose_schema(),
    });
    titled("foxglove.PoseInFrame", &properties)
}

pub(super) fn scene_schema() -> Value {
    let [text, flag, number] = ["string", "boolean", "number"].map(|it| json!({"type": it}));
    let list = |items: &Value| json!({"type": "array", "items": items});
    let color = titled("foxglove.Color", &numbers(&["r", "g", "b", "a"]));
    let vector = titled("foxglove.Vector3", &numbers(&["x", "y", "z"]));
    let cube = json!({"pose": pose_schema(), "size": vector, "color": color});
    let point = titled("foxglove.Point3", &numbers(&["x", "y", "z"]));
    let line = json!({
        "type": {"type": "integer"}, "pose": pose_schema(), "thickness": number, "scale_invariant": flag,
        "points": list(&point), "color": color, "colors": list(&color),
        "indices": list(&json!({"type": "integer"})),
    });
    let words = json!({
        "pose": pose_schema(), "billboard": flag, "font_size": number, "scale_invariant": flag,
        "color": color, "text": text,
    });
    let mut lifetime = time_schema();
    lifetime["title"] = "duration".into();
    let pair = titled("foxglove.KeyValuePair", &json!({"key": text, "value": text}));
    let mut entity = json!({
        "timestamp": time_schema(), "frame_id": text, "id": text, "lifetime": lifetime,
        "frame_locked": flag, "metadata": list(&pair),
    });
    for kind in PRIMITIVES {
        // None of these is ever written.
        entity[kind] = list(&json!({"type": "object", "properties": {}}));
    }
    entity["cubes"] = list(&titled("foxglove.CubePrimitive", &cube));
    entity["lines"] = list(&titled("foxglove.LinePrimitive", &line));
    entity["texts"] = list(&titled("foxglove.TextPrimitive", &words));
    let deletion = json!({"timestamp": time_schema(), "type": {"type": "integer"}, "id": text});
    let properties = json!({
        "deletions": list(&titled("foxglove.SceneEntityDeletion", &deletion)),
        "entities": list(&titled("foxglove.SceneEntity", &entity)),
    });
    titled("foxglove.SceneUpdate", &properties)
}

fn pose_schema() -> Value {
    let properties = json!({
        "position": titled("foxglove.Vector3", &numbers(&["x", "y", "z"])),
        "orientation": titled("foxglove.Quaternion", &numbers(&["x", "y", "z", "w"])),
    });
    titled("foxglove.Pose", &properties)
}

fn titled(title: &str, properties: &Value) -> Value {
    json!({"title": title, "type": "object", "properties": properties})
}

fn numbers(names: &[&str]) -> Value {
    names.iter().map(|name| ((*name).to_owned(), json!({"type": "number"}))).collect()
}
