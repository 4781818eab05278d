//! Planning that gets nowhere (`spec/monitor.md#monitor`, F-45).

use core::time::Duration;

use super::time::Time;

/// When a station's planning gets nowhere. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stall {
    /// How far the CAV's reference point has to get, m, at least 0.
    pub way_m: f64,
    /// For how long PLAN is remote meanwhile before it is given back, at least 1 s.
    pub time: Duration,
}

impl Default for Stall {
    /// 1 m in 30 s: longer than most wait at a junction; at a red light that is longer planning is given back, and
    /// asked for again after t_wait. Source: `spec/monitor.md#monitor`.
    fn default() -> Self {
        Self { way_m: 1.0, time: Duration::from_secs(30) }
    }
}

/// How long the CAV has got nowhere.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Progress {
    /// The place that it has not left since.
    pub(crate) place: [f64; 2],
    /// For how long PLAN has been remote since, ns.
    pub(crate) remote_ns: i64,
    /// The last cycle, where PLAN was remote in it.
    pub(crate) last_ns: Option<i64>,
    pub(crate) given_back: Option<Time>,
}

impl Progress {
    /// A cycle that found the CAV at a place, after which PLAN is remote or not.
    pub(crate) fn cycle(
        &mut self,
        now_ns: i64,
        place: Option<[f64; 2]>,
        is_remote: bool,
        way_m: f64,
    ) {
        let is_beyond = |[x, y]: &[f64; 2]| {
            let [dx, dy] = [x - self.place[0], y - self.place[1]];
            dx * dx + dy * dy > way_m * way_m
        };
        // MON-55
        if let Some(place) = place.filter(is_beyond) {
            (self.place, self.remote_ns) = (place, 0);
        }
        // MON-56
        let since_ns = self.last_ns.map_or(0, |last_ns| now_ns.saturating_sub(last_ns));
        self.last_ns = is_remote.then_some(now_ns);
        if is_remote {
            self.remote_ns = self.remote_ns.saturating_add(since_ns.max(0));
        }
    }
}
