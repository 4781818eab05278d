//! The five stages of the paper profile: of each a cycle that passes and one that fails.

use std::f64::consts::{FRAC_PI_2, PI};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use mufasa_model::input::scene::{Point, Scene, Track};
use mufasa_model::numbers::assignment::{Assignment, Costs, count, least_cost};
use mufasa_model::numbers::cells;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Stage, Witness};
use mufasa_model::stages::distances::{s_b, s_cav, s_valid};
use mufasa_model::stages::horizon::points_within;
use mufasa_model::stages::i_track_validation::costs;
use mufasa_model::stages::ii_trajectory_to_map::OnMap;
use mufasa_model::stages::llcc::cav;
use mufasa_model::stages::v_grid_map::{Disk, dilated, disk_offset, radius};
use serde_json::{Value, json};

use crate::sheet::{Look, Pen, Sheet, xy};
use crate::world::{NOW_NS, ego, merged, outcome, own, scene, seen, tracks, trajectory};

/// Looks that only this sheet has.
const FAINT: &str = "track\" style=\"fill-opacity:.06;stroke-opacity:.5";
const ROAD: &str = "tip\" style=\"fill-opacity:.07";
const MARKED: &str = "tip\" style=\"fill-opacity:.22";
const CELL: &str = "tip\" style=\"stroke:#fff;stroke-width:.7";

/// Title, words for a cycle that passes and for one that fails; a, b: the numbers compared, of a fail by its witness.
const ROWS: &str = "\
Stage i: tracks against detections|\
Received tracks (blue) within r of p are paired with detections (orange). The mean distance of the pairs, {a} m, is below theta_tr = {b} m. Track 4, beyond r, is not compared.|\
Track 3 is not where the CAV detects the car: the mean distance is {a} m, not below theta_tr = {b} m.
Stage ii: trajectory to map|\
Each point of the trajectory has to be within theta_map = {b} m of the reference path (dashed) or inside the corridor (grey). The farthest is {a} m from the path, and inside.|\
The red point is {a} m from the reference path, farther than theta_map = {b} m, and outside the corridor.
Stage iii: trajectory with tracks|\
At each point within s_CAV = {b} m the CAV is compared with the track (blue), moved on with its velocity to the time of the point. The cyclist has left before the CAV comes.|\
A slower cyclist. At the red point the rectangles share a point: their centres are {a} m apart, nearer than theta_obj = {b} m.
Stage iv: gap to the leading vehicle|\
A leading vehicle at v_lead = 4 m/s, as fast as the CAV. The gap to it, {a} m, is above s_follow = {b} m. No point within s_valid = s_follow collides.|\
The same speeds. The gap to the leading vehicle, {a} m, is not above s_follow = {b} m.
Stage iv: trajectory with detections|\
Detections (orange) count as standing. No leading vehicle: s_valid = s_b(8 m/s) = {b} m. Points beyond it (white) are not examined, so the car ahead passes.|\
The parked car reaches into the way of the CAV: at the red point their centres are {a} m apart, nearer than theta_obj = {b} m, and the rectangles share a point.
Stage v: trajectory with grid map|\
n = 4 disks of radius r = {a} m cover the CAV. Cells within r of an occupied one (black) are marked (grey). At the points within s_b = {b} m no centre is in a marked cell.|\
The red centre of a disk is in a marked cell, whose centre is {a} m from that of an occupied one, not farther than r = {b} m.";
const STAGES: [Stage; 6] = [Stage::I, Stage::Ii, Stage::Iii, Stage::Iv, Stage::Iv, Stage::V];

/// The cycle of a row that passes, or the one that fails.
fn changes(row: usize, passes: bool) -> Value {
    let of = |pass: f64, fail: f64| if passes { pass } else { fail };
    let car = |x: f64, y: f64, angle: f64| [x, y, angle, 4.0, 1.8];
    let straight_on = |speed: i32, with: &Value| {
        let points: Vec<_> = (0..10).map(|k| [f64::from(k) * 1.2, 0.0, 0.0]).collect();
        let step_ns = 1_200_000_000 / i64::from(speed);
        merged(json!({"ego": ego(speed.into()), "trajectory": trajectory(step_ns, &points)}), with)
    };
    match row {
        0 => {
            let received = [[6.1, 2.1], [8.6, -2.1], [14.5 - of(0.1, 1.2), 0.7], [19.5, -1.6]];
            let items = [[6.2, 2.0], [8.5, -2.0], [14.5, 0.6]].map(|[x, y]| car(x, y, 0.0));
            let received = received.map(|[x, y]| (car(x, y, 0.0), [0.0; 2]));
            json!({"tracks": tracks(0.0, &received), "detections": seen(0.0, &items)})
        }
        1 => {
            let aside = |x: f64| of(0.8, 1.3) * (1.0 - (PI * (x / 13.0).min(1.0)).cos());
            let points: Vec<_> =
                (0..8).map(|k| f64::from(k) * 2.0).map(|x| [x, aside(x), 0.0]).collect();
            let section = |x: i32| json!({"x": x, "y": 0, "left": [x, 2.2], "right": [x, -2.2]});
            json!({"trajectory": trajectory(200_000_000, &points),
                   "route": {"closed": false, "stations": [section(-9), section(90)]}})
        }
        2 => {
            let cyclist = ([10.5, -2.4, FRAC_PI_2, 1.8, 0.7], [0.0, of(3.5, 2.0)]);
            straight_on(5, &json!({"tracks": tracks(0.0, &[cyclist])}))
        }
        3 => {
            let gap = of(9.4, 6.0);
            let leading = seen(0.0, &[car(5.8 + gap, 0.0, 0.0)]);
            let lead = json!({"stamp_ns": NOW_NS, "gap": gap, "speed": 4});
            straight_on(4, &json!({"lead": lead, "detections": leading}))
        }
        4 => {
            let parked = car(of(7.4, 7.9), of(2.5, 1.85), of(0.0, 0.4));
            straight_on(8, &json!({"detections": seen(0.0, &[parked, car(12.0, 0.3, 0.0)])}))
        }
        _ => {
            let mut bytes = [0_u8; 13 * 6];
            let ahead = if passes { 24 } else { 19 };
            let block = [[ahead, 6], [ahead + 1, 6], [ahead, 7], [ahead + 1, 7]];
            for [column, row] in (14..24).map(|column| [column, 1]).chain(block) {
                bytes[row * 6 + column / 8] |= 1 << (column % 8);
            }
            let grid = json!({"stamp_ns": NOW_NS, "x": -1.8, "y": -3.25, "cos": 1, "sin": 0, "resolution": 0.5,
                              "width": 48, "height": 13, "occupied": STANDARD.encode(bytes), "unknown": null});
            straight_on(8, &json!({"grid": grid}))
        }
    }
}

/// All stages, a row for each, of stage iv two.
pub fn stages() -> String {
    let mut sheet = Sheet::new(2, [430.0, 130.0], 3);
    for (row, (text, stage)) in ROWS.lines().zip(STAGES).enumerate() {
        let text: Vec<_> = text.split('|').collect();
        for (column, passes) in [(1, true), (2, false)] {
            let changes = merged(changes(row, passes), &json!({"profile": "paper"}));
            let scene = scene(&changes);
            let (witness, [a, b]) = match (outcome(&changes, stage), passes) {
                (Outcome::Passed, true) => (None, numbers(&scene, stage)),
                (Outcome::Failed(witness), false) => {
                    let compared = witness.compared;
                    (Some(witness), compared)
                }
                other => panic!("{stage:?}: {other:?}"),
            };
            let number = |of: f64| ((of * 100.0).round() / 100.0).to_string();
            let words = text[column].replace("{a}", &number(a)).replace("{b}", &number(b));
            let look = Look { title: text[0], words: &words, low: [-1.8, -3.6], scale: [18.0; 2] };
            sheet.panel(&look, |pen| {
                draw(pen, &scene, stage, witness.as_ref());
                let [color, verdict] = if passes { ["yes", "passes"] } else { ["no", "fails"] };
                pen.dot([21.5, 3.1], 5.0, color);
                pen.words([21.5, 3.1], [-9.0, 4.0], "h e", verdict);
            });
        }
    }
    sheet.finish()
}

/// How far a stage examines the trajectory.
fn horizon(scene: &Scene, stage: Stage) -> Real {
    let (p, v) = (&scene.parameters, &scene.ego.v_now);
    match stage {
        Stage::I | Stage::Ii => Real::from_integer(1000),
        Stage::Iii => s_cav(&p.safety_time, v),
        Stage::Iv => s_valid(v, scene.lead.as_ref().map(|it| &it.speed), &p.a_b, &p.safety_time),
        Stage::V => s_b(v, &p.a_b),
    }
}

/// The numbers in the words of a cycle that passes.
fn numbers(scene: &Scene, stage: Stage) -> [f64; 2] {
    let (p, s) = (&scene.parameters, horizon(scene, stage).near());
    match stage {
        Stage::I => {
            let Assignment { pairs, cost, .. } = pairs(scene).2;
            [(cost / count(pairs.len())).near(), p.theta_tr.near()]
        }
        Stage::Ii => {
            let map = OnMap::new(scene, scene.trajectory.as_ref().expect("current"));
            let far = map.places.iter().map(|it| it.distance.near()).fold(0.0, f64::max);
            [far, p.theta_map.near()]
        }
        Stage::Iii => [0.0, s],
        Stage::Iv => [scene.lead.as_ref().map_or(0.0, |lead| lead.gap.near()), s],
        Stage::V => [radius(scene, &(&scene.ego.width / Real::from_integer(2))).near(), s],
    }
}

/// Stage i: r, the costs of the gated tracks, which come first here, and the best pairs.
fn pairs(scene: &Scene) -> (Real, Costs, Assignment) {
    let (p, detections) = (&scene.ego.position, &scene.detections.as_ref().expect("current").items);
    let r = detections.iter().map(|d| d.frame.origin.distance(p)).max().expect("some");
    let gated = |track: &&Track| track.object.frame.origin.distance(p) <= r;
    let tracks = scene.tracks.iter().flat_map(|list| &list.items).filter(gated);
    let costs: Costs = tracks.map(|it| costs(&it.object.frame.origin, detections)).collect();
    let best = least_cost(&costs, costs.len()).expect("any two can be paired");
    (r, costs, best)
}

fn draw(pen: &mut Pen<'_>, scene: &Scene, stage: Stage, witness: Option<&Witness>) {
    let (s, wrong) = (horizon(scene, stage), witness.and_then(|it| it.point));
    let points = scene.trajectory.as_deref().unwrap_or_default();
    let within = if points.is_empty() { points } else { points_within(scene, points, &s) };
    pen.rectangle(&cav(scene, &own(scene)), "cav");
    match stage {
        Stage::I => draw_pairs(pen, scene),
        Stage::Ii => draw_map(pen, scene),
        Stage::Iii => draw_tracks(pen, scene, within, wrong),
        Stage::Iv => draw_detections(pen, scene),
        Stage::V => draw_grid(pen, scene),
    }
    if !matches!(stage, Stage::I | Stage::Ii) {
        within.iter().for_each(|point| pen.rectangle(&cav(scene, &point.pose), "cavs"));
        let bar = match (stage, &scene.lead) {
            (Stage::Iii, _) => Some((0.0, -3.1, "s_CAV")),
            (Stage::Iv, Some(_)) => Some((3.8, -3.0, "s_follow")),
            (Stage::Iv, None) => Some((0.0, -2.4, "s_valid")),
            _ => None,
        };
        bar.iter().for_each(|(from, y, words)| pen.bar(*from, from + s.near(), *y, words));
        wrong.iter().for_each(|i| pen.rectangle(&cav(scene, &points[*i].pose), "wrong"));
    }
    pen.dot([0.0, 0.0], 2.6, "place");
    pen.words([0.0, 0.0], [-6.0, -3.0], "e", "p");
    if stage == Stage::V {
        return draw_disks(pen, scene, &within[wrong.unwrap_or(within.len() - 1)], witness);
    }
    let at: Vec<_> = points.iter().map(|point| xy(&point.pose.origin)).collect();
    pen.line(&at, "path");
    for (i, at) in at.into_iter().enumerate() {
        pen.dot(at, 3.0, if i < within.len() { "place" } else { "node" });
        wrong.iter().filter(|it| **it == i).for_each(|_| pen.dot(at, 7.0, "wrong"));
    }
}

fn draw_pairs(pen: &mut Pen<'_>, scene: &Scene) {
    let (r, costs, best) = pairs(scene);
    pen.circle([0.0, 0.0], r.near(), "limit");
    pen.words([r.near(), 0.0], [-10.0, -50.0], "e", "r");
    let tracks = &scene.tracks.as_ref().expect("given").items;
    for track in tracks {
        pen.rectangle(&track.object.rectangle(), "track");
        pen.words(xy(&track.object.frame.origin), [-30.0, 4.0], "", &track.id.to_string());
    }
    draw_detections(pen, scene);
    for (i, j) in best.pairs {
        let detection = &scene.detections.as_ref().expect("current").items[j];
        let [a, b] = [&tracks[i].object, detection].map(|it| xy(&it.frame.origin));
        pen.line(&[a, b], "line");
        let cost = costs[i][j].as_ref().map_or(0.0, Real::near);
        pen.words(b, [41.0, 4.0], "", &format!("{cost:.2} m"));
    }
}

fn draw_map(pen: &mut Pen<'_>, scene: &Scene) {
    let [[a, left, right], [b, next_left, next_right]] =
        scene.route.pairs()[0].map(|it| [0, 1, 2].map(|i| xy(&it[i])));
    let theta_map = scene.parameters.theta_map.near();
    pen.area(&[left, right, next_right, next_left], ROAD);
    [[left, next_left], [right, next_right]].iter().for_each(|side| pen.line(side, "axis"));
    pen.area(&[[-9.0, -theta_map], [90.0, -theta_map], [90.0, theta_map], [-9.0, theta_map]], ROAD);
    pen.line(&[a, b], "road");
    pen.words([19.4, theta_map], [0.0, -3.0], "m", "theta_map");
    pen.words([-1.6, right[1]], [0.0, -5.0], "", "corridor");
}

fn draw_tracks(pen: &mut Pen<'_>, scene: &Scene, within: &[Point], wrong: Option<usize>) {
    let track = &scene.tracks.as_ref().expect("given").items[0];
    pen.rectangle(&track.object.rectangle(), "track");
    for (i, point) in within.iter().enumerate() {
        let mut then = track.object.clone();
        let t = Real::seconds(i128::from(point.t_ns - NOW_NS));
        then.frame.origin = &then.frame.origin + &track.velocity.scaled(&t);
        let is_wrong = wrong == Some(i);
        pen.rectangle(&then.rectangle(), if is_wrong { "wrong" } else { FAINT });
        if i == 0 || i + 2 == within.len() {
            let up = if is_wrong { -16.0 } else { 4.0 };
            pen.words(xy(&then.frame.origin), [12.0, up], "", &format!("{:.1} s", t.near()));
        }
    }
}

fn draw_detections(pen: &mut Pen<'_>, scene: &Scene) {
    let items = scene.detections.iter().flat_map(|list| &list.items);
    items.for_each(|item| pen.rectangle(&item.rectangle(), "det"));
    for gap in scene.lead.iter().map(|lead| lead.gap.near()) {
        pen.bar(3.8, 3.8 + gap, -2.0, "gap");
        pen.words([7.8 + gap, 0.0], [6.0, 4.0], "", "leading");
    }
}

fn draw_grid(pen: &mut Pen<'_>, scene: &Scene) {
    let (grid, cav) = (scene.grid.as_ref().expect("current"), &cav(scene, &own(scene)));
    let (side, r) = (&grid.resolution, &radius(scene, &cav.half_width));
    let marked = |cell| {
        let centre = &cells::centre(cell, side);
        dilated(scene, grid, &Disk { point: 0, cav, centre, r }).is_some()
    };
    let at = |column: i64, row: i64| {
        let [x, y] = [column, row].map(|k| Real::from_integer(k.into()) * side);
        xy(&grid.frame.point(&x, &y))
    };
    let columns: Vec<i64> = (0..grid.width).collect();
    for row in 0..grid.height {
        let mut area = |from: i64, to: i64, look: &str| {
            pen.area(&[at(from, row), at(to, row), at(to, row + 1), at(from, row + 1)], look);
        };
        for run in columns.chunk_by(|a, b| marked((*a, row)) == marked((*b, row))) {
            if marked((run[0], row)) {
                area(run[0], run[run.len() - 1] + 1, MARKED);
            }
        }
        let occupied = columns.iter().filter(|column| grid.is_occupied((**column, row)));
        occupied.for_each(|column| area(*column, column + 1, CELL));
    }
}

fn draw_disks(pen: &mut Pen<'_>, scene: &Scene, point: &Point, witness: Option<&Witness>) {
    let cav = cav(scene, &point.pose);
    for i in 0..scene.parameters.n {
        let [number, n] = [i, scene.parameters.n].map(|it| Real::from_integer(it.into()));
        let centre =
            xy(&cav.frame.point(&disk_offset(&number, &n, &scene.ego.length), &Real::zero()));
        let is_wrong = witness.is_some_and(|it| it.disk == usize::try_from(i).ok());
        pen.circle(centre, radius(scene, &cav.half_width).near(), "limit");
        pen.dot(centre, if is_wrong { 5.0 } else { 2.6 }, if is_wrong { "wrong" } else { "tip" });
    }
}
