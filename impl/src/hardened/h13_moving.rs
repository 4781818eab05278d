//! Stage iv: detections that move as the CAV saw them move (H-13 of
//! `spec/3-stages.md#hardened-profile`).
//!
//! What is decided here in plain doubles, with `CLOSE` on the side that examines more, is which
//! pairs of a detection and an earlier item are examined; whether they collide is decided as in
//! stage iii. That an explained detection is disputed is asked last, of a pair that collides
//! (`disputed`, with what it costs).

mod disputed;
mod lists;
mod seen_twice;
mod waiting;

use crate::hardened::detection_history::DetectionHistory;
use crate::hardened::detection_history::squares::{CLOSE, MARGIN};
use crate::hardened::h10_explained::Explained;
use crate::hardened::h13_moving::disputed::Disputes;
use crate::hardened::h13_moving::lists::{Lists, Past};
use crate::hardened::h13_moving::seen_twice::SeenTwice;
use crate::hardened::h13_moving::waiting::Waiting;
use crate::input::cycle::{Cycle, Detection, DetectionList, TrackList, Trajectory};
use crate::input::scratch::Scratch;
use crate::numbers::range::{intersection, larger};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::CavMotion;
use crate::stages::llcc::pursuit::{Passing, Pursuit};
use crate::stages::llcc::sweep::MovingRectangle;

/// What says how the current detections have moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingDetections<'c, 'a> {
    pub(crate) history: DetectionHistory<'c, 'a>,
    /// The received tracks when they are current; what the CAV saw of them stands in the scratch.
    pub(crate) tracks: Option<&'c TrackList<'a>>,
}

impl MovingDetections<'_, '_> {
    /// Why stage iv fails, if it does.
    pub(crate) fn failure(
        &self,
        cycle: &Cycle<'_>,
        trajectory: &Trajectory<'_>,
        explained: &Explained,
        scratch: &mut Scratch<'_>,
    ) -> Option<Witness> {
        let detections = self.history.detections?;
        let reference = self.history.reference()?;
        let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Motion);
        let places = trajectory.points.len().saturating_add(examined.beyond.count());
        let work = self.work(detections.items.len(), places);
        let limit = cycle.parameters.work_limit;
        if work > limit {
            let compared = [work, limit].map(|steps| Real::integer(steps).value());
            return Some(Witness::of(Rule::WorkLimit, compared));
        }
        let stamp_ns = detections.stamp_ns;
        let motion = CavMotion::with_beyond(&examined, stamp_ns);
        let lists = Lists::new(cycle, &self.history, self.tracks);
        let mut search = Search {
            cycle,
            moving: self,
            detections,
            explained,
            reference,
            off: lists.greatest_off(),
            lists,
            motion: &motion,
            pursuit: &motion.pursuit(),
            waiting: None,
            disputes: Disputes::new(
                detections,
                self.history.index,
                self.tracks,
                explained,
                scratch,
            ),
            first: None,
        };
        search.all(scratch);
        let points = examined.points.len();
        let waiting = Waiting::new(cycle.ego, trajectory.points, points, stamp_ns);
        if let Some(waiting) = waiting.filter(|_| search.first.is_none()) {
            let motion = CavMotion::new(cycle, waiting.points(), stamp_ns);
            let pursuit = motion.pursuit();
            let mut on =
                Search { motion: &motion, pursuit: &pursuit, waiting: Some(&waiting), ..search };
            on.all(scratch);
            return on.first.map(|found| found.witness(&self.history));
        }
        search.first.map(|found| found.witness(&self.history))
    }

    /// Detections times items of the longest usable list times (items of all usable lists + places).
    fn work(&self, detections: usize, places: usize) -> i64 {
        let items = || self.history.usable.iter().flatten().map(|list| list.items.len());
        let longest = items().fold(0, usize::max);
        let each = longest.saturating_mul(items().fold(places, usize::saturating_add));
        i64::try_from(detections.saturating_mul(each)).unwrap_or(i64::MAX)
    }
}

/// A collision; the first is the least in point, order and item.
#[derive(Clone, Copy)]
struct Found {
    point: usize,
    /// Tracks before detections.
    order: usize,
    item: usize,
    detection: usize,
    /// The place of the item's list in the history.
    list: usize,
    compared: [f64; 2],
}

impl Found {
    fn key(&self) -> [usize; 3] {
        [self.point, self.order, self.item]
    }

    fn witness(&self, history: &DetectionHistory<'_, '_>) -> Witness {
        let witness = Witness::of(Rule::CollisionMoving, self.compared).at_point(self.point);
        let list = history.usable.get(self.list).copied().flatten();
        Witness {
            detection: Some(self.detection),
            item: Some(self.item),
            age_ns: list.map(|list| list.age_ns),
            ..witness
        }
    }
}

/// A pair that is examined: of a detection and an item of a list.
#[derive(Clone, Copy)]
struct Pair {
    order: usize,
    detection: usize,
    item: usize,
    list: usize,
}

/// An object as seen by the CAV on its way; and where it stands and would have to wait.
struct Passes<'m> {
    moving: Passing<'m>,
    standing: Option<Passing<'m>>,
}

impl Passes<'_> {
    #[inline]
    fn misses_on_line(&self, velocity: [f64; 2]) -> bool {
        self.moving.misses_on_line(velocity)
            || self.standing.as_ref().is_some_and(|standing| standing.misses_on_line(velocity))
    }

    #[inline]
    fn misses(&self, velocity: [f64; 2]) -> bool {
        self.moving.misses(velocity)
            || self.standing.as_ref().is_some_and(|standing| standing.misses_on_line(velocity))
    }
}

fn is_empty(area: [[f64; 2]; 2]) -> bool {
    area.iter().any(|[least, greatest]| least > greatest)
}

/// The search for the first collision.
struct Search<'m, 'c, 'a> {
    cycle: &'m Cycle<'a>,
    moving: &'m MovingDetections<'c, 'a>,
    detections: &'c DetectionList<'a>,
    explained: &'m Explained,
    /// The place of the reference list.
    reference: usize,
    lists: Lists<'m, 'c, 'a>,
    /// The most of `Past::off`.
    off: f64,
    motion: &'m CavMotion<'m, 'a>,
    pursuit: &'m Pursuit,
    /// (c): that the CAV may not wait at points before, when these are the points after.
    waiting: Option<&'m Waiting<'a>>,
    disputes: Disputes<'m, 'c, 'a>,
    first: Option<Found>,
}

impl<'m> Search<'m, '_, '_> {
    /// All detections that may reach the CAV. No other order finds another first collision.
    fn all(&mut self, scratch: &mut Scratch<'_>) {
        let items = self.detections.items;
        let Some(index) = self.moving.history.index else {
            for (detection, now) in items.iter().enumerate() {
                let track = self.explained.by(detection, scratch.rows, scratch.columns);
                if let Some(track) = track {
                    self.confirmed(track, (detection, now), scratch);
                }
                self.come_from_anywhere((detection, now), track, scratch);
            }
            return;
        };
        let speed = libm::sqrt(self.explained.fastest) * (1.0 + 1e-9) + self.off;
        let [across, up] = self.motion.sweep.surroundings(index.reach, speed);
        let is_within = |[least, most]: [f64; 2], at: f64| least <= at && at <= most;
        let from_anywhere = self.cycle.parameters.v_object + self.more();
        let all_explained = self.explained.count == items.len();
        let fastest = if all_explained { speed } else { larger(speed, from_anywhere) };
        let near = self.motion.sweep.surroundings(index.reach, fastest);
        index.for_each_in(near, |detection, [x, y]| {
            let Some(now) = items.get(detection) else { return };
            let track = self.explained.by(detection, scratch.rows, scratch.columns);
            if let Some(track) = track.filter(|_| is_within(across, x) && is_within(up, y)) {
                self.confirmed(track, (detection, now), scratch);
            }
            self.come_from_anywhere((detection, now), track, scratch);
        });
    }

    fn passing(&self, object: &MovingRectangle) -> Passes<'m> {
        let standing = self.waiting.map(|waiting| waiting.standing.passing(object));
        Passes { moving: self.pursuit.passing(object), standing }
    }

    /// By how much what moves at most `CLOSE` more than `v_object` at the age of the reference list is
    /// faster, m/s.
    fn more(&self) -> f64 {
        self.lists.usable(self.reference).map_or(0.0, |list| CLOSE / list.age)
    }

    /// (a): the detection of a confirmed track, from every item that may have been the track.
    fn confirmed(
        &mut self,
        order: usize,
        (detection, now): (usize, &Detection),
        scratch: &mut Scratch<'_>,
    ) {
        let Some(tracks) = self.moving.tracks else { return };
        let Some((track, row)) = tracks.items.get(order).zip(scratch.rows.get(order)) else {
            return;
        };
        let velocity = [track.vx, track.vy];
        let about = MovingRectangle { velocity, ..MovingRectangle::detection(now) };
        if self.motion.sweep.misses_all_near(&about, self.off) {
            return;
        }
        let Some(past) = self.lists.past_of(row) else { return };
        let Past { list, usable, reach, off, .. } = past;
        if off < self.off && self.motion.sweep.misses_all_near(&about, off) {
            return;
        }
        let (dx, dy) = past.moved(track);
        let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
        let mut near = [around(track.x + dx), around(track.y + dy)];
        if let Some(waiting) = self.waiting {
            let speed = libm::sqrt(self.explained.fastest) * (1.0 + 1e-9) + off;
            let from = self.pursuit.comes_from(&about, speed, usable.age);
            let standing = waiting.standing.comes_from(&about, speed, usable.age);
            near = intersection(near, intersection(from, standing));
            if is_empty(near) {
                return;
            }
        }
        let passing = self.passing(&about);
        let Some(squares) = self.lists.by_squares(list, scratch.columns) else { return };
        squares.for_each_in(scratch.columns, near, |item, before| {
            let [before_x, before_y] = before;
            let (x, y) = ((track.x - before_x) + dx, (track.y - before_y) + dy);
            let seen = SeenTwice::new(now, before, &usable);
            if x * x + y * y <= reach * reach && !passing.misses(seen.now.velocity) {
                let pair = Pair { order, detection, item, list };
                self.first = self.earlier(&pair, &seen, &passing).or(self.first);
            }
        });
    }

    /// (b): a detection that is unexplained, or disputed, from every item that some other list
    /// supports. `track`: which explains it.
    fn come_from_anywhere(
        &mut self,
        (detection, now): (usize, &Detection),
        track: Option<usize>,
        scratch: &mut Scratch<'_>,
    ) {
        if let Some(track) = track {
            if !self.disputes.may_be_disputed(track, &self.lists, scratch) {
                return;
            }
        }
        let reference = self.reference;
        let Some(list) = self.lists.usable(reference) else { return };
        let (v_object, age) = (self.cycle.parameters.v_object, list.age);
        let (farthest, rate) = (v_object * age + CLOSE, 1.0 / age);
        let standing = MovingRectangle::detection(now);
        // Rounded up: what moves as fast as that in an instant more.
        let speed = v_object + self.more();
        let mut from = self.pursuit.comes_from(&standing, speed, age);
        if let Some(waiting) = self.waiting.filter(|_| !is_empty(from)) {
            from = intersection(from, waiting.standing.comes_from(&standing, speed, age));
        }
        if is_empty(from) {
            return;
        }
        let Some(squares) = self.lists.by_squares(reference, scratch.columns) else { return };
        let tracks = self.moving.tracks.map_or(0, |list| list.items.len());
        let order = tracks.saturating_add(detection);
        let passing = self.passing(&standing);
        let scratch = &*scratch;
        squares.for_each_in(scratch.columns, from, |item, before| {
            let [before_x, before_y] = before;
            let (x, y) = (now.x - before_x, now.y - before_y);
            if !passing.misses_on_line([x * rate, y * rate]) && x * x + y * y <= farthest * farthest
            {
                let pair = Pair { order, detection, item, list: reference };
                self.come_from_item(before, (now, track), &pair, &passing, scratch);
            }
        });
    }

    #[inline(never)]
    fn come_from_item(
        &mut self,
        before: [f64; 2],
        (now, track): (&Detection, Option<usize>),
        pair: &Pair,
        passing: &Passes<'_>,
        scratch: &Scratch<'_>,
    ) {
        let Some(list) = self.lists.usable(pair.list) else { return };
        let seen = SeenTwice::new(now, before, &list);
        if passing.misses(seen.now.velocity)
            || !self.lists.is_supported(now, before, (pair.list, &list), scratch.columns)
        {
            return;
        }
        let Some(found) = self.earlier(pair, &seen, passing) else { return };
        if track.is_none_or(|track| self.disputes.is_disputed(track, &self.lists, scratch)) {
            self.first = Some(found);
        }
    }

    /// A collision that is earlier than the first so far.
    fn earlier(&self, pair: &Pair, seen: &SeenTwice, passing: &Passes<'_>) -> Option<Found> {
        let &Pair { order, detection, item, list } = pair;
        let window = passing.moving.window(seen.now.velocity);
        let from = self.waiting.map_or(0, |waiting| waiting.from);
        let end = self.first.map_or(usize::MAX, |first| first.point.saturating_add(1));
        let end = end.saturating_sub(from);
        let (point, compared) = self.motion.collision_within(window, seen, end)?;
        let point = point.saturating_add(from);
        if self.waiting.is_some_and(|waiting| !waiting.is_examined_at(point, seen)) {
            return None;
        }
        let found = Found { point, order, item, detection, list, compared };
        self.first.is_none_or(|first| found.key() < first.key()).then_some(found)
    }
}
