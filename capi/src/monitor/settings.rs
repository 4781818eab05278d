//! What a monitor is made with.

use core::ffi::{CStr, c_char, c_void};
use core::time::Duration;

use mufasa::monitor::{Monitor, MonitorError, Settings, Stall};

use crate::convert;
use crate::cycle::MufasaProfile;
use crate::parameters::{MufasaParameters, MufasaRequesterParameters};
use crate::requester;
use crate::status::MufasaStatus;

/// What a monitor is made with. The last five fields say how much memory it needs; what is longer is
/// refused when it comes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaMonitorSettings {
    /// A MufasaProfile.
    pub profile: u32,
    /// Parameters of the stages.
    pub stages: MufasaParameters,
    /// Times of the requester.
    pub requester: MufasaRequesterParameters,
    /// The nominal period of the cycles and of the remote's results in nanoseconds, at least 1,000,000 (1 ms).
    /// `requester.dt_max_ns` has to be above it: at equality one nanosecond of jitter ends the session. The default,
    /// two periods and 20 ms of jitter, bears one lost message. In the hardened profile `stages.tau`, in seconds, has to be at least 2.5 of it, unless less is meant.
    pub period_ns: i64,
    /// At least the last session of the monitor's earlier lives; 0 for a first life, at most 2^63 - 2. Sessions are
    /// numbered on from here, so that no message of an earlier life fits.
    pub sessions_before: i64,
    /// How long a cycle may take, ns: what may take longer is refused; INT64_MAX for any time.
    pub check_time_ns: i64,
    /// What a step costs on this processor, ps: see `mufasa_monitor_calibrate`.
    pub step_ps: u64,
    /// Sum of `mufasa_monitor_meant`: settings that are meant although no road vehicle has such; UINT32_MAX for all.
    pub meant: u32,
    /// 1: while all groups are local `brake` of a decision says whether control has to brake instead of following the
    /// plan of the CAV's own. Lists may then take half the steps. Else 0: nobody examines that plan.
    pub supervise_local: u32,
    /// How far the CAV gets, m, at least 0, in the time below; else PLAN is given back.
    pub stall_way_m: f64,
    /// For how long PLAN is remote meanwhile, ns, at least 1 s; 0: PLAN is never given back for this reason.
    pub stall_time_ns: i64,
    /// Stations that ever offer something, at least 1.
    pub most_stations: usize,
    /// Tracks of a list, at least 1.
    pub most_tracks: usize,
    /// Points of a trajectory.
    pub most_points: usize,
    /// Detections of a list, at least 1 in the hardened profile.
    pub most_detections: usize,
    /// Cross sections of a route.
    pub most_cross_sections: usize,
}

/// The hardened profile, a `tau` of three periods and 0.1 s, a `dt_max` of two periods and 20 ms, and else the paper's values in a first life, for 8 stations, 128 tracks, 128 points,
/// 256 detections and 528 cross sections.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_monitor_settings_default(period_ns: i64) -> MufasaMonitorSettings {
    // A period below 0 is refused later.
    let period = Duration::from_nanos(u64::try_from(period_ns).unwrap_or(0));
    let settings = Settings::new(period);
    MufasaMonitorSettings {
        profile: MufasaProfile::Hardened as u32,
        stages: settings.stages.into(),
        requester: settings.requester.into(),
        period_ns,
        sessions_before: 0,
        check_time_ns: 15_000_000,
        step_ps: 1000,
        meant: 0,
        supervise_local: 0,
        stall_way_m: 1.0,
        stall_time_ns: 0,
        most_stations: 8,
        most_tracks: 128,
        most_points: 128,
        most_detections: 256,
        most_cross_sections: 528,
    }
}

/// What a step costs on this processor, ps: `step_ps`. It times work by a monotonic clock in ns that tells microseconds apart, which is
/// called with `context`. Take the greatest of several answers. 0 where `now_ns` is null.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_monitor_calibrate(
    now_ns: Option<extern "C" fn(context: *mut c_void) -> u64>,
    context: *mut c_void,
) -> u64 {
    now_ns.map_or(0, |now_ns| Monitor::calibrate(|| now_ns(context)))
}

/// What `meant` has of a setting, such as "stages.a_b"; 0 of a name that there is not.
///
/// # Safety
/// `field` is null or points to a text that ends with 0.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_meant(field: *const c_char) -> u32 {
    if field.is_null() {
        return 0;
    }
    // SAFETY: the caller's duty.
    unsafe { CStr::from_ptr(field) }.to_str().map_or(0, Settings::bit_of)
}

impl MufasaMonitorSettings {
    /// Those of `mufasa`.
    pub(super) fn of_monitor(&self) -> Result<Settings, MufasaStatus> {
        // MON-62
        let period_ns = u64::try_from(self.period_ns).map_err(|_| MufasaStatus::InvalidPeriod)?;
        let period = Duration::from_nanos(period_ns);
        let check_time_ns =
            u64::try_from(self.check_time_ns).map_err(|_| MufasaStatus::InvalidParameter)?;
        let check_time = match self.check_time_ns {
            i64::MAX => Duration::MAX,
            _ => Duration::from_nanos(check_time_ns),
        };
        let stall_time_ns =
            u64::try_from(self.stall_time_ns).map_err(|_| MufasaStatus::InvalidParameter)?;
        let stall = Stall { way_m: self.stall_way_m, time: Duration::from_nanos(stall_time_ns) };
        Ok(Settings {
            profile: convert::profile(self.profile)?,
            stages: self.stages.into(),
            requester: self.requester.into(),
            period,
            sessions_before: self.sessions_before,
            check_time,
            step_ps: self.step_ps,
            meant: self.meant,
            supervise_local: self.supervise_local != 0,
            stall: (stall_time_ns != 0).then_some(stall),
        })
    }
}

/// Why there is no monitor.
pub(super) fn refused(error: MonitorError) -> MufasaStatus {
    match error {
        MonitorError::Stages(_) | MonitorError::Stall { .. } => MufasaStatus::InvalidParameter,
        MonitorError::Requester(error) => requester::refused(error),
        MonitorError::SessionsBefore { .. } => MufasaStatus::NegativeParameter,
        MonitorError::NoPeriod => MufasaStatus::InvalidPeriod,
        MonitorError::TimeTooShort { .. } => MufasaStatus::TimeTooShort,
        MonitorError::MaxAgeBelowLMax { .. } => MufasaStatus::MaxAgeBelowLMax,
        MonitorError::DtMaxNotAbovePeriod { .. } => MufasaStatus::DtMaxNotAbovePeriod,
        MonitorError::TauNotAbovePeriod { .. } => MufasaStatus::TauNotAbovePeriod,
        MonitorError::Memory { .. } => MufasaStatus::MemoryTooSmall,
        MonitorError::TooSlow { .. } => MufasaStatus::TooSlow,
        MonitorError::Unusual(_) => MufasaStatus::Unusual,
    }
}
