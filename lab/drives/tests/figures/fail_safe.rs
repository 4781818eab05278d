//! H-14: places, windows, reach and motions.

use mufasa_model::hardened::h14_fail_safe::excess;
use mufasa_model::hardened::h14_fail_safe::motions::{Motion, all_motions};
use mufasa_model::hardened::h14_fail_safe::path::{first_ahead, places};
use mufasa_model::hardened::h14_fail_safe::reach;
use mufasa_model::hardened::h14_fail_safe::times::{Driving, a_tyre, window};
use mufasa_model::input::scene::Scene;
use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::vector::Vector;
use mufasa_model::stages::llcc::cav;
use serde_json::json;

use crate::sheet::{Look, Pen, Sheet, corners, xy};
use crate::world::{ego, scene, seen, tracks, trajectory};

/// Nodes, places, and where the list ends.
pub fn path() -> String {
    let points =
        [[-1.3, 0.3, 0.0], [0.08, 0.25, 0.05], [1.6, 0.25, 0.1], [2.9, 0.6, 0.35], [3.9, 1.0, 0.4]];
    let scene = scene(&json!({"ego": ego(8.0), "trajectory": trajectory(200_000_000, &points)}));
    let points = scene.trajectory.as_ref().expect("it is current");
    let places: Vec<_> = places(&scene, points).collect();
    let (first, last) = (first_ahead(&scene, points).expect("one is"), &places[places.len() - 1]);
    let words = format!(
        "Large circles: nodes. Dots: places, at most d = 1/4 m apart along x and along y. Thin line: the trajectory as it was sent. \
         Progress of the last place: s_stop = {:.2} m, here for v = 8 m/s.",
        last.progress.near()
    );
    let mut sheet = Sheet::new(1, [880.0, 420.0], 2);
    let look = Look {
        title: "The path of the CAV and its places",
        words: &words,
        low: [-2.2, -1.2],
        scale: [80.0; 2],
    };
    sheet.panel(&look, |pen| {
        pen.rectangle(&cav(&scene, &places[0].pose), "cav");
        pen.rectangle(&cav(&scene, &last.pose), "cavs");
        let sent: Vec<_> = points.iter().map(|point| xy(&point.pose.origin)).collect();
        pen.line(&sent, "axis");
        pen.line(&places.iter().map(|place| xy(&place.pose.origin)).collect::<Vec<_>>(), "path");
        sent[..first].iter().for_each(|at| pen.dot(*at, 3.0, "axis"));
        let nodes = [[0.0, 0.0]].into_iter().chain(sent[first..].iter().copied());
        nodes.for_each(|at| pen.dot(at, 6.5, "node"));
        places.iter().for_each(|place| pen.dot(xy(&place.pose.origin), 2.6, "place"));
        pen.words([0.0, 0.0], [-8.0, 24.0], "m", "p");
        pen.words(sent[0], [0.0, -12.0], "m", "passed: no node");
        pen.words(sent[1], [6.0, -24.0], "", "not 1/8 m ahead: no node");
        pen.arrow([0.24, 0.5], [0.1, 0.29]);
        pen.words(sent[first], [0.0, 26.0], "m", "first node ahead");
        pen.words([0.5, -0.12], [0.0, 0.0], "", "piece");
        pen.words(sent[4], [-16.0, -14.0], "e", "last point, last node");
        let end = xy(&last.pose.origin);
        pen.words(end, [10.0, 14.0], "", "last place: progress = s_stop");
        pen.words(end, [-24.0, 50.0], "", "straight on behind the last node");
        pen.arrow([end[0] - 0.3, end[1] - 0.52], [end[0] - 0.4, end[1] - 0.25]);
    });
    sheet.finish()
}

/// When the CAV can be where.
pub fn windows() -> String {
    let scene =
        scene(&json!({"ego": ego(8.0), "trajectory": trajectory(200_000_000, &[[0.0, 0.0, 0.0]])}));
    let (driving, points) =
        (Driving::of(&scene), scene.trajectory.as_ref().expect("it is current"));
    let [s_tyre, s_stop, t] =
        [driving.s_tyre(driving.v), driving.s_stop(), driving.t_stop()].map(|it| it.near());
    let words = "A bar for each place, straight on: from first at the place before to last at the place after. Neighbours overlap. \
                 Where the place after it is at s_tyre(v) or farther the CAV may stand: these bars end at H(w), or at T for an object that comes across.";
    let mut sheet = Sheet::new(1, [880.0, 400.0], 2);
    let look = Look {
        title: "Windows: time over distance, v = 8 m/s",
        words,
        low: [-0.5, -0.15],
        scale: [150.0, 240.0],
    };
    sheet.panel(&look, |pen| {
        for place in places(&scene, points) {
            let window = window(&scene.reads, &driving, &place.least, place.length_after.as_ref());
            let (way, begin) = (place.progress.near(), window.begin.near());
            let bar = |low: f64, high: f64| {
                [[way - 0.05, low], [way + 0.05, low], [way + 0.05, high], [way - 0.05, high]]
            };
            pen.area(&bar(begin, window.end.as_ref().map_or(t, Real::near)), "cav");
            if window.end.is_none() {
                pen.area(&bar(t, 2.0), "swept");
            }
        }
        let curve = |of: &dyn Fn(&Real) -> Real, end: f64| -> Vec<[f64; 2]> {
            let ways = (0..=30).map(|k| end * (1.0 - (1.0 - f64::from(k) / 30.0).powi(2)));
            ways.map(|f| [f, of(&Real::from_double(f)).near()]).collect()
        };
        pen.line(&curve(&|f| driving.first(f), s_stop), "path");
        pen.line(&curve(&|f| driving.last(f), s_tyre), "path");
        pen.arrow([-0.1, 0.0], [5.6, 0.0]);
        pen.arrow([0.0, -0.05], [0.0, 1.48]);
        pen.words([5.6, 0.0], [-24.0, 18.0], "", "distance, m");
        pen.words([0.0, 1.48], [-62.0, 12.0], "", "time, s");
        pen.line(&[[0.0, t], [5.4, t]], "limit");
        pen.words([0.0, t], [-18.0, 4.0], "", "T");
        pen.line(&[[s_tyre, -0.04], [s_tyre, 1.5]], "limit");
        pen.words([s_tyre, 0.0], [0.0, 24.0], "m", "s_tyre(v)");
        pen.line(&[[s_stop, -0.04], [s_stop, 1.5]], "limit");
        pen.words([s_stop, 0.0], [0.0, 24.0], "m", "s_stop");
        pen.words([1.9, 0.5], [0.0, -8.0], "e", "last(f)");
        pen.words([4.4, 0.6], [0.0, 34.0], "", "first(f)");
        pen.words([s_tyre - 0.25, 1.35], [-16.0, 0.0], "e", "the CAV may stand");
    });
    sheet.finish()
}

/// How far aside the CAV can drive, and lateral_tolerance.
pub fn reach() -> String {
    let swerve = |aside: f64| -> Vec<[f64; 3]> {
        let angle = |x: f64| (aside * 0.24 * (x / 4.0).min(1.0)).atan();
        let mut y = 0.0;
        let point = |k: i32| {
            let x = f64::from(k) * 0.5;
            y += 0.5 * angle(x).tan();
            [x, y, angle(x)]
        };
        (0..14).map(point).collect()
    };
    let ways = [("Within reach", swerve(1.4)), ("Not within reach", swerve(6.0))];
    let mut sheet = Sheet::new(2, [430.0, 330.0], 1);
    for (title, points) in ways {
        let scene = scene(&json!({"trajectory": trajectory(50_000_000, &points)}));
        let points = scene.trajectory.as_ref().expect("it is current");
        let failure = reach::failure(&scene, points).and_then(|witness| witness.point);
        let driving = Driving::of(&scene);
        let words = failure.map_or(
            "No place has an excess above lateral_tolerance.",
            |_| "Red: the first place with too great an excess, by its heading.",
        );
        let look = Look { title, words, low: [-0.4, -1.2], scale: [62.0; 2] };
        sheet.panel(&look, |pen| {
            let limit = |side: f64| -> Vec<[f64; 2]> {
                let ways = (0..50).map(|k| driving.s_stop().near() * f64::from(k) / 50.0);
                // The excess on the line is below 0 by as much as the circle leads aside.
                let limit = |f: f64| {
                    let ahead = Vector { x: Real::from_double(f), y: Real::zero() };
                    0.5 - excess::of_point(&scene, &ahead).near()
                };
                ways.map(|f| [f, side * limit(f)]).collect()
            };
            [1.0, -1.0].iter().for_each(|side| pen.line(&limit(*side), "limit"));
            pen.arrow([0.0, 0.0], [6.3, 0.0]);
            pen.words([6.0, 0.0], [0.0, 18.0], "m", "f");
            pen.words([2.5, 1.75], [-20.0, 0.0], "e", "limit, v = 10 m/s");
            for (k, place) in places(&scene, points).enumerate() {
                let is_first = failure == Some(points.len() + k);
                pen.dot(
                    xy(&place.pose.origin),
                    if is_first { 6.0 } else { 2.6 },
                    if is_first { "wrong" } else { "place" },
                );
            }
            pen.words([0.0, 0.0], [0.0, 20.0], "m", "p");
        });
    }
    sheet.finish()
}

/// What a motion is, and what it sweeps over.
pub fn motions() -> String {
    let mut sheet = Sheet::new(2, [430.0, 250.0], 3);
    swept(&mut sheet);
    candidates(&mut sheet);
    sheet.finish()
}

fn swept(sheet: &mut Sheet) {
    let item = ([0.0, 0.0, 0.2, 4.0, 1.8], [9.8, 1.99]);
    let scene = scene(&json!({"tracks": tracks(0.1, &[item])}));
    let motion = &all_motions(&scene)[0];
    let strip = |from: f64, to: f64| strip(&scene, motion, from, to);
    let look = Look {
        title: "Swept over in the window from 0.5 s to 0.7 s",
        words: "Dashed orange: at the time of the list. Dashed purple: the window's strip, from braking with a_tyre since then to going on.",
        low: [-2.6, -2.4],
        scale: [33.0; 2],
    };
    sheet.panel(&look, |pen| {
        pen.rectangle(&motion.object.rectangle(), "item");
        pen.area(&strip(0.0, 0.0)[..], "object");
        pen.area(&strip(0.5, 0.7)[..], "swept");
        pen.arrow([0.0, 0.0], [2.94, 0.6]);
        pen.words([2.94, 0.6], [4.0, 16.0], "", "w");
        pen.words([0.9, -1.3], [0.0, 20.0], "m", "now");
        pen.words([6.8, 3.0], [0.0, -8.0], "m", "in the window");
    });
}

/// The convex hull of what a motion covers in a window.
fn strip(scene: &Scene, motion: &Motion, from: f64, to: f64) -> Vec<[f64; 2]> {
    let [from, to] = [from, to].map(|t| &motion.age + Real::from_double(t));
    let ends = [motion.r_b(&a_tyre(&scene.parameters.a_b), &from), &motion.speed * &to];
    let moved = ends.iter().flat_map(|r| {
        let [x, y] = xy(&motion.moved_by(r));
        corners(&motion.object.rectangle()).map(|[a, b]| [a + x, b + y])
    });
    hull(moved.collect())
}

/// The convex hull of points, by Andrew's chains.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            let turns = |a: [f64; 2], b: [f64; 2]| {
                (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0.0
            };
            while chain.len() > 1 && !turns(chain[chain.len() - 2], chain[chain.len() - 1]) {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let lower = chain(&mut points.iter());
    let upper = chain(&mut points.iter().rev());
    lower.into_iter().chain(upper).collect()
}

fn candidates(sheet: &mut Sheet) {
    let car = |x: f64, y: f64| [x, y, 0.0, 4.0, 1.8];
    let then = [[-0.8, 0.2], [-6.0, -2.0], [-5.0, 3.2]];
    let earlier = [[-9.6, -3.2], [12.0, 9.0]];
    let scene = scene(&json!({
        "detections": seen(0.0, &[car(0.0, 0.0)]),
        "detection_history": [seen(0.5, &then.map(|[x, y]| car(x, y))), seen(0.8, &earlier.map(|[x, y]| car(x, y)))],
    }));
    let motions = all_motions(&scene);
    let look = Look {
        title: "Motions of an unexplained detection d",
        words: "Dashed: items d' of the reference list. An arrow: w = (d - d')/dt of a candidate, over 0.5 s. The detection counts as \
                standing, too (w = 0).",
        low: [-9.0, -4.2],
        scale: [26.0; 2],
    };
    sheet.panel(&look, |pen| {
        draw_candidates(pen, &scene, &motions);
    });
}

fn draw_candidates(pen: &mut Pen<'_>, scene: &Scene, motions: &[Motion]) {
    pen.rectangle(&scene.detections.as_ref().expect("current").items[0].rectangle(), "det");
    pen.words([0.0, 0.9], [0.0, -5.0], "m", "d");
    let words =
        ["stood: within theta_track_max", "may come from it", "no candidate: no list supports it"];
    let by = [[70.0, 44.0], [0.0, 42.0], [20.0, -30.0]];
    for (i, item) in scene.detection_history[0].items.iter().enumerate() {
        pen.rectangle(&item.rectangle(), "item");
        let at = xy(&item.frame.origin);
        let is_candidate = motions.iter().any(|motion| motion.named.item == Some(i));
        assert_eq!(is_candidate, i < 2, "the words are right");
        pen.words(at, by[i], "m", words[i]);
    }
    for motion in motions {
        let [x, y] = xy(&motion.w);
        if x.hypot(y) > 0.0 {
            pen.arrow([0.0, 0.0], [x * 0.5, y * 0.5]);
        }
    }
}
