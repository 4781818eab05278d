//! Stage iv: detections that move as the CAV saw them move (H-13 of
//! `spec/3-stages.md#hardened-profile`).
//!
//! What is decided here in plain doubles, with `CLOSE` on the side that examines more, is which
//! pairs of a detection and an earlier item are examined; whether they collide is decided as in
//! stage iii. That an explained detection is disputed is asked last, of a pair that collides
//! (`disputed`, with what it costs). Which points after those of (a) and (b) a pair is examined at,
//! (c), is asked of a pair that collides there, too (`waiting`).

mod disputed;
mod lists;
mod seen_twice;
mod waiting;

use crate::hardened::detection_history::squares::{CLOSE, MARGIN};
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::hardened::h10_explained::Explained;
use crate::hardened::h13_moving::disputed::Disputes;
use crate::hardened::h13_moving::lists::{Lists, Past};
use crate::hardened::h13_moving::seen_twice::SeenTwice;
use crate::hardened::h13_moving::waiting::{Far, Stretch, Waiting};
use crate::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList, Trajectory};
use crate::input::scratch::Scratch;
use crate::numbers::range::{intersection, is_empty, larger};
use crate::numbers::rounding::Real;
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::pursuit::Passing;
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
        let lists = Lists::new(cycle, &self.history, self.tracks);
        let waiting = Waiting::new(cycle, trajectory.points, examined.points.len(), stamp_ns);
        let disputes =
            Disputes::new(detections, self.history.index, self.tracks, explained, scratch);
        let mut search = Search {
            cycle,
            moving: self,
            detections,
            explained,
            reference,
            off: lists.greatest_off(),
            lists,
            at: &Stretch::first(&examined, waiting.as_ref(), stamp_ns),
            waiting: waiting.as_ref(),
            disputes,
            first: None,
        };
        search.all(scratch);
        let far = waiting.as_ref().filter(|_| search.first.is_none()).and_then(Waiting::far);
        if let Some(far) = &far {
            let mut search = Search { at: &far.stretch, ..search };
            search.all_far(far, scratch);
            return search.first.map(|found| found.witness(&self.history));
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
    /// The points that are looked at.
    at: &'m Stretch<'m, 'a>,
    /// (c), when there are points after those of (a) and (b).
    waiting: Option<&'m Waiting<'m, 'a>>,
    disputes: Disputes<'m, 'c, 'a>,
    first: Option<Found>,
}

impl<'c> Search<'_, 'c, '_> {
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
        let [across, up] = self.at.motion.sweep.surroundings(index.reach, speed);
        let is_within = |[least, most]: [f64; 2], at: f64| least <= at && at <= most;
        let from_anywhere = self.cycle.parameters.v_object + self.more();
        let all_explained = self.explained.count == items.len();
        let fastest = if all_explained { speed } else { larger(speed, from_anywhere) };
        let near = self.at.motion.sweep.surroundings(index.reach, fastest);
        index.for_each_in(near, |detection, [x, y]| {
            let Some(now) = items.get(detection) else { return };
            let track = self.explained.by(detection, scratch.rows, scratch.columns);
            if let Some(track) = track.filter(|_| is_within(across, x) && is_within(up, y)) {
                self.confirmed(track, (detection, now), scratch);
            }
            self.come_from_anywhere((detection, now), track, scratch);
        });
    }

    /// (c): all detections that may meet the CAV far on.
    fn all_far(&mut self, far: &Far<'_, '_>, scratch: &mut Scratch<'_>) {
        for (detection, now) in self.detections.items.iter().enumerate() {
            let standing = MovingRectangle::detection(now);
            if !far.may_be_met(&standing) {
                continue;
            }
            let velocities = far.velocities(&standing);
            if is_empty(velocities) {
                continue;
            }
            let track = self.explained.by(detection, scratch.rows, scratch.columns);
            if let Some(track) = track {
                self.confirmed_with(velocities, track, (detection, now), scratch);
            }
            self.come_from_anywhere_with(velocities, (detection, now), track, scratch);
        }
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
        if self.at.motion.sweep.misses_all_near(&about, self.off) {
            return;
        }
        let Some(past) = self.lists.past_of(row) else { return };
        if past.off < self.off && self.at.motion.sweep.misses_all_near(&about, past.off) {
            return;
        }
        self.come_from_past((order, track), &past, (detection, now), past.around(track), scratch);
    }

    /// The same with velocities between these.
    fn confirmed_with(
        &mut self,
        velocities: [[f64; 2]; 2],
        order: usize,
        (detection, now): (usize, &Detection),
        scratch: &mut Scratch<'_>,
    ) {
        let Some(tracks) = self.moving.tracks else { return };
        let Some((track, row)) = tracks.items.get(order).zip(scratch.rows.get(order)) else {
            return;
        };
        let about = |rate: f64| [rate - self.off, rate + self.off];
        if is_empty(intersection(velocities, [about(track.vx), about(track.vy)])) {
            return;
        }
        let Some(past) = self.lists.past_of(row) else { return };
        let from = intersection(past.around(track), before(now, velocities, past.usable.age));
        if !is_empty(from) {
            self.come_from_past((order, track), &past, (detection, now), from, scratch);
        }
    }

    /// From every item in the box that may have been the track.
    fn come_from_past(
        &mut self,
        (order, track): (usize, &Track),
        past: &Past<'_>,
        (detection, now): (usize, &Detection),
        from: [[f64; 2]; 2],
        scratch: &mut Scratch<'_>,
    ) {
        let &Past { list, usable, reach, .. } = past;
        let passing = self.at.pursuit.passing(&MovingRectangle::detection(now));
        let Some(squares) = self.lists.by_squares(list, scratch.columns) else { return };
        let (dx, dy) = past.moved(track);
        squares.for_each_in(scratch.columns, from, |item, before| {
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
        let Some((list, speed)) = self.anywhere(track, scratch) else { return };
        let standing = MovingRectangle::detection(now);
        let from = self.at.pursuit.comes_from(&standing, speed, list.age);
        if !is_empty(from) {
            self.come_from_within(from, &list, (detection, now), track, scratch);
        }
    }

    /// The same with velocities between these.
    fn come_from_anywhere_with(
        &mut self,
        velocities: [[f64; 2]; 2],
        (detection, now): (usize, &Detection),
        track: Option<usize>,
        scratch: &mut Scratch<'_>,
    ) {
        let Some((list, speed)) = self.anywhere(track, scratch) else { return };
        let within = intersection(velocities, [[-speed, speed]; 2]);
        if !is_empty(within) {
            let from = before(now, within, list.age);
            self.come_from_within(from, &list, (detection, now), track, scratch);
        }
    }

    /// The reference list, and the greatest speed from it, rounded up: what moves as fast as `v_object` in
    /// an instant more. `None` where a track explains the detection, and nobody may dispute that.
    fn anywhere(
        &self,
        track: Option<usize>,
        scratch: &Scratch<'_>,
    ) -> Option<(UsableList<'c>, f64)> {
        let may_be = |track| self.disputes.may_be_disputed(track, &self.lists, scratch);
        let list = self.lists.usable(self.reference)?;
        let speed = self.cycle.parameters.v_object + self.more();
        track.is_none_or(may_be).then_some((list, speed))
    }

    /// From every item in the box that some other list supports.
    fn come_from_within(
        &mut self,
        from: [[f64; 2]; 2],
        list: &UsableList<'_>,
        (detection, now): (usize, &Detection),
        track: Option<usize>,
        scratch: &mut Scratch<'_>,
    ) {
        let (reference, age) = (self.reference, list.age);
        let (farthest, rate) = (self.cycle.parameters.v_object * age + CLOSE, 1.0 / age);
        let Some(squares) = self.lists.by_squares(reference, scratch.columns) else { return };
        let tracks = self.moving.tracks.map_or(0, |list| list.items.len());
        let order = tracks.saturating_add(detection);
        let passing = self.at.pursuit.passing(&MovingRectangle::detection(now));
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
        passing: &Passing<'_>,
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
    fn earlier(&self, pair: &Pair, seen: &SeenTwice, passing: &Passing<'_>) -> Option<Found> {
        let &Pair { order, detection, item, list } = pair;
        let (window, from) = (passing.window(seen.now.velocity), self.at.from);
        let mut end = self.first.map_or(usize::MAX, |first| first.point.saturating_add(1));
        let waiting = self.waiting.filter(|waiting| end > waiting.examined);
        if let Some(waiting) = waiting.filter(|waiting| waiting.is_passed_by(seen)) {
            end = waiting.examined;
        }
        let end = end.saturating_sub(from);
        let (point, compared) = self.at.motion.collision_within(window, seen, end)?;
        let point = point.saturating_add(from);
        if self.waiting.is_some_and(|waiting| !waiting.is_examined_at(point, seen)) {
            return None;
        }
        let found = Found { point, order, item, detection, list, compared };
        self.first.is_none_or(|first| found.key() < first.key()).then_some(found)
    }
}

/// Where an item of that age in s is from which the detection comes with velocities between these.
fn before(now: &Detection, [across, up]: [[f64; 2]; 2], age: f64) -> [[f64; 2]; 2] {
    let range = |at: f64, [least, greatest]: [f64; 2]| {
        [at - greatest * age - MARGIN, at - least * age + MARGIN]
    };
    [range(now.x, across), range(now.y, up)]
}
