//! H-14: objects that are not examined.

use std::f64::consts::PI;

use mufasa_model::hardened::h14_fail_safe::meeting::{
    BesideRoute, comes_across, follows, goes_along, inner, is_behind, now,
};
use mufasa_model::hardened::h14_fail_safe::motions::{Motion, all_motions};
use mufasa_model::hardened::h14_fail_safe::path::places;
use mufasa_model::numbers::polyline::{beside as beside_path, nearest_point};
use mufasa_model::stages::llcc::cav;
use serde_json::{Value, json};

use crate::sheet::{Look, Pen, Sheet, xy};
use crate::world::{NOW_NS, ego, own, scene, station, tracks, trajectory};

/// An object at (x, y) that drives into a direction.
fn object(x: f64, y: f64, angle: f64, speed: f64) -> ([f64; 5], [f64; 2]) {
    ([x, y, angle, 4.0, 1.8], [speed * angle.cos(), speed * angle.sin()])
}

/// Behind, comes across, goes along and follows, in one panel each.
pub fn others() -> String {
    let mut sheet = Sheet::new(2, [430.0, 230.0], 3);
    inner_rectangle(&mut sheet);
    across(&mut sheet);
    following(&mut sheet);
    along(&mut sheet);
    sheet.finish()
}

fn inner_rectangle(sheet: &mut Sheet) {
    let scene = scene(&json!({}));
    let look = Look {
        title: "Inner rectangle",
        words: "v = 10 m/s. Its front is 0.3 m in; its other sides 0.3 m, or less where s_b(v) is less, and 0 for an object that is behind (dashed line).",
        low: [-2.0, -1.7],
        scale: [68.0; 2],
    };
    sheet.panel(&look, |pen| {
        pen.rectangle(&cav(&scene, &own(&scene)), "cav");
        pen.rectangle(&inner(&scene, true), "limit");
        pen.rectangle(&inner(&scene, false), "inner");
        pen.dot([0.0, 0.0], 3.0, "place");
        pen.words([0.0, 0.0], [8.0, 4.0], "", "p");
        pen.arrow([2.2, 0.0], [4.2, 0.0]);
        pen.words([4.2, 0.0], [-12.0, -8.0], "", "h");
    });
}

fn across(sheet: &mut Sheet) {
    let items = [
        object(1.6, -5.4, PI / 2.0, 6.0),
        object(8.0, 4.2, -PI / 2.0, 6.0),
        object(-6.0, 1.95, 0.0, 6.0),
    ];
    let scene = scene(&json!({"tracks": tracks(0.0, &items)}));
    let look = Look {
        title: "Comes across",
        words: "Straight on, it shares a point with the inner rectangle of the CAV at p. An object that passes before it, or would scrape along its side, does not.",
        low: [-9.0, -7.8],
        scale: [16.0; 2],
    };
    sheet.panel(&look, |pen| {
        pen.rectangle(&cav(&scene, &own(&scene)), "cav");
        pen.rectangle(&inner(&scene, false), "inner");
        for motion in all_motions(&scene) {
            let behind = is_behind(&scene, &motion);
            let words =
                if comes_across(&scene, &motion, behind) { "comes across" } else { "does not" };
            named(pen, &motion, words, 1.4);
        }
    });
}

/// An object, its velocity over some seconds, and words.
fn named(pen: &mut Pen<'_>, motion: &Motion, words: &str, seconds: f64) {
    let object = now(motion);
    pen.rectangle(&object.rectangle(), "object");
    let ([x, y], [vx, vy]) = (xy(&object.frame.origin), xy(&motion.w));
    pen.arrow([x, y], [x + vx * seconds, y + vy * seconds]);
    let turned = if vy.abs() > 0.3 * vx.abs() { 46.0 } else { 32.0 };
    let by = if vx.abs() > vy.abs() { [0.0, turned] } else { [20.0, 4.0] };
    pen.words([x, y], by, if vx.abs() > vy.abs() { "m" } else { "" }, words);
}

fn following(sheet: &mut Sheet) {
    let items =
        [object(-9.0, 0.2, 0.02, 12.0), object(-7.5, -4.6, 0.6, 8.0), object(-2.8, 3.0, 0.0, 10.0)];
    let scene = scene(&json!({"tracks": tracks(0.0, &items)}));
    let look = Look {
        title: "Behind, and follows",
        words: "An object that follows is behind, comes across, goes along, and drives within 45 degrees of h. One that merges at a larger angle is examined.",
        low: [-13.0, -7.0],
        scale: [20.0; 2],
    };
    sheet.panel(&look, |pen| {
        pen.rectangle(&cav(&scene, &own(&scene)), "cav");
        for motion in all_motions(&scene) {
            let behind = is_behind(&scene, &motion);
            let comes_across = comes_across(&scene, &motion, behind);
            let words = match (behind, follows(&scene, &motion, comes_across, behind)) {
                (_, true) => "behind, follows",
                (true, false) => "behind, examined",
                (false, false) => "not behind",
            };
            named(pen, &motion, words, 0.4);
        }
    });
}

fn along(sheet: &mut Sheet) {
    let look = Look {
        title: "Goes along",
        words: "Green: directions of w with which an object there goes along the CAV, that of h or the opposite one within a bend of 30 m radius. Red: every other, examined as it drives.",
        low: [-4.0, -9.0],
        scale: [11.0; 2],
    };
    sheet.panel(&look, |pen| {
        let standing = scene(&json!({}));
        pen.rectangle(&cav(&standing, &own(&standing)), "cav");
        for [x, y] in [[6.0, 5.5], [15.0, -4.0], [23.0, 5.5], [31.0, -4.0]] {
            for k in 0..24 {
                let angle = PI * f64::from(k) / 12.0;
                let scene = scene(&json!({"tracks": tracks(0.0, &[object(x, y, angle, 10.0)])}));
                let is_along = goes_along(&scene, &all_motions(&scene)[0]);
                let tip = [x + 3.6 * angle.cos(), y + 3.6 * angle.sin()];
                pen.dot(tip, 4.0, if is_along { "yes" } else { "no" });
            }
            pen.dot([x, y], 3.0, "line");
            pen.words([x, y], [0.0, 20.0], "m", &format!("{:.0} m", x.hypot(y)));
        }
    });
}

/// A route along a bend, and one that turns off.
pub fn beside() -> String {
    let mut sheet = Sheet::new(2, [430.0, 300.0], 3);
    let bend: Vec<[f64; 3]> = (-2..=18)
        .map(|k| on_arc(60.0, f64::from(k) * 3.0))
        .map(|[x, y, angle]| [x, y + 1.0, angle])
        .collect();
    let own: Vec<[f64; 3]> = (0..8).map(|k| on_arc(61.0, f64::from(k) * 3.0)).collect();
    let exit: Vec<[f64; 3]> = (-2..=18)
        .map(|k| f64::from(k) * 3.0)
        .map(|s| {
            if s < 9.0 { [s, 0.0, 0.0] } else { moved(on_arc(12.0, (s - 9.0).min(18.0)), s - 27.0) }
        })
        .collect();
    let other = on_arc(56.5, 24.0);
    let oncoming = object(other[0], other[1] + 4.5, other[2] + PI, 8.0);
    panel(&mut sheet, "Keeps beside: the route bends", [&bend, &own], oncoming, true);
    let own: Vec<[f64; 3]> = exit.iter().copied().filter(|[x, ..]| *x >= 0.0).take(8).collect();
    panel(
        &mut sheet,
        "Does not: the route turns off",
        [&exit, &own],
        object(22.0, 3.6, PI, 8.0),
        false,
    );
    sheet.finish()
}

/// x, y and angle after a way on an arc to the left that begins at 0 along x.
fn on_arc(radius: f64, way: f64) -> [f64; 3] {
    let angle = way / radius;
    [radius * angle.sin(), radius * (1.0 - angle.cos()), angle]
}

/// 9 m farther along x, and a way straight on where it is above 0.
fn moved([x, y, angle]: [f64; 3], way: f64) -> [f64; 3] {
    let way = way.max(0.0);
    [9.0 + x + way * angle.cos(), y + way * angle.sin(), angle]
}

fn panel(
    sheet: &mut Sheet,
    title: &str,
    [route, own_points]: [&[[f64; 3]]; 2],
    other: ([f64; 5], [f64; 2]),
    is_beside: bool,
) {
    let stations: Vec<Value> =
        route.iter().map(|[x, y, angle]| station(*x, *y, angle.cos(), angle.sin())).collect();
    let scene = scene(&json!({
        "ego": ego(10.0), "trajectory": trajectory(200_000_000, own_points), "tracks": tracks(0.0, &[other]),
        "route": {"closed": false, "stations": stations}, "now_ns": NOW_NS,
    }));
    let points = scene.trajectory.as_ref().expect("it is current");
    let motion = &all_motions(&scene)[0];
    let behind = is_behind(&scene, motion);
    assert_eq!(
        BesideRoute::new(&scene, points).keeps_beside(&scene, motion, behind),
        is_beside,
        "{title}"
    );
    let words = if is_beside {
        "Measured from the route (dashed) the other stays at D, and the CAV at place k at D_k. Straight on (arrow) they would meet. \
         E_k is half of what the CAV covers across the route, and a."
    } else {
        "The route turns off before the other: its distance from the route says nothing of whether it meets the path. It is examined \
         straight on."
    };
    let look = Look { title, words, low: [-4.0, -4.5], scale: [13.0; 2] };
    sheet.panel(&look, |pen| {
        let path = scene.route.reference_path();
        pen.line(&route.iter().map(|[x, y, _]| [*x, *y]).collect::<Vec<_>>(), "road");
        let all: Vec<_> = places(&scene, points).collect();
        for place in all.iter().step_by(8) {
            pen.rectangle(&cav(&scene, &place.pose), "cavs");
        }
        pen.rectangle(&cav(&scene, &all[0].pose), "cav");
        all.iter().step_by(2).for_each(|place| pen.dot(xy(&place.pose.origin), 1.6, "place"));
        let object = now(motion);
        pen.rectangle(&object.rectangle(), "object");
        let c = &object.frame.origin;
        let ([x, y], [vx, vy]) = (xy(c), xy(&motion.w));
        pen.arrow([x, y], [x + vx * 1.6, y + vy * 1.6]);
        let near = nearest_point(c, &path[beside_path(c, &path).nearest]);
        pen.line(&[[x, y], xy(&near)], "limit");
        let [nx, ny] = xy(&near);
        pen.words(
            [x.midpoint(nx), y.midpoint(ny)],
            if is_beside { [8.0, 6.0] } else { [5.0, -5.0] },
            "",
            "D",
        );
        if is_beside {
            let c_k = &cav(&scene, &all[all.len() - 1].pose).frame.origin;
            let near = xy(&nearest_point(c_k, &path[beside_path(c_k, &path).nearest]));
            pen.dot(xy(c_k), 3.0, "line");
            pen.line(&[xy(c_k), near], "line");
            pen.words(near, [-4.0, -8.0], "e", "D_k");
            pen.words(xy(c_k), [4.0, 16.0], "", "c_k");
        }
        pen.words([x, y], if is_beside { [0.0, -20.0] } else { [30.0, -16.0] }, "m", "c");
        pen.words([0.0, 0.0], [0.0, 30.0], "m", "p");
        pen.words(
            [route[route.len() - 1][0], route[route.len() - 1][1]],
            [-40.0, 0.0],
            "e",
            "route",
        );
    });
}
