//! What a monitor is started with, and what is refused (`spec/monitor.md`, settings and memory).

use crate::input::cycle::Route;
use crate::input::domain::{check_parameters, check_route};
use crate::input::parameters::Parameters;
use crate::input::profile::{HardenedRule, Profile};
use crate::monitor::history;
use crate::numbers::real::Real;
use crate::offloading::requester;
use crate::report::InvalidInput;

/// ns
const MILLISECOND: i64 = 1_000_000;
const SECOND: i64 = 1_000_000_000;

/// What a monitor is started with.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters of the stages.
    pub parameters: Parameters,
    /// Parameters of the requester.
    pub requester: requester::Parameters,
    /// The nominal period of cycles and results, ns.
    pub period_ns: i64,
    /// Sessions are numbered on from this number. [MON-28]
    pub last_session: i64,
    /// Whether the CAV's own trajectory is examined where everything is local. [MON-47]
    pub supervise_local: bool,
    /// When PLAN is given back; `None` is never. [MON-54]
    pub stall: Option<Stall>,
    /// How much fits.
    pub memory: Memory,
}

/// A way and a time: PLAN is given back where the CAV gets no farther in this time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stall {
    /// m
    pub way: f64,
    /// ns
    pub time_ns: i64,
}

/// Places of the memory that is lent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    /// For the tracks of a list.
    pub tracks: i64,
    /// For the detections of a list.
    pub detections: i64,
    /// For the cross sections of the route.
    pub cross_sections: i64,
}

/// Whether there is a place for each item.
pub fn fits<T>(items: &[T], places: i64) -> bool {
    i64::try_from(items.len()).is_ok_and(|count| count <= places)
}

impl Settings {
    /// The first setting that is refused. [MON-18] [MON-21] to [MON-27], [MON-29], [MON-60], [MON-62]
    pub fn check(&self, route: &Route) -> Result<(), InvalidInput> {
        self.check_parameters()?;
        self.check_times()?;
        let Self { last_session, stall, memory, .. } = *self;
        asked(
            (0..i64::MAX).contains(&last_session),
            "last_session",
            "must be from 0 to 2^63 - 2: a session follows it",
        )?;
        if let Some(Stall { way, time_ns }) = stall {
            asked(way.is_finite() && way >= 0.0, "stall.way", "must be a number of m from 0 on")?;
            asked(time_ns >= SECOND, "stall.time_ns", "must be 1 s or more")?;
        }
        asked(memory.tracks > 0, "memory.tracks", "must have a place for a track")?;
        let has_place = !history::is_kept(self.profile) || memory.detections > 0;
        asked(has_place, "memory.detections", "must have a place for a detection")?;
        check_route(route)?;
        let has_places = fits(&route.cross_sections, memory.cross_sections);
        asked(has_places, "route.stations", "are more than the memory has places for")
    }

    /// [MON-23]
    fn check_parameters(&self) -> Result<(), InvalidInput> {
        check_parameters(&self.parameters)?;
        match self.requester.first_outside_domain() {
            None => Ok(()),
            Some(name) => asked(false, &format!("parameters.{name}"), "must be 0 ns or more"),
        }
    }

    fn check_times(&self) -> Result<(), InvalidInput> {
        let Self { parameters, requester, period_ns, .. } = self;
        asked(*period_ns > 0, "period_ns", "must be above 0 ns")?;
        // [MON-24]
        let times = [
            ("period_ns", *period_ns),
            ("parameters.max_age_ns", parameters.max_age_ns),
            ("parameters.step_max_ns", parameters.step_max_ns),
            ("parameters.t_wait_ns", requester.t_wait_ns),
            ("parameters.request_timeout_ns", requester.request_timeout_ns),
            ("parameters.l_max_ns", requester.l_max_ns),
            ("parameters.dt_max_ns", requester.dt_max_ns),
        ];
        for (name, time_ns) in times {
            let is_time = time_ns == 0 || time_ns >= MILLISECOND;
            asked(is_time, name, "must be 0 or at least 1 ms, in ns")?;
        }
        // [MON-25]
        let is_wait = requester.t_wait_ns == 0 || requester.t_wait_ns >= SECOND;
        asked(is_wait, "parameters.t_wait_ns", "must be 0 or at least 1 s, in ns")?;
        // [MON-22]
        let is_patient = requester.dt_max_ns > *period_ns;
        asked(is_patient, "parameters.dt_max_ns", "must be above the nominal period")?;
        // [MON-26]
        let is_of_use = parameters.max_age_ns >= requester.l_max_ns;
        asked(is_of_use, "parameters.max_age_ns", "must be at least l_max")?;
        // [MON-27]
        let period = Real::seconds(i128::from(*period_ns)).to_f64();
        let reacts = !self.profile.has(HardenedRule::H14) || parameters.tau > period;
        asked(reacts, "parameters.tau", "must be above the nominal period")
    }
}

fn asked(holds: bool, field: &str, message: &str) -> Result<(), InvalidInput> {
    if holds {
        return Ok(());
    }
    Err(InvalidInput {
        field: field.to_owned(),
        index: None,
        message: format!("{field} {message}"),
    })
}
