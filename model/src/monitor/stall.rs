//! A station whose trajectory leads nowhere (`spec/monitor.md`, where planning gets nowhere).

use super::settings::Stall;
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;

/// How long planning has been remote while the CAV got no farther.
#[derive(Clone, Debug)]
pub struct Progress {
    /// The place of the last cycle that was farther than the way from the one before it, m.
    mark: Vector,
    /// ns
    remote_ns: i128,
    /// Time of the last cycle, if PLAN was remote after it.
    last_remote_ns: Option<i64>,
    /// When PLAN was given back last, ns. [MON-59]
    pub given_back_ns: Option<i64>,
}

impl Progress {
    /// At the start the mark is the origin of the frame. [MON-55]
    pub fn new() -> Self {
        let mark = Vector::from_doubles(0.0, 0.0);
        Self { mark, remote_ns: 0, last_remote_ns: None, given_back_ns: None }
    }

    /// A cycle finds the CAV at a place, m. [MON-55]
    pub fn found_at(&mut self, stall: &Stall, place: &Vector) {
        if place.distance(&self.mark) > Real::from_double(stall.way) {
            self.mark = place.clone();
            self.remote_ns = 0;
        }
    }

    /// A cycle after which PLAN is remote or is not. [MON-56]
    pub fn after_cycle(&mut self, t_ns: i64, plan_is_remote: bool) {
        if let Some(last_ns) = self.last_remote_ns.filter(|_| plan_is_remote) {
            self.remote_ns += (i128::from(t_ns) - i128::from(last_ns)).max(0);
        }
        self.last_remote_ns = plan_is_remote.then_some(t_ns);
    }

    /// Whether the remote time has reached that of `stall`. [MON-54]
    pub fn is_stalled(&self, stall: &Stall) -> bool {
        self.remote_ns >= i128::from(stall.time_ns)
    }

    /// PLAN is given back at a tick. [MON-55] [MON-59]
    pub fn give_back(&mut self, t_ns: i64) {
        self.remote_ns = 0;
        self.given_back_ns = Some(t_ns);
    }
}

impl Default for Progress {
    fn default() -> Self {
        Self::new()
    }
}
