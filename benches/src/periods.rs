//! Periods of the requester with both groups on one station (`spec/2-offloading.md`).

use mufasa::input::profile::Profile;
use mufasa::offloading::requester::{
    Event, EventKind, GroupState, Parameters, Requester, Sessions, StationRecord,
};
use mufasa::services::configuration::{Configuration, Group, Groups};

/// 20 Hz, ns.
const PERIOD_NS: i64 = 50_000_000;

/// A requester that is given what a drive gives it, with a clock of its own.
pub struct Periods<'a> {
    requester: Requester<'a>,
    now_ns: i64,
}

impl<'a> Periods<'a> {
    /// Both groups remote, default times.
    ///
    /// # Panics
    /// If the station is refused or does not run both groups.
    pub fn new(profile: Profile, table: &'a mut [StationRecord]) -> Self {
        let requester = Requester::new(profile, Parameters::default(), table)
            .expect("the defaults are in the domain");
        let mut it = Self { requester, now_ns: 0 };
        it.step(EventKind::Offer { station: 1, groups: Groups::ALL });
        it.ask();
        it
    }

    /// A tick, an element of each group, and a safe verdict on them.
    ///
    /// # Panics
    /// If a group is not remote.
    pub fn period(&mut self) {
        self.now_ns += PERIOD_NS;
        self.step(EventKind::Tick);
        for group in Group::ALL {
            let GroupState::Remote { station, session } = self.requester.state(group) else {
                panic!("{group:?} is not remote");
            };
            let generated_ns = self.now_ns - 1;
            self.step(EventKind::Data { station, group, session, generated_ns });
        }
        let [mot, plan] = Group::ALL.map(|group| match self.requester.state(group) {
            GroupState::Remote { session, .. } => Some(session),
            GroupState::Local | GroupState::Requested { .. } => None,
        });
        self.step(EventKind::Verdict { safe: true, sessions: Sessions { mot, plan } });
    }

    /// An unsafe verdict, the end of the waiting time, and both groups remote again.
    ///
    /// # Panics
    /// If a group is not remote at the end.
    pub fn fallback(&mut self) {
        self.step(EventKind::Verdict { safe: false, sessions: Sessions::NONE });
        self.now_ns = self.requester.hold_until_ns().expect("a fallback holds");
        self.ask();
    }

    /// A tick that asks, and the confirmations.
    fn ask(&mut self) {
        self.step(EventKind::Tick);
        for group in Group::ALL {
            if let GroupState::Requested { station, session, .. } = self.requester.state(group) {
                self.step(EventKind::Confirm { station, group, session });
            }
        }
        assert_eq!(self.requester.configuration(), Configuration::AllRemote);
    }

    fn step(&mut self, kind: EventKind) {
        let event = Event { t_ns: self.now_ns, kind };
        let _done = self.requester.step(&event).expect("the station is known");
    }
}
