//! H-01, H-04, H-06, H-07 and H-11: what the model passes and what it does not.

use std::f64::consts::PI;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use mufasa_model::hardened::h04_gap::s_react;
use mufasa_model::hardened::h11_steps::step_failure;
use mufasa_model::hardened::h14_fail_safe::path::places;
use mufasa_model::hardened::h14_fail_safe::times::Driving;
use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::rectangle::Rectangle;
use mufasa_model::report::{Outcome, Stage};
use mufasa_model::stages::distances::s_b;
use mufasa_model::stages::horizon::points_within;
use mufasa_model::stages::llcc::cav;
use mufasa_model::stages::v_grid_map::{disk_offset, disk_radius};
use serde_json::{Value, json};

use crate::sheet::{Look, Pen, Sheet, xy};
use crate::world::{NOW_NS, ego, merged, outcome, own, scene, seen, tracks, trajectory};

/// A ghost in the mean, and a detection that is missing.
pub fn h01() -> String {
    let car = |x: f64, y: f64| [x, y, 0.0, 4.0, 1.8];
    let places = [8.0, 15.0, 22.0, 29.0, 36.0, 43.0];
    let row = |dx: f64, dy: f64| places.map(|x| car(x + dx, dy));
    let still = |at: &[f64; 5]| (*at, [0.0, 0.0]);
    let history: Vec<Value> = [0.3, 0.5, 0.8].map(|age| seen(age, &row(0.0, 0.0))).into();
    let mut detections = row(0.0, 0.0);
    detections[5][1] = 1.15;
    let ghost = json!({"tracks": tracks(0.0, &row(0.0, 0.0).map(|at| still(&at))), "detections": seen(0.0, &detections)});
    let mut missing = row(0.0, 0.0);
    missing[2] = car(50.0, 2.0);
    let missed = json!({"tracks": tracks(0.0, &row(0.0, 0.0).map(|at| still(&at))),
                        "detections": seen(0.0, &missing), "detection_history": history});
    let mut sheet = Sheet::new(1, [880.0, 90.0], 1);
    for (title, changes) in [
        ("A ghost hides in the mean", ghost),
        ("One detection is missing, another is clutter", missed),
    ] {
        let [paper, hardened] = ["paper", "hardened"].map(|profile| {
            let changes = merged(changes.clone(), &json!({"profile": profile}));
            match outcome(&changes, Stage::I) {
                Outcome::Failed(witness) => format!("{profile}: stage i fails, {:?}", witness.rule),
                _ => format!("{profile}: stage i passes"),
            }
        });
        let words = format!("Blue: tracks. Orange: detections. {paper}. {hardened}.");
        let scene = scene(&changes);
        let look = Look { title, words: &words, low: [-2.0, -2.5], scale: [16.0; 2] };
        sheet.panel(&look, |pen| {
            pen.rectangle(&cav(&scene, &own(&scene)), "cav");
            let tracks = scene.tracks.iter().flat_map(|list| &list.items);
            tracks.for_each(|track| pen.rectangle(&track.object.rectangle(), "track"));
            let detections = scene.detections.iter().flat_map(|list| &list.items);
            detections.for_each(|item| pen.rectangle(&item.rectangle(), "det"));
        });
    }
    sheet.finish()
}

/// Points within s_b from the first one, places up to s_stop from the CAV.
pub fn h04() -> String {
    let points: Vec<_> = (0..5).map(|k| [f64::from(k) * 2.0 - 3.5, 0.0, 0.0]).collect();
    let scene = scene(&json!({"trajectory": trajectory(200_000_000, &points)}));
    let points = scene.trajectory.as_ref().expect("it is current");
    let driving = Driving::of(&scene);
    let s_b = s_b(&scene.ego.v_now, &scene.parameters.a_b);
    let gaps = [10.0, 5.0, 0.0].map(|v| {
        format!("{:.1} m behind {v} m/s", s_react(&driving, &Real::from_double(v)).near())
    });
    let words = format!(
        "v = 10 m/s. Stage v of the paper examines the points within s_b of the first one (large circles). H-04 adds the places \
         (dots). A gap that is measured now has to be above s_react: {}.",
        gaps.join(", ")
    );
    let mut sheet = Sheet::new(1, [880.0, 170.0], 2);
    let look = Look {
        title: "How far the grid is examined",
        words: &words,
        low: [-5.0, -2.4],
        scale: [48.0; 2],
    };
    sheet.panel(&look, |pen| {
        let places: Vec<_> = places(&scene, points).collect();
        let last = &places[places.len() - 1].pose;
        pen.rectangle(&cav(&scene, &own(&scene)), "cav");
        pen.rectangle(&cav(&scene, last), "cavs");
        for point in points_within(&scene, points, &s_b) {
            pen.dot(xy(&point.pose.origin), 7.0, "node");
        }
        points.iter().for_each(|point| pen.dot(xy(&point.pose.origin), 3.0, "line"));
        places.iter().for_each(|place| pen.dot(xy(&place.pose.origin), 2.4, "place"));
        let first = xy(&points[0].pose.origin)[0];
        pen.bar(first, first + s_b.near(), -1.75, "s_b from the first point");
        pen.bar(0.0, xy(&last.origin)[0], -2.2, "s_stop from p");
        pen.words([0.0, 0.0], [0.0, 22.0], "m", "p");
        pen.words(xy(&last.origin), [0.0, -10.0], "m", "last place");
    });
    sheet.finish()
}

const COLUMNS: usize = 24;
const ROWS: usize = 14;
const SIDE: f64 = 0.4;
const CORNER: [f64; 2] = [-2.8, -2.8];

/// Each cell alone in the grid: does stage v fail?
pub fn h06() -> String {
    let ahead = [5.2, 0.3, 0.2, 2.4, 1.6];
    let standing =
        json!({"ego": ego(0.0), "trajectory": trajectory(100_000_000, &[[0.0, 0.0, 0.0]])});
    let views = [
        (
            "paper",
            json!({"profile": "paper"}),
            "Red: stage v fails when this cell alone is occupied.",
        ),
        ("hardened, no detection", json!({}), "Each cell that a disk reaches."),
        (
            "hardened, a detection",
            json!({"detections": seen(0.0, &[ahead])}),
            "Cells that the CAV meets and no detection covers.",
        ),
    ];
    let mut sheet = Sheet::new(3, [288.0, 168.0], 2);
    for (title, changes, words) in views {
        let with = merged(standing.clone(), &changes);
        let look = Look { title, words, low: CORNER, scale: [30.0; 2] };
        sheet.panel(&look, |pen| grid(pen, &with));
    }
    sheet.finish()
}

fn grid(pen: &mut Pen<'_>, with: &Value) {
    let empty = scene(with);
    let fails = |cell: usize| {
        let with = merged(with.clone(), &json!({"grid": only(cell)}));
        matches!(outcome(&with, Stage::V), Outcome::Failed(_))
    };
    let metres = |count: usize| u32::try_from(count).map_or(0.0, f64::from) * SIDE;
    for row in 0..ROWS {
        let hits: Vec<bool> = (0..COLUMNS).map(|column| fails(row * COLUMNS + column)).collect();
        let mut column = 0;
        for run in hits.chunk_by(|a, b| a == b) {
            let [low, left] = [CORNER[1] + metres(row), CORNER[0] + metres(column)];
            column += run.len();
            let [high, right] = [low + SIDE, CORNER[0] + metres(column)];
            if run[0] {
                pen.area(&[[left, low], [right, low], [right, high], [left, high]], "hit");
            }
        }
    }
    let body = cav(&empty, &own(&empty));
    let (n, ego) = (Real::from_integer(4), &empty.ego);
    for i in 0..4 {
        let centre =
            body.frame.point(&disk_offset(&Real::from_integer(i), &n, &ego.length), &Real::zero());
        pen.circle(xy(&centre), disk_radius(&ego.length, &ego.width, &n).near(), "limit");
    }
    pen.rectangle(&body, "cav");
    for item in empty.detections.iter().flat_map(|list| &list.items) {
        let quarter = Real::from_double(0.25);
        let Rectangle { frame, half_length, half_width } = item.rectangle();
        pen.rectangle(&item.rectangle(), "det");
        let grown = Rectangle {
            frame,
            half_length: half_length + &quarter,
            half_width: half_width + &quarter,
        };
        pen.rectangle(&grown, "item");
    }
}

/// A grid with one occupied cell.
fn only(cell: usize) -> Value {
    let mut bytes = vec![0_u8; (COLUMNS * ROWS).div_ceil(8)];
    bytes[cell / 8] |= 1 << (cell % 8);
    json!({"stamp_ns": NOW_NS, "x": CORNER[0], "y": CORNER[1], "cos": 1, "sin": 0, "resolution": SIDE,
           "width": COLUMNS, "height": ROWS, "occupied": STANDARD.encode(&bytes), "unknown": null})
}

/// Where the first point may be, and how it may be turned.
pub fn h07() -> String {
    let passes = |point: [f64; 3]| {
        let changes = json!({"trajectory": trajectory(100_000_000, &[point])});
        outcome(&changes, Stage::Ii) == Outcome::Passed
    };
    let mut sheet = Sheet::new(2, [430.0, 200.0], 3);
    let words = "Dots: where a first point with the CAV's heading passes, t0 = now: within start_tolerance of p (circle), not aside where it passes p (H-07.5), and within reach (H-14.15).";
    let look =
        Look { title: "Where the first point may be", words, low: [-3.2, -2.3], scale: [43.0; 2] };
    sheet.panel(&look, |pen| {
        let scene = scene(&json!({}));
        pen.rectangle(&cav(&scene, &own(&scene)), "cavs");
        pen.circle([0.0, 0.0], scene.parameters.start_tolerance.near(), "limit");
        for x in -12..=12 {
            for y in -4..=4 {
                let at = [f64::from(x) * 0.2, f64::from(y) * 0.2];
                if passes([at[0], at[1], 0.0]) {
                    pen.dot(at, 2.5, "yes");
                }
            }
        }
        pen.dot([0.0, 0.0], 4.0, "place");
        pen.words([0.0, 0.0], [0.0, 44.0], "m", "p");
    });
    let words = "Lines: headings of a first point at p that pass, in steps of 2 degrees: abs(h_0 x h) <= 0.17 and h_0 . h > 0.";
    let look = Look { title: "How it may be turned", words, low: [-1.0, -2.3], scale: [43.0; 2] };
    sheet.panel(&look, |pen| {
        for k in -90..90 {
            let angle = PI * f64::from(k) / 90.0;
            if passes([0.0, 0.0, angle]) {
                pen.line(&[[0.0, 0.0], [6.5 * angle.cos(), 6.5 * angle.sin()]], "path");
            }
        }
        pen.arrow([0.0, 0.0], [7.2, 0.0]);
        pen.words([7.2, 0.0], [0.0, -8.0], "m", "h");
        pen.words([0.0, 0.0], [0.0, 22.0], "m", "p");
    });
    sheet.finish()
}

/// Where the second point may be.
pub fn h11() -> String {
    let mut sheet = Sheet::new(3, [288.0, 170.0], 3);
    for turned in [0.0, 0.2, 0.5_f64] {
        let title = format!("Second heading turned by {turned}");
        let look = Look {
            title: &title,
            words: "Green: where the second point passes, 0.1 s later. Steps are at most L long, and W/2 aside of both headings.",
            low: [-0.7, -1.3],
            scale: [48.0; 2],
        };
        sheet.panel(&look, |pen| {
            let passes = |x: f64, y: f64| {
                let scene = scene(&json!({"trajectory": trajectory(100_000_000, &[[0.0, 0.0, 0.0], [x, y, turned]])}));
                step_failure(&scene, scene.trajectory.as_ref().expect("it is current")).is_none()
            };
            for k in -2..=26 {
                let x = f64::from(k) * 0.2;
                let ys: Vec<f64> = (-50..=100).map(|i| f64::from(i) * 0.02).filter(|y| passes(x, *y)).collect();
                if let (Some(low), Some(high)) = (ys.first(), ys.last()) {
                    pen.area(&[[x - 0.08, *low], [x + 0.08, *low], [x + 0.08, *high], [x - 0.08, *high]], "yes");
                }
            }
            pen.arrow([0.0, 0.0], [0.9, 0.0]);
            pen.words([0.0, 0.0], [0.0, 20.0], "m", "h1");
            pen.arrow([3.8, -0.9], [3.8 + 0.9 * turned.cos(), -0.9 + 0.9 * turned.sin()]);
            pen.words([3.8, -0.9], [-6.0, 4.0], "e", "h2");
        });
    }
    sheet.finish()
}
