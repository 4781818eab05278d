//! What the sequences of events and cycles reached, so that none of it is compared with nothing.

use mufasa::input::profile::Profile;
use mufasa::monitor::{Brake, Decision};
use mufasa::offloading::requester::{Group, Sessions};
use mufasa::services::configuration::Configuration;

use super::kit::place;
use super::plain::{Ended, Plain, Waits};
use super::scene::without_segment;

/// What the sequences reached.
#[derive(Debug, Default)]
pub struct Seen {
    pub cycles: u64,
    pub safe: u64,
    pub errors: u64,
    pub unsafe_while_remote: u64,
    /// Unsafe for want of a tick.
    pub no_tick: u64,
    pub tracks: u64,
    pub remote_trajectories: u64,
    pub local_trajectories: u64,
    pub not_the_last: u64,
    pub dropped: u64,
    pub with_history: u64,
    /// Groups that were starved by stamps ahead, and by those too old by the cycle.
    pub starved_ahead: u64,
    pub starved_old: u64,
    /// Elements of a starved group: dropped in time, and ended the session as they were late.
    pub starved_and_dropped: u64,
    pub starved_and_late: u64,
    /// Starved sessions that ended by a tick, and groups that had a current element again before.
    pub starved_and_left: u64,
    pub recovered: u64,
    /// Starved until a clock was set back.
    pub set_back: u64,
    /// Cycles in which control has to brake, with no plan of the CAV's own, and with one that fails.
    pub no_plan: u64,
    pub own_fails: u64,
    /// Sessions of planning that got nowhere.
    pub given_back: u64,
    /// Sessions by the wait after them.
    pub waits: Waits,
}

/// The sessions that are starved.
pub fn starved(plain: &Plain<'_>) -> [Option<i64>; 2] {
    plain.service.map(|it| it.filter(|it| it.starved).map(|it| it.session))
}

impl Seen {
    pub fn count(&mut self, ended: &Ended, before: Configuration, given: [bool; 2]) {
        let used = [ended.sessions.mot.is_some(), ended.sessions.plan.is_some()];
        let lost = Group::ALL
            .into_iter()
            .any(|group| before.is_remote(group) && given[place(group)] && !used[place(group)]);
        self.not_the_last += u64::from(lost && ended.report.is_ok());
        let examined = before.is_remote(Group::Plan) && used[1];
        self.with_history += u64::from(examined && ended.lists > 1);
    }

    /// What a cycle did to the sessions, with the habit of the stamps.
    pub fn starvation(
        &mut self,
        before: [Option<i64>; 2],
        plain: &Plain<'_>,
        sessions: Sessions,
        (_, ahead_ns, _): (usize, i64, i64),
    ) {
        let used = [sessions.mot, sessions.plan];
        for ((before, after), used) in before.into_iter().zip(plain.service).zip(used) {
            let is_starved = after.is_some_and(|it| it.starved);
            let starts = before.is_none() && is_starved;
            self.starved_ahead += u64::from(starts && ahead_ns > 0);
            self.starved_old += u64::from(starts && ahead_ns < 0);
            let goes_on = before.is_some() && before == after.map(|it| it.session);
            self.recovered += u64::from(goes_on && !is_starved && used.is_some());
            self.set_back += u64::from(goes_on && !is_starved && used.is_none());
        }
    }

    /// What a cycle says of the CAV's own plan.
    pub fn own(&mut self, decision: &Decision<'_>, plainly: Option<Brake>) {
        let (Decision::Safe { brake, .. } | Decision::Unsafe { brake, .. }) = decision;
        assert_eq!(without_segment(*brake), without_segment(plainly));
        self.no_plan += u64::from(*brake == Some(Brake::NoPlan));
        self.own_fails += u64::from(matches!(brake, Some(Brake::Fails { .. })));
    }

    /// What one sequence ended in.
    pub const fn add(&mut self, plain: &Plain<'_>) {
        let waits = plain.waits;
        self.given_back += plain.given_back;
        self.waits.whole += waits.whole;
        self.waits.shortened += waits.shortened;
        self.waits.none += waits.none;
    }

    /// Every case was reached often enough.
    pub fn is_enough(&self, profile: Profile) {
        let &Self { cycles, safe, errors, unsafe_while_remote, tracks, .. } = self;
        let &Self { remote_trajectories, local_trajectories, not_the_last, dropped, .. } = self;
        let often = [safe, errors, unsafe_while_remote, tracks, remote_trajectories, dropped];
        for count in often.into_iter().chain([not_the_last]) {
            assert!(100 * count >= cycles, "something hardly occurs: {self:?}");
        }
        assert!(200 * local_trajectories >= cycles, "{self:?}");
        let needs_history = profile == Profile::HARDENED;
        assert!(!needs_history || 20 * self.with_history >= cycles, "{self:?}");
        assert!(2_000 * self.no_tick >= cycles, "{self:?}");
        let &Self { starved_ahead, starved_old, starved_and_dropped, .. } = self;
        let &Self { starved_and_late, starved_and_left, recovered, set_back, .. } = self;
        let starved = [starved_ahead, starved_old, starved_and_dropped, starved_and_left];
        for count in starved.into_iter().chain([starved_and_late, recovered, set_back]) {
            assert!(2_000 * count >= cycles && count >= 5, "starved groups: {self:?}");
        }
        assert!(self.given_back >= 20, "{self:?}");
        for count in [self.no_plan, self.own_fails] {
            assert!(2_000 * count >= cycles && count >= 5, "own plans: {self:?}");
        }
        let Waits { whole, shortened, none } = self.waits;
        for count in [whole, shortened, none] {
            assert!(2_000 * count >= cycles && count >= 5, "waits: {self:?}");
        }
    }
}
