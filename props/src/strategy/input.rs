//! Values at and beyond the borders of the domain, and lists that break a rule
//! (`spec/3-stages.md#invalid-input`, `spec/4-arithmetic.md#domain`).

use mufasa_model::input::cycle::{Cycle, DetectionList, Profile};
use mufasa_model::input::domain::{Problem, first_problem};

use super::base;
use super::draw::Draw;
use super::{schedule, track_validation};

/// Limits of a quantity.
type Limits = (f64, f64);

const POSITION: Limits = (-16_777_216.0, 16_777_216.0);
const SPEED: Limits = (0.0, 150.0);
const VELOCITY: Limits = (-150.0, 150.0);
const SIZE: Limits = (0.01, 100.0);
const OFFSET: Limits = (-100.0, 100.0);
const GAP: Limits = (0.0, 1e6);
const RESOLUTION: Limits = (0.01, 10.0);
const THRESHOLD: Limits = (1e-3, 1e3);
const ACCELERATION: Limits = (0.1, 100.0);
const DURATION: Limits = (0.0, 60.0);
const ABOVE_ZERO: Limits = (0.0, 1000.0);
const DELTA: Limits = (1e-8, 1e-2);
const DIRECTION: Limits = (-1.0, 1.0);

/// A cycle of the schedule generator with all inputs, and up to two values that may be invalid.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = schedule::cycle(draw, profile);
    let frame = base::Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let now_ns = cycle.now_ns;
    if let Some(list) = &mut cycle.tracks
        && list.items.is_empty()
    {
        list.items.push(track_validation::track(frame, (8.0, 9.0), 1));
    }
    if cycle.detections.as_ref().is_some_and(|list| list.items.is_empty()) {
        let item = track_validation::detection(frame, (8.0, 9.0));
        cycle.detections.iter_mut().for_each(|list| list.items = vec![item.clone()]);
    }
    if draw.one_in(4)
        && let Some(list) = cycle.detections.clone()
    {
        // The items of each list have to be valid.
        let earlier =
            |i: i64| DetectionList { stamp_ns: list.stamp_ns - i * 250_000_000, ..list.clone() };
        cycle.detection_history = (1..=4).map(earlier).collect();
    }
    let most = if draw.one_in(4) { 2 } else { 1 };
    for _ in 0..most {
        match draw.below(8) {
            0..=2 => number(draw, &mut cycle),
            3 | 4 => direction(draw, &mut cycle),
            5 => whole_number(draw, &mut cycle),
            6 => time(draw, &mut cycle, now_ns),
            _ => list(draw, &mut cycle),
        }
    }
    cycle
}

/// One number at a border of its domain, one step beside it, or not a number at all.
fn number(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let mut fields = numbers(cycle);
    let index = draw.below(fields.len());
    let (value, (lo, hi)) = &mut fields[index];
    **value = match draw.below(10) {
        0 => *lo,
        1 => *hi,
        2 => lo.next_down(),
        3 => hi.next_up(),
        4 => lo.next_up(),
        5 => hi.next_down(),
        6 => -0.0,
        7 => draw.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
        _ => draw.pick(&[f64::MIN_POSITIVE, -f64::MIN_POSITIVE, 5e-324, f64::MAX, 1e300]),
    };
}

/// One direction whose norm is at the border that the domain sets, to the last place.
fn direction(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let mut fields = directions(cycle);
    let index = draw.below(fields.len());
    let (cos, sin) = &mut fields[index];
    let square = 1.0 + draw.pick(&[1e-6, -1e-6]);
    **sin = draw.pick(&[0.0, 0.6, -0.8, **sin]);
    let border = (square - **sin * **sin).max(0.0).sqrt();
    let moved = if draw.below(3) == 0 { border } else { draw.ulps(border) };
    **cos = if draw.below(2) == 0 { moved } else { -moved };
}

/// Whether the input stops being valid, or becomes so, when one number moves by one unit in the
/// last place or one integer by one.
pub fn is_near(cycle: &Cycle) -> bool {
    let before = place(cycle);
    let mut moved = cycle.clone();
    if before.is_none() {
        // Other generators draw margins at the limits of delta's domain on purpose.
        moved.parameters.delta = 1e-6;
    }
    if numbers(&mut moved).len() > 500 {
        // A list that is too long: not worth moving every number of it.
        return false;
    }
    for index in 0..numbers(&mut moved).len() {
        for step in [f64::next_up, f64::next_down] {
            let was = *numbers(&mut moved)[index].0;
            if was == 0.0 {
                // The lower limit of most domains, and too common a value to count.
                continue;
            }
            *numbers(&mut moved)[index].0 = step(was);
            if place(&moved) != before {
                return true;
            }
            *numbers(&mut moved)[index].0 = was;
        }
    }
    for index in 0..integers(&mut moved).len() {
        for step in [1, -1] {
            let was = *integers(&mut moved)[index];
            *integers(&mut moved)[index] = was.saturating_add(step);
            if place(&moved) != before {
                return true;
            }
            *integers(&mut moved)[index] = was;
        }
    }
    false
}

/// Field and index of the first problem.
fn place(cycle: &Cycle) -> Option<(String, Option<usize>)> {
    first_problem(cycle).map(|problem| match problem {
        Problem::Local(problem) | Problem::Remote(problem) => (problem.field, problem.index),
    })
}

/// Every direction of the cycle.
pub fn directions(cycle: &mut Cycle) -> Vec<(&mut f64, &mut f64)> {
    let mut fields = vec![(&mut cycle.ego.cos, &mut cycle.ego.sin)];
    fields.extend(cycle.grid.iter_mut().map(|grid| (&mut grid.cos, &mut grid.sin)));
    let items = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    fields.extend(items.map(|item| (&mut item.cos, &mut item.sin)));
    let items = cycle.detection_history.iter_mut().flat_map(|list| &mut list.items);
    fields.extend(items.map(|item| (&mut item.cos, &mut item.sin)));
    let items = cycle.tracks.iter_mut().flat_map(|list| &mut list.items);
    fields.extend(items.map(|item| (&mut item.cos, &mut item.sin)));
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    fields.extend(points.map(|point| (&mut point.cos, &mut point.sin)));
    fields
}

/// Every integer of the cycle that has a domain, without the grid's sizes and the miss budget,
/// which is at its lower limit by default.
fn integers(cycle: &mut Cycle) -> Vec<&mut i64> {
    let p = &mut cycle.parameters;
    let mut fields = vec![&mut p.max_age_ns, &mut p.step_max_ns, &mut p.n];
    fields.extend(cycle.lead.iter_mut().map(|lead| &mut lead.stamp_ns));
    fields.extend(cycle.grid.iter_mut().map(|grid| &mut grid.stamp_ns));
    fields.extend(cycle.detections.iter_mut().map(|list| &mut list.stamp_ns));
    fields.extend(cycle.detection_history.iter_mut().map(|list| &mut list.stamp_ns));
    fields.extend(cycle.tracks.iter_mut().map(|list| &mut list.stamp_ns));
    if let Some(list) = &mut cycle.trajectory {
        fields.push(&mut list.stamp_ns);
        fields.extend(list.points.iter_mut().map(|point| &mut point.t_ns));
    }
    fields
}

/// Every number of the cycle with the limits of its domain.
fn numbers(cycle: &mut Cycle) -> Vec<(&mut f64, Limits)> {
    let (p, ego) = (&mut cycle.parameters, &mut cycle.ego);
    let mut fields = vec![
        (&mut p.theta_tr, THRESHOLD),
        (&mut p.theta_map, THRESHOLD),
        (&mut p.theta_obj, THRESHOLD),
        (&mut p.theta_track_max, THRESHOLD),
        (&mut p.start_tolerance, THRESHOLD),
        (&mut p.a_b, ACCELERATION),
        (&mut p.a_max, ACCELERATION),
        (&mut p.safety_time, DURATION),
        (&mut p.tau, DURATION),
        (&mut p.v_max, ABOVE_ZERO),
        (&mut p.theta_velocity, ABOVE_ZERO),
        (&mut p.lateral_tolerance, THRESHOLD),
        (&mut p.v_object, ABOVE_ZERO),
        (&mut p.t_yield, DURATION),
        (&mut p.a_yield, ACCELERATION),
        (&mut p.delta, DELTA),
        (&mut ego.x, POSITION),
        (&mut ego.y, POSITION),
        (&mut ego.cos, DIRECTION),
        (&mut ego.sin, DIRECTION),
        (&mut ego.speed, SPEED),
        (&mut ego.length, SIZE),
        (&mut ego.width, SIZE),
        (&mut ego.center_offset, OFFSET),
    ];
    if let Some(lead) = &mut cycle.lead {
        fields.extend([(&mut lead.gap, GAP), (&mut lead.speed, SPEED)]);
    }
    for station in &mut cycle.route.cross_sections {
        fields.extend([(&mut station.x, POSITION), (&mut station.y, POSITION)]);
        fields.extend(station.left.iter_mut().map(|value| (value, POSITION)));
        fields.extend(station.right.iter_mut().map(|value| (value, POSITION)));
    }
    if let Some(grid) = &mut cycle.grid {
        fields.extend([(&mut grid.x, POSITION), (&mut grid.y, POSITION)]);
        fields.extend([(&mut grid.cos, DIRECTION), (&mut grid.sin, DIRECTION)]);
        fields.push((&mut grid.resolution, RESOLUTION));
    }
    let lists = cycle.detections.iter_mut().chain(&mut cycle.detection_history);
    for item in lists.flat_map(|list| &mut list.items) {
        fields.extend([(&mut item.x, POSITION), (&mut item.y, POSITION)]);
        fields.extend([(&mut item.cos, DIRECTION), (&mut item.sin, DIRECTION)]);
        fields.extend([(&mut item.length, SIZE), (&mut item.width, SIZE)]);
    }
    for item in cycle.tracks.iter_mut().flat_map(|list| &mut list.items) {
        fields.extend([(&mut item.x, POSITION), (&mut item.y, POSITION)]);
        fields.extend([(&mut item.cos, DIRECTION), (&mut item.sin, DIRECTION)]);
        fields.extend([(&mut item.vx, VELOCITY), (&mut item.vy, VELOCITY)]);
        fields.extend([(&mut item.length, SIZE), (&mut item.width, SIZE)]);
    }
    for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points) {
        fields.extend([(&mut point.x, POSITION), (&mut point.y, POSITION)]);
        fields.extend([(&mut point.cos, DIRECTION), (&mut point.sin, DIRECTION)]);
    }
    fields
}

/// One integer parameter or grid size at a border of its domain.
fn whole_number(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let ages = [0, 60_000_000_000, -1, 60_000_000_001, i64::MIN, i64::MAX];
    let p = &mut cycle.parameters;
    match draw.below(7) {
        0 => p.max_age_ns = draw.pick(&ages),
        1 => p.step_max_ns = draw.pick(&ages),
        2 => p.n = draw.pick(&[1, 64, 0, 65, -4, i64::MAX]),
        3 => p.miss_budget = draw.pick(&[0, 64, 65, -1, i64::MIN]),
        4 => p.work_limit = draw.pick(&[0, 1, -1, i64::MAX, i64::MIN]),
        _ => {
            let Some(grid) = &mut cycle.grid else { return };
            match draw.below(4) {
                0 => grid.width = draw.pick(&[0, -1, 32_769, i64::MAX, 17, 15]),
                1 => grid.height = draw.pick(&[0, -1, 32_769, i64::MIN, 17, 15]),
                2 => {
                    (grid.width, grid.height) =
                        draw.pick(&[(32_768, 512), (32_768, 513), (32_768, 32_768), (64, 4)]);
                    if grid.width == 32_768 && grid.height == 512 && draw.one_in(8) {
                        grid.occupied = vec![0; 1 << 21];
                    }
                }
                _ => {
                    grid.occupied.pop();
                    if draw.one_in(2) {
                        grid.occupied.push(0);
                        grid.unknown = Some(vec![0; draw.pick(&[31, 32, 33, 0])]);
                    }
                }
            }
        }
    }
}

/// One time at the border of 60 s from now, or the clock near the limits of 64 bits.
fn time(draw: &mut Draw<'_>, cycle: &mut Cycle, now_ns: i64) {
    let minute = 60_000_000_000;
    let off = draw.pick(&[minute, minute + 1, -minute, -minute - 1, i64::MAX, minute - 1]);
    let at = now_ns.saturating_sub(off);
    match draw.below(8) {
        0 => cycle.trajectory.iter_mut().for_each(|list| list.stamp_ns = at),
        1 => cycle.tracks.iter_mut().for_each(|list| list.stamp_ns = at),
        2 => cycle.detections.iter_mut().for_each(|list| list.stamp_ns = at),
        3 => cycle.lead.iter_mut().for_each(|lead| lead.stamp_ns = at),
        4 => cycle.grid.iter_mut().for_each(|grid| grid.stamp_ns = at),
        5 => cycle.detection_history.iter_mut().for_each(|list| list.stamp_ns = at),
        6 => {
            let Some(trajectory) = &mut cycle.trajectory else { return };
            let index = draw.below(trajectory.points.len().max(1));
            if let Some(point) = trajectory.points.get_mut(index) {
                point.t_ns = at;
            }
        }
        _ => cycle.now_ns = draw.pick(&[i64::MIN, i64::MAX, now_ns + minute, now_ns - minute]),
    }
}

/// A list that is too short, too long, out of order, or names an id twice.
fn list(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    match draw.below(13) {
        0 => cycle.trajectory.iter_mut().for_each(|list| list.points.clear()),
        1 => {
            let Some(trajectory) = &mut cycle.trajectory else { return };
            if let [.., before, last] = trajectory.points.as_mut_slice() {
                last.t_ns = before.t_ns - draw.pick(&[0, 1, -1]);
            }
        }
        2 => cycle.route.cross_sections.truncate(draw.pick(&[0, 1, 2])),
        3 | 4 => {
            let [first, second, .., last] = cycle.route.cross_sections.as_mut_slice() else {
                return;
            };
            match draw.below(3) {
                0 => (second.x, second.y) = (first.x, first.y),
                1 => (last.x, last.y) = (first.x, first.y),
                _ => second.left = first.right,
            }
            cycle.route.closed = draw.one_in(2);
        }
        5 | 6 => duplicate(cycle),
        _ if !draw.one_in(16) => duplicate(cycle),
        7 => cycle.tracks.iter_mut().for_each(|list| oversize(&mut list.items, 1024)),
        8 => cycle.detections.iter_mut().for_each(|list| oversize(&mut list.items, 2048)),
        9 => cycle.trajectory.iter_mut().for_each(|list| oversize(&mut list.points, 1024)),
        10 => oversize(&mut cycle.route.cross_sections, 8192),
        11 => cycle.detection_history.iter_mut().for_each(|list| oversize(&mut list.items, 2048)),
        _ => oversize(&mut cycle.detection_history, 4),
    }
}

/// Names the first track twice.
fn duplicate(cycle: &mut Cycle) {
    if let Some(list) = &mut cycle.tracks
        && let Some(mut track) = list.items.first().cloned()
    {
        track.x += 1.0;
        list.items.push(track);
    }
}

/// One item more than allowed, all equal to the first.
fn oversize<T: Clone>(items: &mut Vec<T>, most: usize) {
    if let Some(first) = items.first().cloned() {
        items.resize(most + 1, first);
    }
}
