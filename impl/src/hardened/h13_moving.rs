//! Stage iv: detections that move as the CAV saw them move (H-13 of
//! `spec/3-stages.md#hardened-profile`).
//!
//! What is decided here in plain doubles, with `CLOSE` on the side that examines more, is which
//! pairs of a detection and an earlier item are examined; whether they collide is decided as in
//! stage iii.

use crate::hardened::detection_history::squares::{CLOSE, Links, MARGIN, Squares};
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::hardened::h10_explained::Explained;
use crate::input::cycle::{Cycle, Detection, DetectionList, Track, TrackList, Trajectory};
use crate::input::scratch::{Column, Scratch};
use crate::numbers::plane::Vector;
use crate::numbers::range::larger;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};
use crate::report::{Rule, Witness};
use crate::stages::horizon::{Horizon, PointsExamined};
use crate::stages::llcc::pursuit::{Passing, Pursuit};
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
        let work = self.work(detections.items.len(), examined.count());
        let limit = cycle.parameters.work_limit;
        if work > limit {
            let compared = [work, limit].map(|steps| Real::integer(steps).value());
            return Some(Witness::of(Rule::WorkLimit, compared));
        }
        let motion = CavMotion::with_beyond(&examined, detections.stamp_ns);
        let pasts = self.pasts(cycle);
        let mut search = Search {
            cycle,
            moving: self,
            detections,
            explained,
            reference,
            off: pasts.iter().flatten().map(|past| past.off).fold(0.0, larger),
            pasts,
            motion: &motion,
            pursuit: &motion.pursuit(),
            lists: [None; 4],
            first: None,
        };
        search.all(scratch);
        search.first.map(|found| found.witness(&self.history))
    }

    /// Detections times items of the longest usable list times (items of all usable lists + places).
    fn work(&self, detections: usize, places: usize) -> i64 {
        let items = || self.history.usable.iter().flatten().map(|list| list.items.len());
        let longest = items().fold(0, usize::max);
        let each = longest.saturating_mul(items().fold(places, usize::saturating_add));
        i64::try_from(detections.saturating_mul(each)).unwrap_or(i64::MAX)
    }

    /// The lists in which the past of a confirmed track is looked for, the first one first.
    fn pasts(&self, cycle: &Cycle<'_>) -> [Option<Past<'_>>; 4] {
        let mut pasts = [None; 4];
        for (past, list) in pasts.iter_mut().zip(self.history.by_reference_age()) {
            *past = self.history.usable.get(list).copied().flatten().map(|usable| {
                let reach = usable.reach(cycle) + CLOSE;
                let off = (cycle.parameters.theta_track_max + reach) / usable.age;
                Past { list, usable, reach, off }
            });
        }
        pasts
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
struct Pair {
    order: usize,
    detection: usize,
    item: usize,
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
    explained: &'m Explained,
    /// The place of the reference list.
    reference: usize,
    pasts: [Option<Past<'m>>; 4],
    /// The most of `Past::off`.
    off: f64,
    motion: &'m CavMotion<'m, 'a>,
    pursuit: &'m Pursuit,
    /// The usable lists by squares, once they are needed.
    lists: [Option<Squares<'c>>; 4],
    first: Option<Found>,
}

impl<'c> Search<'_, 'c, '_> {
    /// All detections that may reach the CAV. No other order finds another first collision.
    fn all(&mut self, scratch: &mut Scratch<'_>) {
        let items = self.detections.items;
        let Some(index) = self.moving.history.index else {
            for (detection, now) in items.iter().enumerate() {
                match self.explained.by(detection, scratch.rows, scratch.columns) {
                    Some(track) => self.confirmed(track, (detection, now), scratch),
                    None => self.unexplained((detection, now), scratch.columns),
                }
            }
            return;
        };
        let speed = libm::sqrt(self.explained.fastest) * (1.0 + 1e-9) + self.off;
        let [across, up] = self.motion.sweep.surroundings(index.reach, speed);
        let is_within = |[least, most]: [f64; 2], at: f64| least <= at && at <= most;
        let fastest = larger(speed, self.cycle.parameters.v_object + self.more());
        let near = self.motion.sweep.surroundings(index.reach, fastest);
        index.for_each_in(near, |detection, [x, y]| {
            match self.explained.by(detection, scratch.rows, scratch.columns) {
                Some(track) if is_within(across, x) && is_within(up, y) => {
                    let Some(now) = items.get(detection) else { return };
                    self.confirmed(track, (detection, now), scratch);
                }
                Some(_) => {}
                None => {
                    let Some(now) = items.get(detection) else { return };
                    self.unexplained((detection, now), scratch.columns);
                }
            }
        });
    }

    /// By how much what moves at most `CLOSE` more than `v_object` at the age of the reference list is
    /// faster, m/s.
    fn more(&self) -> f64 {
        self.usable(self.reference).map_or(0.0, |list| CLOSE / list.age)
    }

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
        let origins = row.origins();
        let is_held = |past: &&Past<'_>| origins & [1, 2, 4, 8].get(past.list).unwrap_or(&0) != 0;
        let Some(&Past { list, usable, reach, off }) = self.pasts.iter().flatten().find(is_held)
        else {
            return;
        };
        if off < self.off && self.motion.sweep.misses_all_near(&about, off) {
            return;
        }
        let passing = self.pursuit.passing(&about);
        let Some(squares) = self.by_squares(list, scratch.columns) else { return };
        let (dx, dy) = self.moved_since(tracks, track, &usable);
        let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
        let near = [around(track.x + dx), around(track.y + dy)];
        squares.for_each_in(scratch.columns, near, |item, before| {
            let [before_x, before_y] = before;
            let (x, y) = ((track.x - before_x) + dx, (track.y - before_y) + dy);
            let seen = SeenTwice::new(now, before, &usable);
            if x * x + y * y <= reach * reach && !passing.misses(seen.now.velocity) {
                self.examine(&Pair { order, detection, item, list }, &seen, &passing);
            }
        });
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

    /// (b): another detection, from every item that some other list supports.
    fn unexplained(&mut self, (detection, now): (usize, &Detection), columns: &mut [Column]) {
        let reference = self.reference;
        let Some(list) = self.usable(reference) else { return };
        let (v_object, age) = (self.cycle.parameters.v_object, list.age);
        let (farthest, rate) = (v_object * age + CLOSE, 1.0 / age);
        let standing = MovingRectangle::detection(now);
        // Rounded up: what moves as fast as that in an instant more.
        let speed = v_object + self.more();
        let from = self.pursuit.comes_from(&standing, speed, age);
        if from.iter().any(|[least, greatest]| least > greatest) {
            return;
        }
        let Some(squares) = self.by_squares(reference, columns) else { return };
        let tracks = self.moving.tracks.map_or(0, |list| list.items.len());
        let order = tracks.saturating_add(detection);
        let passing = self.pursuit.passing(&standing);
        squares.for_each_in(columns, from, |item, before| {
            let [before_x, before_y] = before;
            let (x, y) = (now.x - before_x, now.y - before_y);
            if !passing.misses_on_line([x * rate, y * rate]) && x * x + y * y <= farthest * farthest
            {
                let pair = Pair { order, detection, item, list: reference };
                self.unexplained_from(before, now, &pair, &passing, columns);
            }
        });
    }

    #[inline(never)]
    fn unexplained_from(
        &mut self,
        before: [f64; 2],
        now: &Detection,
        pair: &Pair,
        passing: &Passing<'_>,
        columns: &[Column],
    ) {
        let Some(list) = self.usable(pair.list) else { return };
        let seen = SeenTwice::new(now, before, &list);
        if !passing.misses(seen.now.velocity) && self.is_supported(now, before, columns) {
            self.examine(pair, &seen, passing);
        }
    }

    /// Whether an item of another list is where the object was then, when there are other lists.
    fn is_supported(&self, now: &Detection, before: [f64; 2], columns: &[Column]) -> bool {
        let Some(own) = self.usable(self.reference) else { return true };
        let reach = self.cycle.parameters.theta_track_max + CLOSE;
        let [before_x, before_y] = before;
        let mut alone = true;
        for (list, squares) in self.lists.iter().enumerate() {
            let (Some(squares), Some(other)) = (squares, self.usable(list)) else { continue };
            if list == self.reference {
                continue;
            }
            alone = false;
            let mut supported = false;
            let share = other.age / own.age;
            let (dx, dy) = ((before_x - now.x) * share, (before_y - now.y) * share);
            let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
            let near = [around(now.x + dx), around(now.y + dy)];
            squares.for_each_in(columns, near, |_, [item_x, item_y]| {
                let (x, y) = ((now.x - item_x) + dx, (now.y - item_y) + dy);
                supported |= x * x + y * y <= reach * reach;
            });
            if supported {
                return true;
            }
        }
        alone
    }

    /// Looks for a collision that is earlier than the first so far.
    fn examine(&mut self, pair: &Pair, seen: &SeenTwice, passing: &Passing<'_>) {
        let &Pair { order, detection, item, list } = pair;
        let window = passing.window(seen.now.velocity);
        let end = self.first.map_or(usize::MAX, |first| first.point.saturating_add(1));
        let Some((point, compared)) = self.motion.collision_within(window, seen, end) else {
            return;
        };
        let found = Found { point, order, item, detection, list, compared };
        if self.first.is_none_or(|first| found.key() < first.key()) {
            self.first = Some(found);
        }
    }
}
