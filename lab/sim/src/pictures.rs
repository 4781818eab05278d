//! Pictures of a moment, from above, as SVG text: 1 m is one unit, north is up.

use core::fmt::Write;

use crate::map::route::corners;
use crate::map::{Light, Town};
use crate::path::Path;
use crate::pose::{Point, Rectangle};
use crate::snapshot::Snapshot;
use crate::traffic::agent::Kind;

/// Resolution of a frame, pixels for each metre.
const SCALE: f64 = 4.0;
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
    strip(town, route, &[(snapshot, overlay, view)])
}

/// A moment, what is drawn over it, and what is seen of it.
pub type Shot<'a> = (&'a Snapshot, &'a Overlay, View);

/// Several frames beside each other, as a whole file; all as high as the highest.
pub fn strip(town: &Town, route: usize, frames: &[Shot<'_>]) -> String {
    sheet(town, route, &[frames])
}

/// Rows of frames, as a whole file; all as high as the highest.
pub fn sheet(town: &Town, route: usize, rows: &[&[Shot<'_>]]) -> String {
    let wide = |row: &&[Shot<'_>]| row.iter().map(|(_, _, view)| view.width + 2.0).sum();
    let width = rows.iter().map(wide).fold(0.0, f64::max);
    let frames = rows.iter().copied().flatten();
    let height = 5.0 + frames.fold(0.0_f64, |most, (_, _, view)| most.max(view.height));
    let all: f64 = rows.iter().map(|_| height).sum();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0}\" height=\"{:.0}\" viewBox=\"0 0 {width:.2} {all:.2}\" \
         font-family=\"sans-serif\" font-size=\"2.6\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width * SCALE,
        all * SCALE,
    );
    let (mut top, mut index) = (0.0, 0);
    for row in rows {
        let mut left = 1.0;
        for shot in *row {
            one(&mut text, (town, route), *shot, ([left, top], index));
            left += shot.2.width + 2.0;
            index += 1;
        }
        top += height;
    }
    text.push_str("</svg>\n");
    text
}

fn one(
    text: &mut String,
    (town, route): (&Town, usize),
    (snapshot, overlay, view): Shot<'_>,
    ([left, top], index): ([f64; 2], usize),
) {
    let View { middle, width, height } = view;
    #[allow(clippy::cast_precision_loss, reason = "seconds for a reader")]
    let seconds = snapshot.time_ns as f64 * 1e-9;
    let caption = escape(&overlay.caption);
    put(
        text,
        format_args!(
            "<text x=\"{left:.2}\" y=\"{:.2}\" fill=\"#333\">t = {seconds:.2} s {caption}</text>\n",
            top + 3.4
        ),
    );
    put(
        text,
        format_args!(
            "<clipPath id=\"f{index}\"><rect x=\"{left:.2}\" y=\"{0:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/>\
             </clipPath>\n<g clip-path=\"url(#f{index})\"><rect x=\"{left:.2}\" y=\"{0:.2}\" width=\"{width:.2}\" \
             height=\"{height:.2}\" fill=\"#f4f6f1\"/>\n<g transform=\"translate({1:.3} {2:.3}) scale(1 -1)\">\n",
            top + 4.5,
            left + width / 2.0 - middle.x,
            top + 4.5 + height / 2.0 + middle.y
        ),
    );
    map(text, (town, route), snapshot, view);
    for &cell in &overlay.cells {
        let half = overlay.cell_size / 2.0;
        put(
            text,
            format_args!(
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{2:.2}\" height=\"{2:.2}\" fill=\"#7a5195\" opacity=\"0.35\"/>\n",
                cell.x - half,
                cell.y - half,
                overlay.cell_size
            ),
        );
    }
    things(text, snapshot, view);
    if overlay.trajectory.len() > 1 {
        polyline(text, &overlay.trajectory, TRAJECTORY, 0.5, 0.9);
    }
    text.push_str("<g stroke-dasharray=\"1.4 0.7\">\n");
    if overlay.rejected.len() > 1 {
        polyline(text, &overlay.rejected, REJECTED, 0.5, 0.9);
    }
    for track in &overlay.rejected_tracks {
        polygon(text, &corners(track), "none", REJECTED);
    }
    text.push_str("</g>\n");
    for track in &overlay.tracks {
        polygon(text, &corners(track), "none", if overlay.is_remote { REMOTE } else { LOCAL });
    }
    for dot in &overlay.detections {
        put(
            text,
            format_args!(
                "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"0.45\" fill=\"{DETECTION}\"/>\n",
                dot.x, dot.y
            ),
        );
    }
    text.push_str("</g></g>\n");
}

fn map(text: &mut String, (town, route): (&Town, usize), snapshot: &Snapshot, view: View) {
    for lane in &town.lanes {
        polyline(text, &near(&lane.path, view), "#dfe3e6", lane.width, 1.0);
    }
    let route = &town.routes[route];
    for crossing in &town.crossings {
        let across = &town.routes[crossing.route];
        let points =
            [across.path.pose_at(4.0).at, across.path.pose_at(across.path.length() - 4.0).at];
        polyline(text, &points, "#ffffff", crossing.width / 2.0, 1.0);
    }
    polyline(text, &near(&route.path, view), "#9db8d6", 0.25, 1.0);
    for signal in &route.signals {
        let color = match snapshot.lights[signal.group] {
            Light::Green => "#2e9e4f",
            Light::Yellow => "#e8b400",
            Light::Red => "#d62828",
        };
        let pose = route.path.pose_at(signal.s);
        polyline(text, &[pose.ahead(0.0, 1.7), pose.ahead(0.0, -1.7)], color, 0.6, 1.0);
    }
    if let Some(task) = route.task {
        polygon(text, &corners(&task.target), "#2e9e4f22", "#2e9e4f");
    }
}

fn things(text: &mut String, snapshot: &Snapshot, view: View) {
    for object in &snapshot.objects {
        let at = object.rectangle.pose.at;
        if !sees(view, at) {
            continue;
        }
        let color = match object.kind {
            Kind::Ego | Kind::Car => "#5b6770",
            Kind::Truck => "#3d464d",
            Kind::Pedestrian | Kind::Bicycle => "#b5541c",
        };
        polygon(text, &corners(&object.rectangle), color, "none");
        arrow(text, at, object.velocity);
        put(
            text,
            format_args!(
                "<text transform=\"translate({:.2} {:.2}) scale(1 -1)\" font-size=\"1.6\" fill=\"#333\">{}</text>\n",
                at.x + 1.2,
                at.y + 1.2,
                object.id
            ),
        );
    }
    let ego = &snapshot.ego;
    polygon(text, &corners(&ego.rectangle), "#1f6fd1", "#0d3b75");
    let pose = ego.rectangle.pose;
    arrow(text, pose.at, Point::new(ego.speed * pose.cos, ego.speed * pose.sin));
}

fn arrow(text: &mut String, from: Point, velocity: Point) {
    let length = velocity.distance(Point::default());
    if length < 0.3 {
        return;
    }
    let (x, y) = (velocity.x / length, velocity.y / length);
    let tip = Point::new(from.x + velocity.x * ARROW, from.y + velocity.y * ARROW);
    polyline(text, &[from, tip], "#111111", 0.22, 0.8);
    let barb = |side: f64| Point::new(tip.x - x + side * 0.5 * y, tip.y - y - side * 0.5 * x);
    polygon(text, &[tip, barb(1.0), barb(-1.0)], "#111111", "none");
}

fn sees(view: View, place: Point) -> bool {
    (place.x - view.middle.x).abs() < view.width / 2.0 + 10.0
        && (place.y - view.middle.y).abs() < view.height / 2.0 + 10.0
}

/// The points of a path that a view may need: from the first to the last that it sees.
fn near(path: &Path, view: View) -> Vec<Point> {
    let points = path.points();
    let wide = View { width: view.width + 400.0, height: view.height + 400.0, ..view };
    let first = points.iter().position(|p| sees(wide, *p)).unwrap_or(0);
    let last = points.iter().rposition(|p| sees(wide, *p)).unwrap_or(0);
    points[first..=last].to_vec()
}

fn polyline(text: &mut String, points: &[Point], color: &str, width: f64, opacity: f64) {
    text.push_str("<polyline points=\"");
    for point in points {
        put(text, format_args!("{:.2},{:.2} ", point.x, point.y));
    }
    put(
        text,
        format_args!(
            "\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width:.2}\" opacity=\"{opacity}\"/>\n"
        ),
    );
}

fn polygon(text: &mut String, points: &[Point], fill: &str, stroke: &str) {
    text.push_str("<polygon points=\"");
    for point in points {
        put(text, format_args!("{:.2},{:.2} ", point.x, point.y));
    }
    put(text, format_args!("\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"0.3\"/>\n"));
}

pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn put(text: &mut String, arguments: core::fmt::Arguments<'_>) {
    text.write_fmt(arguments).unwrap_or_else(|_| unreachable!("a string takes everything"));
}
