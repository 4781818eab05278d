//! The times that a monitor compares with, as far as they are seen from outside.

use mufasa_model::monitor::messages::{Answer, Decision, Event, EventKind};
use mufasa_model::monitor::settings::Settings;
use mufasa_model::offloading::requester::GroupState;
use mufasa_model::services::configuration::Group;

/// ns
pub(super) const MS: i64 = 1_000_000;

/// Of one group, ns.
#[derive(Clone, Copy, Debug, Default)]
struct OfGroup {
    arrived: Option<i64>,
    generated: Option<i64>,
    stamp: Option<i64>,
    /// The last cycle out of which an element came, or the confirmation.
    of_use: Option<i64>,
}

/// What was when, ns.
#[derive(Clone, Debug, Default)]
pub(super) struct Times {
    /// The end of the hold.
    pub hold_until_ns: Option<i64>,
    /// A time that the sequence is to go to.
    pub aimed_ns: Option<i64>,
    /// Stamps of detections that may have been kept, the last ones.
    pub kept_ns: Vec<i64>,
    ticked_ns: Option<i64>,
    /// PLAN was remote since.
    planned_since_ns: Option<i64>,
    groups: [OfGroup; 2],
}

fn place(group: Group) -> usize {
    match group {
        Group::Mot => 0,
        Group::Plan => 1,
    }
}

impl Times {
    /// When the last result of a group was generated.
    pub fn generated_ns(&self, group: Group) -> Option<i64> {
        self.groups[place(group)].generated
    }

    pub fn take(&mut self, event: &Event, answer: &Answer) {
        let t_ns = event.t_ns;
        self.hold_until_ns = answer.hold_until_ns;
        let plan_is_remote = matches!(answer.plan, GroupState::Remote { .. });
        if answer.given_back_ns == Some(t_ns) || !plan_is_remote {
            self.planned_since_ns = None;
        }
        match &event.kind {
            EventKind::Tick => self.ticked_ns = Some(t_ns),
            EventKind::Confirm { group, .. } => {
                let state = [answer.mot, answer.plan][place(*group)];
                if matches!(state, GroupState::Remote { .. }) {
                    self.groups[place(*group)] =
                        OfGroup { arrived: Some(t_ns), of_use: Some(t_ns), ..OfGroup::default() };
                }
            }
            EventKind::Tracks { generated_ns, tracks, .. } if answer.dropped.is_none() => {
                self.arrived(Group::Mot, [t_ns, *generated_ns, tracks.stamp_ns]);
            }
            EventKind::Trajectory { generated_ns, trajectory, .. } if answer.dropped.is_none() => {
                self.arrived(Group::Plan, [t_ns, *generated_ns, trajectory.stamp_ns]);
            }
            EventKind::Cycle { measured } => {
                self.planned_since_ns = self.planned_since_ns.or(plan_is_remote.then_some(t_ns));
                if let Some(Decision { tracks, trajectory, .. }) = &answer.decision {
                    let out = [tracks.is_some(), trajectory.is_some()];
                    for (group, is_out) in self.groups.iter_mut().zip(out) {
                        group.of_use = if is_out { Some(t_ns) } else { group.of_use };
                    }
                }
                let stamp = measured.detections.as_ref().map(|it| it.stamp_ns);
                let apart_ns = 83 * MS;
                if let Some(stamp_ns) = stamp.filter(|it| {
                    let last_ns = self.kept_ns.last().copied();
                    last_ns.is_none_or(|last_ns| it.abs_diff(last_ns) > apart_ns.unsigned_abs())
                }) {
                    self.kept_ns.push(stamp_ns);
                    self.kept_ns.drain(..self.kept_ns.len().saturating_sub(12));
                }
            }
            _ => {}
        }
    }

    fn arrived(&mut self, group: Group, [t_ns, generated_ns, stamp_ns]: [i64; 3]) {
        let it = &mut self.groups[place(group)];
        it.arrived = Some(t_ns);
        it.generated = Some(generated_ns);
        it.stamp = Some(stamp_ns);
    }

    /// All of them.
    pub fn bounds(&self, settings: &Settings, states: [GroupState; 2]) -> Vec<i64> {
        let dt_max_ns = settings.requester.dt_max_ns;
        let mut bounds: Vec<i64> = self.hold_until_ns.into_iter().collect();
        bounds.extend(self.ticked_ns.map(|it| it + dt_max_ns));
        for (state, group) in states.into_iter().zip(&self.groups) {
            match state {
                GroupState::Local => {}
                GroupState::Requested { deadline_ns, .. } => bounds.push(deadline_ns),
                GroupState::Remote { .. } => {
                    let silent = [group.arrived, group.of_use];
                    bounds.extend(silent.into_iter().flatten().map(|it| it + dt_max_ns));
                    let age_ns = settings.parameters.max_age_ns;
                    bounds.extend(group.stamp.map(|it| it + age_ns));
                    bounds.extend(group.stamp);
                }
            }
        }
        let ages = [83_333_334, 200 * MS, 500 * MS, 1_000 * MS];
        for kept_ns in self.kept_ns.iter().rev() {
            bounds.extend(ages.map(|age_ns| kept_ns + age_ns));
        }
        if let Some((since_ns, stall)) = self.planned_since_ns.zip(settings.stall) {
            bounds.push(since_ns + stall.time_ns);
        }
        bounds
    }
}
