//! Changes of what a station sends and of what is detected, each of which keeps the input valid.

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Track, TrajectoryPoint};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// The most of each list (`docs/configuration.md`).
const TRACKS: usize = 128;
const POINTS: usize = 128;
const DETECTIONS: usize = 256;
const EARLIER: usize = 3;

/// What tracks, detections and points have in common.
trait Placed: Clone {
    fn place(&mut self) -> [&mut f64; 2];
    fn direction(&mut self) -> [&mut f64; 2];
    fn size(&mut self) -> Option<[&mut f64; 2]>;
}

macro_rules! placed {
    ($($name:ident { $($size:ident),* })*) => {$(
        impl Placed for $name {
            fn place(&mut self) -> [&mut f64; 2] {
                [&mut self.x, &mut self.y]
            }
            fn direction(&mut self) -> [&mut f64; 2] {
                [&mut self.cos, &mut self.sin]
            }
            fn size(&mut self) -> Option<[&mut f64; 2]> {
                <[_; 2]>::try_from(vec![$(&mut self.$size),*]).ok()
            }
        }
    )*};
}

placed! {
    Track { length, width }
    Detection { length, width }
    TrajectoryPoint {}
}

/// One random change.
pub fn change(cycle: &mut Cycle, random: &mut ChaCha8Rng) {
    match random.random_range(0..10) {
        0..=2 => {
            let Some(list) = &mut cycle.tracks else { return };
            let velocity = [(); 2].map(|()| scaled(random, 100.0));
            items(&mut list.items, TRACKS, random);
            if random.random_ratio(1, 3) {
                list.items.iter_mut().for_each(|track| [track.vx, track.vy] = velocity);
            }
            list.items.iter_mut().zip(1..).for_each(|(track, id)| track.id = id);
        }
        3..=5 => {
            let Some(list) = &mut cycle.detections else { return };
            items(&mut list.items, DETECTIONS, random);
        }
        6 => earlier(cycle, random),
        7 => together(cycle, random),
        _ => {
            let Some(list) = &mut cycle.trajectory else { return };
            items(&mut list.points, POINTS, random);
            let step = [1, 1_000_000, 50_000_000, 100_000_000][random.random_range(0..4)];
            let times = (0..).map(|index| cycle.now_ns + index * step);
            list.points.iter_mut().zip(times).for_each(|(point, t)| point.t_ns = t);
        }
    }
}

/// A number up to a limit, of any magnitude down to the nanometre.
fn scaled(random: &mut ChaCha8Rng, most: f64) -> f64 {
    let exponent = random.random_range(-9.0..=0.0);
    let sign = if random.random() { 1.0 } else { -1.0 };
    sign * most * 10_f64.powf(exponent)
}

/// More or fewer items, all in a row, one beside another, or in another direction and size.
fn items<T: Placed>(list: &mut Vec<T>, most: usize, random: &mut ChaCha8Rng) {
    if list.is_empty() {
        return;
    }
    let chosen = random.random_range(0..list.len());
    let mut model = list[chosen].clone();
    let step = [(); 2].map(|()| scaled(random, 10.0));
    match random.random_range(0..6) {
        0 => list.truncate(random.random_range(1..=list.len())),
        1 => {
            for index in 0..most.saturating_sub(list.len()) {
                let mut item = list[index].clone();
                move_by(&mut item, step);
                list.push(item);
            }
        }
        2 => {
            for item in list.iter_mut() {
                *item = model.clone();
                move_by(&mut model, step);
            }
        }
        3 => {
            let other = random.random_range(0..list.len());
            move_by(&mut model, step);
            list[other] = model;
        }
        4 => {
            let (sin, cos) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
            for item in list.iter_mut() {
                let [c, s] = item.direction();
                (*c, *s) = (cos, sin);
            }
        }
        _ => {
            let sizes = [(); 2].map(|()| scaled(random, 20.0).abs().max(0.01));
            for item in list.iter_mut() {
                if let Some([length, width]) = item.size() {
                    [*length, *width] = sizes;
                }
            }
        }
    }
}

fn move_by(item: &mut impl Placed, [dx, dy]: [f64; 2]) {
    let [x, y] = item.place();
    *x += dx;
    *y += dy;
}

/// Earlier lists that are the current one, moved on.
fn earlier(cycle: &mut Cycle, random: &mut ChaCha8Rng) {
    let Some(current) = &cycle.detections else { return };
    let (period, step) = (random.random_range(20_000_000..=100_000_000), scaled(random, 10.0));
    let mut list = current.clone();
    let mut older = || {
        list.items.iter_mut().for_each(|item| item.x += step);
        list.stamp_ns -= period;
        list.clone()
    };
    let count = random.random_range(0..=EARLIER);
    cycle.detection_history = (0..count).map(|_| older()).collect::<Vec<DetectionList>>();
}

/// Tracks and detections where the CAV will be, or just beside it, and tracks where detections are.
fn together(cycle: &mut Cycle, random: &mut ChaCha8Rng) {
    let (Some(trajectory), Some(tracks), Some(detections)) =
        (&cycle.trajectory, &mut cycle.tracks, &mut cycle.detections)
    else {
        return;
    };
    let off = [(); 2].map(|()| scaled(random, 1.0));
    if random.random_ratio(1, 3) {
        for (track, item) in tracks.items.iter_mut().zip(&detections.items) {
            (track.x, track.y) = (item.x + off[0], item.y + off[1]);
        }
        return;
    }
    let (width, mut points) = (cycle.ego.width, trajectory.points.iter().cycle());
    let whole: bool = random.random();
    let put = |of: f64, point: &TrajectoryPoint| {
        let aside = 0.5 * (width + of) + off[0];
        let along = if whole { 0.0 } else { off[1] };
        [
            point.x - point.sin * aside + point.cos * along,
            point.y + point.cos * aside + point.sin * along,
        ]
    };
    for track in &mut tracks.items {
        let Some(point) = points.next() else { return };
        [track.x, track.y] = put(track.width, point);
        (track.cos, track.sin) = (point.cos, point.sin);
    }
    for item in &mut detections.items {
        let Some(point) = points.next() else { return };
        [item.x, item.y] = put(item.width, point);
        (item.cos, item.sin) = (point.cos, point.sin);
    }
}
