//! Whether somebody looks for silence (`spec/monitor.md`, ticks).

use crate::report::InvalidInput;

/// The last tick since the last cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Ticks(Option<i64>);

impl Ticks {
    /// A tick.
    pub fn tick(&mut self, t_ns: i64) {
        self.0 = Some(t_ns);
    }

    /// A cycle: whether the last tick is in time for it. Ticks count anew behind it. [MON-45]
    pub fn cycle(&mut self, t_ns: i64, dt_max_ns: i64) -> bool {
        let before = |tick_ns| i128::from(t_ns) - i128::from(tick_ns);
        self.0.take().is_some_and(|tick_ns| (0..=i128::from(dt_max_ns)).contains(&before(tick_ns)))
    }
}

/// The error of a cycle whose last tick is not in time. [MON-46]
pub fn error() -> InvalidInput {
    let message = "a tick is needed since the cycle before, at most dt_max before the cycle";
    InvalidInput { field: "tick".into(), index: None, message: message.into() }
}
