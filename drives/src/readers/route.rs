//! A route from the lanelets that a drive follows.
//!
//! The reference path is the centre line of the lanes driven; over a change of lane it passes
//! from one centre line to the other. There the corridor spans both lanes, elsewhere it is the
//! lane driven.

use mufasa_model::input::cycle::{CrossSection, Route};

use crate::geometry::{Point, Polyline, add, cross, distance, mix, scale, sub};
use crate::readers::lanes::{Change, Network, Run};

/// Distance between cross sections, m; more where there would be too many.
const SPACING: f64 = 2.0;
/// Cross sections of a route; the domain allows 8192.
const STATIONS_MAX: f64 = 8000.0;
/// Length of the route behind the first and ahead of the last point of the drive, m.
const BEHIND: f64 = 30.0;
const AHEAD: f64 = 80.0;
/// Half the length of a change of lane, m: bounds, and the time that it stands for, s.
const CHANGE: [f64; 2] = [8.0, 40.0];
const CHANGE_TIME: f64 = 2.0;
/// Length by which the corridor is wider before and after the change itself, m.
const CHANGE_MARGIN: f64 = 10.0;
/// Farthest that lanes beside each other may be apart, m.
const BESIDE: f64 = 8.0;

/// The route along the runs of a drive with these positions and speeds; `None` when no two
/// different cross sections come of it.
pub(crate) fn route_along(
    network: &Network,
    runs: &[Run],
    drive: &[(Point, f64)],
) -> Option<Route> {
    let strips: Vec<Strip> =
        runs.iter().map(|run| Strip::new(network, run)).collect::<Option<_>>()?;
    let spans = spans(runs, &strips, drive)?;
    let total: f64 = spans.iter().map(|s| s.to - s.from).sum();
    let spacing = SPACING.max(total / STATIONS_MAX);
    let mut cross_sections: Vec<CrossSection> = Vec::new();
    for (k, span) in spans.iter().enumerate() {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 8001")]
        let n = ((span.to - span.from) / spacing).ceil().max(1.0) as u32;
        for i in 0..=n {
            let s = span.from + (span.to - span.from) * f64::from(i) / f64::from(n);
            let cross_section = cross_section(&strips, &spans, k, s);
            if cross_sections
                .last()
                .is_none_or(|l| distance([l.x, l.y], [cross_section.x, cross_section.y]) > 0.05)
            {
                cross_sections.push(cross_section);
            }
        }
    }
    (cross_sections.len() >= 2).then_some(Route { closed: false, cross_sections })
}

/// A lane as long as the drive may need it: corresponding points of centre line and bounds.
struct Strip {
    center: Polyline,
    left: Vec<Point>,
    right: Vec<Point>,
}

/// The part of a strip that belongs to the route, in arc lengths of its centre line, and half the
/// length of the change at either end (0 without one).
struct Span {
    from: f64,
    to: f64,
    half: [f64; 2],
}

impl Strip {
    fn new(network: &Network, run: &Run) -> Option<Self> {
        let (first, last) = (run.lanelets[0], run.lanelets[run.lanelets.len() - 1]);
        let mut ids = network.extension(first, false, AHEAD);
        ids.reverse();
        ids.extend(&run.lanelets);
        ids.extend(network.extension(last, true, AHEAD + CHANGE[1]));
        let (mut center, mut left, mut right) = (Vec::new(), Vec::new(), Vec::new());
        for lanelet in ids.iter().filter_map(|id| network.lanelets.get(id)) {
            for i in 0..lanelet.center.len() {
                let c = lanelet.center[i];
                if center.last().is_none_or(|l| distance(*l, c) > 0.01) {
                    center.push(c);
                    left.push(lanelet.left[i]);
                    right.push(lanelet.right[i]);
                }
            }
        }
        (center.len() >= 2).then(|| Self { center: Polyline::new(center), left, right })
    }

    /// Centre, left and right at an arc length.
    fn at(&self, s: f64) -> [Point; 3] {
        let (i, w) = self.center.locate(s);
        [&self.center.points, &self.left, &self.right].map(|line| mix(line[i], line[i + 1], w))
    }

    /// The arc length nearest to a point.
    fn nearest(&self, p: Point) -> Option<f64> {
        self.center.project(p).map(|foot| foot.s)
    }
}

fn spans(runs: &[Run], strips: &[Strip], drive: &[(Point, f64)]) -> Option<Vec<Span>> {
    let mut spans = Vec::with_capacity(runs.len());
    for (k, (run, strip)) in runs.iter().zip(strips).enumerate() {
        let last = k + 1 == runs.len();
        let before = k.checked_sub(1).map(|j| &runs[j]);
        let from = match before {
            None => (strip.nearest(drive[run.first].0)? - BEHIND).max(0.0),
            Some(b) => strip.nearest(crossing(b, run, drive).unwrap_or(drive[run.first].0))?,
        };
        let to = if last {
            (strip.nearest(drive[run.last].0)? + AHEAD).min(strip.center.length())
        } else {
            strip.nearest(crossing(run, &runs[k + 1], drive).unwrap_or(drive[run.last].0))?
        };
        let to = to.max(from);
        // Two changes on one run share its length.
        let room = if before.is_some() && !last { (to - from) / 2.0 } else { to - from };
        let half = |run: Option<&Run>, point: usize| {
            let wish = (drive[point].1 * CHANGE_TIME).clamp(CHANGE[0], CHANGE[1]);
            match run.and_then(|r| r.change) {
                Some(Change::Lane) => wish.min(room),
                Some(Change::Jump) | None => 0.0,
            }
        };
        let half = [half(before, run.first), half(Some(run), run.last)];
        spans.push(Span { from, to, half });
    }
    Some(spans)
}

/// Where the drive crosses from one lane to the next.
fn crossing(run: &Run, next: &Run, drive: &[(Point, f64)]) -> Option<Point> {
    (run.change == Some(Change::Lane)).then(|| mix(drive[run.last].0, drive[next.first].0, 0.5))
}

/// The cross section of run `k` at arc length `s`.
fn cross_section(strips: &[Strip], spans: &[Span], k: usize, s: f64) -> CrossSection {
    let [center, left, right] = strips[k].at(s);
    let (i, _) = strips[k].center.locate(s);
    let along = sub(strips[k].center.points[i + 1], strips[k].center.points[i]);
    let mut reference = center;
    let mut bounds = [left, right];
    // The neighbour behind, then the neighbour ahead.
    for (side, to_change) in [s - spans[k].from, spans[k].to - s].into_iter().enumerate() {
        let half = spans[k].half[side];
        let j = if side == 0 { k.wrapping_sub(1) } else { k + 1 };
        let Some(other) = strips.get(j) else { continue };
        if half <= 0.0 || to_change > half + CHANGE_MARGIN {
            continue;
        }
        let Some(place) = other.nearest(center) else { continue };
        let [there, l, r] = other.at(place);
        if distance(there, center) > BESIDE {
            continue;
        }
        let w = 0.5 * (1.0 - to_change / half).clamp(0.0, 1.0);
        reference = add(reference, scale(sub(there, center), w));
        if cross(along, sub(l, bounds[0])) > 0.0 {
            bounds[0] = l;
        }
        if cross(along, sub(r, bounds[1])) < 0.0 {
            bounds[1] = r;
        }
    }
    CrossSection { x: reference[0], y: reference[1], left: bounds[0], right: bounds[1] }
}
