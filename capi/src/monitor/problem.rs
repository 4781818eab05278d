//! Which field a status is about.

use core::ffi::c_char;

use mufasa::input::parameters::Parameters;
use mufasa::monitor::{MonitorError, Unusual};
use mufasa::offloading::requester::{Requester, RequesterError};
use mufasa::report::InvalidInput;

use super::place::{MufasaMonitor, Sizes};
use super::settings::{MufasaMonitorSettings, refused};
use crate::cycle::MufasaProfile;
use crate::memory::{put, required};
use crate::report::{self, MUFASA_TEXT_BYTES, MufasaInvalidInput};
use crate::status::MufasaStatus;

/// What is wrong with settings. The texts are empty when nothing is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaSettingsProblem {
    /// Dotted path of the field; `parameters.x` names the field `x` of `stages`.
    pub field: [c_char; MUFASA_TEXT_BYTES],
    /// What is wrong and what would be right.
    pub message: [c_char; MUFASA_TEXT_BYTES],
    /// What was given, in the unit of the field (the period of UNUSUAL: s), or NAN where the message says it.
    pub value: f64,
    /// The limit below while the other fields are as they are, or NAN.
    pub least: f64,
    /// The limit above, or NAN.
    pub most: f64,
}

/// What `mufasa_monitor_init` says of these settings, whatever the memory, and writes which field is wrong
/// and what would be right; empty texts when none is.
///
/// # Safety
/// `settings` is null or points to settings; `problem` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_settings_problem(
    settings: *const MufasaMonitorSettings,
    problem: *mut MufasaSettingsProblem,
) -> MufasaStatus {
    // SAFETY: the caller's duty, here and below.
    let (status, told) = match unsafe { required(settings) } {
        Ok(settings) => checked(settings),
        Err(status) => (status, told("", "")),
    };
    // SAFETY: as above.
    unsafe { put(problem, told) }.map_or_else(|fault| fault, |()| status)
}

/// Writes which field of the route made the last call of `mufasa_monitor_set_route` fail; empty texts when
/// it did not, or when a pointer or a length was wrong.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`; `problem` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_route_problem(
    monitor: *const MufasaMonitor,
    problem: *mut MufasaInvalidInput,
) -> MufasaStatus {
    // SAFETY: the caller's duty, here and below.
    match unsafe { required(monitor) } {
        Ok(it) => {
            let told = report::input(it.route_problem);
            // SAFETY: as above.
            unsafe { put(problem, told) }.map_or_else(|fault| fault, |()| MufasaStatus::Ok)
        }
        Err(status) => status,
    }
}

fn checked(settings: &MufasaMonitorSettings) -> (MufasaStatus, MufasaSettingsProblem) {
    let made = match settings.of_monitor() {
        Ok(made) => made,
        Err(MufasaStatus::InvalidPeriod) => {
            return (MufasaStatus::InvalidPeriod, told("period_ns", POSITIVE));
        }
        Err(MufasaStatus::InvalidParameter) => {
            let told = if settings.check_time_ns < 0 {
                told("check_time_ns", "below 0; give ns, or INT64_MAX for any time")
            } else {
                told("stall_time_ns", NO_STALL)
            };
            return (MufasaStatus::InvalidParameter, told);
        }
        Err(status) => return (status, told("profile", "no MufasaProfile")),
    };
    let of_requester = Requester::new(made.profile, made.requester, &mut []);
    let [tracks, detections, cross_sections, stations] = Sizes::of(settings).lists(made.profile);
    let of_requester = of_requester.map(drop).map_err(MonitorError::Requester);
    let in_time = || made.check_lists(tracks, detections, cross_sections, stations);
    let Err(error) = made.check().and(of_requester).and_then(|()| in_time()) else {
        return missing(settings).map_or((MufasaStatus::Ok, told("", "")), |field| {
            (MufasaStatus::MemoryTooSmall, told(field, AT_LEAST_1))
        });
    };
    let told = match error {
        MonitorError::Stages(InvalidInput { field, problem, .. }) => {
            let [value, least, most] = numbers(field, &made.stages);
            MufasaSettingsProblem { value, least, most, ..told(field, problem.message()) }
        }
        MonitorError::Requester(RequesterError::NegativeParameter { field }) => {
            let field = report::joined(["requester.", field]);
            let told = told("", "below 0; give nanoseconds from 0 to 2^63 - 1");
            MufasaSettingsProblem { field, ..told }
        }
        MonitorError::Requester(_) => told("requester", ""),
        MonitorError::NoPeriod => told("period_ns", POSITIVE),
        MonitorError::TimeTooShort { field, ns } => {
            let message = if field == "requester.t_wait_ns" {
                "above 0 and below 1 s; is it in another unit? Give nanoseconds"
            } else {
                "above 0 and below 1 ms; is it in another unit? Give nanoseconds"
            };
            MufasaSettingsProblem { value: number(ns), ..told(period_ns(field), message) }
        }
        MonitorError::MaxAgeBelowLMax { max_age_ns, l_max_ns } => {
            let message = "below requester.l_max_ns, so that no cycle could use what is in time; give at least that";
            let least = number(l_max_ns);
            let told = told("parameters.max_age_ns", message);
            MufasaSettingsProblem { value: number(max_age_ns), least, ..told }
        }
        MonitorError::DtMaxNotAbovePeriod { dt_max_ns, .. } => MufasaSettingsProblem {
            value: number(dt_max_ns),
            least: number(settings.period_ns),
            ..told(
                "requester.dt_max_ns",
                "not above period_ns; give two periods and the largest jitter, to bear one lost message",
            )
        },
        MonitorError::TauNotAbovePeriod { tau, period } => {
            let message = "not above period_ns; give that and the time from the next cycle to full braking, s";
            let least = period.as_secs_f64();
            MufasaSettingsProblem { value: tau, least, ..told("parameters.tau", message) }
        }
        MonitorError::SessionsBefore { sessions_before } => MufasaSettingsProblem {
            value: number(sessions_before),
            ..told(
                "sessions_before",
                "not from 0 to 2^63 - 2; give the last session of earlier lives, or 0",
            )
        },
        MonitorError::Stall { way_m, .. } => of_stall(way_m, settings.stall_time_ns),
        MonitorError::Memory { field, .. } => told(field, AT_LEAST_1),
        // IMPL-12
        MonitorError::TooSlow { list, given, most, .. } => {
            let field = match list {
                "tracks" => "most_tracks",
                "detections" => "most_detections",
                "cross_sections" => "most_cross_sections",
                "stations" => "most_stations",
                list => list,
            };
            let told = told(field, "too many for check_time_ns; give fewer, or more time");
            MufasaSettingsProblem { value: given.into(), most: most.into(), ..told }
        }
        // IMPL-15
        MonitorError::Unusual(Unusual { field, value, least, most }) => {
            let message = match field {
                "stages.tau" => {
                    "too short for a fallback (A-07), or in another unit; else name it in meant"
                }
                _ => "no road vehicle has that; is it in another unit? Else name it in meant",
            };
            MufasaSettingsProblem { value, least, most, ..told(period_ns(field), message) }
        }
    };
    (refused(error), told)
}

fn of_stall(way_m: f64, time_ns: i64) -> MufasaSettingsProblem {
    let (field, message, value, least) = if (0.0..f64::INFINITY).contains(&way_m) {
        ("stall_time_ns", NO_STALL, number(time_ns), 1e9)
    } else {
        ("stall_way_m", "below 0 or not finite; give the way in m", way_m, 0.0)
    };
    MufasaSettingsProblem { value, least, ..told(field, message) }
}

/// A problem without numbers.
fn told(field: &str, message: &str) -> MufasaSettingsProblem {
    let (field, message) = (report::text(field), report::text(message));
    MufasaSettingsProblem { field, message, value: f64::NAN, least: f64::NAN, most: f64::NAN }
}

macro_rules! of_parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in [$least:expr, $most:expr];)*) => {
        /// What was given of a parameter with this path, and the ends of its domain.
        fn numbers(field: &str, parameters: &Parameters) -> [f64; 3] {
            match field {
                $(concat!("parameters.", stringify!($name)) => {
                    let numbers: [$number; 3] = [parameters.$name, $least, $most];
                    numbers.map(of_parameters!($number))
                })*
                _ => [f64::NAN; 3],
            }
        }
    };
    (f64) => { core::convert::identity };
    (i64) => { number };
}

mufasa::parameters!(of_parameters);

/// The name that the period has here.
fn period_ns(field: &str) -> &str {
    if field == "period" { "period_ns" } else { field }
}

#[expect(clippy::cast_precision_loss, reason = "for people to read")]
fn number(ns: i64) -> f64 {
    ns as f64
}

const POSITIVE: &str = "not above 0; give the nominal period of the results, ns";
const NO_STALL: &str = "below 1 s; give the longest stop that a plan may make, ns, or 0 for any";
const AT_LEAST_1: &str = "give at least 1";

/// A number of things that has to be at least 1 and is not.
fn missing(settings: &MufasaMonitorSettings) -> Option<&'static str> {
    let is_hardened = settings.profile == MufasaProfile::Hardened as u32;
    let numbers = [
        ("most_stations", settings.most_stations),
        ("most_tracks", settings.most_tracks),
        ("most_detections", if is_hardened { settings.most_detections } else { 1 }),
    ];
    numbers.into_iter().find(|(_, number)| *number == 0).map(|(name, _)| name)
}

#[cfg(test)]
mod tests;
