//! Whether control gets anything of a remote group (`spec/monitor.md#monitor`).

/// What the cycles of the running session of a group could use.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Served {
    session: Option<i64>,
    /// The first cycle that had a current element.
    first_ns: Option<i64>,
    /// The last cycle that had a current element, or when the session began to run.
    last_ns: i64,
    is_starved: bool,
}

impl Served {
    /// A session that runs since this time, or none.
    pub(super) const fn since(now_ns: i64, session: Option<i64>) -> Self {
        Self { session, first_ns: None, last_ns: now_ns, is_starved: false }
    }

    /// The session that runs.
    pub(super) const fn session(&self) -> Option<i64> {
        self.session
    }

    /// When a station may be asked again if the session ends now: 9 times as long after it as nothing of
    /// it was current, that being 1 period at least, less the time for which the session was of use; `None`
    /// where nothing is left. All in ns.
    pub(super) fn again_ns(&self, now_ns: i64, period_ns: i64) -> Option<i64> {
        let first_ns = self.first_ns.unwrap_or(self.last_ns);
        // In 128 bits none of this can overflow.
        let [now_ns, first_ns, last_ns, period_ns] =
            [now_ns, first_ns, self.last_ns, period_ns].map(i128::from);
        let without_ns = now_ns.saturating_sub(last_ns).max(period_ns);
        let of_use_ns = last_ns.saturating_sub(first_ns);
        let wait_ns = without_ns.saturating_mul(9).saturating_sub(of_use_ns);
        let again_ns = i64::try_from(now_ns.saturating_add(wait_ns)).unwrap_or(i64::MAX);
        (wait_ns > 0).then_some(again_ns)
    }

    /// A cycle in which an element of the session was current, or none. After a clock was set back, time
    /// counts from there. In a group that is local this means nothing: a session begins anew.
    pub(super) fn cycle(&mut self, now_ns: i64, has_current: bool, dt_max_ns: i64) {
        if has_current {
            self.first_ns = self.first_ns.or(Some(now_ns));
            self.last_ns = now_ns;
        }
        self.first_ns = self.first_ns.map(|first_ns| first_ns.min(now_ns));
        self.last_ns = self.last_ns.min(now_ns);
        self.is_starved = now_ns.abs_diff(self.last_ns) > dt_max_ns.unsigned_abs();
    }

    /// Whether elements of the session are no arrivals any more.
    pub(super) const fn is_starved(&self) -> bool {
        self.is_starved
    }
}
