//! `mufasa::offloading::requester` for C. The requester lives in memory of the caller, its table of stations
//! right behind it.

use core::ffi::c_void;
use core::mem::{align_of, size_of};

use mufasa::offloading::requester::{
    Actions, Group, GroupState, Parameters, Requester, RequesterError, StationRecord, Suspended,
};

use crate::convert;
use crate::cycle::MufasaConfiguration;
use crate::event::{self, MUFASA_MAX_ACTIONS, MufasaAction, MufasaEvent};
use crate::memory::{put, required};
use crate::parameters::MufasaRequesterParameters;
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// The state of a group.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MufasaGroupStateKind {
    /// It runs on the CAV.
    Local = 0,
    /// It runs on the CAV, and a station was asked to run it.
    Requested = 1,
    /// It runs on a station.
    Remote = 2,
}

/// The state of a group.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaGroupState {
    /// What it is.
    pub kind: MufasaGroupStateKind,
    /// The station, or 0.
    pub station: i64,
    /// The session, or 0.
    pub session: i64,
    /// Of a requested group: a confirmation must come before this time.
    pub deadline: MufasaTime,
    /// The station whose results may reach control; 0 is the CAV.
    pub source: i64,
}

/// The state of a requester.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaRequesterState {
    /// MOT.
    pub mot: MufasaGroupState,
    /// PLAN.
    pub plan: MufasaGroupState,
    /// For `MufasaCycle.configuration`.
    pub configuration: MufasaConfiguration,
    /// 0: there never was a hold.
    pub has_hold: u32,
    /// No request is sent before this time.
    pub hold_until: MufasaTime,
}

/// A requester in the memory of the caller; its content may change from version to version.
pub struct MufasaRequester {
    suspended: Suspended,
    stations: usize,
}

/// A requester needs memory aligned to this many bytes, as `malloc` gives it.
pub const MUFASA_REQUESTER_ALIGN: usize = 8;

const _: () = assert!(align_of::<MufasaRequester>() <= MUFASA_REQUESTER_ALIGN);
const _: () = assert!(align_of::<StationRecord>() <= MUFASA_REQUESTER_ALIGN);
/// So the table can begin right behind the requester.
const _: () = assert!(size_of::<MufasaRequester>().is_multiple_of(align_of::<StationRecord>()));

/// The defaults of spec/2-offloading.md.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_requester_parameters_default() -> MufasaRequesterParameters {
    Parameters::default().into()
}

/// Bytes of memory for a requester that knows this many stations. A place of the table is taken
/// for good by every station that was ever asked.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_requester_bytes(stations: usize) -> usize {
    stations.saturating_mul(size_of::<StationRecord>()).saturating_add(size_of::<MufasaRequester>())
}

/// Makes a requester in `memory`, whose content means nothing before: both groups local, no
/// offers, no hold, all groups in the area. `*requester` is where it is; it needs no end, and may
/// not be moved.
///
/// # Safety
/// `parameters` is null or points to parameters; `memory` points to `bytes` bytes that nobody
/// else uses as long as the requester is used; `requester` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_requester_init(
    profile: u32,
    parameters: *const MufasaRequesterParameters,
    stations: usize,
    memory: *mut c_void,
    bytes: usize,
    requester: *mut *mut MufasaRequester,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    match unsafe { init(profile, parameters, stations, memory, bytes) } {
        // SAFETY: the caller's duty.
        Ok(made) => status(unsafe { put(requester, made) }),
        Err(status) => status,
    }
}

/// Takes one event and writes what has to be done about it, in this order. When the status is not
/// OK nothing has changed, and `*actions_len`, if it can be written to, is 0.
///
/// # Safety
/// `requester` is null or comes from `mufasa_requester_init`, in memory that nobody else wrote to,
/// and no other call uses it at the same time; `event` is null or points to an event; `actions`
/// is null or has `capacity` places; `actions_len` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_requester_step(
    requester: *mut MufasaRequester,
    event: *const MufasaEvent,
    actions: *mut MufasaAction,
    capacity: usize,
    actions_len: *mut usize,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    if let Err(status) = unsafe { put(actions_len, 0) } {
        return status;
    }
    if capacity < MUFASA_MAX_ACTIONS {
        return MufasaStatus::TooFewActions;
    }
    if actions.is_null() {
        return MufasaStatus::NullPointer;
    }
    if !actions.is_aligned() {
        return MufasaStatus::Misaligned;
    }
    // SAFETY: the caller's duty.
    let taken = match unsafe { step(requester, event) } {
        Ok(taken) => taken,
        Err(status) => return status,
    };
    let mut len: usize = 0;
    for taken in taken.as_slice() {
        // SAFETY: an event makes at most MUFASA_MAX_ACTIONS actions, and `actions` has as many
        // places or more (checked; that it has `capacity` of them is the caller's duty).
        let place = unsafe { actions.add(len) };
        // SAFETY: as above.
        if let Err(status) = unsafe { put(place, event::action(*taken)) } {
            return status;
        }
        len = len.saturating_add(1);
    }
    // SAFETY: the caller's duty.
    status(unsafe { put(actions_len, len) })
}

/// Writes the state of a requester.
///
/// # Safety
/// `requester` as for `mufasa_requester_step`; `state` is null or can be written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_requester_state(
    requester: *const MufasaRequester,
    state: *mut MufasaRequesterState,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let stored = match unsafe { required(requester) } {
        Ok(stored) => stored,
        Err(status) => return status,
    };
    // The state does not depend on the table.
    let told = state_of(&Requester::resume(stored.suspended, &mut []));
    // SAFETY: the caller's duty.
    status(unsafe { put(state, told) })
}

/// The state for C.
pub(crate) fn state_of(requester: &Requester<'_>) -> MufasaRequesterState {
    let group = |group| {
        let (kind, station, session, deadline_ns) = match requester.state(group) {
            GroupState::Local => (MufasaGroupStateKind::Local, 0, 0, 0),
            GroupState::Requested { station, session, deadline_ns } => {
                (MufasaGroupStateKind::Requested, station, session, deadline_ns)
            }
            GroupState::Remote { station, session } => {
                (MufasaGroupStateKind::Remote, station, session, 0)
            }
        };
        let source = requester.source(group).station();
        MufasaGroupState {
            kind,
            station,
            session,
            deadline: MufasaTime { ns: deadline_ns },
            source,
        }
    };
    MufasaRequesterState {
        mot: group(Group::Mot),
        plan: group(Group::Plan),
        configuration: convert::configuration_number(requester.configuration()),
        has_hold: u32::from(requester.hold_until_ns().is_some()),
        hold_until: MufasaTime { ns: requester.hold_until_ns().unwrap_or(0) },
    }
}

/// # Safety
/// As for [`mufasa_requester_init`].
unsafe fn init(
    profile: u32,
    parameters: *const MufasaRequesterParameters,
    stations: usize,
    memory: *mut c_void,
    bytes: usize,
) -> Result<*mut MufasaRequester, MufasaStatus> {
    let profile = convert::profile(profile)?;
    // SAFETY: the caller's duty.
    let parameters = Parameters::from(*unsafe { required(parameters) }?);
    if memory.is_null() {
        return Err(MufasaStatus::NullPointer);
    }
    if memory.align_offset(MUFASA_REQUESTER_ALIGN) != 0 {
        return Err(MufasaStatus::Misaligned);
    }
    if bytes < mufasa_requester_bytes(stations) {
        return Err(MufasaStatus::MemoryTooSmall);
    }
    let suspended = Requester::new(profile, parameters, &mut []).map_err(refused)?.suspend();
    let place: *mut MufasaRequester = memory.cast();
    // SAFETY: not null, aligned, and `bytes` is enough for it (checked); writable (the caller's
    // duty).
    unsafe { place.write(MufasaRequester { suspended, stations }) };
    // SAFETY: `bytes` is enough for the requester and `stations` records behind it (checked).
    let records = unsafe { table(place) };
    for station in 0..stations {
        // SAFETY: as above.
        let record = unsafe { records.add(station) };
        // SAFETY: as above; it is aligned because the requester is, and its size is a multiple of
        // the alignment of a record (asserted above).
        unsafe { record.write(StationRecord::FREE) };
    }
    Ok(place)
}

/// # Safety
/// As for [`mufasa_requester_step`].
unsafe fn step(
    requester: *mut MufasaRequester,
    event: *const MufasaEvent,
) -> Result<Actions, MufasaStatus> {
    // SAFETY: the caller's duty.
    let event = event::event_of(unsafe { required(event) }?)?;
    // SAFETY: the caller's duty.
    let &MufasaRequester { suspended, stations } = unsafe { required(requester) }?;
    // SAFETY: the requester was not null (checked), so it comes from `init`, which was given memory
    // for the table behind it.
    let records = unsafe { table(requester) };
    // SAFETY: `init` wrote `stations` records there; nobody else uses them (the caller's duty).
    let records = unsafe { core::slice::from_raw_parts_mut(records, stations) };
    let mut resumed = Requester::resume(suspended, records);
    let actions = resumed.step(&event).map_err(refused)?;
    let suspended = resumed.suspend();
    // SAFETY: the requester can be written to (the caller's duty).
    unsafe { put(requester, MufasaRequester { suspended, stations }) }?;
    Ok(actions)
}

/// Where the table of a requester begins.
///
/// # Safety
/// The requester is in memory that goes on behind it.
unsafe fn table(requester: *mut MufasaRequester) -> *mut StationRecord {
    // SAFETY: the caller's duty; the end of the requester is in the same memory.
    unsafe { requester.add(1) }.cast()
}

fn status(result: Result<(), MufasaStatus>) -> MufasaStatus {
    match result {
        Ok(()) => MufasaStatus::Ok,
        Err(status) => status,
    }
}

/// Why an event was not taken.
pub(crate) fn refused(error: RequesterError) -> MufasaStatus {
    match error {
        RequesterError::NegativeParameter { .. } => MufasaStatus::NegativeParameter,
        RequesterError::Station { .. } => MufasaStatus::InvalidStation,
        RequesterError::TableFull { .. } => MufasaStatus::TableFull,
    }
}
