//! The points that stages iii, iv and v examine: those of the trajectory up to a horizon
//! (`spec/3-stages.md#distances`).

use crate::input::cycle::{Cycle, Lead, TrajectoryPoint};
use crate::numbers::plane::distance;
use crate::numbers::rounding::Real;
use crate::stages::distances::{Number, s_b, s_cav, s_valid};

/// How far stages iii, iv and v look.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Horizon<'c> {
    /// `s_CAV`
    Cav,
    /// `s_valid`, with the current leading vehicle.
    Valid(Option<&'c Lead>),
    /// `s_b(v_now)`
    Braking,
}

impl Horizon<'_> {
    /// The distance, m.
    fn distance<N: Number>(self, cycle: &Cycle<'_>) -> N {
        let (parameters, v_now) = (&cycle.parameters, cycle.ego.speed);
        match self {
            Self::Cav => s_cav(parameters, v_now),
            Self::Valid(lead) => s_valid(parameters, v_now, lead.map(|lead| lead.speed)),
            Self::Braking => s_b(parameters, N::from_double(v_now)),
        }
    }

    /// Doubles on either side of it: of at most twenty roundings all but those of one difference
    /// are of summands >= 0; its summands are `s_b(v_now)` and, unless 0 is larger, less.
    fn plainly(self, cycle: &Cycle<'_>) -> [f64; 2] {
        let s: f64 = self.distance(cycle);
        let error = 1e-13 * (s + s_b(&cycle.parameters, cycle.ego.speed)) + 1e-140;
        [s - error, s + error]
    }
}

/// The points of the trajectory that a stage examines, from the first on.
pub(crate) fn points_examined<'a>(
    cycle: &Cycle<'_>,
    points: &'a [TrajectoryPoint],
    horizon: Horizon<'_>,
) -> &'a [TrajectoryPoint] {
    let plainly = plainly_examined(points, horizon.plainly(cycle));
    let count = plainly.unwrap_or_else(|| examined(points, horizon.distance(cycle)));
    points.get(..count).unwrap_or(points)
}

/// How many points are examined: the first (DIST-04), and those after it up to one that is not
/// within s; `None` where that is open.
pub(crate) fn prefix(are_within: impl Iterator<Item = Option<bool>>) -> Option<usize> {
    let mut count = 1_usize;
    for is_within in are_within {
        if !is_within? {
            break;
        }
        count = count.saturating_add(1);
    }
    Some(count)
}

/// Each point but the last, and the next one.
fn steps(points: &[TrajectoryPoint]) -> impl Iterator<Item = (&TrajectoryPoint, &TrajectoryPoint)> {
    points.iter().zip(points.iter().skip(1))
}

fn examined(points: &[TrajectoryPoint], s: Real) -> usize {
    let mut arc = Real::ZERO;
    let count = prefix(steps(points).map(|(a, b)| {
        // DIST-03
        arc = arc + distance([a.x, a.y], [b.x, b.y]);
        Some(arc.possibly_at_most(s))
    }));
    count.unwrap_or(points.len())
}

/// The same in plain doubles, unless they cannot tell: stage iii of W1 takes a sixth of the instructions so.
fn plainly_examined(points: &[TrajectoryPoint], s: [f64; 2]) -> Option<usize> {
    let mut arc = 0.0;
    prefix(steps(points).map(|(a, b)| {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        // DIST-03
        arc += libm::sqrt(dx * dx + dy * dy);
        plainly_within(arc, s)
    }))
}

/// Whether a way is within s. A step errs by less than 2^-50 of its size and 1e-150 m (squares may underflow), a sum
/// of at most 1023 of them by less than 2^-40 of all sizes together.
pub(crate) fn plainly_within(arc: f64, [least, most]: [f64; 2]) -> Option<bool> {
    let error = arc * 1e-12 + 1e-140;
    if arc - error > most {
        Some(false)
    } else if arc + error > least {
        None
    } else {
        Some(true)
    }
}
