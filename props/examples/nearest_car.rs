//! How near a car may stand ahead of a CAV in the middle of a road of 8 m while a remote trajectory that
//! goes around it passes stage ii of the hardened profile (findings F-28, F-29, F-40, F-41). What is left
//! is what H-07, H-11 and the reach of H-14 leave open. Simulated annealing; each seed is one run.
//!
//! `cargo run --release -p mufasa-props --example nearest_car -- [v_now, m/s [seconds [center_offset, m]]]`
#![allow(
    clippy::print_stdout,
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "a program with small numbers"
)]

use std::time::{Duration, Instant};

use mufasa::cycle;
use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Route, Trajectory, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::services::configuration::Configuration;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const NOW_NS: i64 = 1_000_000_000;
/// Half the width of the car, m.
const HALF_CAR: f64 = 1.0;
/// Half the width of the road, m.
const HALF_ROAD: f64 = 4.0;
/// Trajectories that one run tries.
const TRIED: u32 = 200_000;

/// From one point to the next: time, displacement along and across the mean heading, turn.
#[derive(Clone, Copy, Debug)]
struct Step {
    dt: f64,
    along: f64,
    across: f64,
    turn: f64,
}

/// The best of a run: how far ahead the car stands, m, and the trajectory.
struct Found {
    gap: f64,
    points: Vec<TrajectoryPoint>,
}

fn main() {
    let given: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().expect("a number")).collect();
    let argument = |i: usize, default: f64| given.get(i).copied().unwrap_or(default);
    let [speed, seconds, center_offset] = [argument(0, 10.0), argument(1, 20.0), argument(2, 0.0)];
    let ego =
        Ego { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, speed, length: 4.0, width: 2.0, center_offset };
    let start = Instant::now();
    let mut runs: Vec<Found> = Vec::new();
    while runs.is_empty() || start.elapsed() < Duration::from_secs_f64(seconds) {
        let seed = u64::try_from(runs.len()).expect("few runs");
        runs.extend(anneal(&ego, seed));
    }
    runs.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    let braking = speed * speed / (2.0 * Parameters::default().a_b);
    println!("v_now {speed} m/s, which needs {braking:.2} m to stand; {} runs", runs.len());
    for (place, found) in runs.iter().take(3).enumerate() {
        println!("nearest car, best {}: {:.2} m ahead", place + 1, found.gap);
    }
    for point in &runs[0].points {
        let TrajectoryPoint { t_ns, x, y, cos, sin } = point;
        println!("{{\"t_ns\": {t_ns}, \"x\": {x}, \"y\": {y}, \"cos\": {cos}, \"sin\": {sin}}},");
    }
}

/// One run, from braking gently straight ahead.
fn anneal(ego: &Ego, seed: u64) -> Option<Found> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (v, end) = (ego.speed, ego.speed / Parameters::default().a_b + 0.35);
    let longest = (0.9 * ego.length / v).min(0.18);
    let least = (end / longest).ceil();
    let count = (least * random.random_range(1.0..2.5)).ceil();
    let dt = end / count;
    let mut steps = Vec::new();
    while (steps.len() as f64) < count {
        let along = ((v - 4.0 * dt * steps.len() as f64) * dt).max(0.01);
        steps.push(Step { dt, along, across: 0.0, turn: 0.0 });
    }
    let mut points = drive(&steps);
    assert!(passes(ego, &points), "braking gently is fine");
    let mut worth = worth_of(ego, &points);
    let mut best = None;
    for i in 0..TRIED {
        let heat = 0.3 * (1.0 - f64::from(i) / f64::from(TRIED)).powi(2);
        let next = changed(&steps, &mut random);
        let there = drive(&next);
        let value = worth_of(ego, &there);
        let taken = value < worth || random.random::<f64>() < ((worth - value) / heat).exp();
        if !taken || !passes(ego, &there) {
            continue;
        }
        (steps, points, worth) = (next, there, value);
        let gap = gap(ego, &points);
        if best.as_ref().is_none_or(|best: &Found| gap < best.gap) {
            best = Some(Found { gap, points: points.clone() });
        }
    }
    best
}

/// What is to become small: the gap, and a little for what is not yet far aside.
fn worth_of(ego: &Ego, points: &[TrajectoryPoint]) -> f64 {
    let aside = points.iter().map(|point| point.y).fold(0.0, f64::max);
    gap(ego, points) - 0.1 * aside.min(HALF_ROAD)
}

/// The steps with one to three of them changed, by much or by little.
fn changed(steps: &[Step], random: &mut ChaCha8Rng) -> Vec<Step> {
    let mut steps = steps.to_vec();
    for _ in 0..random.random_range(1..4) {
        let scale = 10_f64.powf(random.random_range(-3.5..0.0));
        let by = scale * random.random_range(-1.0..1.0);
        let i = random.random_range(0..steps.len());
        let next = (i + 1) % steps.len();
        match random.random_range(0..5) {
            0 => steps[i].dt = (steps[i].dt + 0.2 * by).clamp(0.0005, 0.2),
            1 => steps[i].along += 2.0 * by,
            2 => steps[i].across += by,
            3 => steps[i].turn += by,
            _ => {
                steps[i].turn += by;
                steps[next].turn -= by;
            }
        }
    }
    steps
}

/// The points, from the CAV on.
fn drive(steps: &[Step]) -> Vec<TrajectoryPoint> {
    let mut points = vec![TrajectoryPoint { t_ns: NOW_NS, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }];
    let (mut t_ns, mut x, mut y, mut angle) = (NOW_NS, 0.0, 0.0, 0.0_f64);
    for step in steps {
        let (sin, cos) = (angle + 0.5 * step.turn).sin_cos();
        t_ns += (step.dt * 1e9) as i64;
        x += step.along * cos - step.across * sin;
        y += step.along * sin + step.across * cos;
        angle += step.turn;
        points.push(TrajectoryPoint { t_ns, x, y, cos: angle.cos(), sin: angle.sin() });
    }
    points
}

/// Whether the implementation calls the trajectory safe where nothing is near.
fn passes(ego: &Ego, points: &[TrajectoryPoint]) -> bool {
    let far = [Detection { x: 5.0, y: 50.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }];
    let section = |x: f64| CrossSection { x, y: 0.0, left: [x, HALF_ROAD], right: [x, -HALF_ROAD] };
    let cycle = Cycle {
        profile: Profile::HARDENED,
        parameters: Parameters::default(),
        now_ns: NOW_NS,
        configuration: Configuration::PlanRemote,
        ego: *ego,
        trajectory: Some(Trajectory { stamp_ns: NOW_NS, points }),
        tracks: None,
        detections: Some(DetectionList { stamp_ns: NOW_NS, items: &far }),
        lead: None,
        route: Route { closed: false, cross_sections: &[section(-100.0), section(200.0)] },
        grid: None,
        detection_history: &[],
    };
    let sizes = Sizes::for_cycle(&cycle);
    let mut rows = vec![Row::default(); sizes.rows];
    let mut columns = vec![Column::default(); sizes.columns];
    let report = cycle::check(&cycle, &mut Scratch::new(&mut rows, &mut columns));
    report.is_ok_and(|report| report.failed_stage.is_none())
}

/// How far ahead of the CAV's front the car has to stand for the trajectory to miss it, at its points,
/// between them and beyond its end, until the CAV could stand.
fn gap(ego: &Ego, points: &[TrajectoryPoint]) -> f64 {
    let Parameters { tau, a_max, a_b, .. } = Parameters::default();
    let s_stop =
        ego.speed * tau + 0.5 * a_max * tau * tau + (ego.speed + a_max * tau).powi(2) / (2.0 * a_b);
    let front = 0.5 * ego.length + ego.center_offset;
    let (mut farthest, mut way) = (front, 0.0);
    for pair in points.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        let (x, y) = (to.x - from.x, to.y - from.y);
        let [before, after] = [from, to].map(|point| point.sin.atan2(point.cos));
        let parts = (x.hypot(y) / 0.2).ceil().max(1.0);
        let mut part = 0.0;
        while part < parts {
            part += 1.0;
            let share = part / parts;
            let angle = before + share * (after - before);
            farthest = farthest.max(reach(ego, from.x + share * x, from.y + share * y, angle));
        }
        way += (x * from.cos + y * from.sin).max(0.0);
        if way > s_stop {
            return farthest - front;
        }
    }
    let last = &points[points.len() - 1];
    let angle = last.sin.atan2(last.cos);
    let mut beyond = 0.0;
    while way + beyond <= s_stop {
        let (x, y) = (last.x + beyond * last.cos, last.y + beyond * last.sin);
        farthest = farthest.max(reach(ego, x, y, angle));
        beyond += 0.25;
    }
    farthest - front
}

/// The greatest x of the CAV's rectangle at this pose in the lane of the car.
fn reach(ego: &Ego, x: f64, y: f64, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let corner = |ahead: f64, left: f64| {
        let (along, across) =
            (ego.center_offset + 0.5 * ahead * ego.length, 0.5 * left * ego.width);
        [x + along * cos - across * sin, y + along * sin + across * cos]
    };
    let mut polygon =
        vec![corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)];
    for side in [1.0, -1.0] {
        let inside = |point: [f64; 2]| HALF_CAR - side * point[1];
        let nexts = polygon.iter().cycle().skip(1);
        let mut cut = Vec::new();
        for (&p, &q) in polygon.iter().zip(nexts) {
            let (at_p, at_q) = (inside(p), inside(q));
            if at_p >= 0.0 {
                cut.push(p);
            }
            if at_p * at_q < 0.0 {
                let share = at_p / (at_p - at_q);
                cut.push([p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])]);
            }
        }
        polygon = cut;
    }
    polygon.iter().map(|point| point[0]).fold(f64::NEG_INFINITY, f64::max)
}
