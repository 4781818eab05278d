//! The lanelet network, and which lanelets a trajectory follows.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::geometry::{Point, Polyline, distance, foot, inside, mix, norm, sub, wrap};

/// A lanelet: bounds with corresponding points, and its neighbours.
#[derive(Clone, Debug)]
pub(crate) struct Lanelet {
    pub id: i64,
    pub left: Vec<Point>,
    pub right: Vec<Point>,
    /// Mean of the bounds, point by point.
    pub center: Vec<Point>,
    pub successors: Vec<i64>,
    pub predecessors: Vec<i64>,
    /// The lanelets of the same direction to the left and to the right.
    pub beside: [Option<i64>; 2],
}

/// All lanelets by id.
#[derive(Clone, Debug, Default)]
pub(crate) struct Network {
    /// Boxed, for a tree has room for twice its values.
    pub lanelets: BTreeMap<i64, Box<Lanelet>>,
}

/// How one lanelet of a trajectory follows the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// From a lane to the one beside it.
    Lane,
    /// To a lanelet that nothing in the network connects with.
    Jump,
}

/// A stretch of a trajectory without a change: lanelets, each a successor of the one before.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Run {
    pub lanelets: Vec<i64>,
    /// First and last point of the trajectory on it.
    pub first: usize,
    pub last: usize,
    /// How the next run follows.
    pub change: Option<Change>,
}

/// Farthest a trajectory may be from a lanelet that it is taken to follow, m.
const NEAR: f64 = 5.0;
/// Costs of following: being `NEAR` off a lanelet costs as much as ten changes of lane, which
/// keeps a wandering trajectory on one lane, and a jump is worse than any of them.
const COST_OFF: f64 = 6.0;
const COST_TURN: f64 = 2.0;
const COST_SIDE: f64 = 0.1;
const COST_NEXT: f64 = 0.1;
const COST_LANE: f64 = 3.0;
/// Not being on a lanelet at all costs more than a change to another and back: one state outside
/// the corridor rejects every trajectory with it.
const COST_OUT: f64 = 20.0;
/// To a lanelet that begins or ends where this one does, and overlaps it there.
const COST_FORK: f64 = 8.0;
const COST_JUMP: f64 = 200.0;
/// Lanelets that may lie between two points of a trajectory.
const SKIP_MAX: usize = 4;

impl Lanelet {
    /// A lanelet alone between two bounds of as many points.
    pub(crate) fn between(id: i64, left: Vec<Point>, right: Vec<Point>) -> Self {
        let center = left.iter().zip(&right).map(|(l, r)| mix(*l, *r, 0.5)).collect();
        let (successors, predecessors) = (Vec::new(), Vec::new());
        Self { id, left, right, center, successors, predecessors, beside: [None; 2] }
    }

    /// Whether a point is between the bounds.
    pub(crate) fn contains(&self, p: Point) -> bool {
        let outline: Vec<Point> = self.outline().collect();
        inside(p, &outline)
    }

    /// The polygon between the bounds.
    pub(crate) fn outline(&self) -> impl Iterator<Item = Point> {
        self.left.iter().chain(self.right.iter().rev()).copied()
    }

    /// What it costs to take a pose as being on this lanelet; `None` when it is too far off, or
    /// against the direction.
    fn cost(&self, p: Point, heading: f64) -> Option<f64> {
        let line = Polyline::new(self.center.clone()).project(p)?;
        let turn = wrap(heading - line.tangent[1].atan2(line.tangent[0])).abs();
        if turn > 1.9 {
            return None;
        }
        let (off, out) = if self.contains(p) { (0.0, 0.0) } else { (self.off(p), COST_OUT) };
        let cost = out + COST_OFF * off + COST_TURN * turn * turn + COST_SIDE * line.lateral.abs();
        (off <= NEAR).then_some(cost)
    }

    /// Distance to the outline.
    fn off(&self, p: Point) -> f64 {
        let ends = [
            [self.left[0], self.right[0]],
            [self.left[self.left.len() - 1], { self.right[self.right.len() - 1] }],
        ];
        let sides = self.left.windows(2).chain(self.right.windows(2)).map(|w| [w[0], w[1]]);
        sides.chain(ends).map(|[a, b]| distance(p, foot(p, a, b).1)).fold(f64::INFINITY, f64::min)
    }

    /// Direction at the end (`true`) or start of the centre line.
    fn tangent(&self, end: bool) -> Point {
        let n = self.center.len();
        let way = |i: usize| sub(self.center[i + 1], self.center[i]);
        let mut order: Vec<usize> = (0..n - 1).collect();
        if end {
            order.reverse();
        }
        order.into_iter().map(way).find(|u| norm(*u) > 1e-6).unwrap_or([1.0, 0.0])
    }
}

impl Network {
    /// Whether a pose is on some lanelet that leads its way.
    pub(crate) fn covers(&self, p: Point, heading: f64) -> bool {
        self.lanelets.values().any(|l| l.contains(p) && l.cost(p, heading).is_some())
    }

    /// The lanelets that a trajectory follows: of all sequences the one of least cost, where
    /// leaving the lanelets, crossing their direction and changing lanes cost. Points that are
    /// near no lanelet are passed over; no run at all means that none is near any.
    pub(crate) fn follow(&self, poses: &[(Point, f64)]) -> Vec<Run> {
        let path = self.cheapest(poses);
        let mut runs: Vec<Run> = Vec::new();
        for (point, id) in path {
            let Some(run) = runs.last_mut() else {
                let lanelets = vec![id];
                runs.push(Run { lanelets, first: point, last: point, change: None });
                continue;
            };
            let here = run.lanelets[run.lanelets.len() - 1];
            if here == id {
                run.last = point;
            } else if let Some(way) = self.way(here, id) {
                run.lanelets.extend(way);
                run.last = point;
            } else {
                let beside = self.lane_change(here, id) || self.fork(here, id);
                let change = if beside { Change::Lane } else { Change::Jump };
                run.change = Some(change);
                let lanelets = vec![id];
                runs.push(Run { lanelets, first: point, last: point, change: None });
            }
        }
        runs
    }

    /// Index of the point and id of its lanelet, by dynamic programming over the points.
    fn cheapest(&self, poses: &[(Point, f64)]) -> Vec<(usize, i64)> {
        struct Layer {
            point: usize,
            // Lanelet, cost so far, index in the layer before.
            nodes: Vec<(i64, f64, usize)>,
        }
        let mut layers: Vec<Layer> = Vec::new();
        let mut known: BTreeMap<(i64, i64), f64> = BTreeMap::new();
        for (point, (p, heading)) in poses.iter().enumerate() {
            let mut nodes = Vec::new();
            for lanelet in self.lanelets.values() {
                let Some(cost) = lanelet.cost(*p, *heading) else { continue };
                let Some(before) = layers.last() else {
                    nodes.push((lanelet.id, cost, 0));
                    continue;
                };
                let mut step = |from: i64| {
                    *known
                        .entry((from, lanelet.id))
                        .or_insert_with(|| self.change_cost(from, lanelet.id))
                };
                let best = before
                    .nodes
                    .iter()
                    .enumerate()
                    .map(|(i, (from, so_far, _))| (so_far + step(*from), i))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((so_far, i)) = best {
                    nodes.push((lanelet.id, so_far + cost, i));
                }
            }
            if !nodes.is_empty() {
                layers.push(Layer { point, nodes });
            }
        }
        let mut path = Vec::with_capacity(layers.len());
        let mut next: Option<usize> = None;
        for layer in layers.iter().rev() {
            let last = || {
                let costs = layer.nodes.iter().enumerate();
                costs.min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or(0, |(i, _)| i)
            };
            let (id, _, before) = layer.nodes[next.unwrap_or_else(last)];
            path.push((layer.point, id));
            next = Some(before);
        }
        path.reverse();
        path
    }

    fn change_cost(&self, from: i64, to: i64) -> f64 {
        if from == to {
            return 0.0;
        }
        match self.way(from, to) {
            #[expect(clippy::cast_precision_loss, reason = "at most SKIP_MAX")]
            Some(way) => COST_NEXT * way.len() as f64,
            None if self.lane_change(from, to) => COST_LANE,
            None if self.fork(from, to) => COST_FORK,
            None => COST_JUMP,
        }
    }

    /// The successors from one lanelet to another, the last of them the other.
    pub(crate) fn way(&self, from: i64, to: i64) -> Option<Vec<i64>> {
        let mut queue = VecDeque::from([vec![from]]);
        while let Some(path) = queue.pop_front() {
            let here = self.lanelets.get(&path[path.len() - 1]);
            for next in here.map_or(&[][..], |l| &l.successors) {
                let mut longer = path.clone();
                longer.push(*next);
                if *next == to {
                    longer.remove(0);
                    return Some(longer);
                }
                // Many parallel edges of a broken file must not multiply the paths.
                if longer.len() <= SKIP_MAX && queue.len() < 256 {
                    queue.push_back(longer);
                }
            }
        }
        None
    }

    /// Whether `to` is beside `from`, or beside one of its neighbours in the direction of travel.
    fn lane_change(&self, from: i64, to: i64) -> bool {
        let Some(here) = self.lanelets.get(&from) else { return false };
        let around = std::iter::once(from).chain(here.successors.iter().copied());
        let around = around.chain(here.predecessors.iter().copied());
        around.filter_map(|id| self.lanelets.get(&id)).flat_map(|l| l.beside.iter().flatten()).any(
            |id| *id == to || self.lanelets.get(id).is_some_and(|l| l.successors.contains(&to)),
        )
    }

    /// Whether the two begin at one lanelet or end at one.
    fn fork(&self, from: i64, to: i64) -> bool {
        let (Some(a), Some(b)) = (self.lanelets.get(&from), self.lanelets.get(&to)) else {
            return false;
        };
        a.predecessors.iter().any(|id| b.predecessors.contains(id))
            || a.successors.iter().any(|id| b.successors.contains(id))
    }

    /// Lanelets that go on from `id` with the least turn, forwards or backwards, until they are
    /// `far` metres long together.
    pub(crate) fn extension(&self, id: i64, forward: bool, far: f64) -> Vec<i64> {
        let mut found = Vec::new();
        let mut seen = BTreeSet::from([id]);
        let mut length = 0.0;
        let mut here = self.lanelets.get(&id);
        while let Some(lanelet) = here.filter(|_| length < far) {
            let ids = if forward { &lanelet.successors } else { &lanelet.predecessors };
            let own = lanelet.tangent(forward);
            let next = ids
                .iter()
                .filter_map(|id| self.lanelets.get(id))
                .filter(|next| !seen.contains(&next.id))
                .map(|next| {
                    let u = next.tangent(!forward);
                    (wrap(u[1].atan2(u[0]) - own[1].atan2(own[0])).abs(), next)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, next)| next);
            if let Some(next) = next {
                seen.insert(next.id);
                found.push(next.id);
                length += Polyline::new(next.center.clone()).length();
            }
            here = next;
        }
        found
    }
}
