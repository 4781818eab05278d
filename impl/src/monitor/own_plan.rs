//! The CAV's own plan in `Local`, examined as a station's (`spec/monitor.md#monitor`, F-48).

use super::Monitor;
use super::cycle::named;
use super::decision::Brake;
use super::inputs::Inputs;
use crate::report::Outcome;
use crate::services::configuration::Configuration;
use crate::stages::order::is_current;

impl Monitor<'_> {
    /// What the decision says of the CAV's own plan, once the requester has its verdict. `is_led`: a trajectory
    /// comes out of the cycle.
    pub(super) fn supervise(&mut self, inputs: &Inputs<'_>, is_led: bool) -> Option<Brake> {
        if !self.settings.supervise_local {
            return None;
        }
        // MON-47
        if self.configuration() == Configuration::Local {
            self.brake = self.own_failure(inputs);
        } else if is_led {
            self.brake = None;
        }
        // MON-52
        self.brake
    }

    #[inline(never)]
    fn own_failure(&mut self, inputs: &Inputs<'_>) -> Option<Brake> {
        let (now_ns, max_age_ns) = (inputs.now.as_nanoseconds(), self.settings.stages.max_age_ns);
        let (as_remote, plan) = (Configuration::PlanRemote, inputs.local_trajectory);
        // MON-48, MON-49
        let report = match self.check(as_remote, inputs, inputs.local_tracks, plan, false) {
            Ok(report) => report,
            // MON-50
            Err(problem) => return Some(Brake::Invalid(named(problem, self.route.is_set()))),
        };
        let is_missing = !plan.is_some_and(|it| is_current(it.stamp_ns, now_ns, max_age_ns));
        match (report.failed_stage, report.input) {
            // MON-51
            (None, _) => is_missing.then_some(Brake::NoPlan),
            (Some(_), Some(problem)) => Some(Brake::Invalid(problem)),
            // MON-50
            (Some(stage), None) => {
                let witness = report.stages.into_iter().find_map(|outcome| match outcome {
                    Outcome::Failed(witness) => Some(witness),
                    Outcome::Passed
                    | Outcome::Skipped(_)
                    | Outcome::NotApplicable(_)
                    | Outcome::NotScheduled => None,
                });
                Some(Brake::Fails { stage, witness })
            }
        }
    }
}
