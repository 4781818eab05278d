//! What is done to a trajectory.

use mufasa::input::cycle::{Ego, TrajectoryPoint};

use super::{Attack, Kind, later, nanoseconds};
use crate::services::tpl::STEP_NS;
use crate::time::seconds;
use crate::vehicle::{A_B, TAU_S};

/// Most points of a message.
const MOST_POINTS: usize = 1024;

/// Spoils the points, if this kind of attack does that.
pub(super) fn spoil(attack: &Attack, ego: &Ego, points: &mut Vec<TrajectoryPoint>) {
    let means = &attack.means;
    match attack.kind {
        Kind::StartsLate => {
            let late_ns = nanoseconds(means.late_s);
            points.iter_mut().for_each(|it| *it = later(it, late_ns));
        }
        Kind::EndsEarly => end_early(ego.speed, means.ahead_m, points),
        Kind::Backwards => {
            let places: Vec<_> = points.iter().rev().copied().collect();
            for (point, place) in points.iter_mut().zip(places) {
                *point = TrajectoryPoint { t_ns: point.t_ns, ..place };
            }
        }
        Kind::IntoLead => {
            go_on(ego.speed.max(means.speed_mps), means.acceleration_mps2, points);
        }
        Kind::Swerve => swerve(means.left_m, means.ahead_m, points),
        Kind::Slow => lengthen(points),
        _ => {}
    }
}

/// The way of the trajectory and straight on from its end, from a speed on, m/s, evenly accelerated, m/s^2.
fn go_on(speed: f64, acceleration: f64, points: &mut [TrajectoryPoint]) {
    let way = points.to_vec();
    let Some(first) = way.first() else { return };
    for point in points.iter_mut() {
        let t = seconds(point.t_ns - first.t_ns);
        // Who brakes does not roll back.
        let t = if acceleration < 0.0 { t.min(-speed / acceleration) } else { t };
        let mut rest = speed * t + acceleration * t * t / 2.0;
        let mut at = *first;
        for pair in way.windows(2) {
            let (x, y) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
            let length = (x * x + y * y).sqrt();
            at = pair[1];
            if rest <= length && length > 0.0 {
                let share = rest / length;
                at = TrajectoryPoint {
                    x: pair[0].x + share * x,
                    y: pair[0].y + share * y,
                    ..pair[1]
                };
                rest = 0.0;
                break;
            }
            rest -= length;
        }
        let (x, y) = (at.x + rest * at.cos, at.y + rest * at.sin);
        *point = TrajectoryPoint { t_ns: point.t_ns, x, y, ..at };
    }
}

/// Aside by `left`, m, after a way of `over`, m, evenly swung; directions are those of the new way.
fn swerve(left: f64, over: f64, points: &mut [TrajectoryPoint]) {
    let (over, mut way) = (over.max(1.0), 0.0);
    let Some(mut before) = points.first().copied() else { return };
    for point in points.iter_mut() {
        let (x, y) = (point.x - before.x, point.y - before.y);
        before = *point;
        way += (x * x + y * y).sqrt();
        let share = (way / over).min(1.0);
        let aside = left * share * share * (3.0 - 2.0 * share);
        let slope = 6.0 * left * share * (1.0 - share) / over;
        let norm = (1.0 + slope * slope).sqrt();
        *point = TrajectoryPoint {
            t_ns: point.t_ns,
            x: before.x - aside * before.sin,
            y: before.y + aside * before.cos,
            cos: (before.cos - slope * before.sin) / norm,
            sin: (before.sin + slope * before.cos) / norm,
        };
    }
}

/// Up to the first point farther than the CAV's way until it stands, from a speed on, m/s, and `behind`, m.
fn end_early(speed: f64, behind: f64, points: &mut Vec<TrajectoryPoint>) {
    let reach = TAU_S * speed + speed * speed / (2.0 * A_B) + behind;
    let mut way = 0.0;
    let last = points.windows(2).position(|pair| {
        let (x, y) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        way += (x * x + y * y).sqrt();
        way > reach
    });
    points.truncate(last.map_or(usize::MAX, |index| index + 2));
}

/// As many points as the formats allow, the last standing.
fn lengthen(points: &mut Vec<TrajectoryPoint>) {
    let Some(last) = points.last().copied() else { return };
    let mut t_ns = last.t_ns;
    while points.len() < MOST_POINTS {
        t_ns += STEP_NS / 10;
        points.push(TrajectoryPoint { t_ns, ..last });
    }
}
