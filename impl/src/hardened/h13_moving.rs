//! Stage iv: detections that move as the CAV saw them move (H-13 of
//! `spec/3-stages.md#hardened-profile`).
//!
//! What is decided here in plain doubles, with `CLOSE` on the side that examines more, is which
//! pairs of a detection and an earlier item are examined; whether they collide is decided as in
//! stage iii.

use crate::hardened::detection_history::squares::{CLOSE, Links, MARGIN, Squares};
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList, Trajectory};
use crate::input::scratch::{Column, Scratch};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Moving};

/// What says how the current detections have moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingDetections<'c, 'a> {
    pub(crate) history: DetectionHistory<'c, 'a>,
    /// The received tracks when they are current; what the CAV saw of them stands in the scratch.
    pub(crate) tracks: Option<&'c TrackList<'a>>,
}

impl MovingDetections<'_, '_> {
    /// Why stage iv fails, if it does. `explained`: how many detections are marked as explained.
    pub(crate) fn failure(
        &self,
        cycle: &Cycle<'_>,
        trajectory: &Trajectory<'_>,
        explained: usize,
        scratch: &mut Scratch<'_>,
    ) -> Option<Witness> {
        let detections = self.history.detections?;
        let reference = self.history.reference()?;
        let examined = PointsExamined::new(cycle, trajectory.points, Horizon::Motion);
        let motion = CavMotion::with_beyond(&examined, detections.stamp_ns);
        let unexplained = detections.items.len().saturating_sub(explained);
        let mut search = Search {
            cycle,
            moving: self,
            detections,
            motion: &motion,
            lists: [None; 4],
            first: None,
        };
        search.confirmed(scratch);
        if unexplained > 0 {
            let work = search.work(unexplained, reference, examined.points.len());
            let limit = cycle.parameters.work_limit;
            if work > limit {
                let compared = [work, limit].map(|steps| Real::integer(steps).value());
                return Some(Witness::of(Rule::WorkLimit, compared));
            }
            search.unexplained(reference, scratch);
        }
        search.first.map(|found| found.witness(&self.history))
    }
}

/// A detection that has come from an earlier item.
struct SeenTwice {
    /// With the mean velocity.
    now: MovingRectangle,
    /// The item, m.
    before: [f64; 2],
    age_ns: i64,
}

impl SeenTwice {
    fn new(now: &Detection, before: [f64; 2], list: &UsableList<'_>) -> Self {
        let (rate, [x, y]) = (1.0 / list.age, before);
        let velocity = [(now.x - x) * rate, (now.y - y) * rate];
        let now = MovingRectangle { velocity, ..MovingRectangle::detection(now) };
        Self { now, before, age_ns: list.age_ns }
    }
}

impl Moving for SeenTwice {
    fn plainly(&self) -> &MovingRectangle {
        &self.now
    }

    fn exactly(&self, dt_ns: i64) -> Rectangle {
        let moved = Vector::between(self.before, self.now.centre);
        let times = Real::integer(dt_ns).over(Real::integer(self.age_ns));
        self.now.displaced(moved.times(times))
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
struct Pair<'a> {
    order: usize,
    detection: usize,
    now: &'a Detection,
    item: usize,
    /// Where the item is, m.
    before: [f64; 2],
    list: usize,
}

/// The list in which the past of a track is looked for.
#[derive(Clone, Copy)]
struct Past<'a> {
    /// Its place in the history.
    list: usize,
    usable: UsableList<'a>,
    /// How far from the past an item may be, m.
    reach: f64,
    /// How much the mean velocity may differ from that of the track, m/s.
    off: f64,
}

/// The search for the first collision.
struct Search<'m, 'c, 'a> {
    cycle: &'m Cycle<'a>,
    moving: &'m MovingDetections<'c, 'a>,
    detections: &'c DetectionList<'a>,
    motion: &'m CavMotion<'m, 'a>,
    /// The usable lists by squares, once they are needed.
    lists: [Option<Squares<'c>>; 4],
    first: Option<Found>,
}

impl<'c> Search<'_, 'c, '_> {
    fn usable(&self, list: usize) -> Option<UsableList<'c>> {
        self.moving.history.usable.get(list).copied().flatten()
    }

    /// The list by squares. All usable ones are listed at the first call.
    fn by_squares(&mut self, list: usize, columns: &mut [Column]) -> Option<Squares<'c>> {
        if self.lists.iter().all(Option::is_none) {
            // Of a few squares for what comes from anywhere, and of a few things in a square.
            let side = larger(
                4.0 * self.cycle.parameters.theta_track_max,
                0.25 * self.cycle.parameters.v_object,
            );
            let usable = self.moving.history.usable.iter().zip(Links::ALL);
            for (squares, (list, links)) in self.lists.iter_mut().zip(usable) {
                *squares =
                    list.map(|list| Squares::of((list.items, list.index), side, links, columns));
            }
        }
        self.lists.get(list).copied().flatten()
    }

    /// (a): the detections of confirmed tracks, from every item that may have been the track.
    fn confirmed(&mut self, scratch: &mut Scratch<'_>) {
        let Some(tracks) = self.moving.tracks else { return };
        let pasts = self.pasts();
        for (order, track) in tracks.items.iter().enumerate() {
            let Some(row) = scratch.rows.get(order) else { continue };
            let Some(detection) = row.confirmed_by().map(usize::from) else { continue };
            let Some(now) = self.detections.items.get(detection) else { continue };
            let Some(Some(past)) = pasts.get(row.origins()) else { continue };
            let &Past { list, usable, reach, off } = past;
            let velocity = [track.vx, track.vy];
            let about = MovingRectangle { velocity, ..MovingRectangle::detection(now) };
            if self.motion.sweep.misses_all_near(&about, off) {
                continue;
            }
            let Some(squares) = self.by_squares(list, scratch.columns) else { continue };
            let (dx, dy) = self.moved_since(tracks, track, &usable);
            let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
            let near = [around(track.x + dx), around(track.y + dy)];
            squares.for_each_in(scratch.columns, near, |item, before| {
                let [before_x, before_y] = before;
                let (x, y) = ((track.x - before_x) + dx, (track.y - before_y) + dy);
                if x * x + y * y <= reach * reach {
                    self.examine(&Pair { order, detection, now, item, before, list });
                }
            });
        }
    }

    /// The list in which the past of a confirmed track is looked for, for each set of lists that
    /// hold its own origin: a bit for each place of the history.
    fn pasts(&self) -> [Option<Past<'c>>; 16] {
        let mut pasts = [None; 16];
        for (origins, past) in pasts.iter_mut().enumerate() {
            let mut lists = self.moving.history.by_reference_age();
            let list = lists.find(|&list| origins & [1, 2, 4, 8].get(list).unwrap_or(&0) != 0);
            *past = list.and_then(|list| {
                let usable = self.usable(list)?;
                let reach = usable.reach(self.cycle) + CLOSE;
                let off = (self.cycle.parameters.theta_track_max + reach) / usable.age;
                Some(Past { list, usable, reach, off })
            });
        }
        pasts
    }

    /// From the position of a track to its past, m.
    fn moved_since(
        &self,
        tracks: &TrackList<'_>,
        track: &Track,
        list: &UsableList<'_>,
    ) -> (f64, f64) {
        let since_ns = elapsed_ns(tracks.stamp_ns, self.detections.stamp_ns);
        let since = seconds(since_ns.saturating_sub(list.age_ns));
        (track.vx * since, track.vy * since)
    }

    /// Detections times items of the reference list times (items of the other lists + points).
    fn work(&self, unexplained: usize, reference: usize, points: usize) -> i64 {
        let items = |list: usize| self.usable(list).map_or(0, |list| list.items.len());
        let others =
            (0..4).filter(|&list| list != reference).map(items).fold(0, usize::saturating_add);
        let each = items(reference).saturating_mul(others.saturating_add(points));
        i64::try_from(unexplained.saturating_mul(each)).unwrap_or(i64::MAX)
    }

    /// (b): the other detections, from every item that some other list supports.
    fn unexplained(&mut self, reference: usize, scratch: &mut Scratch<'_>) {
        let Some(list) = self.usable(reference) else { return };
        let (v_object, age) = (self.cycle.parameters.v_object, list.age);
        let farthest = v_object * age + CLOSE;
        let tracks = self.moving.tracks.map_or(0, |list| list.items.len());
        for (detection, now) in self.detections.items.iter().enumerate() {
            let column = scratch.columns.get(detection);
            let standing = MovingRectangle::detection(now);
            // Rounded up: what moves as fast as that in an instant more.
            let speed = v_object + CLOSE / age;
            if column.is_none_or(Column::is_explained)
                || self.motion.sweep.misses_all_near(&standing, speed)
            {
                continue;
            }
            let Some(squares) = self.by_squares(reference, scratch.columns) else { continue };
            let order = tracks.saturating_add(detection);
            let from = self.motion.sweep.comes_from(&standing, speed, age);
            squares.for_each_in(scratch.columns, from, |item, before| {
                let [before_x, before_y] = before;
                let (x, y) = (now.x - before_x, now.y - before_y);
                let pair = Pair { order, detection, now, item, before, list: reference };
                if x * x + y * y <= farthest * farthest
                    && self.may_collide(&pair)
                    && self.is_supported(&pair, scratch.columns)
                {
                    self.examine(&pair);
                }
            });
        }
    }

    fn may_collide(&self, pair: &Pair<'_>) -> bool {
        self.usable(pair.list).is_some_and(|list| {
            let seen = SeenTwice::new(pair.now, pair.before, &list);
            !self.motion.sweep.misses(seen.plainly())
        })
    }

    /// Whether an item of another list is where the object was then, when there are other lists.
    fn is_supported(&self, pair: &Pair<'_>, columns: &[Column]) -> bool {
        let Some(own) = self.usable(pair.list) else { return true };
        let reach = self.cycle.parameters.theta_track_max + CLOSE;
        let mut alone = true;
        for (list, squares) in self.lists.iter().enumerate().filter(|&(list, _)| list != pair.list)
        {
            let (Some(squares), Some(other)) = (squares, self.usable(list)) else { continue };
            alone = false;
            let mut supported = false;
            let share = other.age / own.age;
            let [before_x, before_y] = pair.before;
            let (dx, dy) = ((before_x - pair.now.x) * share, (before_y - pair.now.y) * share);
            let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
            let near = [around(pair.now.x + dx), around(pair.now.y + dy)];
            squares.for_each_in(columns, near, |_, [item_x, item_y]| {
                let (x, y) = ((pair.now.x - item_x) + dx, (pair.now.y - item_y) + dy);
                supported |= x * x + y * y <= reach * reach;
            });
            if supported {
                return true;
            }
        }
        alone
    }

    /// Looks for a collision that is earlier than the first so far.
    fn examine(&mut self, pair: &Pair<'_>) {
        let &Pair { order, detection, now, item, before, list } = pair;
        let Some(usable) = self.usable(list) else { return };
        let seen = SeenTwice::new(now, before, &usable);
        if self.motion.sweep.misses(seen.plainly()) {
            return;
        }
        let end = self.first.map_or(usize::MAX, |first| first.point.saturating_add(1));
        let Some((point, compared)) = self.motion.collision_with(&seen, end) else { return };
        let found = Found { point, order, item, detection, list, compared };
        if self.first.is_none_or(|first| found.key() < first.key()) {
            self.first = Some(found);
        }
    }
}
