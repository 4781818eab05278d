//! Whether somebody looks for silence (`spec/monitor.md`, ticks).

use crate::report::InvalidInput;

/// The last cycle, and the last tick since.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Ticks {
    cycle_ns: Option<i64>,
    tick_ns: Option<i64>,
}

impl Ticks {
    /// A tick.
    pub fn tick(&mut self, t_ns: i64) {
        self.tick_ns = Some(t_ns);
    }

    /// A cycle: whether the last tick is in time for it. Ticks count anew behind it. [MON-45]
    pub fn cycle(&mut self, t_ns: i64, dt_max_ns: i64) -> bool {
        let Self { cycle_ns, tick_ns } = std::mem::take(self);
        self.cycle_ns = Some(t_ns);
        tick_ns.is_some_and(|tick_ns| {
            let before = i128::from(t_ns) - i128::from(tick_ns);
            cycle_ns.is_none_or(|cycle_ns| cycle_ns <= tick_ns)
                && (0..=i128::from(dt_max_ns)).contains(&before)
        })
    }
}

/// The error of a cycle whose last tick is not in time. [MON-46]
pub fn error() -> InvalidInput {
    let message = "a tick is needed since the cycle before, from its time on, at most dt_max ago";
    InvalidInput { field: "tick".into(), index: None, message: message.into() }
}
