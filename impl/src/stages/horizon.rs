//! The points that stages iii, iv and v examine: those of the trajectory up to a horizon, and with
//! H-04 the next one and places beyond the end (`spec/3-stages.md#distances`).

use crate::hardened::h04_horizon::{PlacesBeyond, exact_s_stop, plain_s_stop, plain_way, way};
use crate::input::cycle::{Cycle, Lead, TrajectoryPoint};
use crate::input::profile::Profile;
use crate::numbers::plane::distance;
use crate::numbers::rounding::Real;
use crate::report::Witness;
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
    /// H-10: `s_stop` alone.
    Stop,
    /// H-13: `s_stop` + `tau_motion` `v_now`.
    Motion,
}

impl Horizon<'_> {
    /// The distance, m.
    fn distance<N: Number>(self, cycle: &Cycle<'_>) -> N {
        let (parameters, v_now) = (&cycle.parameters, cycle.ego.speed);
        match self {
            Self::Cav => s_cav(parameters, v_now),
            Self::Valid(lead) => s_valid(parameters, v_now, lead.map(|lead| lead.speed)),
            Self::Braking => s_b(parameters, N::from_double(v_now)),
            Self::Stop => N::from_double(0.0),
            Self::Motion => N::from_double(parameters.tau_motion).times(N::from_double(v_now)),
        }
    }

    /// H-04: (1 + 1e-6) max(s, `s_stop`), and the next point beyond (1 + 1e-6) `s_stop`; H-13 adds
    /// `s_stop` to s, and has the next point beyond that.
    fn hardened<N: Number>(self, cycle: &Cycle<'_>, s_stop: N) -> Bounds<N> {
        let s = self.distance::<N>(cycle);
        let stretched = |s: N| N::from_double(1.0).plus(N::from_double(1e-6)).times(s);
        if matches!(self, Self::Motion) {
            let s = stretched(s.plus(s_stop));
            return Bounds { s, next_beyond: Some(s) };
        }
        Bounds { s: stretched(s.or_larger(s_stop)), next_beyond: Some(stretched(s_stop)) }
    }

    /// How far the profile looks.
    fn exactly(self, cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Bounds<Real> {
        match cycle.profile {
            Profile::Paper => Bounds { s: self.distance(cycle), next_beyond: None },
            Profile::Hardened => self.hardened(cycle, exact_s_stop(cycle, points)),
        }
    }

    /// Doubles on either side of it: of at most twenty roundings all but those of one difference
    /// are of summands >= 0; its summands are `s_b(v_now)` and, unless 0 is larger, less.
    fn plainly(self, cycle: &Cycle<'_>, points: &[TrajectoryPoint]) -> Bounds<[f64; 2]> {
        let around = |[least, most]: [f64; 2]| {
            let error = 1e-13 * (most + s_b(&cycle.parameters, cycle.ego.speed)) + 1e-140;
            [least - error, most + error]
        };
        match (cycle.profile, points.first()) {
            (Profile::Hardened, Some(first)) => {
                let [least, most] =
                    plain_s_stop(cycle, first).map(|s_stop| self.hardened(cycle, s_stop));
                let next_beyond = least.next_beyond.zip(most.next_beyond);
                Bounds {
                    s: around([least.s, most.s]),
                    next_beyond: next_beyond.map(|(least, most)| around([least, most])),
                }
            }
            _ => Bounds { s: around([self.distance(cycle); 2]), next_beyond: None },
        }
    }
}

/// Which points are examined: those within s, and the first beyond a distance that is at most s, if
/// there is one of the two.
#[derive(Clone, Copy, Debug)]
struct Bounds<N> {
    s: N,
    next_beyond: Option<N>,
}

/// The points that a stage examines.
pub(crate) struct PointsExamined<'c, 'a> {
    pub(crate) cycle: &'c Cycle<'a>,
    /// Points of the trajectory, from the first on.
    pub(crate) points: &'a [TrajectoryPoint],
    pub(crate) beyond: PlacesBeyond,
}

impl<'c, 'a> PointsExamined<'c, 'a> {
    pub(crate) fn new(
        cycle: &'c Cycle<'a>,
        points: &'a [TrajectoryPoint],
        horizon: Horizon<'_>,
    ) -> Self {
        let bounds = horizon.plainly(cycle, points);
        let exactly = || horizon.exactly(cycle, points);
        let count = match cycle.profile {
            Profile::Paper => plainly_examined(points, bounds, plain_length)
                .unwrap_or_else(|| examined(points, exactly(), length)),
            Profile::Hardened => plainly_examined(points, bounds, plain_way_and_size)
                .unwrap_or_else(|| examined(points, exactly(), way)),
        };
        let ends = cycle.profile == Profile::Hardened && count > points.len();
        let beyond = if ends { PlacesBeyond::new(cycle, points) } else { PlacesBeyond::NONE };
        Self { cycle, points: points.get(..count).unwrap_or(points), beyond }
    }

    /// H-04: the first place beyond the end where `find` finds something.
    pub(crate) fn first_beyond(
        &self,
        find: impl FnMut(&Cycle<'a>, &[TrajectoryPoint]) -> Option<Witness>,
    ) -> Option<Witness> {
        self.beyond.first(self.cycle, self.points, find)
    }
}

/// The length of a step, m.
pub(crate) fn length(from: &TrajectoryPoint, to: &TrajectoryPoint) -> Real {
    distance([from.x, from.y], [to.x, to.y])
}

/// The same in plain doubles, and what its error is relative to.
#[inline]
fn plain_length(from: &TrajectoryPoint, to: &TrajectoryPoint) -> [f64; 2] {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    [libm::sqrt(dx * dx + dy * dy); 2]
}

/// H-04: the way of a step in plain doubles, and what its error is relative to.
#[inline]
fn plain_way_and_size(from: &TrajectoryPoint, to: &TrajectoryPoint) -> [f64; 2] {
    [plain_way(from, to), (to.x - from.x).abs() + (to.y - from.y).abs()]
}

/// How many points are examined. They form a prefix, since `step` is never below 0: the points
/// within s, of which the first is always one, and the next when the last of them is not beyond
/// `next_beyond`; that one may be behind the last of all.
fn examined(
    points: &[TrajectoryPoint],
    Bounds { s, next_beyond }: Bounds<Real>,
    step: impl Fn(&TrajectoryPoint, &TrajectoryPoint) -> Real,
) -> usize {
    let mut arc = Real::ZERO;
    let mut count = 1_usize;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let next = arc + step(a, b);
        if !next.possibly_at_most(s) {
            break;
        }
        arc = next;
        count = count.saturating_add(1);
    }
    let next = next_beyond.is_some_and(|limit| arc.possibly_at_most(limit));
    count.saturating_add(usize::from(next))
}

/// The same in plain doubles, unless they cannot tell. A step errs by less than 2^-50 of its size
/// and 1e-150 m (squares may underflow), a sum of at most 1023 of them by less than 2^-40 of all
/// sizes together.
fn plainly_examined(
    points: &[TrajectoryPoint],
    Bounds { s, next_beyond }: Bounds<[f64; 2]>,
    step: impl Fn(&TrajectoryPoint, &TrajectoryPoint) -> [f64; 2],
) -> Option<usize> {
    let (mut arc, mut sizes, mut last) = (0.0, 0.0, [0.0; 2]);
    let mut count = 1_usize;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let [length, size] = step(a, b);
        arc += length;
        sizes += size;
        let error = sizes * 1e-12 + 1e-140;
        let next = [arc - error, arc + error];
        if !is_within(next, s)? {
            break;
        }
        last = next;
        count = count.saturating_add(1);
    }
    let next = next_beyond.map_or(Some(false), |limit| is_within(last, limit))?;
    Some(count.saturating_add(usize::from(next)))
}

/// Whether a number is at most a limit, both given from below and from above, if that tells.
#[inline]
fn is_within([from, to]: [f64; 2], [least, most]: [f64; 2]) -> Option<bool> {
    if from > most {
        Some(false)
    } else if to <= least {
        Some(true)
    } else {
        None
    }
}
