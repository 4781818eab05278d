//! What the CAV saw itself: a panel for each term.

use mufasa_model::hardened::detection_history::{
    Seen, confirmed, list_of, may_come_from, nearest_to_reference, origin_limit, past,
    seen as seen_of, shown_within, supports_within, usable, velocity, was_seen_to_come_from,
};
use mufasa_model::input::scene::{Object, Scene};
use serde_json::{Value, json};

use crate::sheet::{Look, Pen, Sheet, xy};
use crate::world::{scene, seen, tracks};

const LOW: [f64; 2] = [-12.0, -6.6];
const SCALE: [f64; 2] = [12.0; 2];

/// All terms.
pub fn terms() -> String {
    let mut sheet = Sheet::new(3, [288.0, 158.0], 3);
    lists(&mut sheet);
    places(&mut sheet);
    origin(&mut sheet);
    own(&mut sheet);
    backed(&mut sheet);
    detection(&mut sheet);
    explained(&mut sheet);
    comes_from(&mut sheet);
    seen_to_come(&mut sheet);
    sheet.finish()
}

fn look<'a>(title: &'a str, words: &'a str) -> Look<'a> {
    Look { title, words, low: LOW, scale: SCALE }
}

fn car(x: f64, y: f64) -> [f64; 5] {
    [x, y, 0.0, 4.0, 1.8]
}

/// The tracks of a scene beside what the CAV saw.
fn beside(scene: &Scene) -> Vec<Seen> {
    seen_of(scene, scene.tracks.as_ref().expect("there are tracks"))
}

fn object(pen: &mut Pen<'_>, of: &Object, class: &str) -> [f64; 2] {
    pen.rectangle(&of.rectangle(), class);
    xy(&of.frame.origin)
}

fn lists(sheet: &mut Sheet) {
    let ages = [0.1, 0.3, 0.6, 1.1];
    let history: Vec<Value> = ages.iter().map(|age| seen(*age, &[])).collect();
    let scene = scene(&json!({"detections": seen(0.0, &[]), "detection_history": history}));
    let lists = usable(&scene);
    let reference = nearest_to_reference(lists.iter().enumerate()).map(|(_, list)| list.age_ns);
    let words = "Lists of the history by their age dt. Filled: usable, 200 ms <= dt <= 1 s. Nearest to 500 ms: reference list.";
    let look =
        Look { title: "Usable, reference list", words, low: [-1.3, -0.5], scale: [200.0, 150.0] };
    sheet.panel(&look, |pen| {
        pen.line(&[[-1.25, 0.0], [0.08, 0.0]], "axis");
        for bound in [-1.0, -0.2] {
            pen.line(&[[bound, -0.2], [bound, 0.3]], "limit");
        }
        for (age, earlier) in ages.iter().zip(&scene.detection_history) {
            let age_ns = i128::from(scene.now_ns - earlier.stamp_ns);
            let is_usable = lists.iter().any(|list| list.age_ns == age_ns);
            pen.dot([-age, 0.0], 6.0, if is_usable { "place" } else { "node" });
            pen.words([-age, 0.0], [0.0, 22.0], "m", &format!("{age} s"));
            if reference == Some(age_ns) {
                pen.words([-age, 0.0], [0.0, -14.0], "m", "reference");
            }
        }
        pen.dot([0.0, 0.0], 6.0, "yes");
        pen.words([0.0, 0.0], [0.0, -14.0], "m", "t_D");
    });
}

fn places(sheet: &mut Sheet) {
    let scene = scene(&json!({
        "tracks": tracks(0.4, &[(car(2.0, 0.6), [10.0, 1.0])]), "detections": seen(0.0, &[]),
        "detection_history": [seen(0.5, &[]), seen(0.9, &[])],
    }));
    let track = &scene.tracks.as_ref().expect("given").items[0];
    let place = &beside(&scene)[0].place;
    sheet.panel(&look("Place, past", "Blue: the track at its own stamp t_T. Its place is where it is at t_D, its pasts where it was at the lists' stamps."), |pen| {
        object(pen, &track.object, "track");
        pen.dot(xy(place), 4.0, "line");
        pen.words(xy(place), [0.0, -10.0], "m", "place");
        for (list, by) in usable(&scene).iter().zip([34.0, -16.0]) {
            let past = xy(&past(place, &track.velocity, &list.dt));
            pen.dot(past, 4.0, "node");
            pen.words(past, [0.0, by], "m", &format!("past, {} s", list.dt.near()));
        }
        pen.arrow([2.0, 0.6], xy(place));
    });
}

/// Pasts of a track as dots, and the circle of an origin.
fn pasts(pen: &mut Pen<'_>, scene: &Scene, track: usize) {
    let place = &beside(scene)[track].place;
    let velocity = &scene.tracks.as_ref().expect("given").items[track].velocity;
    for list in usable(scene) {
        let past = xy(&past(place, velocity, &list.dt));
        pen.dot(past, 3.0, "node");
        pen.circle(past, origin_limit(scene, &list.dt).near(), "limit");
    }
}

fn draw_tracks(pen: &mut Pen<'_>, scene: &Scene) {
    scene.tracks.iter().flat_map(|list| &list.items).for_each(|track| {
        let ([x, y], [vx, vy]) = (object(pen, &track.object, "track"), xy(&track.velocity));
        pen.arrow([x, y], [x + vx * 0.25, y + vy * 0.25]);
    });
}

fn draw_history(pen: &mut Pen<'_>, scene: &Scene) {
    for item in scene.detection_history.iter().flat_map(|list| &list.items) {
        object(pen, item, "item");
    }
}

fn origin(sheet: &mut Sheet) {
    let scene = scene(&json!({
        "tracks": tracks(0.0, &[(car(7.0, 0.0), [24.0, 0.0])]), "detections": seen(0.0, &[]),
        "detection_history": [seen(0.5, &[car(-4.2, 0.9), car(-8.6, -2.8)])],
    }));
    let origin = beside(&scene)[0].own_origins[0].expect("it has one");
    sheet.panel(&look("Origin", "The item nearest to the past, at most theta_track_max + theta_velocity dt from it (circle)."), |pen| {
        draw_tracks(pen, &scene);
        draw_history(pen, &scene);
        pasts(pen, &scene, 0);
        pen.words(xy(&scene.detection_history[0].items[origin].frame.origin), [0.0, -18.0], "m", "origin");
    });
}

fn own(sheet: &mut Sheet) {
    let scene = scene(&json!({
        "tracks": tracks(0.0, &[(car(6.0, 4.0), [20.0, 3.0]), (car(6.0, 1.0), [20.0, -2.0]), (car(6.0, -4.4), [22.0, 0.0])]),
        "detections": seen(0.0, &[]), "detection_history": [seen(0.5, &[car(-4.5, 2.2), car(-5.0, -4.4)])],
    }));
    sheet.panel(&look("Own", "The upper two tracks have one item for their origin: it is no track's own. The lower one has its own."), |pen| {
        draw_tracks(pen, &scene);
        draw_history(pen, &scene);
        for (track, seen) in beside(&scene).iter().enumerate() {
            pasts(pen, &scene, track);
            let words = if seen.own_origins[0].is_some() { "own" } else { "not own" };
            pen.words(xy(&seen.place), [-30.0, 4.0], "e", words);
        }
    });
}

fn backed(sheet: &mut Sheet) {
    let scene = scene(&json!({
        "tracks": tracks(0.0, &[(car(8.0, 0.0), [20.0, 0.0])]), "detections": seen(0.0, &[]),
        "detection_history": [seen(0.3, &[car(2.2, 0.3)]), seen(0.5, &[]), seen(0.8, &[car(-8.0, -0.4)])],
    }));
    let (seen, lists) = (&beside(&scene)[0], usable(&scene));
    let list = list_of(&lists, seen).expect("one holds its own origin");
    let backed = if seen.is_backed { "backed" } else { "not backed" };
    let words = format!(
        "Own origins in two usable lists: {backed}. List of the track: that of {} s; the one of 0.5 s holds no origin.",
        lists[list].dt.near()
    );
    sheet.panel(&look("Backed, list of the track", &words), |pen| {
        draw_tracks(pen, &scene);
        draw_history(pen, &scene);
        pasts(pen, &scene, 0);
        for ([x, y], age) in
            [([2.2, 0.3], "0.3 s"), ([-2.0, 0.0], "0.5 s"), ([-8.0, -0.4], "0.8 s")]
        {
            pen.words([x, y], [0.0, 46.0], "m", age);
        }
    });
}

/// Two tracks with a history, beside their detections, of which one lies across.
fn detection(sheet: &mut Sheet) {
    let history = |age: f64| seen(age, &[car(4.0 - 12.0 * age, 3.5), car(4.0 - 12.0 * age, -3.2)]);
    let scene = scene(&json!({
        "tracks": tracks(0.0, &[(car(4.0, 3.5), [12.0, 0.0]), (car(4.0, -3.2), [12.0, 0.0])]),
        "detections": seen(0.0, &[car(4.4, 3.8), [4.4, -3.0, 1.2, 4.0, 1.8]]),
        "detection_history": [history(0.3), history(0.5), history(0.8)],
    }));
    sheet.panel(&look("Detection, confirmed", "Orange: the detection, less than theta_track_max off. The lower one lies across v: not confirmed."), |pen| {
        draw_tracks(pen, &scene);
        for item in &scene.detections.as_ref().expect("given").items {
            object(pen, item, "det");
        }
        for seen in beside(&scene) {
            let words = if seen.is_confirmed { "confirmed" } else { "not confirmed" };
            pen.words(xy(&seen.place), [-36.0, 4.0], "e", words);
        }
    });
}

fn explained(sheet: &mut Sheet) {
    let history = |age: f64| seen(age, &[car(3.0 - 12.0 * age, 2.8), car(3.0, -3.2)]);
    let scene = scene(&json!({
        "tracks": tracks(0.0, &[(car(3.0, 2.8), [12.0, 0.0])]), "detections": seen(0.0, &[car(3.3, 3.0), car(3.0, -3.2)]),
        "detection_history": [history(0.3), history(0.5), history(0.8)],
    }));
    let by = confirmed(&scene);
    sheet.panel(&look("Explained", "The detection of a confirmed track is explained. Where no track is, it is unexplained, as far as it may be."), |pen| {
        draw_tracks(pen, &scene);
        for (d, item) in scene.detections.as_ref().expect("given").items.iter().enumerate() {
            let at = object(pen, item, "det");
            let words = if by.iter().any(|(_, seen)| seen.detection == Some(d)) { "explained" } else { "unexplained" };
            pen.words(at, [-30.0, 4.0], "e", words);
        }
    });
}

fn comes_from(sheet: &mut Sheet) {
    let then = [car(0.6, 0.6), car(0.0, -3.0)];
    let scene = scene(&json!({
        "detections": seen(0.0, &[car(8.0, 1.0)]),
        "detection_history": [seen(0.5, &then), seen(0.8, &[car(-4.2, 0.7)])],
    }));
    let (lists, d) = (usable(&scene), &scene.detections.as_ref().expect("given").items[0]);
    let words = "Of d' = 1 another list has an item at d - w dt', as far off as tyres let it be (circle). Of d' = 2 none has.";
    sheet.panel(&look("May come from", words), |pen| {
        let at = object(pen, d, "det");
        pen.words(at, [0.0, -16.0], "m", "d");
        draw_history(pen, &scene);
        for (i, item) in lists[0].items.iter().enumerate() {
            let [x, y] = xy(&item.frame.origin);
            let then = [0, 1].map(|axis| at[axis] - (at[axis] - [x, y][axis]) / 0.5 * 0.8);
            pen.circle(then, supports_within(&scene, &lists[0].dt, &lists[1].dt).near(), "limit");
            pen.line(&[at, then], "limit");
            let words = if may_come_from(&scene, &lists, d, [0, i]) { "may" } else { "may not" };
            pen.words([x, y], [0.0, 26.0], "m", &format!("{}: {words}", i + 1));
        }
    });
}

/// Someone who was seen in every list to come from 1, and in one alone to come from 2.
fn seen_to_come(sheet: &mut Sheet) {
    let person = |x: f64, y: f64| [x, y, 0.0, 0.8, 0.8];
    let scene = scene(&json!({
        "detections": seen(0.0, &[person(8.0, 1.0)]),
        "detection_history": [
            seen(0.3, &[person(3.0, 1.9), person(3.4, -1.1)]),
            seen(0.5, &[person(0.0, 2.0), person(0.0, -3.0)]),
            seen(0.8, &[person(-4.0, 3.4)]),
        ],
    }));
    let (lists, d) = (usable(&scene), &scene.detections.as_ref().expect("given").items[0]);
    let words = "Of d' = 1 each other list has an item near d - w dt' (circles, of 0.3 m and what tyres let it be off). Of d' = 2 one has none.";
    sheet.panel(&look("Seen to come from", words), |pen| {
        let at = object(pen, d, "det");
        pen.words(at, [0.0, -16.0], "m", "d");
        draw_history(pen, &scene);
        let dt = &lists[1].dt;
        for (i, item) in lists[1].items.iter().enumerate() {
            for other in [&lists[0], &lists[2]] {
                let then = xy(&past(&d.frame.origin, &velocity(d, item, dt), &other.dt));
                pen.circle(then, shown_within(&scene, dt, &other.dt).near(), "limit");
                pen.line(&[at, then], "limit");
            }
            let was_seen = was_seen_to_come_from(&scene, &lists, d, [1, i]);
            let words = if was_seen { "seen" } else { "not seen" };
            pen.words(xy(&item.frame.origin), [0.0, 26.0], "m", &format!("{}: {words}", i + 1));
        }
    });
}
