//! What is done to a trajectory.

use mufasa::input::cycle::{Ego, TrajectoryPoint};

use super::{Kind, later};
use crate::services::tpl::STEP_NS;
use crate::services::way::seconds;

/// By how much a trajectory that starts late does, ns.
const LATE_NS: i64 = 1_000_000_000;
/// Most points of a message.
const MOST_POINTS: usize = 1024;
/// Speed at which a CAV that stands is driven on, m/s.
const CREEP: f64 = 5.0;

/// Spoils the points, if this kind of attack does that.
pub(super) fn spoil(kind: Kind, ego: &Ego, points: &mut Vec<TrajectoryPoint>) {
    match kind {
        Kind::StartsLate => points.iter_mut().for_each(|it| *it = later(it, LATE_NS)),
        Kind::Backwards => {
            let places: Vec<_> = points.iter().rev().copied().collect();
            for (point, place) in points.iter_mut().zip(places) {
                *point = TrajectoryPoint { t_ns: point.t_ns, ..place };
            }
        }
        Kind::IntoLead => go_on(ego, points),
        Kind::Slow => lengthen(points),
        Kind::MapReplaced
        | Kind::TracksEmpty
        | Kind::Ghosts
        | Kind::OneRemoved
        | Kind::CrossingStands
        | Kind::GhostInMean
        | Kind::FalseVelocities
        | Kind::ExchangedPasts
        | Kind::Replay
        | Kind::Drift
        | Kind::MadeUpLead
        | Kind::Delay
        | Kind::NotFinite
        | Kind::Flood => {}
    }
}

/// The way of the trajectory and straight on from its end, at constant speed.
fn go_on(ego: &Ego, points: &mut [TrajectoryPoint]) {
    let speed = ego.speed.max(CREEP);
    let way = points.to_vec();
    let Some(first) = way.first() else { return };
    for point in points.iter_mut() {
        let mut rest = speed * seconds(point.t_ns - first.t_ns);
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

/// As many points as the formats allow, the last standing.
fn lengthen(points: &mut Vec<TrajectoryPoint>) {
    let Some(last) = points.last().copied() else { return };
    let mut t_ns = last.t_ns;
    while points.len() < MOST_POINTS {
        t_ns += STEP_NS / 10;
        points.push(TrajectoryPoint { t_ns, ..last });
    }
}
