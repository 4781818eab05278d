//! Lanes driven: what of the network each run of a drive needs, and which runs only look aside.

use crate::geometry::{Point, Polyline, add, distance, dot, mix, norm, scale, sub};
use crate::readers::lanes::{Change, Lanelet, Network, Run};
use crate::readers::surface::Outline;

/// A drive that leaves a lane and is back in it within this way, m, has not changed it.
const ASIDE: f64 = 16.0;
/// Farthest that lanes beside each other may be apart, m.
const BESIDE: f64 = 8.0;

/// A run, and the runs beside it that are too short to be changes of lane.
pub(crate) struct Leg {
    pub run: Run,
    pub aside: Vec<Run>,
}

/// The legs of a drive with these positions.
pub(crate) fn legs(network: &Network, runs: &[Run], drive: &[(Point, f64)]) -> Vec<Leg> {
    let mut legs = Vec::new();
    let mut rest = runs;
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        let mut leg = Leg { run: first.clone(), aside: Vec::new() };
        while let [there, back, after @ ..] = rest {
            let beside = [&leg.run, there].iter().all(|run| run.change == Some(Change::Lane));
            let here = leg.run.lanelets[leg.run.lanelets.len() - 1];
            let way = match back.lanelets[0] {
                next if next == here => Some(Vec::new()),
                next => network.way(here, next),
            };
            let Some(way) = way.filter(|_| beside && driven(there, drive) < ASIDE) else { break };
            leg.run.lanelets.extend(way);
            leg.run.lanelets.extend(&back.lanelets[1..]);
            (leg.run.last, leg.run.change) = (back.last, back.change);
            leg.aside.push(there.clone());
            rest = after;
        }
        legs.push(leg);
    }
    legs
}

fn driven(run: &Run, drive: &[(Point, f64)]) -> f64 {
    drive[run.first..=run.last].windows(2).map(|w| distance(w[0].0, w[1].0)).sum()
}

/// A lane as long as the drive may need it: corresponding points of centre line and bounds.
pub(crate) struct Strip {
    pub center: Polyline,
    left: Vec<Point>,
    right: Vec<Point>,
    outlines: Vec<Outline>,
}

/// A line across a strip.
#[derive(Clone, Copy)]
pub(crate) struct Across {
    pub center: Point,
    /// To the left, of length 1.
    pub left: Point,
    /// Half the width of the strip.
    pub half: f64,
}

impl Across {
    /// The point so far left of the centre.
    pub(crate) fn at(&self, t: f64) -> Point {
        add(self.center, scale(self.left, t))
    }
}

impl Strip {
    /// The lane of a run, and `far` metres before and after it.
    pub(crate) fn new(network: &Network, run: &Run, far: f64) -> Option<Self> {
        let (first, last) = (run.lanelets[0], run.lanelets[run.lanelets.len() - 1]);
        let mut ids = network.extension(first, false, far);
        ids.reverse();
        ids.extend(&run.lanelets);
        ids.extend(network.extension(last, true, far));
        let lanelets: Vec<&Lanelet> =
            ids.iter().filter_map(|id| network.lanelets.get(id).map(Box::as_ref)).collect();
        let (mut center, mut left, mut right) = (Vec::new(), Vec::new(), Vec::new());
        for lanelet in &lanelets {
            for i in 0..lanelet.center.len() {
                let c = lanelet.center[i];
                if center.last().is_none_or(|l| distance(*l, c) > 0.01) {
                    center.push(c);
                    left.push(lanelet.left[i]);
                    right.push(lanelet.right[i]);
                }
            }
        }
        let outlines = lanelets.into_iter().map(Outline::new).collect();
        let center = (center.len() >= 2).then(|| Polyline::new(center))?;
        Some(Self { center, left, right, outlines })
    }

    /// The line through corresponding points of the bounds at an arc length.
    pub(crate) fn across(&self, s: f64) -> Across {
        let (i, w) = self.center.locate(s);
        let [center, left, right] =
            [&self.center.points, &self.left, &self.right].map(|line| mix(line[i], line[i + 1], w));
        let width = distance(left, right);
        if width > 0.0 {
            return Across {
                center,
                left: scale(sub(left, right), 1.0 / width),
                half: width / 2.0,
            };
        }
        let [x, y] = sub(self.center.points[i + 1], self.center.points[i]);
        Across { center, left: scale([-y, x], 1.0 / norm([x, y])), half: 0.0 }
    }

    /// The arc length nearest to a point.
    pub(crate) fn nearest(&self, p: Point) -> Option<f64> {
        self.center.project(p).map(|foot| foot.s)
    }

    /// Where a line across another strip meets the centre line of this one, if beside it.
    pub(crate) fn beside(&self, line: &Across) -> Option<f64> {
        let along = [line.left[1], -line.left[0]];
        let cuts = self.center.points.windows(2).filter_map(|w| {
            let [a, b] = [w[0], w[1]].map(|p| dot(sub(p, line.center), along));
            ((a > 0.0) != (b > 0.0))
                .then(|| dot(sub(mix(w[0], w[1], a / (a - b)), line.center), line.left))
        });
        cuts.filter(|t| t.abs() <= BESIDE).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The parts of a line across that are on this strip.
    pub(crate) fn parts<'a>(&'a self, line: &'a Across) -> impl Iterator<Item = [f64; 2]> + 'a {
        self.outlines.iter().flat_map(|o| o.along(line.center, line.left, line.half + BESIDE))
    }

    /// The arc length of a point of the strip between two others, if there is one: the nearest to
    /// the middle.
    pub(crate) fn vertex_between(&self, from: f64, to: f64) -> Option<f64> {
        let middle = f64::midpoint(from, to);
        let arc = &self.center.arc;
        let first = arc.partition_point(|s| *s <= from);
        let inner = arc[first..].iter().take_while(|s| **s < to);
        inner.copied().min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()))
    }
}
