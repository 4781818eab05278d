//! What a monitor is made with, and why it may be refused (`spec/monitor.md#monitor`).

use core::fmt;
use core::time::Duration;

use super::stall::Stall;
use super::time::Time;
use super::unusual::{Unusual, bits, is_unusual, rows};
use crate::cycle::steps::{Counts, LISTS, List, most_steps};
use crate::input::domain::check_parameters;
use crate::input::parameters::Parameters;
use crate::input::profile::{HardenedRule, Profile};
use crate::offloading::requester::{self, RequesterError};
use crate::report::InvalidInput;

/// The shortest time above 0 that is taken for one in nanoseconds: no period, latency or age of a vehicle
/// is shorter, and each of these in milliseconds or microseconds is, up to 1000 s and 1 s.
const LEAST_NS: i64 = 1_000_000;
/// The same for `t_wait`: after a safety issue nobody waits for less, and seconds in microseconds or
/// milliseconds are less, up to 10^6 s and 1000 s.
const LEAST_WAIT_NS: i64 = 1_000_000_000;

/// What a monitor is made with. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters of the stages.
    pub stages: Parameters,
    /// Times of the requester.
    pub requester: requester::Parameters,
    /// The nominal period of the cycles and of the remote's results, above 0. `requester.dt_max_ns` has to be above it:
    /// at equality one nanosecond of jitter ends the session; and in the hardened profile `stages.tau` has to
    /// be at least 2.5 of it, unless less is meant.
    pub period: Duration,
    /// At least the last session of the monitor's earlier lives, from 0 to 2^63 - 2: sessions of this one are
    /// numbered on from there, so that no message of an earlier life fits. A number stored at the last
    /// request will do, or a counter of starts times 2^32; 0 for a first life.
    pub sessions_before: i64,
    /// Whether the CAV's own plan is examined in `Local`, and the decision says [`Brake`](super::Brake) while it fails
    /// (F-48). It costs a second run of the stages in a cycle that is unsafe.
    pub supervise_local: bool,
    /// When planning that gets nowhere is given back (F-45); `None`, as by default: never.
    pub stall: Option<Stall>,
    /// How long a cycle may take: what may take longer is refused, by [`Monitor::new`](super::Monitor::new) or,
    /// where no memory bounds it, by the cycle.
    pub check_time: Duration,
    /// What a step costs on this processor, ps: [`Monitor::calibrate`](super::Monitor::calibrate).
    pub step_ps: u64,
    /// What is meant although it is unusual: [`Settings::meaning`], [`Settings::in_any_range`].
    pub meant: u32,
}

impl Settings {
    /// The hardened profile and the defaults of the paper, in a first life, with two exceptions. `requester.dt_max_ns`
    /// is two periods and 20 ms of jitter: one lost message ends no session. `stages.tau` is three periods and 0.1 s for
    /// the brake: the vehicle's own is to be measured. Source: `spec/monitor.md#monitor`.
    pub fn new(period: Duration) -> Self {
        let tau = period.saturating_mul(3).saturating_add(Duration::from_millis(100));
        // DOM-02
        let tau = tau.min(Duration::from_secs(60)).as_secs_f64();
        let dt_max = period.saturating_mul(2).saturating_add(Duration::from_millis(20));
        let dt_max_ns = i64::try_from(dt_max.as_nanos()).unwrap_or(i64::MAX);
        Self {
            profile: Profile::HARDENED,
            stages: Parameters { tau, ..Parameters::default() },
            requester: requester::Parameters { dt_max_ns, ..requester::Parameters::default() },
            period,
            sessions_before: 0,
            supervise_local: false,
            stall: None,
            check_time: Duration::from_millis(15),
            step_ps: 1000,
            meant: 0,
        }
    }

    /// The same for who does not mind how long a cycle takes: nothing is refused for its length. Source:
    /// `spec/4-arithmetic.md#steps`.
    #[must_use]
    pub const fn in_any_time(self) -> Self {
        Self { check_time: Duration::MAX, ..self }
    }

    /// The settings outside of their usual ranges, meant or not. Source:
    /// `spec/4-arithmetic.md#usual-settings`.
    pub fn unusual(&self) -> impl Iterator<Item = Unusual> {
        self.rows().into_iter().filter(is_unusual)
    }

    /// The same, with a setting that is meant although it is unusual: "stages.a_b", or "a_b" alone. A name that there
    /// is not means nothing. Source: `spec/4-arithmetic.md#usual-settings`.
    #[must_use]
    pub fn meaning(self, field: &str) -> Self {
        Self { meant: self.meant | Self::bit_of(field), ..self }
    }

    /// The same for who wants the whole domain: nothing is refused for being unusual. Source:
    /// `spec/4-arithmetic.md#usual-settings`.
    #[must_use]
    pub const fn in_any_range(self) -> Self {
        Self { meant: u32::MAX, ..self }
    }

    /// What `meant` has of a setting; 0 of a name that there is not. Source:
    /// `spec/4-arithmetic.md#usual-settings`.
    pub fn bit_of(field: &str) -> u32 {
        let rows = Self::new(Duration::ZERO).rows();
        // No `rsplit`, which calls itself in `core`.
        let ends = |name: &str| name.strip_suffix(field).is_some_and(|it| it.ends_with('.'));
        let is_named = |name: &str| name == field || ends(name);
        bits().zip(rows).find(|(_, row)| is_named(row.field)).map_or(0, |(bit, _)| bit)
    }

    fn rows(&self) -> [Unusual; 24] {
        let least_tau = if self.stops() { 2.5 * self.period.as_secs_f64() } else { 0.0 };
        rows(&self.stages, &self.requester, self.period, self.step_ps, least_tau)
    }

    /// Whether a rule reckons the way to stop, which needs `tau`.
    fn stops(&self) -> bool {
        self.profile.has(HardenedRule::H04) || self.profile.has(HardenedRule::H14)
    }

    /// Whether a monitor may be made with it, apart from its memory.
    ///
    /// Errors: the first of these settings that no monitor keeps. Source:
    /// `spec/monitor.md#monitor`.
    pub fn check(&self) -> Result<(), MonitorError> {
        // MON-23
        check_parameters(&self.stages).map_err(MonitorError::Stages)?;
        let dt_max_ns = self.requester.dt_max_ns;
        // MON-62
        if self.period.is_zero() {
            return Err(MonitorError::NoPeriod);
        }
        // MON-24, MON-25
        if let Some((field, ns)) = self.too_short() {
            return Err(MonitorError::TimeTooShort { field, ns });
        }
        let [max_age_ns, l_max_ns] = [self.stages.max_age_ns, self.requester.l_max_ns];
        // MON-26
        if max_age_ns < l_max_ns {
            return Err(MonitorError::MaxAgeBelowLMax { max_age_ns, l_max_ns });
        }
        // MON-22; a negative dt_max is refused by the requester.
        if u128::try_from(dt_max_ns).is_ok_and(|dt_max_ns| dt_max_ns <= self.period.as_nanos()) {
            return Err(MonitorError::DtMaxNotAbovePeriod { dt_max_ns, period: self.period });
        }
        let tau = self.stages.tau;
        // MON-27: the way to stop is reckoned from one cycle to the next that can fail.
        if self.stops() && tau <= self.period.as_secs_f64() {
            return Err(MonitorError::TauNotAbovePeriod { tau, period: self.period });
        }
        // MON-29; A-17
        if !(0..i64::MAX).contains(&self.sessions_before) {
            return Err(MonitorError::SessionsBefore { sessions_before: self.sessions_before });
        }
        // MON-60
        if let Some(Stall { way_m, time }) = self.stall {
            let is_way = (0.0..f64::INFINITY).contains(&way_m);
            if !is_way || time.as_nanos() < u128::from(LEAST_WAIT_NS.unsigned_abs()) {
                return Err(MonitorError::Stall { way_m, time });
            }
        }
        if self.meant == u32::MAX {
            return Ok(());
        }
        // IMPL-14; a time below 0 is refused by the requester.
        let mut rows = bits().zip(self.rows()).filter(|(_, row)| row.value >= 0.0);
        let not_meant = rows.find(|(bit, row)| self.meant & bit == 0 && is_unusual(row));
        not_meant.map_or(Ok(()), |(_, row)| Err(MonitorError::Unusual(row)))
    }
}

impl Settings {
    /// Until when what a cycle examines covers the CAV: `tau` after it, which the paper profile does not have.
    #[allow(clippy::cast_possible_truncation, reason = "rounded down; times saturate")]
    pub(crate) fn brake_by(&self, now_ns: i64) -> Option<Time> {
        // MON-40
        let tau_ns = (self.stages.tau * 1e9) as i64;
        let by = || Time::from_nanoseconds(now_ns.saturating_add(tau_ns));
        // MON-41
        self.profile.has(HardenedRule::H14).then(by)
    }

    /// The most steps that a run of the stages may take: a cycle may run them twice where it supervises.
    pub(super) fn steps_in_time(&self) -> u64 {
        //
        let ps = self.check_time.as_nanos().saturating_mul(1000);
        let steps = ps.checked_div(u128::from(self.step_ps)).unwrap_or(u128::MAX);
        let steps = if self.supervise_local { steps >> 1 } else { steps };
        u64::try_from(steps).unwrap_or(u64::MAX)
    }

    /// Whether what fits into memory for so many tracks, detections, cross sections and stations is checked in time,
    /// with 64 messages and a new route between two cycles, 128 points, the places at 30 m/s and cells of 0.2 m; what is more of these, the cycle refuses where all
    /// is too much.
    ///
    /// Errors: which of the lists is too long. Source: `spec/4-arithmetic.md#steps`.
    pub fn check_lists(
        &self,
        tracks: usize,
        detections: usize,
        cross_sections: usize,
        stations: usize,
    ) -> Result<(), MonitorError> {
        self.in_time([tracks, detections, cross_sections, stations]).map(drop)
    }

    /// The same, and how long everything may be.
    pub(super) fn in_time(&self, lent: [usize; 4]) -> Result<Counts, MonitorError> {
        let counts = Counts::lent(self.profile, lent);
        self.check_steps(&counts, LISTS.get(..lent.len()).unwrap_or(&LISTS))?;
        Ok(counts)
    }

    /// Whether so much is checked in time; if not, which list of these is too long.
    pub(super) fn check_steps(&self, counts: &Counts, among: &[List]) -> Result<(), MonitorError> {
        let (in_time, stages) = (self.steps_in_time(), &self.stages);
        let steps = most_steps(counts, stages).total();
        if steps <= in_time {
            return Ok(());
        }
        // IMPL-12
        let too_long = counts.too_long(stages, in_time, among);
        let (list, given, most) = too_long.unwrap_or(("check_time", 0, 0));
        Err(MonitorError::TooSlow { list, given, most, steps, most_steps: in_time })
    }

    /// The nominal period of the remote's results, saturated.
    pub(super) fn period_ns(&self) -> i64 {
        i64::try_from(self.period.as_nanos()).unwrap_or(i64::MAX)
    }

    /// The first time above 0 and below the least that a vehicle has, ns. Exactly 0 is no slip of a unit.
    fn too_short(&self) -> Option<(&'static str, i64)> {
        let requester::Parameters { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, .. } =
            self.requester;
        let times = [
            ("period", self.period_ns()),
            ("stages.max_age_ns", self.stages.max_age_ns),
            ("stages.step_max_ns", self.stages.step_max_ns),
            ("requester.t_wait_ns", t_wait_ns),
            ("requester.request_timeout_ns", request_timeout_ns),
            ("requester.l_max_ns", l_max_ns),
            ("requester.dt_max_ns", dt_max_ns),
        ];
        times.into_iter().find(|(field, ns)| 0 < *ns && *ns < least_ns(field))
    }
}

/// The shortest time above 0 that a setting may have, ns.
fn least_ns(field: &str) -> i64 {
    if field == "requester.t_wait_ns" { LEAST_WAIT_NS } else { LEAST_NS }
}

/// Why a monitor could not be made. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MonitorError {
    /// A parameter of the stages is outside its domain.
    Stages(InvalidInput),
    /// A time of the requester is below 0.
    Requester(RequesterError),
    /// The nominal period is 0.
    NoPeriod,
    /// A time above 0 and below 1 ms, or a `t_wait` above 0 and below 1 s: it is taken for one in another
    /// unit.
    TimeTooShort {
        /// The setting.
        field: &'static str,
        /// What was given, ns.
        ns: i64,
    },
    /// `stages.max_age_ns` is below `requester.l_max_ns`: of what arrives in time some would be too old for
    /// every cycle.
    MaxAgeBelowLMax {
        /// Largest age of what a cycle uses, ns.
        max_age_ns: i64,
        /// Largest latency that is no violation, ns.
        l_max_ns: i64,
    },
    /// `requester.dt_max_ns` is not above the nominal period.
    DtMaxNotAbovePeriod {
        /// Largest inter-arrival time that is no violation, ns.
        dt_max_ns: i64,
        /// The nominal period.
        period: Duration,
    },
    /// `stages.tau` is not above the nominal period, in the hardened profile.
    TauNotAbovePeriod {
        /// Longest time from `now` of a cycle to braking with at least `a_b`, s.
        tau: f64,
        /// The nominal period.
        period: Duration,
    },
    /// `sessions_before` is below 0, or 2^63 - 1, after which there is no session.
    SessionsBefore {
        /// What was given.
        sessions_before: i64,
    },
    /// `stall` has a way that is negative or no number, or a time below 1 s.
    Stall {
        /// m.
        way_m: f64,
        /// What was given.
        time: Duration,
    },
    /// A setting is outside of its usual range, and not named as meant ([`Settings::meaning`]).
    Unusual(Unusual),
    /// A slice of the memory that is lent has too few elements.
    Memory {
        /// The slice.
        field: &'static str,
        /// How many it needs.
        needed: usize,
        /// How many it has.
        given: usize,
    },
    /// What fits into the memory that is lent may take longer than `check_time`.
    TooSlow {
        /// The list that is too long.
        list: &'static str,
        /// How long it may become.
        given: u32,
        /// How long it may be while all others are as they are; 0 where it alone does not help.
        most: u32,
        /// The steps that a run of the stages may take.
        steps: u64,
        /// And that it may take in `check_time`.
        most_steps: u64,
    },
}

impl fmt::Display for MonitorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Stages(problem) => write!(f, "settings.stages: {problem}"),
            Self::Requester(error) => write!(f, "settings.requester: {error}"),
            Self::NoPeriod => {
                f.write_str("settings.period is 0; give the nominal period of the remote's results")
            }
            Self::TimeTooShort { field, ns } => write!(
                f,
                "settings.{field} = {ns} ns is below {}; is it in another unit? Give nanoseconds",
                if least_ns(field) == LEAST_NS { "1 ms" } else { "1 s" }
            ),
            Self::MaxAgeBelowLMax { max_age_ns, l_max_ns } => write!(
                f,
                "settings.stages.max_age_ns = {max_age_ns} is below settings.requester.l_max_ns = \
                 {l_max_ns}: a result of that latency is in time, and older than any cycle uses; give \
                 max_age_ns at least l_max_ns and the longest time from an arrival to its cycle"
            ),
            Self::DtMaxNotAbovePeriod { dt_max_ns, period } => write!(
                f,
                "settings.requester.dt_max_ns = {dt_max_ns} is not above settings.period = {} ns, \
                 so that any jitter ends the session; give two periods and the largest jitter, with \
                 which one lost message ends no session, or at least the period and that jitter",
                period.as_nanos()
            ),
            Self::TauNotAbovePeriod { tau, period } => write!(
                f,
                "settings.stages.tau = {tau} s is not above settings.period = {} s: the next cycle is \
                 the first that can fail; give the period, and the time from that cycle to full braking",
                period.as_secs_f64()
            ),
            Self::SessionsBefore { sessions_before } => write!(
                f,
                "settings.sessions_before = {sessions_before} is not from 0 to 2^63 - 2; give the last \
                 session of earlier lives, or 0"
            ),
            Self::Stall { way_m, time } => write!(
                f,
                "settings.stall: {way_m} m in {} s is no way from 0 m on in at least 1 s; give the longest \
                 stop that a station's planning may make, or None",
                time.as_secs_f64()
            ),
            Self::Unusual(unusual) => unusual.fmt(f),
            Self::TooSlow { list, given, most, steps, most_steps } => write!(
                f,
                "{list}: memory for {given} is too much by {}: a cycle may take {steps} steps, and \
                 settings.check_time has room for {most_steps}; lend less, lower stages.work_limit, give \
                 more time, or the measured step_ps",
                given.saturating_sub(most)
            ),
            Self::Memory { field, needed, given } => {
                write!(f, "memory.{field} has {given} elements; lend at least {needed}")?;
                match field {
                    "rows" | "columns" => f.write_str(": scratch::Sizes::for_cycle says how many"),
                    "detections" => f.write_str(": Memory::detections_for says how many"),
                    "slots" => f.write_str(": Memory::slots_for says how many"),
                    _ => Ok(()),
                }
            }
        }
    }
}

impl core::error::Error for MonitorError {}
