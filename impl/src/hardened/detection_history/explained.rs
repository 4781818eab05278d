//! Which current detections confirmed tracks explain, and how these move.

use crate::hardened::detection_history::lists::Lists;
use crate::hardened::detection_history::{DetectionHistory, UsableList};
use crate::hardened::h14_fail_safe::motion::Motion;
use crate::input::cycle::{Cycle, Track, TrackList};
use crate::input::parameters::Parameters;
use crate::input::scratch::{Column, Row, Scratch};

/// The current detections that confirmed tracks of a current list explain (SEEN-13).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Explained {
    /// How many they are.
    pub(crate) count: usize,
    /// Of these tracks, whose rows say whether they are confirmed.
    tracks: usize,
}

impl Explained {
    /// Without a usable list there is none. `tracks`: the current ones. Columns say which track may explain
    /// a detection; whether it does, its row says.
    pub(crate) fn new(
        history: &DetectionHistory<'_, '_>,
        tracks: Option<&TrackList<'_>>,
        scratch: &mut Scratch<'_>,
    ) -> Self {
        let tracks = match (history.reference(), tracks) {
            (Some(_), Some(list)) => list.items.len(),
            (_, _) => 0,
        };
        let mut found = Self { count: 0, tracks };
        for (row, index) in scratch.rows.iter().take(tracks).zip(0_u16..) {
            let Some(item) = row.confirmed_by() else { continue };
            if let Some(column) = scratch.columns.get_mut(usize::from(item)) {
                // A detection confirms one track at most.
                column.explained_by = index;
                found.count = found.count.saturating_add(1);
            }
        }
        found
    }

    /// The confirmed track that explains a detection.
    #[inline]
    pub(crate) fn by(&self, detection: usize, rows: &[Row], columns: &[Column]) -> Option<usize> {
        let track = usize::from(columns.get(detection)?.explained_by);
        let item = rows.get(track).filter(|_| track < self.tracks)?.confirmed_by()?;
        (usize::from(item) == detection).then_some(track)
    }
}

/// Where the detections that tracks explain came from.
pub(crate) struct Explaining<'m, 'c, 'a> {
    explained: Explained,
    tracks: &'m [Track],
    rows: &'m [Row],
    columns: &'m [Column],
    lists: Lists<'m, 'c, 'a>,
    parameters: &'m Parameters,
}

impl<'m, 'c, 'a> Explaining<'m, 'c, 'a> {
    pub(crate) fn new(
        cycle: &'m Cycle<'a>,
        history: &'m DetectionHistory<'c, 'a>,
        list: &'m TrackList<'_>,
        scratch: &'m mut Scratch<'_>,
    ) -> Self {
        let explained = Explained::new(history, Some(list), scratch);
        let lists = Lists::new(cycle, history, Some(list));
        let (rows, columns, parameters) = (&*scratch.rows, &*scratch.columns, &cycle.parameters);
        Self { explained, tracks: list.items, rows, columns, lists, parameters }
    }

    /// A detection that a track explains, moving as it did since the list of the track (H-06.7).
    pub(crate) fn moving(&self, detection: usize, now: &Motion) -> Option<Motion> {
        let track = self.explained.by(detection, self.rows, self.columns)?;
        let past = self.lists.past_of(self.rows.get(track)?)?;
        let UsableList { age_ns, age, .. } = past.usable;
        let origin = past.origin(self.tracks.get(track)?)?;
        Some(now.coming_from(origin, age_ns, 1.0 / age))
    }

    /// The velocity that the track states which explains a detection, m/s.
    pub(crate) fn stated(&self, detection: usize) -> Option<[f64; 2]> {
        let track = self.explained.by(detection, self.rows, self.columns)?;
        self.tracks.get(track).map(|track| [track.vx, track.vy])
    }

    /// By less than that the velocity of a detection is another one, m/s: it came from an item near the past of a track
    /// near it (SEEN-06, SEEN-09), and no list is younger than 0.2 s.
    pub(crate) const fn misstated(&self) -> f64 {
        let &Parameters { theta_velocity, theta_track_max, .. } = self.parameters;
        theta_velocity + 11.0 * theta_track_max
    }
}
