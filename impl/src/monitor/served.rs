//! Whether control gets anything of a remote group, and when a station is asked again (`spec/monitor.md#monitor`).

use crate::offloading::requester::per_group::PerGroup;
use crate::offloading::requester::{
    ByKind, Event, EventKind, GroupState, Requester, RequesterError,
};
use crate::services::configuration::Group;

/// What the cycles of the running session of a group could use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Served {
    /// The session that runs.
    pub session: Option<i64>,
    /// The first cycle that had a current element.
    pub first_ns: Option<i64>,
    /// The last cycle that had a current element, or when the session began to run.
    pub last_ns: i64,
    /// Whether elements of the session are no arrivals any more.
    pub is_starved: bool,
}

impl Served {
    /// A session that runs since this time, or none.
    const fn since(now_ns: i64, session: Option<i64>) -> Self {
        Self { session, first_ns: None, last_ns: now_ns, is_starved: false }
    }

    /// When a station may be asked again if the session ends now: 9 times as long after it as nothing of
    /// it was current, that being 1 period at least, less the time for which the session was of use; `None`
    /// where nothing is left. All in ns.
    pub fn again_ns(&self, now_ns: i64, period_ns: i64) -> Option<i64> {
        let first_ns = self.first_ns.unwrap_or(self.last_ns);
        // In 128 bits none of this can overflow.
        let [now_ns, first_ns, last_ns, period_ns] =
            [now_ns, first_ns, self.last_ns, period_ns].map(i128::from);
        // MON-35
        let without_ns = now_ns.saturating_sub(last_ns).max(period_ns);
        // MON-36
        let of_use_ns = last_ns.saturating_sub(first_ns);
        // MON-34
        let wait_ns = without_ns.saturating_mul(9).saturating_sub(of_use_ns);
        // MON-38
        let again_ns = i64::try_from(now_ns.saturating_add(wait_ns)).unwrap_or(i64::MAX);
        (wait_ns > 0).then_some(again_ns)
    }

    /// A cycle that counts, in which an element of the session was current, or none. In a group that is local this means
    /// nothing: a session begins anew.
    pub fn cycle(&mut self, now_ns: i64, has_current: bool, dt_max_ns: i64) {
        if has_current {
            // MON-33, MON-35, MON-36
            self.first_ns = self.first_ns.or(Some(now_ns));
            self.last_ns = now_ns;
            self.is_starved = false;
        } else if now_ns > self.last_ns.saturating_add(dt_max_ns) {
            // MON-31
            self.is_starved = true;
        }
    }
}

impl PerGroup<Served> {
    /// An event of the requester, and what follows from it for the waits between sessions. `is_blind`: at this tick nothing
    /// that a station leaves out would be examined as moving. `period_ns`: the nominal period.
    ///
    /// Errors: those of the requester; then nothing has changed but holds at a tick.
    pub(crate) fn step(
        &mut self,
        requester: &mut Requester<'_>,
        event: &Event,
        is_blind: bool,
        period_ns: impl Fn() -> i64,
    ) -> Result<ByKind, RequesterError> {
        let Event { t_ns, kind } = *event;
        if matches!(kind, EventKind::Tick) {
            if is_blind {
                // MON-44
                requester.hold(t_ns.saturating_add(1));
            }
            for group in Group::ALL {
                // MON-64: a hold that begins at a tick bars the requests of that tick.
                if requester.is_silent(group, t_ns) {
                    self.get(group).hold_after(requester, t_ns, &period_ns);
                }
            }
        }
        let answer = requester.decide(event);
        let goes_on = match (&answer, kind) {
            (Err(_), _) => true,
            (Ok(_), EventKind::Verdict { safe, .. }) => safe,
            (Ok(by_kind), EventKind::Tick) => by_kind.iter().flatten().all(Option::is_none),
            (Ok(_), _) => false,
        };
        if goes_on {
            // No session has begun, and none has ended, which would be a release.
            return answer;
        }
        for group in Group::ALL {
            let session = match requester.state(group) {
                GroupState::Local | GroupState::Requested { .. } => None,
                GroupState::Remote { session, .. } => Some(session),
            };
            let served = self.get_mut(group);
            if session == served.session {
                continue;
            }
            // MON-34
            if served.session.is_some() {
                served.hold_after(requester, t_ns, &period_ns);
            }
            *served = Served::since(t_ns, session);
        }
        answer
    }
}

impl Served {
    /// The group returns to local now: its session may have been of no use for long, and the next one
    /// may be no better.
    fn hold_after(&self, requester: &mut Requester<'_>, now_ns: i64, period_ns: &impl Fn() -> i64) {
        if let Some(again_ns) = self.again_ns(now_ns, period_ns()) {
            requester.hold(again_ns);
        }
    }
}
