//! Which explained detections are disputed.
//!
//! In plain doubles, with `CLOSE` on the side that disputes more. The own origin is found again: what
//! is as near to the past as the nearest item, but for `CLOSE`, is at the same place, or stage i has
//! failed (`ambiguous`).
//!
//! What it costs counts as pairs (H-14.51): each confirmed track is asked about once at most, and compares its own
//! origin, which no other track has, with each unexplained detection near it (H-14.57), and of each of these one
//! place in every other list with the items there.

use crate::hardened::detection_history::explained::Explained;
use crate::hardened::detection_history::lists::{Lists, Origin, Past};
use crate::hardened::detection_history::squares::{CLOSE, MARGIN};
use crate::input::cycle::{Detection, Track, TrackList};
use crate::input::detection_index::DetectionIndex;
use crate::input::scratch::{Column, Scratch};

/// What is asked of the current detections, and what is known.
pub(crate) struct Disputes<'m, 'c, 'a> {
    detections: &'c [Detection],
    index: Option<&'c DetectionIndex<'a>>,
    tracks: Option<&'c TrackList<'a>>,
    explained: &'m Explained,
    /// Whether the detection of one track is disputed, the last one asked for.
    last: Option<(usize, bool)>,
}

impl<'m, 'c, 'a> Disputes<'m, 'c, 'a> {
    pub(crate) const fn new(
        detections: &'c [Detection],
        index: Option<&'c DetectionIndex<'a>>,
        tracks: Option<&'c TrackList<'a>>,
        explained: &'m Explained,
    ) -> Self {
        Self { detections, index, tracks, explained, last: None }
    }

    /// Whether the detection of a confirmed track is disputed (SEEN-17). The lists are listed by
    /// squares.
    pub(crate) fn is_disputed(
        &mut self,
        track: usize,
        lists: &Lists<'_, '_, '_>,
        scratch: &Scratch<'_>,
    ) -> bool {
        if let Some((_, known)) = self.last.filter(|&(last, _)| last == track) {
            return known;
        }
        let known = self
            .own_origin(track, lists, scratch)
            .is_some_and(|(past, origin)| self.any_may_come_from(origin, &past, lists, scratch));
        self.last = Some((track, known));
        known
    }

    /// The list of a confirmed track, and where its own origin in it is.
    fn own_origin<'l>(
        &self,
        track: usize,
        lists: &Lists<'_, 'l, '_>,
        scratch: &Scratch<'_>,
    ) -> Option<(Past<'l>, [f64; 2])> {
        let (track, row) = self.tracks?.items.get(track).zip(scratch.rows.get(track))?;
        let past = lists.past_of(row)?;
        let origin = nearest_to_past(track, &past, lists, scratch.columns)?;
        Some((past, origin))
    }

    /// Whether any unexplained detection may come from there.
    fn any_may_come_from(
        &self,
        before: [f64; 2],
        past: &Past<'_>,
        lists: &Lists<'_, '_, '_>,
        scratch: &Scratch<'_>,
    ) -> bool {
        let items = self.detections;
        let (list, age) = (past.list, past.usable.age);
        let farthest = lists.v_object() * age + CLOSE;
        let comes = |detection: usize, now: &Detection| {
            let (x, y) = (now.x - before[0], now.y - before[1]);
            let origin = Origin { now: [now.x, now.y], before, list, age };
            x * x + y * y <= farthest * farthest
                && self.explained.by(detection, scratch.rows, scratch.columns).is_none()
                && lists.is_supported(&origin, scratch.columns)
        };
        let Some(index) = self.index else {
            return items.iter().enumerate().any(|(detection, now)| comes(detection, now));
        };
        let mut any = false;
        let around = |at: f64| [at - farthest - MARGIN, at + farthest + MARGIN];
        index.for_each_in(before.map(around), |detection, _| {
            any = any || items.get(detection).is_some_and(|now| comes(detection, now));
        });
        any
    }
}

fn nearest_to_past(
    track: &Track,
    past: &Past<'_>,
    lists: &Lists<'_, '_, '_>,
    columns: &[Column],
) -> Option<[f64; 2]> {
    let (dx, dy) = past.moved(track);
    let around = |at: f64| [at - past.reach - MARGIN, at + past.reach + MARGIN];
    let near = [around(track.x + dx), around(track.y + dy)];
    let (mut nearest, mut origin) = (f64::INFINITY, None);
    lists.listed(past.list)?.for_each_in(columns, near, |_, at| {
        let (x, y) = ((track.x - at[0]) + dx, (track.y - at[1]) + dy);
        let squared = x * x + y * y;
        if squared < nearest {
            (nearest, origin) = (squared, Some(at));
        }
    });
    origin
}
