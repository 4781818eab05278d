//! Processor time of what runs on the CAV.

use std::time::Duration;

use cpu_time::ThreadTime;

/// What is measured apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// MOT.
    Mot,
    /// ENV and TPL.
    Plan,
    /// Requester, monitor and stages; without coding of messages.
    Guard,
}

/// The time of each part since the start of the run. No result depends on it, and it is another one in each
/// run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    spent: [Duration; 3],
}

impl Cost {
    /// Does something, and adds the processor time of this thread.
    pub fn of<T>(&mut self, part: Part, does: impl FnOnce() -> T) -> T {
        let start = ThreadTime::now();
        let done = does();
        self.spent[part as usize] += start.elapsed();
        done
    }

    /// The time of a part.
    pub const fn spent(&self, part: Part) -> Duration {
        self.spent[part as usize]
    }
}
