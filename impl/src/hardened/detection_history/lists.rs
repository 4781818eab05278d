//! The usable lists, as H-14 looks into them.

use crate::cycle::steps::SUPPORT;
use crate::hardened::detection_history::squares::{CLOSE, MARGIN, Squares};
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::hardened::h14_fail_safe::work::Work;
use crate::input::cycle::{Cycle, Detection, Track, TrackList};
use crate::input::scratch::{Column, Row};
use crate::numbers::range::larger;
use crate::numbers::time::{elapsed_ns, seconds};

/// So near to where it is an object was that stood, m.
const STOOD: f64 = 0.3;

/// The list of a track.
#[derive(Clone, Copy)]
pub(crate) struct Past<'c> {
    /// Its place in the history.
    pub(crate) list: usize,
    pub(crate) usable: UsableList<'c>,
    /// How far from the past an item may be, m.
    pub(crate) reach: f64,
    /// From the stamp of the tracks to that of the list, s.
    since: f64,
}

impl Past<'_> {
    /// From the position of a track to its past (SEEN-05), m.
    pub(crate) fn moved(&self, track: &Track) -> (f64, f64) {
        (track.vx * self.since, track.vy * self.since)
    }

    /// A box that holds what is as near to the past as an item may be.
    pub(crate) fn around(&self, track: &Track) -> [[f64; 2]; 2] {
        let (dx, dy) = self.moved(track);
        let around = |at: f64| [at - self.reach - MARGIN, at + self.reach + MARGIN];
        [around(track.x + dx), around(track.y + dy)]
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
            // Of a few squares for what comes from anywhere, and of a few things in a square.
            let parameters = &self.cycle.parameters;
            let side = larger(4.0 * parameters.theta_track_max, 0.25 * parameters.v_object);
            let usable = self.history.usable.iter().zip(0..);
            for (squares, (list, number)) in self.squares.iter_mut().zip(usable) {
                *squares =
                    list.map(|list| Squares::of((list.items, list.index), side, number, columns));
            }
        }
        self.listed(list)
    }

    /// The same after that call.
    pub(crate) fn listed(&self, list: usize) -> Option<Squares<'c>> {
        self.squares.get(list).copied().flatten()
    }

    /// The list of the confirmed track with this row (SEEN-12).
    pub(crate) fn past_of(&self, row: &Row) -> Option<Past<'c>> {
        let origins = row.origins();
        let is_held = |past: &&Past<'_>| origins & [1, 2, 4, 8].get(past.list).unwrap_or(&0) != 0;
        self.pasts.iter().flatten().find(is_held).copied()
    }

    /// At most so far from an item of the reference list a detection may have stood, m.
    pub(crate) fn stands_within(&self) -> f64 {
        self.cycle.parameters.theta_track_max + CLOSE
    }

    /// Whether a detection stood (SEEN-18, kept in `stood`), and neither near an item nor evenly from there (H-14.63). All
    /// lists are listed.
    pub(crate) fn is_elsewhere(
        &self,
        now: &Detection,
        before: [f64; 2],
        (place, own): (usize, &UsableList<'_>),
        stood: &mut Option<bool>,
        columns: &[Column],
    ) -> bool {
        let (x, y, far) = (now.x - before[0], now.y - before[1], STOOD + CLOSE);
        if x * x + y * y <= far * far {
            return false;
        }
        let mut others = self.shown().map(|(_, list, squares)| (list, squares));
        let is_there = |(list, squares)| {
            self.has_item([now.x, now.y], [0.0; 2], STOOD - CLOSE, (list, squares), columns)
        };
        if !*stood.get_or_insert_with(|| others.clone().count() >= 2 && others.all(is_there)) {
            return false;
        }
        // SEEN-19
        !self.shown().all(|(list, other, squares)| {
            let share = other.age / own.age;
            let moved = [(before[0] - now.x) * share, (before[1] - now.y) * share];
            list == place || self.has_item([now.x, now.y], moved, far, (other, squares), columns)
        })
    }

    /// The usable lists with their places in the history, by squares.
    fn shown(&self) -> impl Iterator<Item = (usize, UsableList<'c>, Squares<'c>)> + Clone {
        let lists = self.squares.iter().zip(self.history.usable).enumerate();
        lists.filter_map(|(place, (squares, list))| Some((place, list?, (*squares)?)))
    }

    /// Whether a list has an item so near to where a detection is, moved by that much.
    fn has_item(
        &self,
        [x, y]: [f64; 2],
        [dx, dy]: [f64; 2],
        reach: f64,
        (list, squares): (UsableList<'_>, Squares<'_>),
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

    /// Whether a detection may come from an item of a list, except for the distance: whether an item of
    /// another list is where the object was then (SEEN-16), when there are other lists (SEEN-15).
    /// All are listed.
    pub(crate) fn is_supported(
        &self,
        now: &Detection,
        before: [f64; 2],
        (place, own): (usize, &UsableList<'_>),
        columns: &[Column],
    ) -> bool {
        let reach = self.stands_within();
        let [before_x, before_y] = before;
        if self.work.is_too_much() {
            // The stage fails anyhow.
            return true;
        }
        self.work.add(SUPPORT);
        let mut alone = true;
        for (_, other, squares) in self.shown().filter(|(list, ..)| *list != place) {
            alone = false;
            let share = other.age / own.age;
            let moved = [(before_x - now.x) * share, (before_y - now.y) * share];
            if self.has_item([now.x, now.y], moved, reach, (other, squares), columns) {
                return true;
            }
        }
        alone
    }
}
