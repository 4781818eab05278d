//! The requester over a drive: which unsafe cycles start a fallback
//! (`spec/2-offloading.md#fallback`).
//!
//! One station offers the groups that the cycles call remote and confirms every request at once.
//! Every cycle is judged as if offloaded; the requester learns only of those whose remote data it
//! used.

use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Sessions,
};
use mufasa_model::services::configuration::Configuration;

use super::sides::Side;
use super::step::Step;

/// The only station of a drive.
const STATION: i64 = 1;

/// What the requester did over a drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RequesterRun {
    /// The unsafe cycles in order.
    pub unsafe_cycles: Vec<UnsafeCycle>,
    /// Elements that ended offloading by the quality of service: too old or too long after the
    /// previous one.
    pub late: usize,
    /// Silences that did so: the next cycle of the drive came later than `dt_max`.
    pub silent: usize,
    /// Cycles whose remote data the requester used.
    pub offloaded: usize,
    /// Every action, with the number of the cycle.
    pub log: Vec<(usize, Action)>,
}

/// An unsafe cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnsafeCycle {
    /// Index in the drive.
    pub index: usize,
    /// What it did to the waiting time.
    pub hold: Hold,
}

/// What an unsafe cycle did to the waiting time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// It ended offloading and started a wait until this time.
    Started {
        /// End of the wait, ns.
        until_ns: i64,
    },
    /// It fell into a running wait: its data were not used.
    Running,
    /// No data were used for another reason, such as their lateness.
    Off,
}

/// Runs a requester over the cycles; `safe` holds the verdicts, one per cycle. `Err` is a
/// complaint of the requester, in words.
pub fn follow<'a>(
    side: &mut impl Side,
    cycles: impl IntoIterator<Item = &'a Step>,
    safe: &[bool],
) -> Result<RequesterRun, String> {
    let mut run = RequesterRun::default();
    let mut offered = None;
    for (index, (cycle, safe)) in cycles.into_iter().zip(safe).enumerate() {
        let groups = remote_groups(cycle.configuration);
        if offered != Some(groups) {
            let offer = EventKind::Offer { station: STATION, groups };
            run.step(side, index, cycle, offer)?;
            offered = Some(groups);
        }
        let remote = |side: &_| Group::ALL.map(|group| is_remote(side, group));
        let before = remote(side);
        let ticked = run.step(side, index, cycle, EventKind::Tick)?;
        let after = remote(side);
        run.silent += before.iter().zip(after).filter(|(was, is)| **was && !is).count();
        for action in ticked {
            if let Action::Request { station, group, session } = action {
                let confirm = EventKind::Confirm { station, group, session };
                run.step(side, index, cycle, confirm)?;
            }
        }
        let sessions = run.data(side, index, cycle)?;
        let used = sessions != Sessions::NONE;
        if used {
            run.offloaded += 1;
            run.step(side, index, cycle, EventKind::Verdict { safe: *safe, sessions })?;
        }
        if !safe {
            let hold = match side.hold_until_ns() {
                Some(until_ns) if used => Hold::Started { until_ns },
                Some(until_ns) if until_ns > cycle.now_ns => Hold::Running,
                Some(_) | None => Hold::Off,
            };
            run.unsafe_cycles.push(UnsafeCycle { index, hold });
        }
    }
    Ok(run)
}

impl RequesterRun {
    /// How many waits were started.
    pub fn fallbacks(&self) -> usize {
        let started = |cycle: &&UnsafeCycle| matches!(cycle.hold, Hold::Started { .. });
        self.unsafe_cycles.iter().filter(started).count()
    }

    fn step(
        &mut self,
        side: &mut impl Side,
        index: usize,
        cycle: &Step,
        kind: EventKind,
    ) -> Result<Vec<Action>, String> {
        let actions = side.step(&Event { t_ns: cycle.now_ns, kind })?;
        self.log.extend(actions.iter().map(|action| (index, *action)));
        Ok(actions)
    }

    /// Hands the remote data of a cycle to the requester; returns the sessions of the data that are used.
    fn data(
        &mut self,
        side: &mut impl Side,
        index: usize,
        cycle: &Step,
    ) -> Result<Sessions, String> {
        let mut used = Sessions::NONE;
        for group in Group::ALL {
            let (Some(generated_ns), GroupState::Remote { station, session }) =
                (generated(cycle, group), side.state(group))
            else {
                continue;
            };
            let data = EventKind::Data { station, group, session, generated_ns };
            let actions = self.step(side, index, cycle, data)?;
            if side.state(group) == GroupState::Local {
                self.late += 1;
            } else if !actions.contains(&Action::Drop(group)) {
                match group {
                    Group::Mot => used.mot = Some(session),
                    Group::Plan => used.plan = Some(session),
                }
            }
        }
        Ok(used)
    }
}

fn is_remote(side: &impl Side, group: Group) -> bool {
    matches!(side.state(group), GroupState::Remote { .. })
}

/// When the remote result of a group in this cycle was generated.
fn generated(cycle: &Step, group: Group) -> Option<i64> {
    if !remote_groups(cycle.configuration).contains(group) {
        return None;
    }
    match group {
        Group::Mot => cycle.tracks_ns,
        Group::Plan => cycle.trajectory_ns,
    }
}

/// The groups that a configuration calls remote (`spec/1-services.md#configuration`).
fn remote_groups(configuration: Configuration) -> Groups {
    match configuration {
        Configuration::Local => Groups::NONE,
        Configuration::MotRemote => Groups { mot: true, plan: false },
        Configuration::AllRemote => Groups::ALL,
        Configuration::PlanRemote => Groups { mot: false, plan: true },
    }
}
