//! How long the services of one vehicle take in a cycle with 30 objects around:
//! `cargo run --release -p mufasa-sim --example services_time`.

use std::hint::black_box;
use std::time::Duration;

use core::f64::consts::TAU;
use mufasa::input::cycle::{Ego, TrackList};
use mufasa_sim::path::Path;
use mufasa_sim::pose::{Point, Pose, Rectangle};
use mufasa_sim::services::control::{Controller, Settings as ControlSettings};
use mufasa_sim::services::detectors::scan::Sweep;
use mufasa_sim::services::detectors::scene::{Scene, Seen};
use mufasa_sim::services::detectors::{Detector, Errors, Mount, Observer};
use mufasa_sim::services::env::{Situation, environment};
use mufasa_sim::services::grid::{OccupancyMap, Settings as GridSettings};
use mufasa_sim::services::mot::{Settings as MotSettings, Tracker};
use mufasa_sim::services::tpl::settings::Settings as TplSettings;
use mufasa_sim::services::tpl::trajectory;
use mufasa_sim::vehicle::Body;

const CYCLES: u32 = 4000;
const OBJECTS: u32 = 30;
const CYCLE_S: f64 = 0.05;

/// Vehicles here and there inside and beside a ring road of 100 m radius, most of them in view.
fn objects(t: f64) -> Vec<Seen> {
    let object = |id: u32| {
        let radius = 70.0 + f64::from(id * 23 % 61);
        let speed = f64::from(id % 5) * 2.0 - 4.0;
        let angle = (f64::from(id) - 14.5) * 0.033 + 0.05 * libm::sin(t);
        let (sin, cos) = libm::sincos(angle);
        let pose = Pose::new(Point::new(radius * cos, radius * sin), angle + TAU / 4.0);
        let velocity = Point::new(-speed * sin, speed * cos);
        Seen { id, rectangle: Rectangle { pose, length: 4.5, width: 1.8 }, velocity }
    };
    (0..OBJECTS).map(object).filter(|object| object.id != 14).collect()
}

#[allow(clippy::disallowed_methods)] // the one place that measures real time
fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = std::time::Instant::now();
    let done = black_box(work());
    *total += start.elapsed();
    done
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ring = |index: u32| {
        let (sin, cos) = libm::sincos(TAU * f64::from(index) / 320.0);
        Point::new(100.0 * cos, 100.0 * sin)
    };
    let path = Path::closed((0..320).map(ring).collect())?;
    let errors = Errors::default();
    let lidar = Detector { mount: Mount::Vehicle(1.4), sweep: Sweep::new(60.0, TAU, 720), errors };
    let radar = Detector { mount: Mount::Vehicle(3.8), sweep: Sweep::new(90.0, 0.7, 140), errors };
    let observer = Observer { seed: [1, 1], detectors: vec![lidar, radar], merge_radius: 1.0 };
    let mut tracker = Tracker::new(MotSettings::default());
    let mut map = OccupancyMap::new(GridSettings::default());
    let mut controller = Controller::new(Body::default(), ControlSettings::default());
    let (mut times, mut seen) = ([Duration::ZERO; 6], 0);
    for cycle in 0..CYCLES {
        let t = CYCLE_S * f64::from(cycle);
        let now_ns = i64::from(cycle) * 50_000_000;
        let angle = 8.0 * t / 100.0;
        let (sin, cos) = libm::sincos(angle);
        let pose = Pose::new(Point::new(100.0 * cos, 100.0 * sin), angle + TAU / 4.0);
        // The others go round with it, so that they stay around.
        let objects: Vec<_> = objects(t).into_iter().map(|object| turned(object, angle)).collect();
        let scene = Scene { objects: &objects, walls: &[] };
        let Pose { at, cos, sin } = pose;
        let ego = Ego {
            x: at.x,
            y: at.y,
            cos,
            sin,
            speed: 8.0,
            length: 5.1,
            width: 1.89,
            center_offset: 1.47,
        };
        let [detect, track, model, plan, grid, control] = &mut times;
        let observed = timed(detect, || observer.observe(&scene, pose, None, cycle.into()));
        seen += observed.detections.len();
        let tracks = timed(track, || {
            tracker.update(now_ns, &observed.detections);
            tracker.tracks(now_ns)
        });
        let situation =
            Situation { now_ns, ego, path: &path, near_s: Some(100.0 * angle), stops: &[] };
        let list = TrackList { stamp_ns: now_ns, items: &tracks };
        let environment = timed(model, || environment(&situation, &list));
        let points = timed(plan, || {
            trajectory(now_ns, &ego, &path, &environment, &|_| 13.9, &TplSettings::default())
        });
        timed(grid, || map.update(now_ns, &ego, &observed.scans[0]));
        timed(control, || controller.command(&ego, &points, now_ns));
    }
    println!(
        "{CYCLES} cycles, {} of {OBJECTS} objects detected in the mean",
        seen / CYCLES as usize
    );
    let names = ["detectors", "mot", "env", "tpl", "grid", "control"];
    for (name, time) in names.iter().zip(times) {
        println!("{name:10} {:8.1} us", time.as_secs_f64() * 1e6 / f64::from(CYCLES));
    }
    let all: Duration = times.iter().sum();
    println!("{:10} {:8.1} us", "all", all.as_secs_f64() * 1e6 / f64::from(CYCLES));
    Ok(())
}

fn turned(object: Seen, angle: f64) -> Seen {
    let (sin, cos) = libm::sincos(angle);
    let turn = |p: Point| Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos);
    let Rectangle { pose, .. } = object.rectangle;
    let pose = Pose::new(turn(pose.at), pose.angle() + angle);
    Seen {
        rectangle: Rectangle { pose, ..object.rectangle },
        velocity: turn(object.velocity),
        ..object
    }
}
