//! A cycle: the stages of the paper with what the rules of its profile change, and what it reports
//! (`spec/3-stages.md#schedule`, `spec/hardened/README.md`). A rule changes a stage by what it gives
//! to it, or is asked behind it.

pub mod order;
pub mod steps;

use crate::cycle::order::{Turn, decide, schedule};
use crate::cycle::steps::looks_along;
use crate::hardened::detection_history::{DetectionHistory, Seen};
use crate::hardened::h01_matched_pairs::matched_tracks;
use crate::hardened::h04_gap::places::{dilated_at_places, places_of};
use crate::hardened::h04_gap::{s_react, s_since};
use crate::hardened::h06_closed_cells::closed_cells;
use crate::hardened::h07_start::{corridor_failure, direction_failure, start_failure};
use crate::hardened::h11_steps::step_failure;
use crate::hardened::h14_fail_safe::FailSafe;
use crate::hardened::h14_fail_safe::reach::reach_failure;
use crate::hardened::h14_fail_safe::returns::return_failure;
use crate::hardened::h14_fail_safe::road::road_failure;
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::input::cycle::{Cycle, DetectionList, Grid, Lead, TrackList, Trajectory};
use crate::input::domain::{Fault, Usable};
use crate::input::indexes::Indexes;
use crate::input::profile::HardenedRule;
use crate::input::route_index::RouteIndex;
use crate::input::scratch::Scratch;
use crate::report::{FailedStage, Input, InvalidInput, Outcome, Reason, Report, Stage, Witness};
use crate::services::configuration::{Configuration, Group};
use crate::stages::i_track_validation::track_validation;
use crate::stages::ii_trajectory_to_map::indexed_route::IndexedRoute;
use crate::stages::ii_trajectory_to_map::trajectory_to_map;
use crate::stages::iii_tracks::trajectory_with_tracks;
use crate::stages::iv_detections::{gap_failure, trajectory_with_detections};
use crate::stages::order::{Given, Scheduled, is_current};
use crate::stages::v_grid_map::trajectory_with_grid_map;

/// Decides one cycle. `Err` is invalid local input, an error to the caller; invalid remote data
/// make the cycle unsafe (`spec/3-stages.md#invalid-input`).
///
/// Usually each stage is linear in its lists; at most it takes the steps that [`most_steps`](steps::most_steps) counts by their
/// sizes, each of at most 10 instructions of x86-64.
// IMPL-08
pub fn check(cycle: &Cycle<'_>, scratch: &mut Scratch<'_>) -> Result<Report, InvalidInput> {
    check_with(cycle, &Indexes::default(), scratch)
}

/// As `check`, with the index of the cycle's route: the same cross sections in the same memory. An index
/// of another route is not used. The answer is the same. Source:
/// `spec/3-stages.md#stage-ii-trajectory-to-map`.
pub fn check_indexed<'a>(
    cycle: &Cycle<'a>,
    index: &RouteIndex<'a>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    check_with(cycle, &Indexes { route: Some(index), detections: &[] }, scratch)
}

/// As `check`, with what the caller keeps. The answer is the same with one exception: where H-14 reaches `work_limit`
/// and an object meets the CAV, the order of an index decides which of the two is told. Source:
/// `spec/4-arithmetic.md#conformance-of-an-implementation`.
pub fn check_with<'a>(
    cycle: &Cycle<'a>,
    indexes: &Indexes<'_, 'a>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    check_unless(None, cycle, indexes, scratch)
}

/// The same, unless the cycle may be late: then this is the error of a cycle whose input is valid. Source:
/// `spec/4-arithmetic.md#conformance-of-an-implementation`.
pub(crate) fn check_unless<'a>(
    late: Option<InvalidInput>,
    cycle: &Cycle<'a>,
    indexes: &Indexes<'_, 'a>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    let indexes = of_this_route(cycle, indexes);
    match indexes.validate(cycle) {
        // INPUT-05
        Err(Fault::Local(problem)) => Err(problem),
        // INPUT-06
        Err(Fault::Remote(problem)) => {
            let schedule = schedule(cycle.profile, cycle.configuration);
            let stages = schedule.stages.map(|scheduled| match scheduled {
                Scheduled::Never => Outcome::NotScheduled,
                Scheduled::Always | Scheduled::Conditional => {
                    Outcome::Skipped(Reason::AfterFailure)
                }
            });
            Ok(Report { failed_stage: Some(FailedStage::Input), stages, input: Some(problem) })
        }
        // INPUT-07
        Ok(usable) => {
            // IMPL-13
            late.map_or(Ok(()), Err)?;
            // IMPL-09
            scratch.fits(cycle)?;
            Ok(run(&ValidCycle::of(cycle, usable, indexes), scratch))
        }
    }
}

/// Without an index of another route.
fn of_this_route<'i, 'a>(cycle: &Cycle<'a>, indexes: &Indexes<'i, 'a>) -> Indexes<'i, 'a> {
    Indexes { route: indexes.route.filter(|index| index.is_of(&cycle.route)), ..*indexes }
}

/// A cycle whose input is valid, for running one stage alone: to test it, or to time it. Source:
/// `spec/3-stages.md`.
#[derive(Debug)]
pub struct ValidCycle<'c, 'a> {
    cycle: &'c Cycle<'a>,
    current: Current<'c, 'a>,
    history: DetectionHistory<'c, 'a>,
    indexes: Indexes<'c, 'a>,
}

/// Why a stage fails, if it does; or the first input that it lacks.
type Found = Result<Option<Witness>, Input>;

impl<'c, 'a> ValidCycle<'c, 'a> {
    /// Checks all input, local and remote, and the size of the scratch. `index`: as for
    /// `check_indexed`.
    ///
    /// Errors: the first invalid value. Source: `spec/3-stages.md#invalid-input`.
    pub fn new(
        cycle: &'c Cycle<'a>,
        index: Option<&'c RouteIndex<'a>>,
        scratch: &Scratch<'_>,
    ) -> Result<Self, InvalidInput> {
        Self::with(cycle, Indexes { route: index, detections: &[] }, scratch)
    }

    /// As `new`, with what the caller keeps.
    ///
    /// Errors: the first invalid value. Source: `spec/3-stages.md#invalid-input`.
    pub fn with(
        cycle: &'c Cycle<'a>,
        indexes: Indexes<'c, 'a>,
        scratch: &Scratch<'_>,
    ) -> Result<Self, InvalidInput> {
        let indexes = of_this_route(cycle, &indexes);
        let usable = indexes
            .validate(cycle)
            .map_err(|(Fault::Local(problem) | Fault::Remote(problem))| problem)?;
        scratch.fits(cycle)?;
        Ok(Self::of(cycle, usable, indexes))
    }

    fn of(cycle: &'c Cycle<'a>, usable: Usable, indexes: Indexes<'c, 'a>) -> Self {
        let current = Current::new(cycle, usable);
        let history = DetectionHistory::new(cycle, current.detections, &indexes);
        Self { cycle, current, history, indexes }
    }

    /// What the stage finds on its own, whatever the schedule says about it; `NotApplicable` when
    /// an input of it is not current. H-14 is part of stages ii and iv, and its places of stage v. Stage iv
    /// tells `ambiguous` first here, and behind the gap in a cycle.
    /// Source: `spec/3-stages.md`.
    pub fn stage(&self, stage: Stage, scratch: &mut Scratch<'_>) -> Outcome {
        let found = match stage {
            Stage::I => {
                let seen = self.look_back(scratch);
                self.i(seen, scratch)
            }
            Stage::Ii => self.ii(self.aside()),
            Stage::Iii => self.iii(),
            Stage::Iv => match self.look_back(scratch) {
                Seen::Unclear(witness) if self.cycle.profile.has(HardenedRule::H14) => {
                    Ok(Some(witness))
                }
                seen => self.iv(seen, self.aside(), scratch),
            },
            Stage::V => self.v(self.aside()),
        };
        outcome(found)
    }

    /// What the CAV saw of the tracks, into the scratch: of those of the remote MOT, whatever their age,
    /// and of its own in `PlanRemote` (SEEN-03).
    fn look_back(&self, scratch: &mut Scratch<'_>) -> Seen {
        let tracks = match self.cycle.configuration {
            Configuration::PlanRemote => self.current.tracks,
            configuration => {
                self.cycle.tracks.as_ref().filter(|_| configuration.is_remote(Group::Mot))
            }
        };
        let look = |tracks| self.history.look_back(self.cycle, tracks, scratch);
        tracks.map_or(Seen::Open, look)
    }

    /// What the order of the stages depends on.
    fn given(&self) -> Given {
        Given {
            tracks_of_any_age: self.cycle.tracks.is_some(),
            tracks: self.current.tracks.is_some(),
            trajectory: self.current.trajectory.is_some(),
            detections: self.current.detections.is_some(),
            grid: self.current.grid.is_some(),
        }
    }

    /// After `look_back`, which says what was seen. Tracks go to stage i whatever their age.
    fn i(&self, seen: Seen, scratch: &mut Scratch<'_>) -> Found {
        // SCHED-04
        let tracks = self.cycle.tracks.as_ref().ok_or(Input::Tracks)?;
        let detections = self.current.detections.ok_or(Input::Detections)?;
        Ok(match seen {
            Seen::Unclear(witness) => Some(witness),
            Seen::Paired => None,
            Seen::Open if self.cycle.profile.has(HardenedRule::H01) => {
                matched_tracks(self.cycle, tracks, detections, scratch)
            }
            Seen::Open => track_validation(self.cycle, tracks, detections, scratch),
        })
    }

    /// By how much the CAV is wider at its places, m (H-14.26): stages ii, iv and v take it.
    fn aside(&self) -> f64 {
        let along = self.current.trajectory.filter(|_| looks_along(self.cycle.profile));
        along.map_or(0.0, |trajectory| wider_by(self.cycle, trajectory.points))
    }

    fn ii(&self, aside: f64) -> Found {
        let (cycle, points) = (self.cycle, self.current.trajectory()?.points);
        let route = IndexedRoute::new(&cycle.route, self.indexes.route);
        let (found, all_inside) = trajectory_to_map(cycle, route, points);
        let [h07, h11, h14] = [HardenedRule::H07, HardenedRule::H11, HardenedRule::H14]
            .map(|rule| cycle.profile.has(rule));
        // SCHED-20
        Ok(found
            .or_else(|| if h07 { start_failure(cycle, points) } else { None })
            .or_else(|| if h07 && !all_inside { corridor_failure(route, points) } else { None })
            .or_else(|| if h07 { direction_failure(route, points) } else { None })
            .or_else(|| if h11 { step_failure(cycle, points) } else { None })
            .or_else(|| if h14 { reach_failure(cycle, points, aside) } else { None })
            .or_else(|| if h14 { return_failure(cycle, points) } else { None })
            .or_else(|| if h14 { road_failure(cycle, route, points) } else { None }))
    }

    fn iii(&self) -> Found {
        let trajectory = self.current.trajectory()?;
        let tracks = self.current.tracks.ok_or(Input::Tracks)?;
        Ok(trajectory_with_tracks(self.cycle, trajectory, tracks))
    }

    /// After `look_back`, which says what was seen.
    fn iv(&self, seen: Seen, aside: f64, scratch: &mut Scratch<'_>) -> Found {
        let trajectory = self.current.trajectory()?;
        let detections = self.current.detections.ok_or(Input::Detections)?;
        let lead = self.current.lead;
        let found = trajectory_with_detections(self.cycle, trajectory, detections, lead);
        // H-14.46
        Ok(found.or_else(|| self.fail_safe(seen, aside, scratch)))
    }

    /// Why the cycle fails at the place of stage iv, which does not run (H-04, H-14).
    fn instead_of_iv(&self, seen: Seen, aside: f64, scratch: &mut Scratch<'_>) -> Option<Witness> {
        let Cycle { profile, configuration, .. } = *self.cycle;
        self.current.trajectory?;
        if configuration == Configuration::Local || !profile.runs(Stage::Iv) {
            return None;
        }
        let lead = self.current.lead.filter(|_| profile.has(HardenedRule::H04));
        // H-04.2, H-14.46
        gap_failure(lead, |lead| s_react(self.cycle, lead) + s_since(self.cycle, lead))
            .or_else(|| self.fail_safe(seen, aside, scratch))
    }

    /// H-14, after `look_back`.
    fn fail_safe(&self, seen: Seen, aside: f64, scratch: &mut Scratch<'_>) -> Option<Witness> {
        let examined = self.cycle.profile.has(HardenedRule::H14)
            && self.cycle.configuration != Configuration::Local;
        let rule = FailSafe {
            cycle: self.cycle,
            trajectory: self.current.trajectory.filter(|_| examined)?,
            aside,
            tracks: self.current.tracks,
            history: &self.history,
            route: IndexedRoute::new(&self.cycle.route, self.indexes.route),
            seen,
        };
        rule.failure(scratch)
    }

    fn v(&self, aside: f64) -> Found {
        let (cycle, trajectory) = (self.cycle, self.current.trajectory()?);
        let grid = self.current.grid.ok_or(Input::Grid)?;
        let [h04, h06] = [HardenedRule::H04, HardenedRule::H06].map(|rule| cycle.profile.has(rule));
        let places = if h04 { Some(places_of(cycle, trajectory, aside)) } else { None };
        Ok(if h06 {
            closed_cells(cycle, grid, (trajectory, places.as_ref()), self.current.detections)
        } else {
            let found = trajectory_with_grid_map(cycle, trajectory, grid);
            found.or_else(|| dilated_at_places(grid, places.as_ref()?))
        })
    }
}

/// The inputs that are current.
#[derive(Debug)]
struct Current<'c, 'a> {
    trajectory: Option<&'c Trajectory<'a>>,
    tracks: Option<&'c TrackList<'a>>,
    detections: Option<&'c DetectionList<'a>>,
    lead: Option<&'c Lead>,
    grid: Option<&'c Grid<'a>>,
}

impl<'c, 'a> Current<'c, 'a> {
    fn new(cycle: &'c Cycle<'a>, usable: Usable) -> Self {
        // SCHED-13
        let current = |stamp_ns| is_current(stamp_ns, cycle.now_ns, cycle.parameters.max_age_ns);
        let trajectory = cycle.trajectory.as_ref().filter(|list| current(list.stamp_ns));
        Self {
            trajectory: trajectory.filter(|_| usable.trajectory),
            tracks: cycle.tracks.as_ref().filter(|list| current(list.stamp_ns)),
            detections: cycle.detections.as_ref().filter(|list| current(list.stamp_ns)),
            lead: cycle.lead.as_ref().filter(|lead| current(lead.stamp_ns)),
            grid: cycle.grid.as_ref().filter(|grid| current(grid.stamp_ns)),
        }
    }

    fn trajectory(&self) -> Result<&'c Trajectory<'a>, Input> {
        self.trajectory.ok_or(Input::Trajectory)
    }
}

/// Runs the stages on valid input.
fn run(valid: &ValidCycle<'_, '_>, scratch: &mut Scratch<'_>) -> Report {
    let seen = valid.look_back(scratch);
    let mut stages = [Outcome::NotScheduled; 5];
    let mut slots = stages.iter_mut();
    let Cycle { profile, configuration, .. } = *valid.cycle;
    // SCHED-01: no stage asks.
    let aside = if configuration == Configuration::Local { 0.0 } else { valid.aside() };
    let failed_stage = decide(profile, configuration, valid.given(), |stage, turn| {
        // SCHED-14
        let outcome = match turn {
            Turn::Rest(idle) => idle.into(),
            Turn::Gap(idle) => {
                let found = valid.instead_of_iv(seen, aside, scratch);
                // H-04.4, H-14.47
                found.map_or_else(|| idle.into(), Outcome::Failed)
            }
            Turn::Run => outcome(match stage {
                Stage::I => valid.i(seen, scratch),
                Stage::Ii => valid.ii(aside),
                Stage::Iii => valid.iii(),
                Stage::Iv => valid.iv(seen, aside, scratch),
                Stage::V => valid.v(aside),
            }),
        };
        if let Some(slot) = slots.next() {
            *slot = outcome;
        }
        matches!(outcome, Outcome::Failed(_))
    });
    Report { failed_stage, stages, input: None }
}

fn outcome(found: Found) -> Outcome {
    let decided = |found: Option<Witness>| found.map_or(Outcome::Passed, Outcome::Failed);
    found.map_or_else(Outcome::NotApplicable, decided)
}
