//! Which current detections confirmed tracks explain.

use crate::hardened::detection_history::DetectionHistory;
use crate::input::cycle::TrackList;
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
