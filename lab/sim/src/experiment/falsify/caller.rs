//! Who is told how far a search is, and says whether it goes on.

/// How far it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// A run with attacks was made.
    Run,
    /// Runs were looked at: least time left up to now, s, and collisions.
    Looked(f64, u64),
}

/// Who is told how far it is, and says whether it is to go on.
pub trait Caller: Sync {
    /// How far it is.
    fn tell(&self, _: Progress) {}

    /// Asked between two batches of runs.
    fn goes_on(&self) -> bool {
        true
    }

    /// Whether all is to end at once: no other run is begun, and what was found is shrunk no further.
    fn is_interrupted(&self) -> bool {
        false
    }

    /// What the search takes for the least: the time left, s, and less than any for a collision.
    fn worth(&self, time_left_s: f64) -> f64 {
        time_left_s
    }
}

/// Nobody is told.
impl Caller for () {}
