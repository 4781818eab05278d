//! A planner in the hands of an attacker: it knows the route and the CAV, and no object.

use mufasa_model::input::cycle::{Cycle, Ego, Track, TrajectoryPoint};

use crate::drive::DriveCycle;
use crate::geometry::Rectangle;
use crate::geometry::{Point, Polyline, add, direction, distance, scale, sub};
use crate::readers::error::ReadError;
use crate::recording::lead::{Cav, leading_vehicle};
use crate::recording::object::Seen;

/// Points of a trajectory, and the time between them, s and ns.
const POINTS: u32 = 50;
const STEP_S: f64 = 0.1;
const STEP_NS: i64 = 100_000_000;
/// The planner speeds up with this, m/s^2, until it drives at least so fast, m/s.
const PULL: f64 = 2.0;
const CRUISE: f64 = 8.0;
/// A wrong lane is reached after this way, m, or this time, s.
const ASIDE: [f64; 2] = [15.0, 2.0];
/// Ghosts: ahead along the path and to the left, m; ids count down from the first.
const GHOSTS: [(i64, Point); 3] = [(-1, [15.0, 0.0]), (-2, [10.0, 4.0]), (-3, [20.0, -4.0])];

/// Points of a line are at least so far apart, m, so that it has a direction where the CAV creeps.
const APART: f64 = 0.5;

/// The planner at one instant.
pub(crate) struct Planner {
    path: Polyline,
    /// Width of the corridor where the CAV is, m.
    pub(crate) width: f64,
    /// Place and offset of the CAV on the path, m, and its speed, m/s.
    s: f64,
    lateral: f64,
    speed: f64,
    /// Whether it plans no farther than its path goes.
    ends: bool,
}

impl Planner {
    /// A planner that follows the reference path, as far aside of it as the CAV is.
    pub(crate) fn new(cycle: &Cycle) -> Self {
        let path = reference_path(cycle);
        let foot = path.project([cycle.ego.x, cycle.ego.y]);
        let width = foot.map_or(3.5, |f| {
            let section = &cycle.route.cross_sections[path.locate(f.s).0];
            distance(section.left, section.right)
        });
        Self { width, ends: false, ..Self::along(path, cycle) }
    }

    /// A planner that follows a line; it needs no width.
    pub(crate) fn along(path: Polyline, cycle: &Cycle) -> Self {
        let foot = path.project([cycle.ego.x, cycle.ego.y]);
        let (s, lateral) = foot.map_or((0.0, 0.0), |f| (f.s, f.lateral));
        Self { path, width: 0.0, s, lateral, speed: cycle.ego.speed, ends: true }
    }

    /// Whether the path ends before a CAV that brakes from now on stands: then nobody knows how it
    /// would go on.
    pub(crate) fn is_at_the_end(&self, cycle: &Cycle) -> bool {
        let braking_s = self.speed / cycle.parameters.a_b;
        self.s + self.after(braking_s + STEP_S).0 > self.path.length()
    }

    /// Way made good and speed after a time.
    fn after(&self, time_s: f64) -> (f64, f64) {
        let pull_s = ((CRUISE - self.speed) / PULL).clamp(0.0, time_s.max(0.0));
        let fast = self.speed + PULL * pull_s;
        (self.speed.midpoint(fast) * pull_s + fast * (time_s - pull_s), fast)
    }

    /// The place `lateral` left of the path at arc length `s`; beyond its ends it goes straight
    /// on. `None` when there is no path.
    fn place(&self, s: f64, lateral: f64) -> Option<Point> {
        if self.path.points.len() < 2 {
            return None;
        }
        let (i, _) = self.path.locate(s);
        let (a, b) = (self.path.points[i], self.path.points[i + 1]);
        let length = distance(a, b);
        if length <= 0.0 {
            return None;
        }
        let along = scale(sub(b, a), 1.0 / length);
        let foot = add(a, scale(along, s - self.path.arc[i]));
        Some(add(foot, scale([-along[1], along[0]], lateral)))
    }

    /// A new trajectory from the CAV along the path, at its speed or faster, or backwards; ending
    /// `aside` to the left of where it would.
    pub(crate) fn replan(&self, cycle: &mut Cycle, backwards: bool, aside: f64) {
        let now_ns = cycle.now_ns;
        let Ego { x, y, cos, sin, speed, .. } = cycle.ego;
        let ramp = ASIDE[0].max(ASIDE[1] * speed);
        let mut points = vec![TrajectoryPoint { t_ns: now_ns, x, y, cos, sin }];
        for k in 1..=POINTS {
            let (driven, _) = self.after(f64::from(k) * STEP_S);
            let u = (driven / ramp).min(1.0);
            let lateral = self.lateral + aside * u * u * (3.0 - 2.0 * u);
            let made = if backwards { -driven } else { driven };
            // A planner plans no farther than it knows the road.
            if self.ends && self.s + made > self.path.length() {
                break;
            }
            let Some([x, y]) = self.place(self.s + made, lateral) else { return };
            // The heading is that of the step, or of its reverse when driving backwards.
            let last = &points[points.len() - 1];
            let step = if backwards { [last.x - x, last.y - y] } else { [x - last.x, y - last.y] };
            let still = step[0].hypot(step[1]) < 1e-6;
            let [cos, sin] =
                if still { [last.cos, last.sin] } else { direction(step[1].atan2(step[0])) };
            let t_ns = now_ns.saturating_add(i64::from(k) * STEP_NS);
            points.push(TrajectoryPoint { t_ns, x, y, cos, sin });
        }
        if let Some(trajectory) = &mut cycle.trajectory {
            trajectory.points = points;
        }
    }

    /// Moves the CAV to where it is `time_s` after this instant if it drives as planned, and
    /// measures its lead anew, from the true objects.
    pub(crate) fn execute(
        &self,
        cycle: &mut Cycle,
        time_s: f64,
        objects: &[Track],
        lead_range_m: f64,
    ) {
        let (driven, speed) = self.after(time_s);
        let (here, next) = (self.s + driven, self.s + driven + 0.5);
        let places = [self.place(here, self.lateral), self.place(next, self.lateral)];
        let [Some([x, y]), Some(ahead)] = places else { return };
        if driven > 0.0 {
            let way = sub(ahead, [x, y]);
            let [cos, sin] = direction(way[1].atan2(way[0]));
            cycle.ego = Ego { x, y, cos, sin, speed, ..cycle.ego };
        }
        let seen: Vec<Seen> = objects.iter().map(seen).collect();
        let cav = Cav { position: [x, y], length: cycle.ego.length, width: cycle.ego.width };
        let stamp_ns = cycle.lead.as_ref().map_or(cycle.now_ns, |l| l.stamp_ns);
        cycle.lead = leading_vehicle(&cycle.route, stamp_ns, &cav, &seen, lead_range_m);
    }

    /// Standing cars where there are none.
    pub(crate) fn ghosts(&self, ego: &Ego) -> Vec<Track> {
        let ghost = |(id, [ahead, left]): (i64, Point)| {
            let place = self.place(self.s + ahead, left);
            let [x, y] = place.unwrap_or([ego.x + ahead, ego.y + left]);
            let (cos, sin) = (ego.cos, ego.sin);
            Track { id, x, y, cos, sin, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 }
        };
        GHOSTS.map(ghost).to_vec()
    }
}

fn reference_path(cycle: &Cycle) -> Polyline {
    let mut points: Vec<Point> = cycle.route.cross_sections.iter().map(|s| [s.x, s.y]).collect();
    if cycle.route.closed {
        points.extend(points.first().copied());
    }
    Polyline::new(points)
}

/// The way of a CAV as it was driven and, at its end, planned, and from there on the reference path,
/// as far aside of it as that end is: a line that keeps to the lane as far as the drive does.
pub(crate) fn driven_line(
    cycles: impl Iterator<Item = Result<DriveCycle, ReadError>>,
) -> Result<Polyline, ReadError> {
    let mut points: Vec<Point> = Vec::new();
    let mut push = |p: Point| {
        if points.last().is_none_or(|last| distance(*last, p) >= APART) {
            points.push(p);
        }
    };
    let mut last = None;
    for made in cycles {
        let cycle = made?.cycle;
        push([cycle.ego.x, cycle.ego.y]);
        last = Some(cycle);
    }
    let planned = last.iter().filter_map(|it| it.trajectory.as_ref()).flat_map(|it| &it.points);
    planned.for_each(|point| push([point.x, point.y]));
    let Some(path) = last.as_ref().map(reference_path) else {
        return Ok(Polyline::new(points));
    };
    if let Some(foot) = points.last().and_then(|end| path.project(*end)) {
        let from = path.locate(foot.s).0;
        for (i, pair) in path.points.windows(2).enumerate().skip(from) {
            let along = sub(pair[1], pair[0]);
            let length = distance(pair[0], pair[1]);
            if length > 0.0 && path.arc[i + 1] > foot.s + APART {
                let left = scale([-along[1], along[0]], foot.lateral / length);
                points.push(add(pair[1], left));
            }
        }
    }
    Ok(Polyline::new(points))
}

fn seen(track: &Track) -> Seen {
    let center = [track.x, track.y];
    let heading = track.sin.atan2(track.cos);
    let shape = Rectangle { center, heading, length: track.length, width: track.width };
    Seen { id: track.id, shape, velocity: [track.vx, track.vy] }
}
