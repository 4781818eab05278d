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
