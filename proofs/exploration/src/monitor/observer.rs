//! An observer outside the monitor, who remembers what was sent, asked, used and given out.

use enumset::{EnumSet, EnumSetType};
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::monitor::messages::{Answer, Decision, Dropped, Verified};
use mufasa_model::offloading::requester::{Action, Group, GroupState};

use super::period::{LONGEST, MAX_AGE, PERIOD_NS, Period, T_WAIT, TAU_NS};
use crate::fit::fitted;
use crate::properties::named;

named! {
    /// A law of the monitor.
    Law {
        /// MON-01, MON-45
        NothingOutOfUnsafe = "nothing comes out of an unsafe cycle",
        /// FALL-04
        NothingBeforeHoldUntil = "nothing of a station comes out before hold_until",
        /// MON-01, MON-07
        OutIsCurrentAndUsed = "what comes out is of the running session, current, and used by the requester",
        /// MON-01, MON-04
        VerifiedComesOut = "what is current in a safe cycle comes out",
        /// MON-34 to MON-38
        AskedAgainAfterNineTimes = "no station is asked before nine times the time without use",
        /// MON-33
        LeftInTime = "a session without use is left within 2 dt_max and two periods",
        /// MON-40, MON-41
        BrakeByMovesOn = "brake_by is that of its cycle, and never decreases",
        /// MON-39, in runs without faults.
        OffloadingComesBack = "without faults offloading comes back",
    }
}

named! {
    /// A step that a law speaks of, and that has to be reached.
    Scene {
        /// The stages say unsafe.
        UnsafeWithCurrent = "unsafe cycle with a current element",
        /// MON-45
        UnsafeForATick = "unsafe cycle without a tick",
        /// FALL-04
        ArrivesInTheWait = "an element arrives before hold_until",
        /// MON-01
        ComesOut = "an element comes out",
        /// Exactly `max_age`.
        OldestComesOut = "an element as old as max_age comes out",
        /// MON-33, why.
        AheadComesOutLater = "an element stamped ahead comes out a period later",
        /// MON-09
        OtherSessionDropped = "an element of another session is dropped",
        /// MON-09
        LateDropped = "a late element is dropped",
        /// MON-30
        StaleDropped = "a stale element is dropped",
        /// MON-09
        RepeatedDropped = "a repeated element is dropped",
        /// MON-32
        StarvedDropped = "an element of a starved group is dropped",
        /// MON-34
        NinefoldWait = "a wait after a session longer than t_wait ends with a request",
        /// MON-36
        UseShortensTheWait = "a session of long use ends and leaves no wait",
        /// MON-42
        BrakeByPasses = "brake_by passes while the group is remote",
        /// From a fallback.
        ComesBack = "an element comes out after a fallback",
    }
}

impl Scene {
    /// The laws that it shows not to be empty.
    pub fn laws(self) -> &'static [Law] {
        match self {
            Self::UnsafeWithCurrent | Self::UnsafeForATick => &[Law::NothingOutOfUnsafe],
            Self::ArrivesInTheWait => &[Law::NothingBeforeHoldUntil],
            Self::ComesOut => {
                &[Law::OutIsCurrentAndUsed, Law::VerifiedComesOut, Law::BrakeByMovesOn]
            }
            Self::OldestComesOut
            | Self::AheadComesOutLater
            | Self::OtherSessionDropped
            | Self::LateDropped
            | Self::StaleDropped
            | Self::RepeatedDropped => &[Law::OutIsCurrentAndUsed],
            Self::StarvedDropped => &[Law::AskedAgainAfterNineTimes, Law::LeftInTime],
            Self::NinefoldWait | Self::UseShortensTheWait => &[Law::AskedAgainAfterNineTimes],
            Self::BrakeByPasses => &[Law::BrakeByMovesOn],
            Self::ComesBack => &[Law::OffloadingComesBack],
        }
    }
}

/// What a period shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shown {
    /// The laws that it breaks.
    pub broken: EnumSet<Law>,
    /// The scenes in it.
    pub seen: EnumSet<Scene>,
}

impl Shown {
    fn breaks(&mut self, law: Law, condition: bool) {
        if condition {
            self.broken.insert(law);
        }
    }

    fn shows(&mut self, scene: Scene, condition: bool) {
        if condition {
            self.seen.insert(scene);
        }
    }
}

/// What the observer remembers. Times and ages in periods.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Observer {
    /// Until nothing may come out.
    barred: i8,
    /// Until a request may be sent.
    wait: i8,
    /// Whether that wait was longer than `t_wait`.
    waits_long: bool,
    session: Option<Seen>,
    /// Until control brakes, ns; not below minus one period.
    brake_left_ns: Option<i64>,
    fell_back: bool,
}

/// A running session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Seen {
    number: i64,
    /// Age of the last element that the requester used.
    element: Option<i8>,
    /// Whether that element was stamped ahead.
    is_ahead: bool,
    /// Since the last cycle with a current element, or the confirmation.
    without: i8,
    /// Since the first such cycle.
    first: Option<i8>,
}

/// Beyond this a session was of use for long enough to leave no wait.
const LONG: i64 = 10 * LONGEST;

impl Observer {
    /// What decides how it goes on: the number of a session is only compared with itself.
    pub fn alike(self) -> Self {
        Self { session: self.session.map(|it| Seen { number: 0, ..it }), ..self }
    }

    /// A station confirms.
    pub fn confirmed(&mut self, answer: &Answer, group: Group, number: i64) {
        if running(answer, group) == Some(number) {
            self.session =
                Some(Seen { number, element: None, is_ahead: false, without: 0, first: None });
        }
    }

    /// An element arrives, whose stamp is ahead of now by so much.
    pub fn arrived(&mut self, answer: &Answer, ahead_ns: i64, shown: &mut Shown) {
        shown.shows(Scene::ArrivesInTheWait, self.barred > 0);
        let scene = match answer.dropped {
            None => {
                let age: i8 = fitted(-ahead_ns / PERIOD_NS);
                let is_running = self.session.is_some();
                shown.breaks(Law::OutIsCurrentAndUsed, !is_running);
                let is_ahead = age < 0;
                self.session = self.session.map(|it| Seen { element: Some(age), is_ahead, ..it });
                return;
            }
            Some(Dropped::OtherSession) => Scene::OtherSessionDropped,
            Some(Dropped::Late) => Scene::LateDropped,
            Some(Dropped::Stale) => Scene::StaleDropped,
            Some(Dropped::Repeated) => Scene::RepeatedDropped,
            Some(Dropped::Starved) => Scene::StarvedDropped,
            Some(Dropped::Older | Dropped::DoesNotFit) => return,
        };
        shown.shows(scene, true);
    }

    /// What any event may have done: a session ended, a request was sent.
    pub fn follow(&mut self, answer: &Answer, group: Group, shown: &mut Shown) {
        if let Some(seen) = self.session
            && running(answer, group) != Some(seen.number)
        {
            let used = seen.first.map_or(0, |first| first - seen.without);
            let wait = 9 * i64::from(seen.without.max(1)) - i64::from(used);
            self.wait = self.wait.max(fitted(wait.max(0)));
            shown.shows(Scene::UseShortensTheWait, wait <= 0);
            self.waits_long |= wait > T_WAIT;
            self.session = None;
        }
        if answer.actions.iter().any(|it| matches!(it, Action::Request { .. })) {
            shown.shows(Scene::NinefoldWait, self.waits_long);
            self.waits_long = false;
            shown.breaks(Law::AskedAgainAfterNineTimes, self.wait > 0);
        }
    }

    /// A cycle was decided.
    pub fn decided(
        &mut self,
        answer: &Answer,
        (now_ns, profile): (i64, Profile),
        group: Group,
        period: Period,
        shown: &mut Shown,
    ) {
        let Some(decision) = &answer.decision else { unreachable!("a cycle is decided") };
        let lacks_tick = self.session.is_some() && !period.ticks;
        let is_safe = period.safe && !lacks_tick;
        let out = match group {
            Group::Mot => decision.tracks,
            Group::Plan => decision.trajectory,
        };
        let current = self.use_element();
        shown.shows(Scene::UnsafeWithCurrent, !period.safe && current.is_some());
        shown.shows(Scene::UnsafeForATick, period.safe && lacks_tick);
        let is_empty = decision.tracks.is_none() && decision.trajectory.is_none();
        shown.breaks(Law::NothingOutOfUnsafe, !is_safe && (!is_empty || decision.is_safe()));
        shown.breaks(Law::VerifiedComesOut, is_safe && out.is_some() != current.is_some());
        shown.breaks(Law::OutIsCurrentAndUsed, self.session.is_none() && !is_empty);
        if let Some(out) = out {
            self.came_out(out, now_ns, current, shown);
        }
        self.judge_brake_by(decision, now_ns, profile, shown);
        if !is_safe {
            self.barred = fitted(T_WAIT);
            self.fell_back = true;
        }
    }

    /// The age of the element that is current in a cycle; time of use is counted.
    fn use_element(&mut self) -> Option<i8> {
        let seen = self.session.as_mut()?;
        let current = seen.element.filter(|age| (0..=MAX_AGE).contains(&i64::from(*age)));
        if current.is_some() {
            seen.without = 0;
            seen.first = seen.first.or(Some(0));
        }
        current
    }

    fn came_out(&mut self, out: Verified, now_ns: i64, age: Option<i8>, shown: &mut Shown) {
        let number = out.remote.map(|(_, number)| number);
        let is_its_own = number.is_some() && number == self.session.map(|it| it.number);
        let stamp_ns = age.map(|age| now_ns - i64::from(age) * PERIOD_NS);
        shown.breaks(Law::OutIsCurrentAndUsed, !is_its_own || stamp_ns != Some(out.stamp_ns));
        shown.breaks(Law::NothingBeforeHoldUntil, self.barred > 0);
        shown.shows(Scene::ComesOut, true);
        let is_ahead = self.session.is_some_and(|it| it.is_ahead);
        shown.shows(Scene::AheadComesOutLater, is_ahead);
        shown.shows(Scene::OldestComesOut, age.map(i64::from) == Some(MAX_AGE));
        shown.shows(Scene::ComesBack, self.fell_back);
        self.fell_back = false;
    }

    fn judge_brake_by(
        &mut self,
        decision: &Decision,
        now_ns: i64,
        profile: Profile,
        shown: &mut Shown,
    ) {
        let is_named = decision.trajectory.is_some() && profile.has(HardenedRule::H14);
        let expected = is_named.then_some(now_ns + TAU_NS);
        shown.breaks(Law::BrakeByMovesOn, decision.brake_by_ns != expected);
        let has_passed = self.brake_left_ns.is_some_and(|left| left < 0);
        shown.shows(Scene::BrakeByPasses, has_passed && self.session.is_some());
        if let Some(by_ns) = decision.brake_by_ns {
            let left = by_ns - now_ns;
            shown.breaks(Law::BrakeByMovesOn, self.brake_left_ns.is_some_and(|old| left < old));
            self.brake_left_ns = Some(left);
        }
    }

    /// To the next period.
    pub fn time_passes(&mut self, shown: &mut Shown) {
        self.barred = (self.barred - 1).max(0);
        self.wait = (self.wait - 1).max(0);
        self.brake_left_ns = self.brake_left_ns.map(|it| (it - PERIOD_NS).max(-PERIOD_NS));
        if let Some(seen) = &mut self.session {
            seen.element = seen.element.map(|age| (age + 1).min(fitted(MAX_AGE + 1)));
            seen.without += 1;
            seen.first = seen.first.map(|it| (it + 1).min(fitted(LONG)));
            shown.breaks(Law::LeftInTime, i64::from(seen.without) > LONGEST);
        }
    }
}

/// The number of the session that runs.
fn running(answer: &Answer, group: Group) -> Option<i64> {
    let state = match group {
        Group::Mot => answer.mot,
        Group::Plan => answer.plan,
    };
    match state {
        GroupState::Remote { session, .. } => Some(session),
        GroupState::Local | GroupState::Requested { .. } => None,
    }
}
