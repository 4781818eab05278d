//! Stage ii at its thresholds: distance to the reference path, edges of the corridor, H-07, H-11
//! and H-14's reach (`spec/3-stages.md#stage-ii-trajectory-to-map`).

use mufasa_model::input::cycle::{
    CrossSection, Cycle, DetectionList, Ego, Profile, Route, Trajectory, TrajectoryPoint,
};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame, cross_section, seconds};
use super::draw::Draw;
use super::fail_safe::reach;
use super::steps;

/// A cycle that stage ii decides: an empty detection list is its passing obstacle check.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration =
        draw.pick(&[Configuration::PlanRemote, Configuration::AllRemote, Configuration::MotRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: Vec::new() });
    match (profile, draw.below(11)) {
        // Hardened: what is outside the corridor fails however near the path is.
        (Profile::PAPER, 1) | (_, 0) => {
            reference_distance(draw, frame, &mut cycle);
        }
        (_, 2 | 3) => corridor_edge(draw, frame, &mut cycle),
        (_, 4) => crooked_road(draw, frame, &mut cycle),
        (Profile::PAPER, _) => anywhere(draw, frame, &mut cycle),
        (_, 5) if draw.one_in(2) => positions(draw, frame, &mut cycle),
        (_, 5) => start(draw, frame, &mut cycle),
        (_, 6) => direction(draw, frame, &mut cycle),
        (_, 1 | 7 | 8) => steps::cycle(draw, frame, &mut cycle),
        (_, _) => reach::cycle(draw, &mut cycle),
    }
    cycle
}

/// Points near `theta_map` from the reference path of a corridor that does not reach so far,
/// beside a segment, beside a cross section, or behind the end.
fn reference_distance(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let theta_map = cycle.parameters.theta_map;
    let half_width = draw.pick(&[0.5 * theta_map, theta_map, 0.01]);
    cycle.route = base::road(frame, half_width);
    let side = draw.pick(&[1.0, -1.0]);
    let distance = draw.near(theta_map);
    let behind = draw.one_in(4);
    let Some(trajectory) = &mut cycle.trajectory else { return };
    let last = trajectory.points.len() - 1;
    let index = draw.below(last + 1);
    let along = draw.pick(&[0.0, 0.25, 40.0, 12.5]);
    let place = if behind {
        let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.6, 0.8), (0.8, -0.6)]);
        (120.0 + distance * cos, distance * sin)
    } else {
        (along, side * distance)
    };
    (trajectory.points[index].x, trajectory.points[index].y) = frame.at(place.0, place.1);
}

/// The whole trajectory along an edge of the corridor: outer edges, and the diagonals that two
/// triangles share.
fn corridor_edge(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let half_width = draw.pick(&[1.0, 0.75, 3.0]);
    let cross_sections = [-40.0, -8.0, draw.pick(&[0.0, 1.0, 4.0]), 40.0, 120.0];
    let cross_sections = cross_sections.map(|a| cross_section(frame, a, 0.0, half_width));
    cycle.route = Route { closed: false, cross_sections: cross_sections.to_vec() };
    if draw.one_in(3) {
        // A left boundary that comes in: the edge of the corridor is no longer parallel.
        let (x, y) = frame.at(0.0, 0.4 * half_width);
        cycle.route.cross_sections[2].left = [x, y];
    }
    let side = draw.pick(&[1.0, -1.0]);
    let offset = side * draw.near(half_width);
    let diagonal = draw.one_in(3);
    let shift = draw.offset();
    if let Some(trajectory) = &mut cycle.trajectory {
        let first = (trajectory.points[0].x, trajectory.points[0].y);
        for point in &mut trajectory.points {
            let along = (point.x - first.0).hypot(point.y - first.1);
            let place = if diagonal {
                let [r, l] =
                    [cycle.route.cross_sections[2].right, cycle.route.cross_sections[3].left];
                let part = (along / 40.0).min(1.0);
                let slope = (l[0] - r[0], l[1] - r[1]);
                (r[0] + part * slope.0 - shift * frame.sin, r[1] + part * slope.1)
            } else {
                frame.at(along, offset)
            };
            (point.x, point.y) = place;
        }
    }
    follow(cycle);
    if diagonal {
        head_along(cycle);
        cut_corridor(cycle);
    }
}

/// Turns the headings of the trajectory, and the CAV's, along its steps.
fn head_along(cycle: &mut Cycle) {
    let Some(trajectory) = &mut cycle.trajectory else { return };
    let [first, .., last] = trajectory.points.as_slice() else { return };
    let way = (last.x - first.x, last.y - first.y);
    if way.0.hypot(way.1) > 1e-3 {
        let (cos, sin) = unit(way);
        (cycle.ego.cos, cycle.ego.sin) = (cos, sin);
        for point in &mut trajectory.points {
            (point.cos, point.sin) = (cos, sin);
        }
    }
}

/// Takes away the triangle (left, right, right) of every pair by laying both left points of the
/// first cross section on its right one: the diagonal becomes an outer edge.
fn cut_corridor(cycle: &mut Cycle) {
    if let Some(cross_section) = cycle.route.cross_sections.get_mut(2) {
        cross_section.left = cross_section.right;
    }
}

/// Moves the CAV to the first point of its trajectory, so that H-07's start holds.
fn follow(cycle: &mut Cycle) {
    if let Some(first) = cycle.trajectory.as_ref().and_then(|list| list.points.first()) {
        (cycle.ego.x, cycle.ego.y) = (first.x, first.y);
    }
}

/// Roads with corners, loops and boundaries that cross, and a trajectory of a few points near
/// cross sections, boundaries and midpoints.
fn crooked_road(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    const CORNERS: [(f64, f64); 6] =
        [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0), (-6.0, 4.0), (4.0, -6.0)];
    let n = draw.between(2, 6);
    let mut cross_sections: Vec<CrossSection> = Vec::new();
    for &(a, b) in CORNERS.iter().take(n) {
        let half = draw.pick(&[1.0, 0.5, 2.0]);
        cross_sections.push(cross_section(frame, a, b, half));
    }
    let closed = draw.one_in(2);
    if closed && draw.one_in(3) {
        cross_sections.push(cross_sections[0].clone());
    }
    if draw.one_in(4) {
        let cross_section = &mut cross_sections[1];
        std::mem::swap(&mut cross_section.left, &mut cross_section.right);
    }
    cycle.route = Route { closed, cross_sections };
    for index in 0..draw.between(1, 3) {
        let place = road_place(draw, cycle);
        if let Some(point) = point_at(cycle, index) {
            (point.x, point.y) = place;
        }
    }
    follow(cycle);
}

/// A place near an edge of the corridor, a corner of it, or `theta_map` beside the path.
fn road_place(draw: &mut Draw<'_>, cycle: &Cycle) -> (f64, f64) {
    let cross_sections = &cycle.route.cross_sections;
    let from = draw.below(cross_sections.len());
    let (here, next) = (&cross_sections[from], &cross_sections[(from + 1) % cross_sections.len()]);
    let edge = draw.below(5);
    let (a, b) = match edge {
        0 => (here.left, next.left),
        1 => (here.right, next.right),
        2 => (here.left, here.right),
        3 => (here.left, next.right),
        _ => ([here.x, here.y], [next.x, next.y]),
    };
    let part = draw.pick(&[0.5, 0.0, 1.0, 0.25]);
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0].hypot(along[1]).max(1e-3);
    let aside = if edge == 4 { draw.near(cycle.parameters.theta_map) } else { draw.offset() };
    (
        a[0] + part * along[0] - aside * along[1] / length,
        a[1] + part * along[1] + aside * along[0] / length,
    )
}

/// Paper: any points of a trajectory near the path's limits, times and headings at will.
fn anywhere(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let half_width = draw.pick(&[2.0, 0.1]);
    cycle.route = base::road(frame, half_width);
    for index in 0..draw.between(1, 4) {
        let place = road_place(draw, cycle);
        let heading = draw.direction();
        if let Some(point) = point_at(cycle, index) {
            (point.x, point.y) = place;
            (point.cos, point.sin) = heading;
        }
    }
}

/// H-07: the first point late or early by about `max_age`, too far from the CAV, too far aside, or
/// turned too far.
fn start(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let parameters = cycle.parameters.clone();
    let late = match draw.below(4) {
        0 => draw.near_ns(parameters.max_age_ns),
        1 => -draw.near_ns(parameters.max_age_ns),
        _ => {
            let late = draw.pick(&[0, 20_000_000, -20_000_000, 100_000_000]);
            draw.odd_ns(late.max(0)) + late.min(0)
        }
    };
    let t = seconds(late);
    // Late is negative where the first point is ahead of now.
    let gained = if late < 0 { parameters.a_max * t * t / 2.0 } else { 0.0 };
    let limit = parameters.start_tolerance + cycle.ego.speed * t.abs() + gained;
    let distance = if draw.one_in(4) { 0.0 } else { draw.near(limit) };
    let (cos, sin) = draw.pick(&[(1.0, 0.0), (0.0, 1.0), (0.8, -0.6), (-1.0, 0.0), (0.6, 0.8)]);
    // Beside the start as far as at the end of the tolerance, or at the limit to the side.
    let (along, aside) = if draw.one_in(2) {
        (distance.min(0.5) * cos, draw.pick(&[1.0, -1.0]) * draw.near(parameters.lateral_tolerance))
    } else {
        cycle.parameters.lateral_tolerance = 10.0;
        (distance * cos, distance * sin)
    };
    let (x, y) = frame.at(along, aside);
    (cycle.ego.x, cycle.ego.y) = (x, y);
    if draw.one_in(3) {
        let sin = draw.pick(&[1.0, -1.0]) * draw.near(0.17);
        let (cos, sin) = frame.turn(((1.0 - sin * sin).sqrt(), sin));
        (cycle.ego.cos, cycle.ego.sin) = (cos, sin);
    }
    if let Some(trajectory) = &mut cycle.trajectory {
        for point in &mut trajectory.points {
            point.t_ns -= late;
        }
    }
}

/// H-07.2: a straight plan, of which the second point is about as far as the CAV can drive by then.
pub fn positions(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let late_ns = draw.pick(&[60_000_000, -30_000_000, 30_000_000, 0]);
    let parameters = &mut cycle.parameters;
    parameters.max_age_ns = parameters.max_age_ns.max(60_000_000);
    // So near that a step leads there.
    parameters.start_tolerance = draw.pick(&[0.5, 1.0, 2.0]);
    let after_ns = draw.odd_ns(50_000_000) - late_ns;
    let t = seconds(after_ns);
    let gained = if after_ns < 0 { 0.0 } else { parameters.a_max * t * t / 2.0 };
    let limit = draw.near(parameters.start_tolerance + cycle.ego.speed * t.abs() + gained);
    let far = limit.min(0.99 * cycle.ego.length);
    let Ego { x, y, cos, sin, .. } = cycle.ego;
    let way = [(-late_ns, 0.0), (after_ns, far), (after_ns + 100_000_000, far + 0.1)];
    let points = way.map(|(after_ns, along)| {
        let (x, y) = Frame { x, y, ..frame }.at(along, 0.0);
        TrajectoryPoint { t_ns: cycle.now_ns + after_ns, x, y, cos, sin }
    });
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points: points.to_vec() });
}

/// H-07: headings nearly across the nearest segment, at corners where several are nearest.
fn direction(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let (a, b) = draw.pick(&[(3.0, 4.0), (4.0, 3.0), (0.0, 5.0), (-3.0, 4.0), (-4.0, -3.0)]);
    let side = draw.pick(&[1.0, -1.0]);
    let ends = [cross_section(frame, -5.0, 0.0, 8.0), cross_section(frame, 0.0, 0.0, 8.0)];
    let mut cross_sections = ends.to_vec();
    cross_sections.push(cross_section(frame, a, side * b, 8.0));
    cycle.route = Route { closed: false, cross_sections };
    cycle.ego.speed = 0.0;
    // Straight up, away from the turn: the corner is nearest, or both segments are.
    let up = -side * draw.pick(&[0.5, 1.0, 0.0, 2.0]);
    let along = draw.pick(&[0.0, -0.5, 0.25]) + draw.offset();
    let (x, y) = frame.at(along, up);
    let tilt = draw.near(0.0);
    let heading = match draw.below(4) {
        0 => (tilt, side),
        1 => (tilt, -side),
        2 => (-side * b / 5.0 + tilt, a / 5.0),
        _ => (side * b / 5.0, -a / 5.0 + tilt),
    };
    let (cos, sin) = frame.turn(unit(heading));
    (cycle.ego.x, cycle.ego.y) = (x, y);
    (cycle.ego.cos, cycle.ego.sin) = (cos, sin);
    let t_ns = cycle.now_ns;
    let point = TrajectoryPoint { t_ns, x, y, cos, sin };
    cycle.trajectory = Some(Trajectory { stamp_ns: t_ns, points: vec![point] });
}

/// The trajectory point of this index, if there is one.
fn point_at(cycle: &mut Cycle, index: usize) -> Option<&mut TrajectoryPoint> {
    cycle.trajectory.as_mut().and_then(|list| list.points.get_mut(index))
}

/// The direction of a vector that is not null.
fn unit((a, b): (f64, f64)) -> (f64, f64) {
    let length = a.hypot(b);
    (a / length, b / length)
}
