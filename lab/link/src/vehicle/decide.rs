//! How a vehicle decides a cycle.

use std::time::Instant;

use mufasa::input::cycle::Trajectory;
use mufasa::monitor::{Decision, Inputs, Verified};
use mufasa::offloading::requester::Source;
use mufasa::services::configuration::{Configuration, Group};
use mufasa_model::input::cycle::Cycle;
use mufasa_props::bridge;

use super::log::{Follows, What, digest};
use super::tell::Given;
use super::{Vehicle, VehicleError, time, word};
use crate::play::moved;
use crate::transport::Transport;

impl<T: Transport> Vehicle<'_, T> {
    /// Decides a cycle, and lets control have what it may have.
    pub(super) fn decide(
        &mut self,
        now_ns: i64,
        cycle: &Cycle,
        later_ns: i64,
    ) -> Result<(), VehicleError> {
        let owned = bridge::to_impl(cycle);
        let known = owned.borrow(&[]);
        if self.route.as_ref() != Some(&cycle.route) {
            self.monitor.set_route(&known.route).map_err(VehicleError::Route)?;
            self.route = Some(cycle.route.clone());
        }
        let points = known.trajectory.map(|it| moved(it, later_ns));
        let trajectory = known.trajectory.zip(points.as_deref());
        let given = Given {
            detections: known.detections,
            lead: known.lead,
            grid: known.grid,
            tracks: known.tracks,
            trajectory: trajectory.map(|(it, points)| Trajectory { points, ..it }),
        };
        let inputs = Inputs::new(time(now_ns), self.played.decided(cycle));
        let mut inputs = given.inputs(inputs, later_ns);
        if let Some(tracks) = &self.tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        if let Some(trajectory) = &self.trajectory {
            inputs = inputs.remote_trajectory(trajectory);
        }
        let before = self.states();
        let configuration = self.monitor.configuration();
        let begun = Instant::now();
        let (decision, actions) = self.monitor.cycle(&inputs);
        let took = begun.elapsed();
        let report = match &decision {
            Decision::Safe { report, .. } => Ok(*report),
            Decision::Unsafe { report, .. } => *report,
        };
        let is_safe = matches!(decision, Decision::Safe { .. });
        self.tally.decided(now_ns, self.next, configuration, is_safe, &report, took);
        let follows = follows(&decision, configuration);
        if let Decision::Safe { tracks, trajectory, .. } = decision {
            let follow = |it: &Verified<'_, Trajectory<'_>>| digest(it.stamp_ns, it.points);
            let used = [
                tracks.map(|it| (Group::Mot, it.source(), digest(it.stamp_ns, it.items))),
                trajectory.map(|it| (Group::Plan, it.source(), follow(&it))),
            ];
            let remote = |(group, source, digest)| match source {
                Source::Remote { station } => {
                    Some(What::Used { group: word(group), station, digest })
                }
                Source::Local => None,
            };
            let used = used.into_iter().flatten().filter_map(remote).collect();
            self.tally.used(now_ns, self.played.period_ns(), used);
        }
        self.answered(now_ns, before, Ok(actions), "unsafe");
        if let Some(advice) = self.monitor.advice() {
            self.tally.note(now_ns, What::Advice { advice: advice.to_string() });
        }
        let control = Some((self.configuration(), follows));
        if self.control != control {
            self.control.clone_from(&control);
            if let Some((configuration, follows)) = control {
                let configuration = format!("{configuration:?}");
                self.tally.note(now_ns, What::Control { configuration, follows });
            }
        }
        Ok(())
    }
}

/// What control follows after a cycle that was decided in this configuration.
fn follows(decision: &Decision<'_>, configuration: Configuration) -> Follows {
    let (Decision::Safe { brake, .. } | Decision::Unsafe { brake, .. }) = decision;
    match (brake, decision) {
        (Some(_), _) => Follows::Brakes,
        (None, Decision::Safe { trajectory: Some(it), .. }) => match it.source() {
            Source::Remote { station } => Follows::Station(station),
            Source::Local => Follows::OwnPlan,
        },
        // MON-67
        (None, _) if configuration == Configuration::Local => Follows::OwnPlan,
        (None, _) => Follows::LastVerified,
    }
}
