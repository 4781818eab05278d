//! The two waits of a session, as a small state machine (`spec/monitor.md`, the wait after a session):
//! its table stands there, and each function is a row.

/// What is remembered of the use of a running session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Use {
    /// The time that silence and waits count from: of the last cycle that had a current element, or of the
    /// confirmation.
    pub since_ns: i64,
    /// The first cycle that had one.
    pub first_ns: Option<i64>,
    /// Whether the group is starved.
    pub starved: bool,
}

impl Use {
    /// A session that is confirmed.
    pub fn confirmed(t_ns: i64) -> Self {
        Self { since_ns: t_ns, first_ns: None, starved: false }
    }

    /// A cycle that counts, at this time, which has a current element of the group or has none.
    /// [MON-31] [MON-33] [MON-35] [MON-36]
    #[must_use]
    pub fn after_cycle(self, t_ns: i64, has_current: bool, dt_max_ns: i64) -> Self {
        if has_current {
            return Self { since_ns: t_ns, first_ns: self.first_ns.or(Some(t_ns)), starved: false };
        }
        let without = i128::from(t_ns) - i128::from(self.since_ns);
        Self { starved: self.starved || without > i128::from(dt_max_ns), ..self }
    }

    /// The end of the time without a request when the group returns to local at this time; `None`: nothing
    /// is left of it. [MON-34] to [MON-36], [MON-38]
    pub fn wait_until_ns(self, t_ns: i64, period_ns: i64) -> Option<i64> {
        let since = i128::from(self.since_ns);
        let unused = (i128::from(t_ns) - since).max(i128::from(period_ns));
        let used = self.first_ns.map_or(0, |first_ns| since - i128::from(first_ns));
        let wait = 9 * unused - used;
        let end = (i128::from(t_ns) + wait).min(i128::from(i64::MAX));
        (wait > 0).then(|| i64::try_from(end).unwrap_or(i64::MAX))
    }
}
