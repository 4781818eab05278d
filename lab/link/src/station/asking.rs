//! What the station asks before it sends (`spec/5-interfaces.md#precheck`).

use mufasa::input::cycle::{
    Cycle, Detection, DetectionList, Ego, Track, TrackList, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::provider::Precheck;
use mufasa::services::configuration::Configuration;
use mufasa_props::bridge;

use crate::play::{Played, SENSED_BEFORE_NS, driven_on};

/// The stages, for a vehicle on a drive that is not attacked: what an attacker changed is sent as it is.
#[derive(Debug)]
pub(super) struct Asking<'a> {
    pub(super) clean: &'a Played,
    parameters: Parameters,
    rows: Vec<Row>,
    columns: Vec<Column>,
}

/// What a vehicle said of a moment, and in which configuration it will use what it gets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told<'c> {
    /// That of the drive.
    pub(super) cycle: &'c mufasa_model::input::cycle::Cycle,
    pub(super) configuration: Configuration,
    pub(super) ego: Ego,
    pub(super) stamp_ns: i64,
    pub(super) detections: &'c [Detection],
}

impl<'a> Asking<'a> {
    pub(super) fn new(clean: &'a Played, parameters: Parameters) -> Self {
        Self {
            clean,
            parameters,
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
        }
    }

    /// Those of the tracks that are to be sent; none: no list is.
    pub(super) fn tracks(
        &mut self,
        told: &Told<'_>,
        (stamp_ns, mut tracks): (i64, Vec<Track>),
    ) -> Option<(i64, Vec<Track>)> {
        let kept = self.ask(told, None, |precheck, cycle| {
            let kept = precheck.tracks(cycle, stamp_ns, &mut tracks, |_, _| {});
            kept.ok().flatten().map(|kept| kept.tracks.items.len())
        });
        tracks.truncate(kept?);
        Some((stamp_ns, tracks))
    }

    /// The trajectory, if it passes beside these tracks.
    pub(super) fn trajectory(
        &mut self,
        told: &Told<'_>,
        tracks: Option<&(i64, Vec<Track>)>,
        (stamp_ns, points): (i64, Vec<TrajectoryPoint>),
    ) -> Option<(i64, Vec<TrajectoryPoint>)> {
        let tracks = tracks.map(|(stamp_ns, items)| TrackList { stamp_ns: *stamp_ns, items });
        let first = self.ask(told, tracks, |precheck, cycle| {
            precheck.first(cycle, stamp_ns, [points], |_, _| {}).ok().flatten()
        });
        first.map(|(_, points)| (stamp_ns, points))
    }

    /// Asks about the cycle that the vehicle will decide.
    fn ask<T>(
        &mut self,
        told: &Told<'_>,
        tracks: Option<TrackList<'_>>,
        question: impl FnOnce(&mut Precheck<'_>, &Cycle<'_>) -> Option<T>,
    ) -> Option<T> {
        let Told { cycle, configuration, ego, stamp_ns, detections } = *told;
        let later_ns = SENSED_BEFORE_NS.saturating_add(self.clean.decided_late_ns());
        let owned = bridge::to_impl(cycle);
        let cycle = Cycle {
            parameters: self.parameters,
            now_ns: stamp_ns.saturating_add(later_ns),
            configuration,
            ego: driven_on(ego, later_ns),
            tracks,
            detections: Some(DetectionList { stamp_ns, items: detections }),
            trajectory: None,
            lead: None,
            grid: None,
            ..owned.borrow(&[])
        };
        question(&mut Precheck::new(&mut self.rows, &mut self.columns), &cycle)
    }
}
