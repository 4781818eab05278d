//! Control: acceleration and steering that follow a trajectory.
//!
//! A stand-in for a vehicle's control, which the paper leaves on the vehicle: pure pursuit across, feedback
//! of place and speed along. It cannot show delays of actuators or slipping tyres.

use core::mem::take;

use mufasa::input::cycle::{Ego, TrajectoryPoint};

use crate::pose::{Point, Pose};
use crate::time::seconds;
use crate::vehicle::{Body, Command};

/// Distance of the pursued place: at least this, m, ...
const PURSUIT: f64 = 3.5;
/// ... and this time at the present speed, s.
const PURSUIT_TIME: f64 = 0.6;

/// Control of one vehicle.
#[derive(Clone, Debug)]
pub struct Controller {
    body: Body,
    /// The last trajectory that was followed.
    last: Vec<TrajectoryPoint>,
}

impl Controller {
    /// Control that has followed nothing yet.
    pub const fn new(body: Body) -> Self {
        Self { body, last: Vec::new() }
    }

    /// The command for a time, ns. Without points, or with points that end before it, it brakes as hard as
    /// it can along the last trajectory. The vehicle's reference point has to be its rear axle.
    pub fn command(&mut self, ego: &Ego, points: &[TrajectoryPoint], t_ns: i64) -> Command {
        let usable = points.last().is_some_and(|last| t_ns <= last.t_ns);
        if usable && points != self.last {
            let mut last = take(&mut self.last);
            last.clear();
            last.extend_from_slice(points);
            self.last = last;
        }
        let steering = self.steering(ego);
        let acceleration =
            if usable { self.acceleration(ego, t_ns) } else { self.body.acceleration_min };
        Command { acceleration, steering }
    }

    /// Steers on a circle through the place of the trajectory that is the distance of the pursuit away; the
    /// trajectory goes on straight on behind its end.
    fn steering(&self, ego: &Ego) -> f64 {
        let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
        let Body { wheelbase, steering_max, .. } = self.body;
        let distance = PURSUIT.max(PURSUIT_TIME * ego.speed);
        let Some(place) = self.place_at_distance(pose, distance) else { return 0.0 };
        let (ahead, left) = pose.local(place);
        let square = ahead * ahead + left * left;
        // Nothing behind can be pursued.
        if ahead <= 0.0 {
            return steering_max.copysign(left);
        }
        libm::atan(wheelbase * 2.0 * left / square).clamp(-steering_max, steering_max)
    }

    fn place_at_distance(&self, pose: Pose, distance: f64) -> Option<Point> {
        let nearest = |a: &&TrajectoryPoint, b: &&TrajectoryPoint| {
            place(a).distance(pose.at).total_cmp(&place(b).distance(pose.at))
        };
        let start = self.last.iter().min_by(nearest)?;
        let behind = self.last.iter().skip_while(|point| point.t_ns < start.t_ns);
        let mut before = place(start);
        for point in behind {
            let at = place(point);
            if at.distance(pose.at) >= distance {
                return Some(between(before, at, pose.at, distance));
            }
            before = at;
        }
        let end = self.last.last()?;
        let pose_at_end = Pose { at: place(end), cos: end.cos, sin: end.sin };
        // From the end on, such that the place is about as far away as asked for.
        let (ahead, left) = pose_at_end.local(pose.at);
        let rest = (distance * distance - left * left).max(0.0).sqrt();
        Some(pose_at_end.ahead((ahead + rest).max(0.0), 0.0))
    }

    fn acceleration(&self, ego: &Ego, t_ns: i64) -> f64 {
        let Body { acceleration_min, acceleration_max, .. } = self.body;
        let Some((wanted, at, slope)) = self.wanted(t_ns) else { return acceleration_min };
        let pose = Pose { at: Point::new(ego.x, ego.y), cos: ego.cos, sin: ego.sin };
        let (ahead, _) = pose.local(at);
        let feedback = slope + 2.0 * (wanted - ego.speed) + ahead;
        // Where the trajectory stands, the vehicle does not creep to make up for the last centimetres.
        let feedback = if wanted <= 0.05 && slope <= 0.0 { feedback.min(-1.0) } else { feedback };
        feedback.clamp(acceleration_min, acceleration_max)
    }

    /// Speed, place and acceleration of the trajectory at a time.
    fn wanted(&self, t_ns: i64) -> Option<(f64, Point, f64)> {
        let points = &self.last;
        let after =
            points.partition_point(|point| point.t_ns <= t_ns).clamp(1, points.len().max(2) - 1);
        let (from, to) = (points.get(after - 1)?, points.get(after)?);
        let speed = |index: usize| -> Option<f64> {
            let (from, to) = (points.get(index.checked_sub(1)?)?, points.get(index)?);
            let dt = seconds(to.t_ns.checked_sub(from.t_ns)?);
            (dt > 0.0).then(|| place(from).distance(place(to)) / dt)
        };
        let dt = seconds(to.t_ns.checked_sub(from.t_ns)?);
        let share = (seconds(t_ns.saturating_sub(from.t_ns)) / dt).clamp(0.0, 1.0);
        let (start, end) = (place(from), place(to));
        let at =
            Point::new(start.x + share * (end.x - start.x), start.y + share * (end.y - start.y));
        // Speeds of steps are those of their middles; before the first middle the change goes on as behind it.
        let own = speed(after)?;
        let (before, behind) = (speed(after - 1), speed(after + 1));
        let (from_before, to_behind) =
            (before.map(|before| own - before), behind.map(|behind| behind - own));
        let slope = if share < 0.5 { from_before.or(to_behind) } else { to_behind.or(from_before) };
        let slope = slope.unwrap_or(0.0);
        Some(((own + slope * (share - 0.5)).max(0.0), at, slope / dt))
    }
}

fn place(point: &TrajectoryPoint) -> Point {
    Point::new(point.x, point.y)
}

/// The place between two that is at a distance from a centre.
fn between(near: Point, far: Point, centre: Point, distance: f64) -> Point {
    let (a, b) = (near.distance(centre), far.distance(centre));
    let share = if b - a > 1e-9 { ((distance - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
    Point::new(near.x + share * (far.x - near.x), near.y + share * (far.y - near.y))
}
