//! A route from the lanelets that a drive follows.
//!
//! The reference path is the centre line of the lanes driven; over a change of lane it passes
//! from one centre line to the other. There the corridor spans both lanes as long as the road does
//! not part between them, elsewhere it is the lane driven; nothing of it is off the lanelets.

use mufasa_model::input::cycle::{CrossSection, Route};

use crate::geometry::{Point, mix};
use crate::readers::corridor::{SECTIONS_MAX, Section, on_road, on_surface};
use crate::readers::lanes::{Change, Network, Run};
use crate::readers::strip::{Leg, Strip, legs};
use crate::readers::surface::{GAP, Surface};

/// Distance between cross sections, m; more where there would be too many.
const SPACING: f64 = 2.0;
/// Where the road asks for more, they are put in down to this distance, m.
const SPACING_MIN: f64 = 0.2;
/// Length of the route behind the first and ahead of the last point of the drive, m.
const BEHIND: f64 = 30.0;
const AHEAD: f64 = 80.0;
/// Half the length of a change of lane, m: bounds, and the time that it stands for, s.
const CHANGE: [f64; 2] = [8.0, 40.0];
const CHANGE_TIME: f64 = 2.0;
/// Length by which the corridor is wider before and after the change itself, m.
const CHANGE_MARGIN: f64 = 10.0;
/// Lanes that are together for less than this on a side of a change are not driven into each
/// other there, m.
const TOGETHER_MIN: f64 = 1.0;
/// Over a change of lane the reference path goes at least so far along the next lane, m.
const AHEAD_MIN: f64 = 1.0;
/// Way to lose the width of the corridor in, or to gain it, where two legs do not connect, m.
const CLOSING: f64 = 0.1;

/// The route along the runs of a drive with these positions and speeds; `None` when no two
/// different cross sections come of it.
pub(crate) fn route_along(
    network: &Network,
    runs: &[Run],
    drive: &[(Point, f64)],
) -> Option<Route> {
    let course = Course::new(network, runs, drive)?;
    let points: Vec<Point> =
        course.strips.iter().flat_map(|strip| strip.center.points.iter().copied()).collect();
    let surface = Surface::near(network, &points, AHEAD);
    let between = |a: &Section, b: &Section| course.between(a, b);
    let sections = on_surface(&surface, course.sections(&surface), between);
    let cross_sections: Vec<CrossSection> = sections.iter().map(CrossSection::from).collect();
    (cross_sections.len() >= 2).then_some(Route { closed: false, cross_sections })
}

/// The legs of a drive as strips, and which part of each belongs to the route.
struct Course {
    legs: Vec<Leg>,
    strips: Vec<Strip>,
    spans: Vec<Span>,
    /// Of each leg, the strips that the drive only looks into, and where, in arc lengths of the leg.
    aside: Vec<Vec<(Strip, [f64; 2])>>,
}

/// A part of a strip, in arc lengths of its centre line.
#[derive(Clone, Copy)]
struct Span {
    from: f64,
    to: f64,
    /// At either end, half the length over which the reference path changes lanes, and the length
    /// over which the corridor has both; 0 without a change.
    half: [f64; 2],
    reach: [f64; 2],
}

impl Course {
    fn new(network: &Network, runs: &[Run], drive: &[(Point, f64)]) -> Option<Self> {
        let strip = |run: &Run| Strip::new(network, run, AHEAD + CHANGE[1]);
        let legs = legs(network, runs, drive);
        let strips: Vec<Strip> = legs.iter().map(|leg| strip(&leg.run)).collect::<Option<_>>()?;
        let spans = spans(&legs, &strips, drive)?;
        let aside = |(leg, own): (&Leg, &Strip)| {
            let place = |run: &Run| {
                let [from, to] =
                    [run.first, run.last].map(|i| (own.nearest(drive[i].0), reach_at(drive[i].1)));
                Some((strip(run)?, [from.0? - from.1, to.0? + to.1]))
            };
            leg.aside.iter().map(place).collect::<Option<Vec<_>>>()
        };
        let aside = legs.iter().zip(&strips).map(aside).collect::<Option<_>>()?;
        let mut course = Self { legs, strips, spans, aside };
        for k in 1..course.legs.len() {
            let half = [course.together(k - 1, 1), course.together(k, 0)];
            if half.iter().all(|half| *half >= TOGETHER_MIN) {
                [course.spans[k - 1].half[1], course.spans[k].half[0]] = half;
            }
        }
        Some(course)
    }

    /// How far from the change at this end of a leg its lane is together with the other one: as
    /// far as the change may be long, at most.
    fn together(&self, k: usize, end: usize) -> f64 {
        let Span { from, to, reach, .. } = self.spans[k];
        let other = if end == 0 { k - 1 } else { k + 1 };
        let changes = |(k, end): (usize, usize)| self.spans[k].reach[end] > 0.0;
        // Two changes on one leg share its length.
        let room = if changes((k, 1 - end)) { (to - from) / 2.0 } else { to - from };
        let most = (reach[end] - CHANGE_MARGIN).min(room);
        let mut far = 0.0;
        while far <= most {
            let s = if end == 0 { from + far } else { to - far };
            let line = self.strips[k].across(s);
            let [left, right] = self.lanes(k, s);
            if self.strips[other].beside(&line).is_none_or(|t| t > left || -t > right) {
                return far - TOGETHER_MIN;
            }
            far += TOGETHER_MIN;
        }
        most
    }

    /// How far the lanes reach that the drive may be on at an arc length of a leg, to the left and
    /// to the right of its centre line.
    fn lanes(&self, k: usize, s: f64) -> [f64; 2] {
        let line = self.strips[k].across(s);
        let aside = self.aside[k].iter().filter(|(_, [from, to])| (*from..=*to).contains(&s));
        let mut strips: Vec<&Strip> = aside.map(|(strip, _)| strip).collect();
        let mut way = s - self.spans[k].from;
        for j in (1..=k).rev() {
            if way > self.spans[j].reach[0] {
                break;
            }
            strips.push(&self.strips[j - 1]);
            way += self.spans[j - 1].to - self.spans[j - 1].from;
        }
        way = self.spans[k].to - s;
        for j in k..self.strips.len() - 1 {
            if way > self.spans[j].reach[1] {
                break;
            }
            strips.push(&self.strips[j + 1]);
            way += self.spans[j + 1].to - self.spans[j + 1].from;
        }
        let parts: Vec<[f64; 2]> = strips.iter().flat_map(|strip| strip.parts(&line)).collect();
        // From the lane driven outwards, as long as nothing is between the lanes.
        [1.0, -1.0].map(|side: f64| {
            let mut width = line.half;
            let outwards = |part: &[f64; 2]| {
                let [a, b] = part.map(|t| t * side);
                [a.min(b), a.max(b)]
            };
            while let Some(wider) =
                parts.iter().map(outwards).find(|it| it[0] <= width + GAP && it[1] > width)
            {
                width = wider[1];
            }
            width
        })
    }

    fn section(&self, k: usize, s: f64) -> Section {
        let line = self.strips[k].across(s);
        let Span { from, to, half, .. } = self.spans[k];
        let lanes = self.lanes(k, s);
        let mut reference = 0.0;
        for (end, way) in [s - from, to - s].into_iter().enumerate() {
            if half[end] > 0.0 && way < half[end] {
                let other = if end == 0 { k - 1 } else { k + 1 };
                let beside = self.strips[other].beside(&line).unwrap_or(0.0);
                reference += 0.5 * (1.0 - way / half[end]).clamp(0.0, 1.0) * beside;
            }
        }
        Section::new(k, s, line, reference.clamp(-lanes[1], lanes[0]), lanes)
    }

    fn sections(&self, surface: &Surface) -> Vec<Section> {
        let total: f64 = self.spans.iter().map(|s| s.to - s.from).sum();
        let spacing = SPACING.max(2.0 * total / f64::from(SECTIONS_MAX));
        let mut sections: Vec<Section> = Vec::new();
        for (k, span) in self.spans.iter().enumerate() {
            let mut span = *span;
            // Both legs of a change have its place, by lines across that need not be parallel.
            let is_back = |from: f64| {
                let last = sections.last().filter(|_| span.half[0] > 0.0 && from < span.to);
                last.is_some_and(|it| !self.section(k, from).is_ahead_of(it, AHEAD_MIN))
            };
            while is_back(span.from) {
                span.from += AHEAD_MIN / 2.0;
            }
            if k > 0 && span.half[0] == 0.0 {
                let [before, here] =
                    [self.section(k - 1, self.spans[k - 1].to), self.section(k, span.from)];
                if on_road(surface, &before, &here) != [true; 2] {
                    sections.push(self.section(k - 1, self.spans[k - 1].to + CLOSING).closed());
                    sections.push(self.section(k, span.from - CLOSING).closed());
                }
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "0 to 8001"
            )]
            let n = ((span.to - span.from) / spacing).ceil().max(1.0) as u32;
            for i in 0..=n {
                let s = span.from + (span.to - span.from) * f64::from(i) / f64::from(n);
                sections.push(self.section(k, s));
            }
        }
        sections.dedup_by(|next, last| !next.follows(last));
        sections
    }

    /// A cross section between two of one leg, if they are far enough apart: where the bounds of
    /// the lane turn, or in the middle.
    fn between(&self, a: &Section, b: &Section) -> Option<Section> {
        let vertex = self.strips[a.leg].vertex_between(a.s + CLOSING / 2.0, b.s - CLOSING / 2.0);
        let middle = (b.s - a.s > 2.0 * SPACING_MIN).then(|| f64::midpoint(a.s, b.s));
        (a.leg == b.leg).then(|| vertex.or(middle)).flatten().map(|s| self.section(a.leg, s))
    }
}

fn spans(legs: &[Leg], strips: &[Strip], drive: &[(Point, f64)]) -> Option<Vec<Span>> {
    let mut spans = Vec::with_capacity(legs.len());
    for (k, (Leg { run, .. }, strip)) in legs.iter().zip(strips).enumerate() {
        let before = k.checked_sub(1).map(|j| &legs[j].run);
        let next = legs.get(k + 1).map(|leg| &leg.run);
        let from = match before {
            None => (strip.nearest(drive[run.first].0)? - BEHIND).max(0.0),
            Some(b) => strip.nearest(crossing(b, run, drive).unwrap_or(drive[run.first].0))?,
        };
        let to = match next {
            None => (strip.nearest(drive[run.last].0)? + AHEAD).min(strip.center.length()),
            Some(n) => strip.nearest(crossing(run, n, drive).unwrap_or(drive[run.last].0))?,
        };
        let changes = [before, next.map(|_| run)].map(|run| run.is_some_and(is_to_lane));
        let reach = [(changes[0], run.first), (changes[1], run.last)];
        let reach = reach.map(|(changes, i)| if changes { reach_at(drive[i].1) } else { 0.0 });
        spans.push(Span { from, to: to.max(from), half: [0.0; 2], reach });
    }
    Some(spans)
}

fn is_to_lane(run: &Run) -> bool {
    run.change == Some(Change::Lane)
}

/// Where the drive crosses from one lane to the next.
fn crossing(run: &Run, next: &Run, drive: &[(Point, f64)]) -> Option<Point> {
    is_to_lane(run).then(|| mix(drive[run.last].0, drive[next.first].0, 0.5))
}

/// How far from a change of lane at a speed the corridor has both lanes.
fn reach_at(speed: f64) -> f64 {
    (speed * CHANGE_TIME).clamp(CHANGE[0], CHANGE[1]) + CHANGE_MARGIN
}
