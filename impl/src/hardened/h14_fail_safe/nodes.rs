//! The nodes of the path, and its pieces in plain doubles (`spec/hardened/H-14.md#requirements-the-path`).

use core::cmp::Ordering;
use core::iter;

use crate::hardened::h14_fail_safe::times::{Times, longest};
use crate::input::cycle::{Cycle, Ego, TrajectoryPoint};
use crate::numbers::exact::{Product, compare};
use crate::numbers::range::{larger, smaller};
use crate::stages::llcc::sweep::{minus, split};

/// How far ahead the first point has to be that is a node, m.
const AHEAD: f64 = 0.125;
/// A quarter of a metre; less for a CAV that is shorter.
const QUARTER: f64 = 0.25;

/// From the CAV through the points of the trajectory that are ahead of it, and on.
#[derive(Clone, Copy)]
pub(crate) struct Nodes<'c, 'a> {
    pub(crate) cycle: &'c Cycle<'a>,
    /// Those of the trajectory.
    pub(super) points: &'a [TrajectoryPoint],
    /// d_p, m.
    pub(super) d: f64,
}

impl<'c, 'a> Nodes<'c, 'a> {
    pub(crate) fn new(cycle: &'c Cycle<'a>, points: &'a [TrajectoryPoint]) -> Self {
        // H-14.1
        let ahead = points.iter().position(|point| is_ahead(&cycle.ego, point));
        let points = ahead.and_then(|first| points.get(first..)).unwrap_or(&[]);
        Self { cycle, points, d: smaller(QUARTER, cycle.ego.length) }
    }

    /// Of all points of the trajectory those that are no nodes: the first ones.
    pub(crate) fn others<'p>(&self, points: &'p [TrajectoryPoint]) -> &'p [TrajectoryPoint] {
        points.get(..points.len().saturating_sub(self.points.len())).unwrap_or(&[])
    }

    /// The pieces in plain doubles, up to the first that ends more than 1 mm beyond `s_stop`, or begins beyond the greatest
    /// length (less than H-14.56 has). Behind the last node there is one, to `s_stop`, or a place beyond the greatest length.
    pub(crate) fn lines(self) -> impl Iterator<Item = Line> + Clone {
        let ego = &self.cycle.ego;
        let h = [ego.cos, ego.sin];
        let s_stop = Times::<f64>::new(self.cycle).s_stop * (1.0 + 1e-9) + 1e-3;
        let longest = longest(s_stop);
        let mut nodes = self.points.iter();
        let mut next = Some(([0.0; 2], h, 0.0));
        iter::from_fn(move || {
            let (from, heading, length) = next.take()?;
            let Some(node) = nodes.next() else {
                let (rate, ahead) = (split(h, heading)[0], s_stop - split(h, from)[0]);
                let left = larger(longest - length, 0.0) + self.d;
                let more = if rate * left > ahead { ahead / rate } else { left };
                let [x, y] = heading.map(|part| part * more);
                let to = [from[0] + x, from[1] + y];
                return Some(Line { from, to, heading, length, more });
            };
            let to = [node.x - ego.x, node.y - ego.y];
            let [along, across] = split(heading, minus(to, from)).map(f64::abs);
            let more = along + across;
            let ends = split(h, to)[0] > s_stop || length > longest;
            next = (!ends).then_some((to, [node.cos, node.sin], length + more));
            Some(Line { from, to, heading, length, more })
        })
    }

    /// How many places there are at most: of each piece as many as fit, the last one, and few more where
    /// rounding leaves it open. What a piece costs by itself is within them.
    pub(crate) fn most_places(self) -> f64 {
        let places = |line: Line| {
            let u = minus(line.to, line.from);
            let ([x, y], [along, _]) = (u.map(f64::abs), split(line.heading, u));
            larger(larger(x, y), along) / self.d + 5.0
        };
        self.lines().map(places).sum()
    }
}

/// A piece in plain doubles, from the CAV's reference point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    pub(crate) heading: [f64; 2],
    /// The length where it begins, and how much it adds to it, m.
    pub(crate) length: f64,
    pub(crate) more: f64,
}

/// Whether the point is more than 1/8 m ahead of the CAV (H-14.1); exact. Plain doubles err by less
/// than 2^-50 of the sizes.
fn is_ahead(ego: &Ego, point: &TrajectoryPoint) -> bool {
    let (x, y) = (point.x - ego.x, point.y - ego.y);
    let beyond = x * ego.cos + y * ego.sin - AHEAD;
    if beyond.abs() > (x.abs() + y.abs() + 1.0) * 1e-15 {
        return beyond > 0.0;
    }
    let along =
        [Product([point.x, ego.x], [ego.cos, 0.0]), Product([point.y, ego.y], [ego.sin, 0.0])];
    compare(&along, &[Product([AHEAD, 0.0], [1.0, 0.0])]) == Ordering::Greater
}
