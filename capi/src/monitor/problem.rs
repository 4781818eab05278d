//! Which field a status is about.

use mufasa::monitor::{MonitorError, Unusual};
use mufasa::offloading::requester::{Requester, RequesterError};

use super::place::{MufasaMonitor, Sizes};
use super::settings::{MufasaMonitorSettings, refused};
use crate::cycle::MufasaProfile;
use crate::memory::{put, required};
use crate::report::{self, MufasaInvalidInput};
use crate::status::MufasaStatus;

/// What `mufasa_monitor_init` says of these settings, whatever the memory, and writes which field is wrong
/// and what would be right; empty texts when none is.
///
/// # Safety
/// `settings` is null or points to settings; `problem` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_settings_problem(
    settings: *const MufasaMonitorSettings,
    problem: *mut MufasaInvalidInput,
) -> MufasaStatus {
    // SAFETY: the caller's duty, here and below.
    let (status, told) = match unsafe { required(settings) } {
        Ok(settings) => checked(settings),
        Err(status) => (status, report::input(None)),
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

fn checked(settings: &MufasaMonitorSettings) -> (MufasaStatus, MufasaInvalidInput) {
    let made = match settings.of_monitor() {
        Ok(made) => made,
        Err(MufasaStatus::InvalidPeriod) => {
            return (MufasaStatus::InvalidPeriod, report::wrong("period_ns", POSITIVE));
        }
        Err(MufasaStatus::InvalidParameter) => {
            let told =
                report::wrong("check_time_ns", "below 0; give ns, or INT64_MAX for any time");
            return (MufasaStatus::InvalidParameter, told);
        }
        Err(status) => return (status, report::wrong("profile", "no MufasaProfile")),
    };
    let of_requester = Requester::new(made.profile, made.requester, &mut []);
    let [tracks, detections, cross_sections] = Sizes::of(settings).lists(made.profile);
    let of_requester = of_requester.map(drop).map_err(MonitorError::Requester);
    let in_time = || made.check_lists(tracks, detections, cross_sections);
    let Err(error) = made.check().and(of_requester).and_then(|()| in_time()) else {
        return missing(settings).map_or((MufasaStatus::Ok, report::input(None)), |field| {
            (MufasaStatus::MemoryTooSmall, report::wrong(field, AT_LEAST_1))
        });
    };
    let told = match error {
        MonitorError::Stages(problem) => report::input(Some(problem)),
        MonitorError::Requester(RequesterError::NegativeParameter { field }) => {
            report::wrong(field, "below 0; give nanoseconds from 0 to 2^63 - 1")
        }
        MonitorError::Requester(_) => report::wrong("requester", ""),
        MonitorError::NoPeriod => report::wrong("period_ns", POSITIVE),
        MonitorError::TimeTooShort { field, .. } => {
            let field = if field == "period" { "period_ns" } else { field };
            let message = if field == "requester.t_wait_ns" {
                "above 0 and below 1 s; is it in another unit? Give nanoseconds"
            } else {
                "above 0 and below 1 ms; is it in another unit? Give nanoseconds"
            };
            report::wrong(field, message)
        }
        MonitorError::MaxAgeBelowLMax { .. } => report::wrong(
            "parameters.max_age_ns",
            "below requester.l_max_ns, so that no cycle could use what is in time; give at least that",
        ),
        MonitorError::DtMaxNotAbovePeriod { .. } => report::wrong(
            "requester.dt_max_ns",
            "not above period_ns; give that and its largest jitter",
        ),
        MonitorError::TauNotAbovePeriod { .. } => report::wrong(
            "parameters.tau",
            "not above period_ns; give that and the time from the next cycle to full braking, s",
        ),
        MonitorError::SessionsBefore { .. } => report::wrong(
            "sessions_before",
            "not from 0 to 2^63 - 2; give the last session of earlier lives, or 0",
        ),
        MonitorError::Stall { .. } => report::wrong("stall", ""),
        MonitorError::Memory { field, .. } => report::wrong(field, AT_LEAST_1),
        MonitorError::TooSlow { list, .. } => {
            let field = match list {
                "tracks" => "most_tracks",
                "detections" => "most_detections",
                "cross_sections" => "most_cross_sections",
                list => list,
            };
            report::wrong(field, "too many for check_time_ns; give fewer, or more time")
        }
        MonitorError::Unusual(Unusual { field, .. }) => {
            let field = if field == "period" { "period_ns" } else { field };
            report::wrong(
                field,
                "no road vehicle has that; is it in another unit? Else name it in meant",
            )
        }
    };
    (refused(error), told)
}

const POSITIVE: &str = "not above 0; give the nominal period of the results, ns";
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
