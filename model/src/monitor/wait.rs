//! The two waits of a session, as a small state machine (`spec/monitor.md`, the wait after a session):
//! its table stands there, and each function is a row.

use super::starvation::is_starved;

/// What is remembered of the use of a running session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Use {
    /// The time that silence counts from: of the last cycle that had a current element, or of the
    /// confirmation; lowered by a clock that is set back.
    pub since_ns: i64,
    /// The first cycle that had one; lowered likewise.
    pub first_ns: Option<i64>,
    /// Whether the group is starved.
    pub starved: bool,
}

impl Use {
    /// A session that is confirmed.
    pub fn confirmed(t_ns: i64) -> Self {
        Self { since_ns: t_ns, first_ns: None, starved: false }
    }

    /// A cycle at this time, which has a current element of the group or has none.
    /// [MON-31] [MON-33] [MON-35] to [MON-37]
    #[must_use]
    pub fn after_cycle(self, t_ns: i64, has_current: bool, dt_max_ns: i64) -> Self {
        let first_ns = self.first_ns.map(|first_ns| first_ns.min(t_ns));
        if has_current {
            return Self { since_ns: t_ns, first_ns: first_ns.or(Some(t_ns)), starved: false };
        }
        let starved = is_starved(self.starved, self.since_ns, t_ns, dt_max_ns);
        Self { since_ns: self.since_ns.min(t_ns), first_ns, starved }
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
