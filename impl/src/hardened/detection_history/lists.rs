//! The usable lists, as H-14 looks into them.

use crate::cycle::steps::SUPPORT;
use crate::hardened::detection_history::squares::{CLOSE, MARGIN, Squares};
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::hardened::h14_fail_safe::times::a_tyre;
use crate::hardened::h14_fail_safe::work::Work;
use crate::input::cycle::{Cycle, Track, TrackList};
use crate::input::scratch::{Column, Row};
use crate::numbers::range::larger;
use crate::numbers::time::{elapsed_ns, seconds};

/// At most so far from its items is what stood, m.
const STOOD: f64 = 0.3;

/// No dt' abs(dt' - dt)/2 of two usable lists is greater (SEEN-01, SEEN-16), s^2.
const LONGEST_BEND: f64 = 0.4;

/// A usable list, by squares, and its place in the history.
type Shown<'c> = (usize, UsableList<'c>, Squares<'c>);

/// An item of a usable list that a detection may have come from.
pub(crate) struct Origin {
    /// Where the detection is.
    pub(crate) now: [f64; 2],
    /// Where the item is.
    pub(crate) before: [f64; 2],
    /// The place of its list in the history.
    pub(crate) list: usize,
    /// The age of that, s.
    pub(crate) age: f64,
}

/// The list of a track.
#[derive(Clone, Copy)]
pub(crate) struct Past<'c> {
    /// Its place in the history.
    pub(crate) list: usize,
    pub(crate) usable: UsableList<'c>,
    /// How far from the past an item may be, m.
    reach: f64,
    /// From the stamp of the tracks to that of the list, s.
    since: f64,
}

impl Past<'_> {
    /// From the position of a track to its past (SEEN-05), m.
    fn moved(&self, track: &Track) -> [f64; 2] {
        [track.vx * self.since, track.vy * self.since]
    }

    /// A box that holds what is as near to the past as an item may be.
    pub(crate) fn around(&self, track: &Track) -> [[f64; 2]; 2] {
        let [dx, dy] = self.moved(track);
        let around = |at: f64| [at - self.reach - MARGIN, at + self.reach + MARGIN];
        [around(track.x + dx), around(track.y + dy)]
    }

    /// Whether an item is as near to the past as one may be (H-14.18).
    pub(crate) fn has(&self, track: &Track, item: [f64; 2]) -> bool {
        let [dx, dy] = self.moved(track);
        let (x, y) = ((track.x - item[0]) + dx, (track.y - item[1]) + dy);
        x * x + y * y <= self.reach * self.reach
    }
}

/// All that is asked of the usable lists.
pub(crate) struct Lists<'m, 'c, 'a> {
    cycle: &'m Cycle<'a>,
    history: &'m DetectionHistory<'c, 'a>,
    /// The lists in which the past of a confirmed track is looked for, the first one first.
    pasts: [Option<Past<'c>>; 4],
    /// By squares, once they are needed.
    squares: [Option<Squares<'c>>; 4],
    /// What was done with them, and with what they show.
    pub(crate) work: Work,
}

impl<'m, 'c, 'a> Lists<'m, 'c, 'a> {
    pub(crate) fn new(
        cycle: &'m Cycle<'a>,
        history: &'m DetectionHistory<'c, 'a>,
        tracks: Option<&TrackList<'_>>,
    ) -> Self {
        let mut pasts = [None; 4];
        if let Some((tracks, detections)) = tracks.zip(history.detections) {
            let since_ns = elapsed_ns(tracks.stamp_ns, detections.stamp_ns);
            for (past, list) in pasts.iter_mut().zip(history.by_reference_age()) {
                *past = history.usable.get(list).copied().flatten().map(|usable| {
                    let reach = usable.reach(cycle) + CLOSE;
                    let since = seconds(since_ns.saturating_sub(usable.age_ns));
                    Past { list, usable, reach, since }
                });
            }
        }
        Self { cycle, history, pasts, squares: [None; 4], work: Work::new(&cycle.parameters) }
    }

    pub(crate) const fn v_object(&self) -> f64 {
        self.cycle.parameters.v_object
    }

    pub(crate) fn usable(&self, list: usize) -> Option<UsableList<'c>> {
        self.history.usable.get(list).copied().flatten()
    }

    /// The list by squares. All usable ones are listed at the first call.
    pub(crate) fn by_squares(
        &mut self,
        list: usize,
        columns: &mut [Column],
    ) -> Option<Squares<'c>> {
        if self.squares.iter().all(Option::is_none) {
            // Of a few squares for what comes from anywhere, at most four for what supports it, and of a
            // few things in a square.
            let parameters = &self.cycle.parameters;
            let within = larger(parameters.theta_track_max, STOOD);
            let support = 4.0 * within + 2.0 * LONGEST_BEND * a_tyre(parameters);
            let side = larger(support, 0.25 * parameters.v_object);
            let usable = self.history.usable.iter().zip(0..);
            for (squares, (list, number)) in self.squares.iter_mut().zip(usable) {
                *squares =
                    list.map(|list| Squares::of((list.items, list.index), side, number, columns));
            }
        }
        self.squares.get(list).copied().flatten()
    }

    /// The list of the confirmed track with this row (SEEN-12).
    pub(crate) fn past_of(&self, row: &Row) -> Option<Past<'c>> {
        let origins = row.origins();
        let is_held = |past: &&Past<'_>| origins & [1, 2, 4, 8].get(past.list).unwrap_or(&0) != 0;
        self.pasts.iter().flatten().find(is_held).copied()
    }

    /// At most so far from an item of the reference list a detection may stand, m.
    pub(crate) fn may_stand_within(&self) -> f64 {
        self.cycle.parameters.theta_track_max + CLOSE
    }

    /// Whether a detection may come from an item (SEEN-15), or, when it is explained, was seen to (SEEN-17),
    /// except for the distance. All lists are listed.
    pub(crate) fn may_come(&self, origin: &Origin, is_explained: bool, columns: &[Column]) -> bool {
        if self.work.is_too_much() {
            // The stage fails anyhow.
            return true;
        }
        self.work.add(SUPPORT);
        let shown = STOOD + CLOSE;
        let within = if is_explained { shown } else { larger(self.may_stand_within(), shown) };
        // No vehicle was farther from an even motion (SEEN-16, SEEN-17): A-09
        let a_tyre = a_tyre(&self.cycle.parameters);
        let shows = |list: Shown<'_>| {
            let bend = 0.5 * list.1.age * (list.1.age - origin.age).abs();
            self.had_it(list, origin, within + a_tyre * bend, columns)
        };
        let mut others = self.others(origin);
        if is_explained {
            return others.all(shows);
        }
        let mut others = others.peekable();
        others.peek().is_none() || others.any(shows)
    }

    /// Whether an item is taken (H-14.63). `has_stood`: what is known of that. All lists are listed.
    pub(crate) fn is_taken(
        &self,
        origin: &Origin,
        has_stood: &mut Option<bool>,
        columns: &[Column],
    ) -> bool {
        let (&Origin { now, before, .. }, reach) = (origin, STOOD + CLOSE);
        let [x, y] = [now[0] - before[0], now[1] - before[1]];
        // SEEN-19
        let moved_evenly =
            || self.others(origin).all(|list| self.had_it(list, origin, reach, columns));
        x * x + y * y <= reach * reach
            || !*has_stood.get_or_insert_with(|| self.has_stood(now, columns))
            || moved_evenly()
    }

    /// SEEN-18
    fn has_stood(&self, now: [f64; 2], columns: &[Column]) -> bool {
        let is_there = |list| self.has_item(list, now, [0.0; 2], STOOD - CLOSE, columns);
        self.shown().count() >= 2 && self.shown().all(is_there)
    }

    /// The usable lists with their places in the history, by squares.
    fn shown(&self) -> impl Iterator<Item = Shown<'c>> {
        let lists = self.squares.iter().zip(self.history.usable).enumerate();
        lists.filter_map(|(place, (squares, list))| Some((place, list?, (*squares)?)))
    }

    /// The lists other than that of the item.
    fn others(&self, origin: &Origin) -> impl Iterator<Item = Shown<'c>> {
        let own = origin.list;
        self.shown().filter(move |(place, ..)| *place != own)
    }

    /// Whether a list has an item so near to where the detection was then, if it comes from there.
    fn had_it(&self, list: Shown<'_>, origin: &Origin, reach: f64, columns: &[Column]) -> bool {
        let &Origin { now, before, age, .. } = origin;
        let share = list.1.age / age;
        let moved = [(before[0] - now[0]) * share, (before[1] - now[1]) * share];
        self.has_item(list, now, moved, reach, columns)
    }

    /// Whether a list has an item so near to a point, moved by that much.
    fn has_item(
        &self,
        (_, list, squares): Shown<'_>,
        [x, y]: [f64; 2],
        [dx, dy]: [f64; 2],
        reach: f64,
        columns: &[Column],
    ) -> bool {
        self.work.add(u64::try_from(list.items.len()).unwrap_or(u64::MAX));
        let around = |at: f64| [at - reach - MARGIN, at + reach + MARGIN];
        let mut has = false;
        squares.for_each_in(columns, [around(x + dx), around(y + dy)], |_, [item_x, item_y]| {
            let (x, y) = ((x - item_x) + dx, (y - item_y) + dy);
            has |= x * x + y * y <= reach * reach;
        });
        has
    }
}
