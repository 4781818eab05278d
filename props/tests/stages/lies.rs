//! How much lies can hide (SEEN-17, H-14.20; F-38, F-42 and F-57 of `findings/README.md`): no false tracks and no
//! omissions hide the motion of an object that every list shows, and that did not stand; where one list misses
//! it, they can.

use std::cell::RefCell;

use mufasa_model::hardened::detection_history::{confirmed, has_stood, usable};
use mufasa_model::hardened::h14_fail_safe::motions::{Named, all_motions};
use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track, TrackList};
use mufasa_model::input::scene::Scene;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration::AllRemote;
use mufasa_props::differential::{cases, runner};
use mufasa_props::strategy::base::{self, Frame};
use mufasa_props::strategy::draw::{Draw, tape};
use proptest::strategy::Strategy;
use proptest::test_runner::TestCaseError;

/// Ages of the lists, ms.
const AGES_MS: [[u16; 3]; 4] = [[250, 500, 750], [248, 496, 744], [200, 500, 700], [300, 500, 800]];

/// Where an object is when it is detected, m, its velocity, m/s, and how hard it has braked, 1/s times that.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Object {
    at: [f64; 2],
    v: [f64; 2],
    braked: f64,
}

impl Object {
    fn before(&self, ms: u16) -> [f64; 2] {
        let dt = f64::from(ms) / 1000.0;
        let way = dt + 0.5 * self.braked * dt * dt;
        [self.at[0] - self.v[0] * way, self.at[1] - self.v[1] * way]
    }
}

/// Not longer than 1 m, so that its direction does not bind its velocity.
const fn detection([x, y]: [f64; 2]) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 1.0, width: 1.0 }
}

const fn track(id: i64, Object { at: [x, y], v: [vx, vy], .. }: Object) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx, vy, length: 1.0, width: 1.0 }
}

/// Up to five objects at different places, close enough to have been where another one was.
fn objects(draw: &mut Draw<'_>) -> Vec<Object> {
    let mut objects: Vec<Object> = Vec::new();
    for _ in 0..draw.between(2, 5) {
        let at = [draw.range(-12.0, 12.0).round(), draw.range(-12.0, 12.0).round()];
        let speed = |draw: &mut Draw<'_>| draw.pick(&[0.0, 0.0, -10.0, 8.0, 4.0, -2.0]);
        let v: [f64; 2] = [speed(draw), speed(draw)];
        // As hard as tyres hold.
        let braked = if draw.one_in(2) { 11.5 / v[0].hypot(v[1]).max(1.0) } else { 0.0 };
        if objects.iter().all(|other| other.at.map(f64::to_bits) != at.map(f64::to_bits)) {
            objects.push(Object { at, v, braked });
        }
    }
    objects
}

/// What is said of one object: about where it is, and that in a list it was where another one was, or anything.
fn lie(draw: &mut Draw<'_>, objects: &[Object], ages_ms: [u16; 3]) -> (usize, Object) {
    let about = draw.below(objects.len());
    let aside = draw.pick(&[[0.0, 0.0], [0.5, 0.0], [0.0, -0.75], [0.25, 0.25]]);
    let at = [objects[about].at[0] + aside[0], objects[about].at[1] + aside[1]];
    let ms = draw.pick(&ages_ms[1..]);
    let (other, per_s) = (objects[draw.below(objects.len())].before(ms), 1000.0 / f64::from(ms));
    let off = draw.pick(&[[0.0, 0.0], [1.0, -1.0], [-2.0, 0.5], [0.0, 2.5]]);
    let v = if draw.one_in(5) {
        [draw.range(-20.0, 20.0), draw.range(-20.0, 20.0)]
    } else {
        [per_s * (at[0] - other[0]) + off[0], per_s * (at[1] - other[1]) + off[1]]
    };
    (about, Object { at, v, braked: 0.0 })
}

/// A cycle in which the remote side tells the truth about some objects, leaves others out, and lies
/// about up to three. `missed`: one list, which is not the reference list, shows only the first of the objects.
fn cycle(draw: &mut Draw<'_>, objects: &[Object], missed: bool) -> Cycle {
    let frame = Frame { x: 100.0, y: 100.0, cos: 1.0, sin: 0.0 };
    let mut cycle = base::cycle(draw, frame, Profile::HARDENED, AllRemote);
    let ages_ms = draw.pick(&AGES_MS);
    let missed = missed.then(|| draw.pick(&[ages_ms[0], ages_ms[2]]));
    let lies: Vec<(usize, Object)> =
        (0..draw.between(1, 3)).map(|_| lie(draw, objects, ages_ms)).collect();
    let is_true = |i: &usize| lies.iter().all(|(about, _)| about != i);
    let told: Vec<usize> = (0..objects.len()).filter(|i| !draw.one_in(2) && is_true(i)).collect();
    let items = told.into_iter().map(|i| objects[i]).chain(lies.iter().map(|(_, lie)| *lie));
    let items = items.zip(1..).map(|(object, id)| track(id, object)).collect();
    let now_ns = cycle.now_ns.max(0);
    cycle.now_ns = now_ns;
    cycle.tracks = Some(TrackList { stamp_ns: now_ns, items });
    let items = objects.iter().map(|object| detection(object.at)).collect();
    cycle.detections = Some(DetectionList { stamp_ns: now_ns, items });
    let list = |ms: u16| {
        let shown = if missed == Some(ms) { 1 } else { objects.len() };
        let items = objects[..shown].iter().map(|object| detection(object.before(ms))).collect();
        DetectionList { stamp_ns: now_ns - 1_000_000 * i64::from(ms), items }
    };
    cycle.detection_history = ages_ms.map(list).to_vec();
    cycle
}

/// Whether what a false track says of an object counts, and an object that did not stand and whose true motion is
/// not examined.
fn judged(cycle: &Cycle, objects: &[Object]) -> (bool, Option<usize>) {
    let scene = Scene::new(cycle, Reading::Exact);
    let (motions, lists) = (all_motions(&scene), usable(&scene));
    let is_own = |i: usize, it: &Named| (it.detection, it.item) == (Some(i), Some(i));
    let detections = &scene.detections.as_ref().expect("given").items;
    let is_hidden = |i: &usize| {
        !has_stood(&scene, &lists, &detections[*i])
            && !motions.iter().any(|it| is_own(*i, &it.named))
    };
    let is_taken = confirmed(&scene).iter().any(|(_, seen)| {
        seen.own_origins.iter().any(|own| own.is_some() && *own != seen.detection)
    });
    (is_taken, (0..objects.len()).find(is_hidden))
}

/// In how many cases a past was taken, and in how many some motion was hidden. `stop`: at the first such one.
fn search(missed: bool, stop: bool) -> [u32; 2] {
    let counts = RefCell::new([0; 2]);
    let scenes = tape().prop_map(|tape| {
        let mut draw = Draw::new(&tape);
        let objects = objects(&mut draw);
        (cycle(&mut draw, &objects, missed), objects)
    });
    let result = runner().run(&scenes, |(cycle, objects)| {
        let (is_taken, hidden) = judged(&cycle, &objects);
        let mut counts = counts.borrow_mut();
        counts[0] += u32::from(is_taken);
        counts[1] += u32::from(hidden.is_some());
        match hidden {
            Some(i) if stop => Err(TestCaseError::fail(format!("object {i} of {objects:?}"))),
            _ => Ok(()),
        }
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    counts.into_inner()
}

#[test]
fn no_lies_hide_a_motion_that_every_list_shows() {
    let [taken, _] = search(false, true);
    println!("the past of another was taken in {taken} cases, none hid a motion");
    assert!(taken > cases() / 50, "{taken}");
}

#[test]
fn lies_can_hide_a_motion_that_one_list_misses() {
    let [_, hidden] = search(true, false);
    println!("one list misses objects: in {hidden} cases some motion was not examined");
    assert!(hidden > 0);
}
