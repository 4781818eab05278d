//! A cycle of the monitor (`spec/monitor.md`, what comes out and what a cycle uses).

use super::brake_by::brake_by_ns;
use super::elements::{Element, is_current, of_session};
use super::messages::{Brake, Decision, Measured, Verified};
use super::settings::fits;
use super::{Done, Judge, Monitor, history, supervision, ticks};
use crate::input::cycle::{Cycle, TrackList, Trajectory};
use crate::input::domain::{Problem, first_problem};
use crate::input::profile::HardenedRule;
use crate::numbers::vector::Vector;
use crate::offloading::requester::{EventKind, Sessions};
use crate::report::{InvalidInput, Outcome, Report};
use crate::services::configuration::{Configuration, Group};

impl Monitor {
    /// Decides a cycle, gives the requester the verdict, and hands out what was verified.
    pub(super) fn cycle(
        &mut self,
        now_ns: i64,
        measured: Measured,
        judge: Judge<'_>,
    ) -> (Decision, Done) {
        let own = self.own(now_ns, measured);
        let cycle = self.asked(&own);
        let local_problem = match first_problem(&cycle) {
            Some(Problem::Local(problem)) => Some(problem),
            Some(Problem::Remote(_)) | None => self.misfit(&own),
        };
        let is_in_time = self.ticks.cycle(now_ns, self.settings.requester.dt_max_ns);
        let silence_is_noticed = is_in_time || cycle.configuration == Configuration::Local;
        let report = match &local_problem {
            Some(problem) => Err(problem.clone()),
            None if !silence_is_noticed => Err(ticks::error()), // [MON-45] [MON-46]
            None => judge(&cycle),
        };
        if local_problem.is_none() {
            self.remember(&own);
        }
        if is_in_time && !lacks_detections(&cycle) {
            self.count_use(&cycle); // [MON-69]
        }

        let (tracks, trajectory) = match &report {
            Ok(report) if report.failed_stage.is_none() => self.verified(&cycle, report),
            Ok(_) | Err(_) => (None, None),
        };
        // [MON-10] [MON-11]
        let session = |it: Option<Verified>| it?.remote.map(|(_, session)| session);
        let sessions = Sessions { mot: session(tracks), plan: session(trajectory) };
        let done = self.tell(now_ns, EventKind::of_cycle(&report, sessions));

        let configuration = self.requester.configuration();
        self.progress.after_cycle(now_ns, configuration.remote().plan);
        self.brake = self.brake_after(own, trajectory.is_some(), judge);
        let by_ns = brake_by_ns(cycle.profile, &cycle.parameters, now_ns);
        let brake_by_ns = trajectory.and(by_ns);
        (Decision { report, tracks, trajectory, brake_by_ns, brake: self.brake.clone() }, done)
    }

    /// The cycle with the CAV's own tracks and trajectory. [MON-06] [MON-15]
    fn own(&self, now_ns: i64, measured: Measured) -> Cycle {
        let Measured { ego, trajectory, tracks, detections, lead, grid } = measured;
        let parameters = self.settings.parameters.clone();
        let current =
            detections.as_ref().filter(|it| is_current(now_ns, it.stamp_ns, parameters.max_age_ns));
        let detection_history = self.history.of_cycle(now_ns, current);
        Cycle {
            profile: self.settings.profile,
            parameters,
            now_ns,
            configuration: self.requester.configuration(),
            ego,
            trajectory,
            tracks,
            detections,
            lead,
            route: self.route.clone(),
            grid,
            detection_history,
        }
    }

    /// The same with the elements of the remote groups. [MON-07] [MON-08]
    fn asked(&self, own: &Cycle) -> Cycle {
        let remote = own.configuration.remote();
        let mut cycle = own.clone();
        if remote.mot {
            cycle.tracks = self.last_tracks().map(|it| it.content.clone());
        }
        if remote.plan {
            cycle.trajectory = self.last_trajectory().map(|it| it.content.clone());
        }
        cycle
    }

    fn last_tracks(&self) -> Option<&Element<TrackList>> {
        of_session(self.tracks.as_ref(), self.requester.session_of(Group::Mot))
    }

    fn last_trajectory(&self) -> Option<&Element<Trajectory>> {
        of_session(self.trajectory.as_ref(), self.requester.session_of(Group::Plan))
    }

    /// [MON-19] [MON-65]
    fn misfit(&self, own: &Cycle) -> Option<InvalidInput> {
        let memory = self.settings.memory;
        let is_kept = history::is_kept(own.profile);
        let detections = own.detections.as_ref().filter(|_| is_kept);
        let tracks = own.tracks.as_ref().filter(|_| !own.configuration.remote().mot);
        [
            detections.map(|it| (fits(&it.items, memory.detections), "detections.items")),
            tracks.map(|it| (fits(&it.items, memory.tracks), "tracks.items")),
        ]
        .into_iter()
        .flatten()
        .find(|(fits, _)| !fits)
        .map(|(_, field)| InvalidInput {
            field: field.into(),
            index: None,
            message: "more items than the memory has places".into(),
        })
    }

    /// What a cycle with valid local input leaves behind. [MON-12] [MON-17] [MON-55]
    fn remember(&mut self, own: &Cycle) {
        if let Some(detections) = &own.detections
            && history::is_kept(own.profile)
            && is_current(own.now_ns, detections.stamp_ns, own.parameters.max_age_ns)
        {
            self.history.keep(detections);
        }
        if let Some(stall) = &self.settings.stall {
            self.progress.found_at(stall, &Vector::from_doubles(own.ego.x, own.ego.y));
        }
    }

    /// Each remote group has a current element in this cycle, which counts, or has none.
    fn count_use(&mut self, cycle: &Cycle) {
        let current = |stamp_ns| is_current(cycle.now_ns, stamp_ns, cycle.parameters.max_age_ns);
        let (tracks, trajectory) = (&cycle.tracks, &cycle.trajectory);
        for (group, (_, used)) in &mut self.uses {
            let stamp_ns = match group {
                Group::Mot => tracks.as_ref().map(|it| it.stamp_ns),
                Group::Plan => trajectory.as_ref().map(|it| it.stamp_ns),
            };
            let dt_max_ns = self.settings.requester.dt_max_ns;
            *used = used.after_cycle(cycle.now_ns, stamp_ns.is_some_and(current), dt_max_ns);
        }
    }

    /// What comes out of a safe cycle: tracks and trajectory. [MON-01] [MON-02] [MON-04] [MON-05] [MON-66]
    fn verified(&self, cycle: &Cycle, report: &Report) -> (Option<Verified>, Option<Verified>) {
        let current = |stamp_ns| is_current(cycle.now_ns, stamp_ns, cycle.parameters.max_age_ns);
        let [stage_i, ..] = &report.stages;
        let tracks = self.last_tracks().filter(|_| *stage_i == Outcome::Passed);
        let tracks = tracks.map(|it| it.verified(it.content.stamp_ns));
        let trajectory = match cycle.configuration {
            Configuration::Local => None,
            Configuration::MotRemote => {
                let own = cycle.trajectory.as_ref();
                own.map(|it| Verified { stamp_ns: it.stamp_ns, remote: None })
            }
            Configuration::AllRemote | Configuration::PlanRemote => {
                self.last_trajectory().map(|it| it.verified(it.content.stamp_ns))
            }
        };
        let is_current = |it: &Verified| current(it.stamp_ns);
        let is_let_out = |it: &Verified| !lacks_detections(cycle) && is_current(it); // [MON-66]
        (tracks.filter(is_current), trajectory.filter(is_let_out))
    }

    /// Whether the decision says `brake`. [MON-47] [MON-48] [MON-49] [MON-52]
    fn brake_after(
        &self,
        own: Cycle,
        trajectory_comes_out: bool,
        judge: Judge<'_>,
    ) -> Option<Brake> {
        if !self.settings.supervise_local || trajectory_comes_out {
            return None;
        }
        if self.requester.configuration() != Configuration::Local {
            return self.brake.clone();
        }
        let current = own
            .detections
            .as_ref()
            .filter(|it| is_current(own.now_ns, it.stamp_ns, own.parameters.max_age_ns));
        let detection_history = self.history.of_cycle(own.now_ns, current);
        let configuration = Configuration::PlanRemote;
        let as_remote = Cycle { configuration, detection_history, ..own };
        supervision::examine(&as_remote, self.misfit(&as_remote).as_ref(), judge)
    }
}

/// Whether this is a cycle of the hardened profile without current detections. [MON-66] [MON-69]
fn lacks_detections(cycle: &Cycle) -> bool {
    let current = |stamp_ns| is_current(cycle.now_ns, stamp_ns, cycle.parameters.max_age_ns);
    let is_looked_around = cycle.detections.as_ref().is_some_and(|it| current(it.stamp_ns));
    cycle.profile.has(HardenedRule::H14) && !is_looked_around
}
