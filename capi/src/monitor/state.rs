//! What can be read of a monitor between two calls.

use mufasa::monitor::Time;

use super::place::MufasaMonitor;
use crate::memory::{put, required};
use crate::requester::{self, MufasaRequesterState};
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// Writes the state of the monitor's requester.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`; `state` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_state(
    monitor: *const MufasaMonitor,
    state: *mut MufasaRequesterState,
) -> MufasaStatus {
    // SAFETY: the caller's duty, here and below.
    match unsafe { required(monitor) } {
        Ok(it) => {
            let told = requester::state_of(it.monitor.requester());
            // SAFETY: as above.
            unsafe { put(state, told) }.map_or_else(|fault| fault, |()| MufasaStatus::Ok)
        }
        Err(status) => status,
    }
}

/// When PLAN was given back last because the CAV got nowhere (`stall_time_ns`), at a tick that names its release;
/// INT64_MIN ns: never, or the monitor is null.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_given_back(monitor: *const MufasaMonitor) -> MufasaTime {
    // SAFETY: the caller's duty.
    let given_back = unsafe { required(monitor) }.ok().and_then(|it| it.monitor.given_back());
    MufasaTime { ns: given_back.map_or(i64::MIN, Time::as_nanoseconds) }
}
