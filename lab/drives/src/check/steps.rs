//! When the cycles of a drive come, beside what the quality of service allows
//! (`spec/2-offloading.md#quality-of-service`).

use mufasa_model::input::cycle::Cycle;
use mufasa_model::offloading::requester::Parameters;

use crate::seconds;

/// Times between cycles that follow each other, and ages of their remote data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_field_names, reason = "a unit is no postfix")]
pub struct Steps {
    last_ns: Option<i64>,
    /// Shortest and longest, ns; times that do not advance are no steps.
    apart_ns: Option<[i64; 2]>,
    /// Greatest age, ns.
    oldest_ns: i64,
}

impl Steps {
    /// Takes the next cycle.
    pub fn take(&mut self, cycle: &Cycle) {
        let now_ns = cycle.now_ns;
        let step_ns = self.last_ns.replace(now_ns).map_or(0, |last| now_ns.saturating_sub(last));
        if step_ns > 0 {
            let [least, most] = self.apart_ns.unwrap_or([step_ns; 2]);
            self.apart_ns = Some([least.min(step_ns), most.max(step_ns)]);
        }
        let remote = cycle.configuration.remote();
        let tracks = cycle.tracks.as_ref().filter(|_| remote.mot).map(|it| it.stamp_ns);
        let plan = cycle.trajectory.as_ref().filter(|_| remote.plan).map(|it| it.stamp_ns);
        for stamp_ns in [tracks, plan].into_iter().flatten() {
            self.oldest_ns = self.oldest_ns.max(now_ns.saturating_sub(stamp_ns));
        }
    }

    /// Which limits are exceeded, with their parameters, and what to do.
    pub fn notes(&self, limits: &Parameters) -> Vec<String> {
        let &Parameters { dt_max_ns, l_max_ns, .. } = limits;
        let in_s = |ns: i64| format!("{} s", seconds(0, ns));
        let limit = |name: &str, ns: i64| format!("more than {name} = {ns} ({})", in_s(ns));
        let mut notes = Vec::new();
        if let Some([least, most]) = self.apart_ns.filter(|[_, most]| *most > dt_max_ns) {
            let limit = limit("dt_max_ns", dt_max_ns);
            notes.push(if least > dt_max_ns {
                let from = if least < most { format!("{} to ", in_s(least)) } else { String::new() };
                let (to, wider) = (in_s(most), most.saturating_add(most / 4));
                format!(
                    "the drive has a cycle every {from}{to}, {limit}, so that each counts as late and \
                     ends offloading; if this step is meant, write `dt_max_ns = {wider}` into a file and \
                     give it by --parameters"
                )
            } else {
                let gap = in_s(most);
                format!("the drive has gaps of up to {gap} between cycles, {limit}, which end offloading")
            });
        }
        if self.oldest_ns > l_max_ns {
            let (oldest, limit) = (in_s(self.oldest_ns), limit("l_max_ns", l_max_ns));
            notes.push(format!(
                "remote data are up to {oldest} old, {limit}, which ends offloading"
            ));
        }
        notes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notes(apart: [i64; 2], oldest_ns: i64) -> Vec<String> {
        let steps =
            Steps { last_ns: None, apart_ns: Some(apart.map(|ms| ms * 1_000_000)), oldest_ns };
        steps.notes(&Parameters::default())
    }

    #[test]
    fn limits_are_named_with_what_exceeds_them() {
        assert_eq!(notes([100, 100], 50_000_000), [""; 0]);
        let [step] = &notes([200, 200], 0)[..] else { panic!("one note") };
        assert!(step.contains("every 0.2 s, more than dt_max_ns = 100000000 (0.1 s)"), "{step}");
        assert!(
            step.contains("`dt_max_ns = 250000000`") && step.contains("--parameters"),
            "{step}"
        );
        let [steps] = &notes([150, 200], 0)[..] else { panic!("one note") };
        assert!(steps.contains("every 0.15 s to 0.2 s"), "{steps}");
        let [gap] = &notes([100, 300], 0)[..] else { panic!("one note") };
        assert!(gap.contains("gaps of up to 0.3 s") && !gap.contains("--parameters"), "{gap}");
        let [old] = &notes([100, 100], 60_000_000)[..] else { panic!("one note") };
        assert!(old.contains("0.06 s old, more than l_max_ns = 50000000 (0.05 s)"), "{old}");
    }
}
