//! The requester over a drive: which unsafe cycles start a fallback
//! (`spec/2-offloading.md#fallback`).
//!
//! One station offers the groups that the cycles call remote and confirms every request at once.
//! Every cycle is judged as if offloaded; the requester learns only of those whose remote data it
//! used.

use mufasa_model::input::cycle::Cycle;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Sessions,
};
use mufasa_model::services::configuration::Configuration;

use super::sides::Side;

/// The only station of a drive.
const STATION: i64 = 1;

/// What the requester did over a drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RequesterRun {
    /// Unsafe cycles.
    pub unsafe_cycles: usize,
    /// Waits that were started.
    pub fallbacks: usize,
    /// Elements that ended offloading by the quality of service: too old or too long after the
    /// previous one. A cycle has one of each remote group.
    pub late: usize,
    /// Silences that did so, of each remote group: the next cycle of the drive came later than `dt_max`.
    pub silent: usize,
    /// Cycles whose remote data the requester used.
    pub offloaded: usize,
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

/// What a requester did in one cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Followed {
    /// What the cycle did to the waiting time, if it is unsafe.
    pub hold: Option<Hold>,
    /// Every action.
    pub actions: Vec<Action>,
}

/// A requester that is led along a drive, a cycle at a time.
pub struct Follower<S> {
    side: S,
    run: RequesterRun,
    offered: Option<Groups>,
    /// Of the cycle that is followed.
    actions: Vec<Action>,
}

impl<S: Side> Follower<S> {
    /// Before the first cycle.
    pub fn new(side: S) -> Self {
        Self { side, run: RequesterRun::default(), offered: None, actions: Vec::new() }
    }

    /// What it did up to now.
    pub fn run(&self) -> RequesterRun {
        self.run
    }

    /// Takes the next cycle and whether it is safe. `Err` is a complaint of the requester, in words.
    pub fn follow(&mut self, cycle: &Cycle, safe: bool) -> Result<Followed, String> {
        self.actions.clear();
        let groups = remote_groups(cycle.configuration);
        if self.offered != Some(groups) {
            self.step(cycle, EventKind::Offer { station: STATION, groups })?;
            self.offered = Some(groups);
        }
        let before = self.remote();
        let ticked = self.step(cycle, EventKind::Tick)?;
        let after = self.remote();
        self.run.silent += before.iter().zip(after).filter(|(was, is)| **was && !is).count();
        for action in ticked {
            if let Action::Request { station, group, session } = action {
                self.step(cycle, EventKind::Confirm { station, group, session })?;
            }
        }
        let sessions = self.data(cycle)?;
        let used = sessions != Sessions::NONE;
        if used {
            self.run.offloaded += 1;
            self.step(cycle, EventKind::Verdict { safe, sessions })?;
        }
        let hold = (!safe).then(|| match self.side.hold_until_ns() {
            Some(until_ns) if used => Hold::Started { until_ns },
            Some(until_ns) if until_ns > cycle.now_ns => Hold::Running,
            Some(_) | None => Hold::Off,
        });
        self.run.unsafe_cycles += usize::from(hold.is_some());
        self.run.fallbacks += usize::from(matches!(hold, Some(Hold::Started { .. })));
        Ok(Followed { hold, actions: std::mem::take(&mut self.actions) })
    }
    fn step(&mut self, cycle: &Cycle, kind: EventKind) -> Result<Vec<Action>, String> {
        let actions = self.side.step(&Event { t_ns: cycle.now_ns, kind })?;
        self.actions.extend_from_slice(&actions);
        Ok(actions)
    }

    /// Hands the remote data of a cycle to the requester; returns the sessions of the data that are used.
    fn data(&mut self, cycle: &Cycle) -> Result<Sessions, String> {
        let mut used = Sessions::NONE;
        for group in Group::ALL {
            let (Some(generated_ns), GroupState::Remote { station, session }) =
                (generated(cycle, group), self.side.state(group))
            else {
                continue;
            };
            let data = EventKind::Data { station, group, session, generated_ns };
            let actions = self.step(cycle, data)?;
            if self.side.state(group) == GroupState::Local {
                self.run.late += 1;
            } else if !actions.contains(&Action::Drop(group)) {
                match group {
                    Group::Mot => used.mot = Some(session),
                    Group::Plan => used.plan = Some(session),
                }
            }
        }
        Ok(used)
    }

    /// Whether the groups are remote.
    fn remote(&self) -> [bool; 2] {
        Group::ALL.map(|group| matches!(self.side.state(group), GroupState::Remote { .. }))
    }
}

/// When the remote result of a group in this cycle was generated.
fn generated(cycle: &Cycle, group: Group) -> Option<i64> {
    if !remote_groups(cycle.configuration).contains(group) {
        return None;
    }
    match group {
        Group::Mot => cycle.tracks.as_ref().map(|list| list.stamp_ns),
        Group::Plan => cycle.trajectory.as_ref().map(|it| it.stamp_ns),
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
