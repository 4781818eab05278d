//! Who asks the stages before something is sent, or handed over: the station, and the CAV's own planner.

use mufasa::input::cycle::{CrossSection, Cycle, Detection, Track, TrackList, TrajectoryPoint};
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::provider::Precheck;

pub use super::assembled::Known;
use super::assembled::{Cycles, Results};
use crate::settings::Settings;

/// The stages with what they need from cycle to cycle.
#[derive(Debug)]
pub struct Asking<'s> {
    cycles: Cycles<'s>,
    rows: Vec<Row>,
    columns: Vec<Column>,
}

impl<'s> Asking<'s> {
    /// Nothing seen yet; none where nobody asks. `cross_sections`: of the CAV's whole route.
    pub fn new(settings: &'s Settings, cross_sections: &[CrossSection]) -> Option<Self> {
        let cycles = Cycles::new(settings, cross_sections).filter(|_| settings.prechecks)?;
        let rows = vec![Row::default(); Sizes::MAX.rows];
        Some(Self { cycles, rows, columns: vec![Column::default(); Sizes::MAX.columns] })
    }

    /// Keeps what the CAV detected, for later cycles.
    pub fn see(&mut self, stamp_ns: i64, detections: &[Detection]) {
        self.cycles.see(stamp_ns, detections);
    }

    /// Those of the tracks of this stamp that are to be sent; none: not even an empty list, nor with invalid input.
    pub fn tracks(
        &mut self,
        known: &Known<'_>,
        (stamp_ns, mut tracks): (i64, Vec<Track>),
    ) -> Option<Vec<Track>> {
        let kept = self.ask(known, None, |precheck, cycle| {
            let kept = precheck.tracks(cycle, stamp_ns, &mut tracks, |_, _| {});
            kept.ok().flatten().map(|kept| kept.tracks.items.len())
        });
        tracks.truncate(kept?);
        Some(tracks)
    }

    /// The first of the candidates that passes, made at this time.
    pub fn first<P: AsRef<[TrajectoryPoint]>>(
        &mut self,
        known: &Known<'_>,
        tracks: Option<TrackList<'_>>,
        stamp_ns: i64,
        candidates: impl IntoIterator<Item = P>,
    ) -> Option<P> {
        self.ask(known, tracks, |precheck, cycle| {
            let first = precheck.first(cycle, stamp_ns, candidates, |_, _| {});
            first.ok().flatten().map(|(_, points)| points)
        })
    }

    fn ask<T>(
        &mut self,
        known: &Known<'_>,
        tracks: Option<TrackList<'_>>,
        question: impl FnOnce(&mut Precheck<'_>, &Cycle<'_>) -> T,
    ) -> T {
        let Self { cycles, rows, columns } = self;
        let results = Results { tracks, trajectory: None };
        cycles.with(known, results, |cycle| question(&mut Precheck::new(rows, columns), cycle))
    }
}
