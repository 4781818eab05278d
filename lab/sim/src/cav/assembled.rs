//! The cycle that the stages are asked about, put together from what is there: before something is sent, or when it is
//! decided, for the monitor lets nobody look at its own.

use std::collections::VecDeque;
use std::ops::RangeInclusive;

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, TrackList, Trajectory,
};
use mufasa::input::profile::Profile;
use mufasa::services::configuration::Configuration;

use super::sensing::Sensed;
use crate::settings::Settings;

/// Ages of earlier detections that are looked for, of those that can be used at all, and between two lists
/// that are kept, ns (`spec/hardened/what-the-cav-saw.md`).
const WANTED_NS: [i64; 3] = [300_000_000, 500_000_000, 800_000_000];
const USABLE_NS: RangeInclusive<i64> = 200_000_000..=1_000_000_000;
const SPACING_NS: i64 = 83_333_334;

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

/// Results of services, as far as there are any.
#[derive(Clone, Copy, Debug, Default)]
pub struct Results<'c> {
    /// Those of MOT.
    pub tracks: Option<TrackList<'c>>,
    /// Those of PLAN.
    pub trajectory: Option<Trajectory<'c>>,
}

/// What cycles of a run are put together with: what does not change, and what the CAV saw before.
#[derive(Clone, Debug)]
pub(super) struct Cycles<'s> {
    profile: Profile,
    settings: &'s Settings,
    cross_sections: Vec<CrossSection>,
    /// Lists with their stamps, the oldest first.
    seen: VecDeque<(i64, Vec<Detection>)>,
}

impl<'s> Cycles<'s> {
    /// Nothing seen yet; none where nothing is checked. `cross_sections`: of the whole route.
    pub(super) fn new(settings: &'s Settings, cross_sections: &[CrossSection]) -> Option<Self> {
        let (cross_sections, seen) = (cross_sections.to_vec(), VecDeque::new());
        settings.profile.map(|profile| Self { profile, settings, cross_sections, seen })
    }

    /// Keeps what the CAV detected at a time, if it has come, ns.
    pub(super) fn see(&mut self, now_ns: i64, detections: &[Detection]) {
        let youngest = self.seen.back().map(|(stamp_ns, _)| *stamp_ns);
        if youngest.is_some_and(|it| now_ns - it < SPACING_NS) {
            return;
        }
        self.seen.push_back((now_ns, detections.to_vec()));
        while self.seen.front().is_some_and(|it| now_ns - it.0 > *USABLE_NS.end()) {
            self.seen.pop_front();
        }
    }

    /// The lists whose ages are nearest to those wanted, the youngest first.
    fn history(&self, stamp_ns: i64) -> Vec<DetectionList<'_>> {
        let usable = || self.seen.iter().rev().filter(|it| USABLE_NS.contains(&(stamp_ns - it.0)));
        let mut lists: Vec<DetectionList<'_>> = Vec::new();
        for wanted in WANTED_NS.iter().filter(|_| self.profile.looks_back()) {
            // Of two that are as near the younger: the first.
            let nearest = usable().min_by_key(|it| (stamp_ns - it.0 - wanted).abs());
            if let Some((stamp_ns, items)) = nearest
                && lists.iter().all(|list| list.stamp_ns != *stamp_ns)
            {
                lists.push(DetectionList { stamp_ns: *stamp_ns, items });
            }
        }
        lists
    }

    /// What somebody makes of a cycle with these results.
    pub(super) fn with<T>(
        &self,
        known: &Known<'_>,
        Results { tracks, trajectory }: Results<'_>,
        of: impl FnOnce(&Cycle<'_>) -> T,
    ) -> T {
        let Known { configuration, now_ns, ego, detections, lead, grid } = *known;
        let history = self.history(detections.stamp_ns);
        let cycle = Cycle {
            profile: self.profile,
            parameters: self.settings.stages,
            now_ns,
            configuration,
            ego,
            trajectory,
            tracks,
            detections: Some(detections),
            lead,
            route: Route { closed: false, cross_sections: &self.cross_sections },
            grid,
            detection_history: &history,
        };
        of(&self.settings.withheld.map_or(cycle, |it| it.taken_from(cycle)))
    }
}
