//! Whether control gets anything of a remote group (`spec/5-interfaces.md#monitor`).

use crate::offloading::requester::Running;

/// What the cycles of the running session of a group could use.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Served {
    session: Option<i64>,
    /// The last cycle that had a current element, or when the session began to run.
    last_ns: i64,
    is_starved: bool,
}

impl Served {
    /// What runs after an event at this time.
    pub(super) fn runs(&mut self, now_ns: i64, running: Option<Running>) {
        let session = running.map(|it| it.session);
        if self.session != session {
            *self = Self { session, last_ns: now_ns, is_starved: false };
        }
    }

    /// Whether a session ran that does not any more.
    pub(super) fn has_ended(&self, running: Option<Running>) -> bool {
        self.session.is_some() && self.session != running.map(|it| it.session)
    }

    /// When a station may be asked again if the session ends now: 9 times as long after it as nothing of
    /// it was current, and at least 9 periods. All in ns.
    pub(super) fn again_ns(&self, now_ns: i64, period_ns: i64) -> i64 {
        // In 128 bits none of this can overflow.
        let [now_ns, last_ns, period_ns] = [now_ns, self.last_ns, period_ns].map(i128::from);
        let without_ns = now_ns.saturating_sub(last_ns).max(period_ns);
        let again_ns = now_ns.saturating_add(without_ns.saturating_mul(9));
        i64::try_from(again_ns).unwrap_or(i64::MAX)
    }

    /// A cycle in which an element of the session was current, or none. After a clock was set back, time
    /// counts from there. In a group that is local this means nothing: a session begins anew.
    pub(super) fn cycle(&mut self, now_ns: i64, has_current: bool, dt_max_ns: i64) {
        if has_current {
            self.last_ns = now_ns;
        }
        self.last_ns = self.last_ns.min(now_ns);
        self.is_starved = now_ns.abs_diff(self.last_ns) > dt_max_ns.unsigned_abs();
    }

    /// Whether elements of the session are no arrivals any more.
    pub(super) const fn is_starved(&self) -> bool {
        self.is_starved
    }
}
