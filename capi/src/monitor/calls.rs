//! The calls of a monitor.

use core::ffi::c_void;
use core::ptr::null_mut;

use mufasa::input::cycle::{CrossSection, Ego, Grid, Route};
use mufasa::monitor::{Gap, GridMap, Inputs, Monitor, Time};
use mufasa::offloading::requester::Group;
use mufasa::report::Problem;

use super::decision::{MufasaActions, MufasaDecision, actions_of, nothing_decided};
use super::element::{MufasaTrackMessage, MufasaTrajectoryMessage, message, with_remote};
use super::place::{self, MufasaMonitor, MufasaMonitorInputs};
use super::settings::MufasaMonitorSettings;
use crate::convert;
use crate::cycle::MufasaRoute;
use crate::event::{self, MufasaEvent, MufasaEventType};
use crate::memory::{Arena, list, optional, put, required, required_mut};
use crate::requester;
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// Makes a monitor in `memory`, whose content means nothing before: everything local, no offers, no
/// route, nothing seen yet. `*monitor` is where it is; it needs no end, and may not be moved. When the
/// status is not OK there is none, and `*monitor`, if it can be written to, is null;
/// `mufasa_monitor_settings_problem` says the field that is wrong.
///
/// # Safety
/// `settings` is null or points to settings; `memory` points to `bytes` bytes that nobody else uses as
/// long as the monitor is used; `monitor` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_init(
    settings: *const MufasaMonitorSettings,
    memory: *mut c_void,
    bytes: usize,
    monitor: *mut *mut MufasaMonitor,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let (made, status) = match unsafe { place::init(settings, memory, bytes) } {
        Ok(made) => (made, MufasaStatus::Ok),
        Err(status) => (null_mut(), status),
    };
    // SAFETY: the caller's duty.
    unsafe { put(monitor, made) }.map_or_else(|fault| fault, |()| status)
}

/// From now on the CAV follows this route, of which a copy and an index are kept. When the status is
/// not OK it follows the route before; INVALID_ROUTE: a value is outside its domain, of which
/// `mufasa_monitor_route_problem` says the field. Where the route ends before the CAV can stop, each cycle of the
/// hardened profile fails stage ii (H-14.58).
///
/// # Safety
/// `monitor` is null or comes from `mufasa_monitor_init`, in memory that nobody else wrote to, and no other
/// call uses it at the same time; `route` is null or points to a route with as many cross sections as
/// it says.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_set_route(
    monitor: *mut MufasaMonitor,
    route: *const MufasaRoute,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    unsafe { set_route(monitor, route) }.map_or_else(|fault| fault, |()| MufasaStatus::Ok)
}

/// Takes an event and writes what has to be done about it. DATA and VERDICT are UNKNOWN_VALUE here: data
/// come with their contents (`mufasa_monitor_tracks`, `mufasa_monitor_trajectory`), and the verdict is
/// `mufasa_monitor_cycle`'s. When the status is not OK nothing has changed, and there are no actions.
/// TICK is to be given in each period, before its cycle.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`; `event` is null or points to an event; `actions` is null
/// or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_step(
    monitor: *mut MufasaMonitor,
    event: *const MufasaEvent,
    actions: *mut MufasaActions,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let call = || unsafe { step(monitor, event) };
    // SAFETY: as above.
    unsafe { tell(actions, call) }
}

/// Tracks of a station arrive: used are those of the running session of MOT, in time, and newer than the
/// last. They are copied, and come out of the next cycle if it is safe. When one of `actions` is DROP they
/// are of no use, and `actions->dropped` says why, more tracks than the settings say among it; a violation
/// of quality of service ends the session, too. For every status but OK nothing has changed.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`; `message` is null or points to a message with as many
/// tracks as it says; `actions` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_tracks(
    monitor: *mut MufasaMonitor,
    now: MufasaTime,
    message: *const MufasaTrackMessage,
    actions: *mut MufasaActions,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let call = || unsafe { tracks(monitor, now.time(), message) };
    // SAFETY: as above.
    unsafe { tell(actions, call) }
}

/// As `mufasa_monitor_tracks`, for a trajectory of a station and PLAN. What its points have to be like
/// stands at MufasaTrajectory.
///
/// # Safety
/// As for `mufasa_monitor_tracks`.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_trajectory(
    monitor: *mut MufasaMonitor,
    now: MufasaTime,
    message: *const MufasaTrajectoryMessage,
    actions: *mut MufasaActions,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let call = || unsafe { trajectory(monitor, now.time(), message) };
    // SAFETY: as above.
    unsafe { tell(actions, call) }
}

/// Decides on the inputs and the last elements that were used, and tells the requester: to be called in
/// each period, offloading or not. Unless `decision` is null or misaligned it is always written; when
/// the status is not OK (a pointer in the inputs that cannot be followed, a list longer than the settings
/// say) it is not safe, and every group is local as after any other unsafe cycle. Where `decision`
/// itself is null or misaligned, or `monitor` is, nothing has happened.
///
/// # Safety
/// `monitor` as for `mufasa_monitor_set_route`; `inputs` is null or points to inputs, every pointer in which
/// is null or points to what its type says, in the number that is given beside it, which nobody writes to
/// during the call; `decision` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_cycle(
    monitor: *mut MufasaMonitor,
    now: MufasaTime,
    inputs: *const MufasaMonitorInputs,
    decision: *mut MufasaDecision,
) -> MufasaStatus {
    // That it can be written is known before anything is done.
    // SAFETY: the caller's duty, here and below.
    if let Err(status) = unsafe { put(decision, nothing_decided()) } {
        return status;
    }
    // SAFETY: as above.
    let monitor = match unsafe { called(monitor) } {
        Ok(monitor) => monitor,
        Err(status) => return status,
    };
    // SAFETY: as above.
    let (status, told) = match unsafe { cycle(monitor, now, inputs) } {
        Ok(told) => (MufasaStatus::Ok, told),
        // SAFETY: the caller's duty.
        Err(status) => (status, unsafe { fall_back(monitor, now, inputs) }),
    };
    // SAFETY: as above.
    unsafe { put(decision, told) }.map_or_else(|fault| fault, |()| status)
}

/// Writes the actions of a call, or that there are none. That they can be written is known before anything
/// is done.
///
/// # Safety
/// `actions` is null or can be written to.
unsafe fn tell(
    actions: *mut MufasaActions,
    call: impl FnOnce() -> Result<MufasaActions, MufasaStatus>,
) -> MufasaStatus {
    // SAFETY: the caller's duty, here and below.
    if let Err(status) = unsafe { put(actions, actions_of(&[])) } {
        return status;
    }
    match call() {
        // SAFETY: as above.
        Ok(told) => unsafe { put(actions, told) }.map_or_else(|fault| fault, |()| MufasaStatus::Ok),
        Err(status) => status,
    }
}

/// The monitor in its next call, which ends what the last cycle gave (MON-03).
///
/// # Safety
/// As for [`mufasa_monitor_set_route`].
unsafe fn called<'m>(monitor: *mut MufasaMonitor) -> Result<&'m mut MufasaMonitor, MufasaStatus> {
    // SAFETY: the caller's duty.
    let monitor = unsafe { required_mut(monitor) }?;
    monitor.verdicts.forget();
    Ok(monitor)
}

/// # Safety
/// As for [`mufasa_monitor_set_route`].
unsafe fn set_route(
    monitor: *mut MufasaMonitor,
    route: *const MufasaRoute,
) -> Result<(), MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let MufasaMonitor {
        monitor, most_cross_sections, scratch, scratch_bytes, route_problem, ..
    } = unsafe { called(monitor) }?;
    *route_problem = None;
    // SAFETY: as above.
    let raw = unsafe { required(route) }?;
    fits(raw.cross_sections_len, *most_cross_sections)?;
    // SAFETY: the memory is the monitor's, and nothing in it is used after the call.
    let mut arena = unsafe { Arena::new(*scratch, *scratch_bytes) }?;
    // SAFETY: the caller's duty.
    let cross_sections =
        unsafe { list(raw.cross_sections, raw.cross_sections_len, convert::CROSS_SECTIONS) }?;
    let cross_sections: &[CrossSection] =
        arena.keep(cross_sections.iter().map(convert::cross_section))?;
    let taken = monitor.set_route(&Route { closed: raw.closed != 0, cross_sections });
    taken.map_err(|invalid| {
        *route_problem = Some(invalid);
        match invalid.problem {
            Problem::ScratchTooSmall => MufasaStatus::MemoryTooSmall,
            _ => MufasaStatus::InvalidRoute,
        }
    })
}

/// # Safety
/// As for [`mufasa_monitor_step`].
unsafe fn step(
    monitor: *mut MufasaMonitor,
    event: *const MufasaEvent,
) -> Result<MufasaActions, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let &MufasaEvent { t, event_type, group, groups, station, session } =
        unsafe { required(event) }?;
    // SAFETY: as above.
    let monitor = &mut unsafe { called(monitor) }?.monitor;
    let now = Time::from_nanoseconds(t.ns);
    let actions = match event::event_type(event_type)? {
        MufasaEventType::Offer => monitor.offer(now, station, event::groups(groups)?),
        MufasaEventType::Withdraw => monitor.withdraw(now, station),
        MufasaEventType::Lost => monitor.lost(now, station),
        MufasaEventType::Area => Ok(monitor.area(now, event::groups(groups)?)),
        MufasaEventType::Tick => Ok(monitor.tick(now)),
        MufasaEventType::Confirm => monitor.confirm(now, station, event::group(group)?, session),
        MufasaEventType::Reject => monitor.reject(now, station, event::group(group)?, session),
    };
    actions.map(|actions| actions_of(&actions)).map_err(requester::refused)
}

/// # Safety
/// As for [`mufasa_monitor_tracks`].
unsafe fn tracks(
    monitor: *mut MufasaMonitor,
    now: Time,
    raw: *const MufasaTrackMessage,
) -> Result<MufasaActions, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let MufasaMonitor { monitor, tracks: received, .. } = unsafe { called(monitor) }?;
    // SAFETY: as above.
    let MufasaTrackMessage { station, session, generated, tracks } = unsafe { required(raw) }?;
    // SAFETY: as above.
    let items = unsafe { list(tracks.items, tracks.items_len, convert::TRACKS) }?;
    let items = items.iter().map(convert::track);
    let is_running = runs(monitor, Group::Mot, (*station, *session));
    received.arrive(items, *session, is_running, |session, items| {
        let message = message((*station, session, *generated), tracks.stamp, items);
        monitor.tracks(now, message).map_err(requester::refused)
    })
}

/// # Safety
/// As for [`mufasa_monitor_trajectory`].
unsafe fn trajectory(
    monitor: *mut MufasaMonitor,
    now: Time,
    raw: *const MufasaTrajectoryMessage,
) -> Result<MufasaActions, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let MufasaMonitor { monitor, trajectory: received, .. } = unsafe { called(monitor) }?;
    // SAFETY: as above.
    let raw = unsafe { required(raw) }?;
    let MufasaTrajectoryMessage { station, session, generated, trajectory } = raw;
    // SAFETY: as above.
    let points = unsafe { list(trajectory.points, trajectory.points_len, convert::POINTS) }?;
    let points = points.iter().map(convert::trajectory_point);
    let is_running = runs(monitor, Group::Plan, (*station, *session));
    received.arrive(points, *session, is_running, |session, items| {
        let message = message((*station, session, *generated), trajectory.stamp, items);
        monitor.trajectory(now, message).map_err(requester::refused)
    })
}

/// Whether this session of this station is the running one of a group.
fn runs(monitor: &Monitor<'_>, group: Group, named: (i64, i64)) -> bool {
    monitor.requester().session_of(group).is_some_and(|it| (it.station, it.session) == named)
}

/// # Safety
/// As for [`mufasa_monitor_cycle`].
unsafe fn cycle(
    monitor: &mut MufasaMonitor,
    now: MufasaTime,
    raw: *const MufasaMonitorInputs,
) -> Result<MufasaDecision, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let raw = unsafe { required(raw) }?;
    let (most_detections, scratch, scratch_bytes) =
        (monitor.most_detections, monitor.scratch, monitor.scratch_bytes);
    // SAFETY: the memory is the monitor's, and nothing in it is used after the call.
    let mut arena = unsafe { Arena::new(scratch, scratch_bytes) }?;
    let MufasaMonitor { monitor, tracks, trajectory, verdicts, .. } = monitor;
    let mut inputs = Inputs::new(now.time(), convert::ego(&raw.ego));
    // SAFETY: the caller's duty, here and below.
    if let Some(it) = unsafe { optional(raw.detections) }? {
        fits(it.items_len, most_detections)?;
        // SAFETY: as above.
        let items = unsafe { list(it.items, it.items_len, convert::DETECTIONS) }?;
        let items = arena.keep(items.iter().map(convert::detection))?;
        inputs = inputs.detections(it.stamp.time(), items);
    }
    // SAFETY: as above.
    if let Some(it) = unsafe { optional(raw.lead) }? {
        let gap = Gap::between_bumpers(it.gap.between_bumpers);
        inputs = inputs.lead(it.stamp.time(), gap, it.speed);
    }
    // SAFETY: as above.
    let grid = unsafe { convert::grid(raw.grid) }?;
    if let Some(Grid { stamp_ns, x, y, cos, sin, resolution, width, height, occupied, unknown }) =
        grid
    {
        let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
        inputs = inputs.grid(Time::from_nanoseconds(stamp_ns), map);
    }
    // SAFETY: as above.
    if let Some(it) = unsafe { convert::tracks(raw.local_tracks, &mut arena) }? {
        fits(it.items.len(), tracks.capacity())?;
        inputs = inputs.local_tracks(Time::from_nanoseconds(it.stamp_ns), it.items);
    }
    // SAFETY: as above.
    if let Some(it) = unsafe { convert::trajectory(raw.local_trajectory, &mut arena) }? {
        fits(it.points.len(), trajectory.capacity())?;
        inputs = inputs.local_trajectory(Time::from_nanoseconds(it.stamp_ns), it.points);
    }
    Ok(verdicts.of_cycle(monitor, &with_remote(inputs, tracks, trajectory)))
}

/// Whether a list is no longer than the settings say (IMPL-09).
const fn fits(len: usize, most: usize) -> Result<(), MufasaStatus> {
    if len <= most { Ok(()) } else { Err(MufasaStatus::MemoryTooSmall) }
}

/// An unsafe cycle, because its inputs cannot be read: no CAV has a width that is no number. That elements of the
/// stations were current counts in it, too (MON-35), as far as detections were (MON-69), and the requester is told (MON-10).
///
/// # Safety
/// As for [`mufasa_monitor_cycle`].
unsafe fn fall_back(
    monitor: &mut MufasaMonitor,
    now: MufasaTime,
    raw: *const MufasaMonitorInputs,
) -> MufasaDecision {
    let nowhere = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 0.0,
        length: 1.0,
        width: f64::NAN,
        center_offset: 0.0,
    };
    let MufasaMonitor { monitor, verdicts, tracks, trajectory, .. } = monitor;
    let mut inputs = with_remote(Inputs::new(now.time(), nowhere), tracks, trajectory);
    // SAFETY: the caller's duty, here and below.
    let seen = unsafe { required(raw) }.and_then(|raw| unsafe { optional(raw.detections) });
    if let Ok(Some(it)) = seen {
        // Of an invalid cycle no list is kept.
        inputs = inputs.detections(it.stamp.time(), &[]);
    }
    let MufasaDecision { actions, advice, brake, .. } = verdicts.of_cycle(monitor, &inputs);
    MufasaDecision { actions, advice, brake, ..nothing_decided() }
}
