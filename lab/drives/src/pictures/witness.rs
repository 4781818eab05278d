//! The witness in a strong colour, with a label.

use mufasa_model::hardened::h14_fail_safe::path;
use mufasa_model::input::cycle::{Cycle, TrajectoryPoint};
use mufasa_model::input::domain::first_problem;
use mufasa_model::input::scene;
use mufasa_model::report::{FailedStage, Reading, Report, Rule, Witness};

use super::frame::Rectangle;
use super::layers;
use super::scene::Scene;
use crate::check::words;
use crate::seconds;
use mufasa_records::names;

/// Width of a character of a label, px.
const CHARACTER: f64 = 7.1;
/// Height of a label, px.
const LABEL_HEIGHT: f64 = 24.0;
/// Between a label and the edges of the map, px.
const EDGE: f64 = 8.0;
/// Length of the head of an arrow, px.
const TIP: f64 = 11.0;

/// What a witness points at.
struct Marks {
    /// Rectangles to be filled.
    shapes: Vec<Rectangle>,
    /// Where the objects of the shapes were: rectangles to be outlined.
    outlines: Vec<Rectangle>,
    /// Lines, m on the map.
    lines: Vec<[[f64; 2]; 2]>,
    /// The same with a head at the second end.
    arrows: Vec<[[f64; 2]; 2]>,
    /// Circles: centre, radius, whether it is the witness itself; m.
    circles: Vec<([f64; 2], f64, bool)>,
    /// What the label points at, m.
    anchor: [f64; 2],
}

/// Places of the map that a picture of this report has to show.
pub fn places(cycle: &Cycle, report: &Report) -> Vec<[f64; 2]> {
    let marks = marks(cycle, report);
    let shapes = marks.shapes.iter().chain(&marks.outlines);
    let mut places: Vec<_> = shapes.flat_map(Rectangle::corners).collect();
    places.push(marks.anchor);
    places.extend(marks.lines.into_iter().chain(marks.arrows).flatten());
    places
}

/// Draws the witness and its label.
pub fn draw(scene: &mut Scene, cycle: &Cycle, report: &Report) {
    let marks = marks(cycle, report);
    let stage = mufasa_props::conformance::name(report.failed_stage);
    let rule = report.witness().map_or("", |witness| names::rule(witness.rule));
    scene.canvas.open(&format!("id=\"witness\" data-stage=\"{stage}\" data-rule=\"{rule}\""));
    for shape in &marks.shapes {
        scene.rectangle(shape, "witness");
    }
    for (centre, radius, strong) in &marks.circles {
        scene.circle(*centre, *radius, if *strong { "witness" } else { "disk" });
    }
    for outline in &marks.outlines {
        scene.rectangle(outline, "disk");
    }
    for line in &marks.lines {
        scene.line(line, "witness-line");
    }
    for arrow in &marks.arrows {
        scene.arrow(*arrow, TIP, "witness");
    }
    if marks.shapes.is_empty() && marks.circles.is_empty() && marks.lines.is_empty() {
        scene.dot(marks.anchor, 16.0, "witness");
    }
    label(scene, &marks, &label_text(report));
    scene.canvas.close();
}

fn label_text(report: &Report) -> String {
    match (report.failed_stage, report.witness()) {
        (_, Some(witness)) => words::witness(witness),
        (Some(FailedStage::Input), None) => match &report.input {
            Some(problem) => format!("invalid {}", problem.field),
            None => "invalid input".to_owned(),
        },
        (Some(failed), None) => words::failed_stage(failed),
        (None, None) => "safe".to_owned(),
    }
}

fn marks(cycle: &Cycle, report: &Report) -> Marks {
    let centre =
        Rectangle::of_ego(&cycle.ego, [cycle.ego.x, cycle.ego.y], [cycle.ego.cos, cycle.ego.sin])
            .centre;
    let mut marks = Marks {
        shapes: Vec::new(),
        outlines: Vec::new(),
        lines: Vec::new(),
        arrows: Vec::new(),
        circles: Vec::new(),
        anchor: centre,
    };
    let Some(witness) = report.witness() else { return marks };
    let point = witness.point.and_then(|index| point_or_place(cycle, index));
    let point = point.as_ref();
    if let Some(point) = point {
        let footprint = layers::footprint(cycle, point);
        marks.anchor = footprint.centre;
        if witness.disk.is_none() {
            marks.shapes.push(footprint);
        } else {
            disks(cycle, &footprint, witness, &mut marks);
        }
    }
    if witness.rule == Rule::FailSafe && witness.item.is_some() {
        moving(cycle, witness, &mut marks);
    } else {
        objects(cycle, witness, point, &mut marks);
    }
    if matches!(witness.rule, Rule::MeanCost | Rule::WorkLimit | Rule::NoAssignment) {
        assignment(cycle, &mut marks);
    } else if witness.rule == Rule::Gap {
        gap(cycle, &mut marks);
    } else if let (Rule::Corridor | Rule::ThetaMap, Some(point)) = (witness.rule, point) {
        marks.circles.push(([point.x, point.y], 0.5, true));
        marks.anchor = [point.x, point.y];
    }
    marks
}

/// A point of the trajectory, or a place of H-14, which are counted as points behind the last one; of invalid input
/// there are no places.
fn point_or_place(cycle: &Cycle, index: usize) -> Option<TrajectoryPoint> {
    let points = &cycle.trajectory.as_ref()?.points;
    if let Some(point) = points.get(index) {
        return Some(point.clone());
    }
    if first_problem(cycle).is_some() {
        return None;
    }
    let scene = scene::Scene::new(cycle, Reading::Exact);
    let place = path::places(&scene, scene.trajectory.as_ref()?).nth(index - points.len())?;
    let (origin, direction) = (place.pose.origin, place.pose.direction);
    let [x, y, cos, sin] = [origin.x, origin.y, direction.x, direction.y].map(|it| it.to_f64());
    Some(TrajectoryPoint { t_ns: cycle.now_ns, x, y, cos, sin })
}

/// Track, detection, cell and segment of the witness.
fn objects(cycle: &Cycle, witness: &Witness, point: Option<&TrajectoryPoint>, marks: &mut Marks) {
    let mut objects = Vec::new();
    if let (Some(id), Some(list)) = (witness.track, &cycle.tracks) {
        let predicted = point.filter(|_| witness.rule == Rule::Collision);
        let later = predicted.map_or(0.0, |point| seconds(list.stamp_ns, point.t_ns));
        let track = list.items.iter().find(|track| track.id == id);
        objects.extend(track.map(|track| layers::track(track, later)));
        if later != 0.0 {
            let path = track.map(|track| [0.0, later].map(|t| layers::track(track, t).centre));
            marks.lines.extend(path);
        }
    }
    if let (Some(index), Some(list)) = (witness.detection, &cycle.detections) {
        objects.extend(list.items.get(index).map(layers::detection));
    }
    if let (Some(cell), Some(grid)) = (witness.cell, &cycle.grid) {
        objects.push(layers::cell(grid, cell));
    }
    if let Some(first) = witness.segment {
        let sections = &cycle.route.cross_sections;
        let next = if first + 1 < sections.len() { first + 1 } else { 0 };
        if let (Some(from), Some(to)) = (sections.get(first), sections.get(next)) {
            marks.lines.push([[from.x, from.y], [to.x, to.y]]);
        }
    }
    if let Some(object) = objects.last() {
        marks.anchor = object.centre;
    }
    marks.shapes.extend(objects);
}

/// H-14: the item of the history and the detection that it became.
fn moving(cycle: &Cycle, witness: &Witness, marks: &mut Marks) {
    let (Some(now), Some(age_ns)) = (&cycle.detections, witness.age_ns) else { return };
    let then = cycle.detection_history.iter();
    let then =
        then.into_iter().find(|list| now.stamp_ns.checked_sub(list.stamp_ns) == Some(age_ns));
    let item = witness.item.and_then(|index| then?.items.get(index));
    let detection = witness.detection.and_then(|index| now.items.get(index));
    let (Some(item), Some(detection)) = (item, detection) else { return };
    let [was, is] = [item, detection].map(layers::detection);
    marks.arrows.push([was.centre, is.centre]);
    marks.outlines.push(was);
    marks.anchor = is.centre;
    marks.shapes.push(is);
}

/// Stage v: the disks at the point, the one of the witness strong.
#[expect(clippy::cast_precision_loss)] // of a picture
fn disks(cycle: &Cycle, footprint: &Rectangle, witness: &Witness, marks: &mut Marks) {
    let count = usize::try_from(cycle.parameters.n).unwrap_or(0).min(64);
    let [length, width] = footprint.size;
    let radius = (length / count as f64).hypot(width) / 2.0;
    for index in 0..count {
        let along = (2 * index + 1) as f64 * length / (2 * count) as f64 - length / 2.0;
        let centre = footprint.point([along, 0.0]);
        marks.circles.push((centre, radius, witness.disk == Some(index)));
        if witness.disk == Some(index) {
            marks.anchor = centre;
        }
    }
}

/// Stage i: from every track in the field of view to its nearest detection; those that are
/// farther than `theta_track_max` are marked, and the loneliest one.
fn assignment(cycle: &Cycle, marks: &mut Marks) {
    let (Some(tracks), Some(detections)) = (&cycle.tracks, &cycle.detections) else { return };
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let ego = [cycle.ego.x, cycle.ego.y];
    let places: Vec<_> = detections.items.iter().map(|d| [d.x, d.y]).collect();
    let view = places.iter().map(|place| distance(*place, ego)).fold(0.0, f64::max);
    marks.circles.push((ego, view, false));
    let limit = cycle.parameters.theta_track_max;
    marks.shapes.clear();
    let mut loneliest: Option<(f64, Rectangle)> = None;
    for track in tracks.items.iter().filter(|track| distance([track.x, track.y], ego) <= view) {
        let at = [track.x, track.y];
        let nearest =
            places.iter().copied().min_by(|a, b| distance(*a, at).total_cmp(&distance(*b, at)));
        let Some(nearest) = nearest else { continue };
        let apart = distance(nearest, at);
        let rectangle = layers::track(track, 0.0);
        if apart >= limit {
            marks.shapes.push(rectangle);
        }
        if loneliest.as_ref().is_none_or(|(most, _)| apart > *most) {
            loneliest = Some((apart, rectangle));
        }
        marks.lines.push([at, nearest]);
    }
    if let Some((apart, rectangle)) = loneliest {
        marks.anchor = rectangle.centre;
        if apart < limit {
            marks.shapes.push(rectangle);
        }
    }
}

/// Stage iv: the free distance ahead of the CAV, as if the road were straight.
fn gap(cycle: &Cycle, marks: &mut Marks) {
    let Some(lead) = &cycle.lead else { return };
    let ego = &cycle.ego;
    let rectangle = Rectangle::of_ego(ego, [ego.x, ego.y], [ego.cos, ego.sin]);
    let front = rectangle.point([ego.length / 2.0, 0.0]);
    let end = rectangle.point([ego.length / 2.0 + lead.gap, 0.0]);
    let bar = [1.0, -1.0].map(|side| rectangle.point([ego.length / 2.0 + lead.gap, side]));
    marks.lines.extend([[front, end], bar]);
    marks.anchor = end;
}

/// A label at the upper edge of the map, or at the lower one where the anchor is near it, with a line to the anchor.
fn label(Scene { canvas, frame }: &mut Scene, marks: &Marks, text: &str) {
    let Some(anchor) = frame.at(marks.anchor) else { return };
    #[expect(clippy::cast_precision_loss)] // of a picture
    let width = text.chars().count() as f64 * CHARACTER + 16.0;
    let ([left, top], [wide, high]) = (frame.place, frame.size);
    let x = (anchor[0] - width / 2.0).clamp(left + EDGE, left + (wide - width - EDGE).max(EDGE));
    let upper = top + EDGE;
    let lower = top + high - EDGE - LABEL_HEIGHT;
    let is_above = anchor[1] > upper + 2.0 * LABEL_HEIGHT;
    let (y, end) = if is_above { (upper, upper + LABEL_HEIGHT) } else { (lower, lower) };
    canvas.polyline(&[Some(anchor), Some([anchor[0], end])], "leader");
    canvas.rect([x, y], [width, LABEL_HEIGHT], "label");
    canvas.text(Some([x + width / 2.0, y + 16.5]), "label-text", text);
}
