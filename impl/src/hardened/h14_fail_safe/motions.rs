//! The motions that are examined: of tracks, and of detections as the CAV saw them move
//! (`spec/hardened/H-14.md#requirements-motions`).
//!
//! What is decided here in plain doubles, with `CLOSE` on the side that examines more, is which pairs of
//! a detection and an earlier item are examined; whether they meet the CAV, `meeting` decides.

use crate::cycle::steps::{MOTION, PAIR};
use crate::hardened::detection_history::DetectionHistory;
use crate::hardened::detection_history::explained::Explained;
use crate::hardened::detection_history::lists::{Lists, Origin, Past};
use crate::hardened::detection_history::squares::{CLOSE, MARGIN};
use crate::hardened::h14_fail_safe::meeting::{Meeting, Met};
use crate::hardened::h14_fail_safe::motion::Motion;
use crate::input::cycle::{Detection, DetectionList, Track, TrackList};
use crate::input::scratch::{Row, Scratch};
use crate::numbers::range::{is_empty, larger};
use crate::report::{Rule, Witness};
use crate::stages::llcc::sweep::MovingRectangle;

/// Where to look for motions.
pub(super) struct Motions<'m, 'c, 'a> {
    pub(super) meeting: Meeting<'m, 'a>,
    pub(super) history: &'m DetectionHistory<'c, 'a>,
    pub(super) lists: Lists<'m, 'c, 'a>,
    pub(super) explained: &'m Explained,
    pub(super) first: Option<Found>,
}

/// One that meets the CAV; the first has the least number of its place (H-14.48), then kind of
/// motion, order in its list, and item.
#[derive(Clone, Copy)]
pub(super) struct Found {
    number: i64,
    order: [usize; 3],
    pub(super) witness: Witness,
}

/// The kinds of motions in their order (H-14.22).
const TRACK: usize = 0;
const CONFIRMED: usize = 1;
const ANYWHERE: usize = 2;
const STANDING: usize = 3;

/// A pair of a detection and an item of a list.
#[derive(Clone, Copy)]
struct Pair {
    /// Kind and order.
    order: [usize; 2],
    detection: usize,
    item: usize,
    dt_ns: i64,
}

impl Motions<'_, '_, '_> {
    /// Each track with its own velocity (H-14.17).
    pub(super) fn tracks(&mut self, list: &TrackList<'_>, age_ns: i64) {
        for (index, track) in list.items.iter().enumerate() {
            let motion = Motion::new(MovingRectangle::track(track), age_ns);
            let witness = |it: Witness| Witness { track: Some(track.id), ..it };
            self.keep(&motion, [TRACK, index, 0], witness, |_| true);
        }
    }

    pub(super) fn detections(
        &mut self,
        list: &DetectionList<'_>,
        age_ns: i64,
        tracks: Option<&TrackList<'_>>,
        scratch: &mut Scratch<'_>,
    ) {
        if let Some(tracks) = tracks.filter(|_| self.explained.count > 0) {
            for (order, track) in tracks.items.iter().enumerate() {
                let item = scratch.rows.get(order).and_then(Row::confirmed_by);
                let Some(detection) = item.map(usize::from) else { continue };
                let Some(now) = list.items.get(detection) else { continue };
                let motion = Motion::new(MovingRectangle::detection(now), age_ns);
                self.confirmed((order, track), (detection, now), &motion, scratch);
            }
        }
        for (detection, now) in list.items.iter().enumerate() {
            let motion = Motion::new(MovingRectangle::detection(now), age_ns);
            let by = self.explained.by(detection, scratch.rows, scratch.columns);
            let by = by.and_then(|by| Some((tracks?.items.get(by)?, scratch.rows.get(by)?)));
            let by = by.map(|(track, row)| (track, self.lists.past_of(row)));
            self.anywhere((detection, now), &motion, by, scratch);
            // H-14.21; A-03
            if by.is_none() {
                let witness = |it: Witness| Witness { detection: Some(detection), ..it };
                self.keep(&motion, [STANDING, detection, 0], witness, |_| true);
            }
        }
    }

    /// Keeps a motion that meets the CAV before the first one so far. `counts`: asked when boxes leave it
    /// open.
    fn keep(
        &mut self,
        motion: &Motion,
        order: [usize; 3],
        witness: impl FnOnce(Witness) -> Witness,
        counts: impl FnOnce(&mut Self) -> bool,
    ) {
        // H-14.48
        let end = self
            .first
            .map_or(i64::MAX, |first| first.number.saturating_add(i64::from(order < first.order)));
        self.lists.work.add(MOTION);
        let is_over = self.lists.work.is_too_much();
        let object = self.meeting.plainly(motion);
        if is_over
            || self.meeting.is_far(&object)
            || !counts(self)
            || !self.meeting.may_be_met(&object, &self.lists.work)
        {
            return;
        }
        if let Some(Met { number, point, compared }) =
            self.meeting.first((motion, &object), end, &self.lists.work)
        {
            let found = Witness::of(Rule::FailSafe, compared).at_point(point);
            self.first = Some(Found { number, order, witness: witness(found) });
        }
    }

    fn keep_pair(&mut self, motion: &Motion, pair: &Pair, counts: impl FnOnce(&mut Self) -> bool) {
        // H-14.49
        let &Pair { order: [kind, order], detection, item, dt_ns } = pair;
        let witness = |it: Witness| Witness {
            detection: Some(detection),
            item: Some(item),
            age_ns: Some(dt_ns),
            ..it
        };
        self.keep(motion, [kind, order, item], witness, counts);
    }

    /// The detection of a confirmed track, from every item that may have been the track (H-14.18).
    fn confirmed(
        &mut self,
        (order, track): (usize, &Track),
        (detection, now): (usize, &Detection),
        motion: &Motion,
        scratch: &mut Scratch<'_>,
    ) {
        let past = scratch.rows.get(order).and_then(|row| self.lists.past_of(row));
        let Some(past) = past else { return };
        let Past { list, usable, .. } = past;
        let Some(squares) = self.lists.by_squares(list, scratch.columns) else { return };
        let (scratch, age, mut has_stood) = (&*scratch, usable.age, None);
        squares.for_each_in(scratch.columns, past.around(track), |item, before| {
            if self.lists.work.is_too_much() {
                return;
            }
            let motion = motion.coming_from(before, usable.age_ns, 1.0 / age);
            if past.has(track, before) {
                self.lists.work.add(PAIR);
                let order = [CONFIRMED, order];
                let pair = Pair { order, detection, item, dt_ns: usable.age_ns };
                let origin = Origin { now: [now.x, now.y], before, list, age };
                self.keep_pair(&motion, &pair, |it| {
                    it.lists.is_taken(&origin, &mut has_stood, scratch.columns)
                });
            }
        });
    }

    /// A detection from every item of the reference list (H-14.19) where it may have stood, and one that no
    /// track explains from every item that some other list supports, an explained one from every item that
    /// all others do (H-14.20), whatever has the item (SEEN-14). `by`: the track that explains it, and its
    /// past, from which it was taken to come already.
    fn anywhere(
        &mut self,
        (detection, now): (usize, &Detection),
        motion: &Motion,
        by: Option<(&Track, Option<Past<'_>>)>,
        scratch: &mut Scratch<'_>,
    ) {
        let Some(reference) = self.history.reference() else { return };
        let Some(list) = self.lists.usable(reference) else { return };
        let (within, age) = (self.lists.may_stand_within(), list.age);
        // SEEN-15; H-14.57
        let farthest = larger(self.lists.v_object() * age + CLOSE, within);
        let area = self.meeting.comes_from(motion, farthest / age, age + MARGIN);
        if is_empty(area) {
            return;
        }
        let Some(squares) = self.lists.by_squares(reference, scratch.columns) else { return };
        let (scratch, seen, mut has_stood) = (&*scratch, self.meeting.seen_from(motion), None);
        let is_explained = by.is_some();
        let taken =
            by.and_then(|(track, past)| past.filter(|it| it.list == reference).zip(Some(track)));
        squares.for_each_in(scratch.columns, area, |item, before| {
            if self.lists.work.is_too_much() {
                return;
            }
            let (x, y) = (now.x - before[0], now.y - before[1]);
            if seen.is_passed([x, y]) || x * x + y * y > farthest * farthest {
                return;
            }
            if taken.is_some_and(|(past, track)| past.has(track, before)) {
                return;
            }
            // What an index shows besides is no more than each item once.
            self.lists.work.add(PAIR);
            let motion = motion.coming_from(before, list.age_ns, 1.0 / age);
            let order = [ANYWHERE, detection];
            let pair = Pair { order, detection, item, dt_ns: list.age_ns };
            let origin = Origin { now: [now.x, now.y], before, list: reference, age };
            let comes = x * x + y * y <= within * within
                || self.lists.may_come(&origin, is_explained, scratch.columns);
            if comes {
                self.keep_pair(&motion, &pair, |it| {
                    it.lists.is_taken(&origin, &mut has_stood, scratch.columns)
                });
            }
        });
    }
}
