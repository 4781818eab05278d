//! Pictures of a moment, from above, as SVG text: north is up.

use mufasa_drives::pictures::frame::{self as drawn, Frame};
use mufasa_drives::pictures::scene::Scene;

use crate::map::{Light, Town};
use crate::path::Path;
use crate::pose::{Point, Rectangle};
use crate::snapshot::Snapshot;
use crate::traffic::agent::Kind;

/// Resolution of a frame, pixels for each metre.
const SCALE: f64 = 4.0;
/// Above a frame, and between two beside each other, px.
const ABOVE: f64 = 18.0;
const APART: f64 = 8.0;
/// Colours of tracks: those that came over the link, and the CAV's own.
pub const REMOTE: &str = "#c2185b";
/// See `REMOTE`.
pub const LOCAL: &str = "#00838f";
/// Colour of what came over the link and was rejected.
pub const REJECTED: &str = "#d62828";
/// Colour of detections.
pub const DETECTION: &str = "#e67e00";
/// Colour of the trajectory.
pub const TRAJECTORY: &str = "#0b6e4f";
/// Seconds of way that an arrow shows.
const ARROW: f64 = 1.0;

/// What services believe, drawn over the truth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// Places of a planned trajectory, m.
    pub trajectory: Vec<Point>,
    /// Tracks.
    pub tracks: Vec<Rectangle>,
    /// Whether they came over the link: drawn in another colour then.
    pub is_remote: bool,
    /// Places of a trajectory that came over the link and was rejected, m.
    pub rejected: Vec<Point>,
    /// Tracks that came over the link and were rejected.
    pub rejected_tracks: Vec<Rectangle>,
    /// Middles of detections, m.
    pub detections: Vec<Point>,
    /// Middles of occupied cells, m.
    pub cells: Vec<Point>,
    /// Side of a cell, m.
    pub cell_size: f64,
    /// A line of text above the frame.
    pub caption: String,
}

/// What a frame shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Its middle, m.
    pub middle: Point,
    /// East to west, m.
    pub width: f64,
    /// North to south, m.
    pub height: f64,
}

impl View {
    /// 80 m by 60 m around the ego.
    pub const fn of_ego(snapshot: &Snapshot) -> Self {
        Self { middle: snapshot.ego.rectangle.pose.at, width: 80.0, height: 60.0 }
    }
}

/// One frame, as a whole file.
pub fn frame(
    town: &Town,
    route: usize,
    snapshot: &Snapshot,
    overlay: &Overlay,
    view: View,
) -> String {
    sheet(town, route, &[&[(snapshot, overlay, view)]])
}

/// A moment, what is drawn over it, and what is seen of it.
pub type Shot<'a> = (&'a Snapshot, &'a Overlay, View);

/// Rows of frames, as a whole file; all as high as the highest.
pub fn sheet(town: &Town, route: usize, rows: &[&[Shot<'_>]]) -> String {
    let wide = |row: &&[Shot<'_>]| row.iter().map(|(_, _, it)| it.width * SCALE + APART).sum();
    let width = rows.iter().map(wide).fold(0.0, f64::max);
    let highest = rows.iter().copied().flatten().map(|(_, _, view)| view.height);
    let height = ABOVE + highest.fold(0.0, f64::max) * SCALE + 2.0;
    let mut scene = Scene::new(Frame::north_up([0.0; 2], [0.0; 2], SCALE, [0.0; 2]));
    let (mut top, mut index) = (0.0, 0);
    for row in rows {
        let mut left = APART / 2.0;
        for (snapshot, overlay, view) in *row {
            let size = [view.width, view.height];
            scene.frame = Frame::north_up(at(view.middle), size, SCALE, [left, top + ABOVE]);
            one(&mut scene, (town, route), (snapshot, overlay, *view), index);
            left += view.width * SCALE + APART;
            index += 1;
        }
        top += height;
    }
    scene.canvas.document([width, top], "a drive from above", &style())
}

/// What the looks are.
fn style() -> String {
    format!(
        ".caption,.id{{font-family:sans-serif;font-size:10.4px;fill:#333}}.id{{font-size:6.4px}}.ground{{fill:#f4f6f1}}\
         .lane{{fill:none;stroke:#dfe3e6}}.crossing{{fill:none;stroke:#fff}}\
         .route{{fill:none;stroke:#9db8d6;stroke-width:1}}.target{{fill:#2e9e4f22;stroke:#2e9e4f;stroke-width:1.2}}\
         .Green,.Yellow,.Red{{fill:none;stroke:#2e9e4f;stroke-width:2.4}}.Yellow{{stroke:#e8b400}}\
         .Red{{stroke:{REJECTED}}}.cell{{fill:#7a5195;opacity:.35}}.car{{fill:#5b6770}}.truck{{fill:#3d464d}}\
         .person{{fill:#b5541c}}.cav{{fill:#1f6fd1;stroke:#0d3b75;stroke-width:1.2}}\
         .way-line{{fill:none;stroke:#111;stroke-width:.9;opacity:.8}}.way-tip{{fill:#111}}\
         .trajectory,.rejected{{fill:none;stroke:{TRAJECTORY};stroke-width:2;opacity:.9}}\
         .rejected{{stroke:{REJECTED}}}.remote,.local,.rejected-track{{fill:none;stroke:{REMOTE};stroke-width:1.2}}\
         .local{{stroke:{LOCAL}}}.rejected-track{{stroke:{REJECTED}}}\
         .rejected,.rejected-track{{stroke-dasharray:5.6 2.8}}.detection{{fill:{DETECTION}}}"
    )
}

const fn at(point: Point) -> [f64; 2] {
    [point.x, point.y]
}

fn drawn(rectangle: &Rectangle) -> drawn::Rectangle {
    let &Rectangle { pose, length, width } = rectangle;
    drawn::Rectangle { centre: at(pose.at), direction: [pose.cos, pose.sin], size: [length, width] }
}

fn line(scene: &mut Scene, points: &[Point], look: &str) {
    if points.len() > 1 {
        scene.line(&points.iter().copied().map(at).collect::<Vec<_>>(), look);
    }
}

fn one(
    scene: &mut Scene,
    (town, route): (&Town, usize),
    (snapshot, overlay, view): Shot<'_>,
    index: usize,
) {
    #[allow(clippy::cast_precision_loss, reason = "seconds for a reader")]
    let seconds = snapshot.time_ns as f64 * 1e-9;
    let (place, size) = (scene.frame.place, scene.frame.size);
    let caption = format!("t = {seconds:.2} s {}", overlay.caption);
    scene.canvas.text(Some([place[0], place[1] - 4.4]), "caption", &caption);
    scene.canvas.clip(&format!("f{index}"), place, size);
    scene.canvas.rect(place, size, "ground");
    map(scene, (town, route), snapshot, view);
    for cell in &overlay.cells {
        let size = [overlay.cell_size; 2];
        let cell = drawn::Rectangle { centre: at(*cell), direction: [1.0, 0.0], size };
        scene.rectangle(&cell, "cell");
    }
    things(scene, snapshot, view);
    line(scene, &overlay.trajectory, "trajectory");
    line(scene, &overlay.rejected, "rejected");
    for track in &overlay.rejected_tracks {
        scene.rectangle(&drawn(track), "rejected-track");
    }
    for track in &overlay.tracks {
        scene.rectangle(&drawn(track), if overlay.is_remote { "remote" } else { "local" });
    }
    for dot in &overlay.detections {
        scene.dot(at(*dot), 1.8, "detection");
    }
    scene.canvas.close();
}

fn map(scene: &mut Scene, (town, route): (&Town, usize), snapshot: &Snapshot, view: View) {
    for lane in &town.lanes {
        scene.band(&near(&lane.path, view), lane.width, "lane");
    }
    let route = &town.routes[route];
    for crossing in &town.crossings {
        let across = &town.routes[crossing.route].path;
        let ends = [across.pose_at(4.0).at, across.pose_at(across.length() - 4.0).at];
        scene.band(&ends.map(at), crossing.width / 2.0, "crossing");
    }
    scene.line(&near(&route.path, view), "route");
    for signal in &route.signals {
        let look = match snapshot.lights[signal.group] {
            Light::Green => "Green",
            Light::Yellow => "Yellow",
            Light::Red => "Red",
        };
        let pose = route.path.pose_at(signal.s);
        scene.line(&[pose.ahead(0.0, 1.7), pose.ahead(0.0, -1.7)].map(at), look);
    }
    if let Some(task) = route.task {
        scene.rectangle(&drawn(&task.target), "target");
    }
}

fn things(scene: &mut Scene, snapshot: &Snapshot, view: View) {
    for object in snapshot.objects.iter().filter(|it| sees(view, it.rectangle.pose.at)) {
        let middle = object.rectangle.pose.at;
        let look = match object.kind {
            Kind::Ego | Kind::Car => "car",
            Kind::Truck => "truck",
            Kind::Pedestrian | Kind::Bicycle => "person",
        };
        scene.rectangle(&drawn(&object.rectangle), look);
        way(scene, middle, object.velocity);
        scene.text(at(middle), [4.8, -4.8], "id", &object.id.to_string());
    }
    let ego = &snapshot.ego;
    scene.rectangle(&drawn(&ego.rectangle), "cav");
    let pose = ego.rectangle.pose;
    way(scene, pose.at, Point::new(ego.speed * pose.cos, ego.speed * pose.sin));
}

/// The way of the next second.
fn way(scene: &mut Scene, from: Point, velocity: Point) {
    if velocity.distance(Point::default()) > 0.3 {
        let tip = [from.x + velocity.x * ARROW, from.y + velocity.y * ARROW];
        scene.arrow([at(from), tip], 4.0, "way");
    }
}

fn sees(view: View, place: Point) -> bool {
    (place.x - view.middle.x).abs() < view.width / 2.0 + 10.0
        && (place.y - view.middle.y).abs() < view.height / 2.0 + 10.0
}

/// The points of a path that a view may need: from the first to the last that it sees.
fn near(path: &Path, view: View) -> Vec<[f64; 2]> {
    let points = path.points();
    let wide = View { width: view.width + 400.0, height: view.height + 400.0, ..view };
    let first = points.iter().position(|p| sees(wide, *p)).unwrap_or(0);
    let last = points.iter().rposition(|p| sees(wide, *p)).unwrap_or(0);
    points[first..=last].iter().copied().map(at).collect()
}
