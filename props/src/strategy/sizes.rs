//! Lists and grids of any size that the domain allows, with what decides the cycle anywhere in them.

use mufasa_model::input::cycle::{Cycle, Detection, Grid, TrajectoryPoint};
use mufasa_model::report::{FailedStage, Stage};

use super::base::{self, Frame};
use super::draw::Draw;
use super::track_validation;

const TRACKS: usize = 1024;
const DETECTIONS: usize = 2048;
const POINTS: usize = 1024;
const CROSS_SECTIONS: usize = 8192;
/// Of the 2^24 of the domain: a record has 350 kB then, and not 5.6 MB.
const CELLS: usize = 1 << 20;
const CELLS_A_SIDE: usize = 1 << 15;

/// Points times cross sections: what a program of exact fractions decides in seconds.
const POINTS_AND_SECTIONS: usize = 1 << 14;

/// What can be made larger.
#[derive(Clone, Copy)]
pub enum Part {
    /// Points of the trajectory.
    Points,
    /// Tracks.
    Tracks,
    /// Detections of now.
    Detections,
    /// Detections of a list of the history.
    History,
    /// Cross sections.
    Sections,
    /// Cells.
    Cells,
}

impl Part {
    /// Each of them.
    pub const ALL: [Self; 6] =
        [Self::Points, Self::Tracks, Self::Detections, Self::History, Self::Sections, Self::Cells];

    /// Whether the cycle has something of it, which can decide.
    fn is_in(self, cycle: &Cycle) -> bool {
        match self {
            Self::Points | Self::Sections => true,
            Self::Tracks => cycle.tracks.as_ref().is_some_and(|list| !list.items.is_empty()),
            Self::Detections => {
                cycle.detections.as_ref().is_some_and(|list| !list.items.is_empty())
            }
            Self::History => !cycle.detection_history.is_empty(),
            Self::Cells => cycle.grid.is_some(),
        }
    }

    /// Whether the cycle can have as much of it as the domain allows.
    pub fn fits(self, cycle: &Cycle) -> bool {
        let points = cycle.trajectory.as_ref().map_or(0, |list| list.points.len());
        let is_little = CROSS_SECTIONS * points <= POINTS_AND_SECTIONS;
        self.is_in(cycle) && (is_little || !matches!(self, Self::Sections))
    }

    /// Whether the last item of the list decides behind stage i, to whoever says which stage fails.
    pub fn decides(self, cycle: &Cycle, failed: impl Fn(&Cycle) -> Option<FailedStage>) -> bool {
        let mut without = cycle.clone();
        match self {
            Self::Points => without.trajectory.iter_mut().for_each(|it| _ = it.points.pop()),
            Self::Tracks => without.tracks.iter_mut().for_each(|it| _ = it.items.pop()),
            Self::Detections => without.detections.iter_mut().for_each(|it| _ = it.items.pop()),
            Self::History | Self::Sections | Self::Cells => return true,
        }
        let (with, without) = (failed(cycle), failed(&without));
        with != without && with != Some(FailedStage::Stage(Stage::I))
    }
}

/// Makes one list that is not empty longer, or the grid larger.
pub fn grow(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    // Of many tracks or detections one alone decides.
    let again = [Part::Tracks, Part::Tracks, Part::Detections, Part::Cells];
    let mut parts: Vec<Part> = Part::ALL.into_iter().chain(again).collect();
    parts.retain(|part| part.is_in(cycle));
    let part = draw.pick(&parts);
    enlarge(draw, cycle, part);
}

/// Makes it as large as it can be, with what was there behind the rest.
pub fn largest(cycle: &mut Cycle, part: Part) {
    enlarge(&mut Draw::new(&[]), cycle, part);
}

/// What is added is harmless: far from the CAV, or between two points or cross sections.
fn enlarge(draw: &mut Draw<'_>, cycle: &mut Cycle, part: Part) {
    let ego = &cycle.ego;
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    match part {
        Part::Points => points(draw, cycle),
        Part::Sections => sections(draw, cycle),
        Part::Tracks => {
            let track = |(index, id)| track_validation::track(road, far(index), id);
            let tracks: Vec<_> = (0..TRACKS).zip(1000..).map(track).collect();
            let list = cycle.tracks.iter_mut();
            list.for_each(|list| surround(draw, &mut list.items, &tracks));
        }
        Part::Detections => {
            let list = cycle.detections.iter_mut();
            list.for_each(|list| surround(draw, &mut list.items, &detections(road)));
        }
        Part::History => {
            let list = draw.below(cycle.detection_history.len());
            surround(draw, &mut cycle.detection_history[list].items, &detections(road));
        }
        Part::Cells => {
            let grid = cycle.grid.iter_mut();
            grid.for_each(|grid| cells(draw, grid));
        }
    }
}

/// A size on a log scale: a power of two or beside it, the largest, or any.
fn size(draw: &mut Draw<'_>, most: usize) -> usize {
    let power = 1 << draw.between(1, log(most).max(1));
    let size = match draw.below(8) {
        0 => most,
        1..=3 => power + draw.below(3) - 1,
        _ => power + draw.below(power),
    };
    size.min(most)
}

/// A place from 0 to `most`: the last, the first, a power of two or beside it, or any.
fn place(draw: &mut Draw<'_>, most: usize) -> usize {
    let place = match draw.below(5) {
        0 => most,
        1 => 0,
        2 | 3 => (1 << draw.below(log(most) + 1)) + draw.below(3) - 1,
        _ => draw.below(most + 1),
    };
    place.min(most)
}

fn log(number: usize) -> usize {
    number.max(1).ilog2() as usize
}

/// In the frame of the CAV: behind it and beside it, farther than what any generator draws.
fn far(index: usize) -> (f64, f64) {
    (-150.0 - (index % 32) as f64, 30.0 + (index / 32) as f64)
}

fn detections(road: Frame) -> Vec<Detection> {
    (0..DETECTIONS).map(|index| track_validation::detection(road, far(index))).collect()
}

/// What is there comes to stand in succession somewhere among up to so many others in all.
fn surround<T: Clone>(draw: &mut Draw<'_>, items: &mut Vec<T>, others: &[T]) {
    let more = size(draw, others.len()).saturating_sub(items.len());
    let (before, after) = others[..more].split_at(place(draw, more));
    items.splice(..0, before.iter().cloned());
    items.extend_from_slice(after);
}

/// Divides a step of the trajectory, or lets the CAV stay at its only point.
fn points(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let Some(list) = &mut cycle.trajectory else { return };
    let more = size(draw, POINTS).saturating_sub(list.points.len()).max(1);
    let at = place(draw, list.points.len().saturating_sub(2));
    let (from, to) = match &list.points[at.min(list.points.len())..] {
        [] => return,
        [only] => (
            only.clone(),
            TrajectoryPoint { t_ns: only.t_ns.saturating_add(1_000_003), ..only.clone() },
        ),
        [from, to, ..] => (from.clone(), to.clone()),
    };
    let Some(dt_ns) = to.t_ns.checked_sub(from.t_ns).filter(|dt| (1_000_000..1 << 40).contains(dt))
    else {
        return;
    };
    let between = |index: usize| {
        let part = index as f64 / (more + 1) as f64;
        let t_ns = from.t_ns + base::to_ns(part * base::seconds(dt_ns));
        let (x, y) = (from.x + part * (to.x - from.x), from.y + part * (to.y - from.y));
        TrajectoryPoint { t_ns, x, y, ..from }
    };
    let next = at + 1;
    list.points.splice(next..next, (1..=more).map(between));
}

/// Divides the road between two cross sections.
fn sections(draw: &mut Draw<'_>, cycle: &mut Cycle) {
    let points = cycle.trajectory.as_ref().map_or(0, |list| list.points.len());
    let most = CROSS_SECTIONS.min(POINTS_AND_SECTIONS / points.max(1)).max(2);
    let sections = &mut cycle.route.cross_sections;
    let more = size(draw, most).saturating_sub(sections.len());
    let at = place(draw, sections.len().saturating_sub(2));
    let [from, to] = match &sections[at.min(sections.len())..] {
        [from, to, ..] => [from.clone(), to.clone()],
        _ => return,
    };
    let between = |index: usize| {
        let part = index as f64 / (more + 1) as f64;
        let on = |a: f64, b: f64| a + part * (b - a);
        let mut section = from.clone();
        (section.x, section.y) = (on(from.x, to.x), on(from.y, to.y));
        section.left = [on(from.left[0], to.left[0]), on(from.left[1], to.left[1])];
        section.right = [on(from.right[0], to.right[0]), on(from.right[1], to.right[1])];
        section
    };
    let next = at + 1;
    sections.splice(next..next, (1..=more).map(between));
}

/// Free cells on all sides.
fn cells(draw: &mut Draw<'_>, grid: &mut Grid) {
    let (Ok(width), Ok(height)) = (usize::try_from(grid.width), usize::try_from(grid.height))
    else {
        return;
    };
    let bytes = width.saturating_mul(height).div_ceil(8);
    let fits = |bitmap: &Vec<u8>| bitmap.len() == bytes;
    if bytes > 1 << 12 || !fits(&grid.occupied) || !grid.unknown.iter().all(fits) {
        return;
    }
    let all = size(draw, CELLS);
    let columns = size(draw, all.min(CELLS_A_SIDE)).max(width);
    let rows = (all / columns).clamp(height, CELLS_A_SIDE);
    let (left, below) = (place(draw, columns - width), place(draw, rows - height));
    for bitmap in [Some(&mut grid.occupied), grid.unknown.as_mut()].into_iter().flatten() {
        let mut new = vec![0; (columns * rows).div_ceil(8)];
        let is_set = |bit: &usize| bitmap[bit / 8] >> (bit % 8) & 1 == 1;
        for bit in (0..width * height).filter(is_set) {
            let at = (bit / width + below) * columns + bit % width + left;
            new[at / 8] |= 1 << (at % 8);
        }
        *bitmap = new;
    }
    let Grid { x, y, cos, sin, resolution, .. } = *grid;
    let corner = Frame { x, y, cos, sin };
    (grid.x, grid.y) = corner.at(-resolution * left as f64, -resolution * below as f64);
    let sides = [columns, rows].map(|side| i64::try_from(side).unwrap_or(1));
    (grid.width, grid.height) = sides.into();
}
