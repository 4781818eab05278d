//! The corridor of a route: cross sections that are as wide as the road lets them be, so near each
//! other and so narrow that nothing between them is off it.

use mufasa_model::input::cycle::CrossSection;

use crate::geometry::{Point, distance, dot, sub};
use crate::readers::strip::Across;
use crate::readers::surface::Surface;

/// Cross sections of a route; the domain allows 8192.
pub(crate) const SECTIONS_MAX: u16 = 8000;
/// How much narrower a side is made, step by step, m: first than the lanes there, then than the
/// lane driven. After the last step the corridor ends at the reference path.
const STEPS: [f64; 8] = [0.0, 0.002, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8];
/// Left and right of a line across.
const SIDES: [f64; 2] = [1.0, -1.0];
/// Least way between reference points, m.
const NEAREST: f64 = 0.05;

/// A cross section in the making: places on a line across the lane driven.
#[derive(Clone)]
pub(crate) struct Section {
    /// The leg that it is of, and the arc length there.
    pub leg: usize,
    pub s: f64,
    line: Across,
    /// The reference point, so far left of the centre of the lane.
    reference: f64,
    /// How far left and how far right of the centre the corridor may reach: narrowest first.
    widths: [Vec<f64>; 2],
}

impl Section {
    /// A cross section that reaches, at its widest, `lanes` to the left and to the right.
    pub(crate) fn new(leg: usize, s: f64, line: Across, reference: f64, lanes: [f64; 2]) -> Self {
        let mut widths = SIDES.map(|side| vec![side * reference]);
        for (i, side) in SIDES.into_iter().enumerate() {
            let own = STEPS.map(|step| line.half - step);
            let wide = STEPS.map(|step| lanes[i] - step);
            let wide = wide.into_iter().filter(|width| *width > line.half);
            let all = wide.chain(own).filter(|width| *width > side * reference);
            widths[i].extend(all);
            widths[i][1..].reverse();
        }
        Self { leg, s, line, reference, widths }
    }

    /// The same place with no width.
    pub(crate) fn closed(mut self) -> Self {
        self.widths.iter_mut().for_each(|widths| widths.truncate(1));
        self
    }

    fn reference(&self) -> Point {
        self.line.at(self.reference)
    }

    fn bound(&self, side: usize) -> Point {
        self.line.at(SIDES[side] * self.widths[side].last().copied().unwrap_or(0.0))
    }

    /// Whether a side could be made narrower, and was.
    fn narrow(&mut self, side: usize) -> bool {
        let could = self.widths[side].len() > 1;
        if could {
            self.widths[side].pop();
        }
        could
    }

    /// Whether this one is so far ahead of another, m, in the direction of this one's lane.
    pub(crate) fn is_ahead_of(&self, other: &Self, far: f64) -> bool {
        let along = [self.line.left[1], -self.line.left[0]];
        dot(sub(self.reference(), other.reference()), along) >= far
    }

    /// Whether this one may come next after another: not too near, and ahead of it where the reference path passes
    /// from lane to lane, beside which lines across turn it back.
    pub(crate) fn follows(&self, last: &Self) -> bool {
        let passes = self.reference != 0.0 || last.reference != 0.0;
        let is_near = distance(self.reference(), last.reference()) <= NEAREST;
        !is_near && (!passes || self.is_ahead_of(last, NEAREST))
    }
}

impl From<&Section> for CrossSection {
    fn from(section: &Section) -> Self {
        let [x, y] = section.reference();
        Self { x, y, left: section.bound(0), right: section.bound(1) }
    }
}

/// Which triangles between two cross sections (`spec/3-stages.md#stage-ii-trajectory-to-map`) are
/// on the road: that with the left bound, that with the right one.
pub(crate) fn on_road(surface: &Surface, a: &Section, b: &Section) -> [bool; 2] {
    [[a.bound(0), b.bound(1), b.bound(0)], [a.bound(0), a.bound(1), b.bound(1)]]
        .map(|triangle| surface.covers(triangle))
}

/// The cross sections with nothing between them that is off the road. `between` gives one between
/// two where there may be; where there is none, both are made narrower.
pub(crate) fn on_surface(
    surface: &Surface,
    mut sections: Vec<Section>,
    between: impl Fn(&Section, &Section) -> Option<Section>,
) -> Vec<Section> {
    let mut i = 0;
    while i + 1 < sections.len() {
        let covered = on_road(surface, &sections[i], &sections[i + 1]);
        if covered == [true; 2] {
            i += 1;
            continue;
        }
        let room = sections.len() < usize::from(SECTIONS_MAX);
        let new = between(&sections[i], &sections[i + 1])
            .filter(|new| room && new.follows(&sections[i]) && sections[i + 1].follows(new));
        if let Some(new) = new {
            sections.insert(i + 1, new);
            continue;
        }
        let mut narrow = |side: usize| {
            let changed = [i, i + 1].map(|k| sections[k].narrow(side));
            changed != [false; 2]
        };
        let [off, on]: [Vec<usize>; 2] =
            [false, true].map(|on| (0..2).filter(|side| covered[*side] == on).collect());
        // Where a side has no width left to take, it is the other one that is off.
        let changed = off.into_iter().filter(|side| narrow(*side)).count();
        if changed == 0 && !on.into_iter().chain(0..2).any(narrow) {
            return Vec::new();
        }
        // The triangles before are others now.
        i = i.saturating_sub(1);
    }
    sections
}
