//! Who asks the stages before something is sent, or handed over: the station, and the CAV's own planner.

use mufasa::input::cycle::{
    Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::provider::Precheck;
use mufasa::services::configuration::Configuration;

use super::assembled::Fixed;
use super::seen::Seen;
use super::sensing::Sensed;
use super::withheld::Withheld;

/// The stages with what they need from cycle to cycle.
#[derive(Debug)]
pub struct Asking {
    fixed: Fixed,
    seen: Seen,
    rows: Vec<Row>,
    columns: Vec<Column>,
}

/// What is known of a cycle before it is decided.
#[derive(Clone, Copy, Debug)]
pub struct Known<'c> {
    /// In which the results will be used.
    pub configuration: Configuration,
    /// When it is decided, ns.
    pub now_ns: i64,
    /// The CAV.
    pub ego: Ego,
    /// What the CAV detected.
    pub detections: DetectionList<'c>,
    /// Its leading vehicle; none: not known.
    pub lead: Option<Lead>,
    /// Its grid; none: not known.
    pub grid: Option<Grid<'c>>,
}

impl<'c> Known<'c> {
    /// All that the CAV measured.
    pub fn of(configuration: Configuration, (now_ns, ego): (i64, Ego), sensed: &'c Sensed) -> Self {
        let Sensed { stamp_ns, ref detections, lead, ref grid, .. } = *sensed;
        Self {
            configuration,
            now_ns,
            ego,
            detections: DetectionList { stamp_ns, items: detections },
            lead: lead.map(|lead| Lead { stamp_ns, gap: lead.gap, speed: lead.speed }),
            grid: Some(grid.borrow(true)),
        }
    }
}

impl Asking {
    /// Nothing seen yet. `route`: the CAV's, whole.
    pub fn new(profile: Profile, parameters: Parameters, route: &Route<'_>) -> Self {
        let route = (route.closed, route.cross_sections.to_vec());
        Self {
            fixed: Fixed { profile, parameters, route, withheld: None },
            seen: Seen::default(),
            rows: vec![Row::default(); Sizes::MAX.rows],
            columns: vec![Column::default(); Sizes::MAX.columns],
        }
    }

    /// The same; the cycles are without what the stages do not get.
    pub fn withholding(mut self, withheld: Option<Withheld>) -> Self {
        self.fixed.withheld = withheld;
        self
    }

    /// Keeps what the CAV detected, for later cycles.
    pub fn see(&mut self, stamp_ns: i64, detections: &[Detection]) {
        self.seen.see(stamp_ns, detections);
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
        let Fixed { profile, parameters, route: (closed, ref cross_sections), withheld } =
            self.fixed;
        let Known { configuration, now_ns, ego, detections, lead, grid } = *known;
        let history =
            if profile.looks_back() { self.seen.history(detections.stamp_ns) } else { Vec::new() };
        let cycle = Cycle {
            profile,
            parameters,
            now_ns,
            configuration,
            ego,
            trajectory: None,
            tracks,
            detections: Some(detections),
            lead,
            route: Route { closed, cross_sections },
            grid,
            detection_history: &history,
        };
        let cycle = withheld.map_or(cycle, |it| it.taken_from(cycle));
        question(&mut Precheck::new(&mut self.rows, &mut self.columns), &cycle)
    }
}
