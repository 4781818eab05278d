//! `mufasa::cycle::check` for C.

use core::ffi::c_void;

use mufasa::cycle;
use mufasa::input::parameters::Parameters;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{InvalidInput, Report};

use crate::convert::{self, Counts};
use crate::cycle::MufasaCycle;
use crate::memory::{Arena, put, required};
use crate::parameters::MufasaParameters;
use crate::report::{self, MufasaReport};
use crate::status::MufasaStatus;

/// Bytes of scratch memory that are enough for every cycle.
pub const MUFASA_SCRATCH_BYTES_MAX: usize = 1 << 21;

const _: () = assert!(Counts::MAX.bytes() <= MUFASA_SCRATCH_BYTES_MAX);

/// The defaults of spec/3-stages.md.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_parameters_default() -> MufasaParameters {
    Parameters::default().into()
}

/// Bytes of scratch memory that `mufasa_check` needs for this cycle, at any alignment;
/// MUFASA_SCRATCH_BYTES_MAX when the cycle cannot be read.
///
/// # Safety
/// Every pointer in the cycle is null or points to what its type says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_scratch_bytes(cycle: *const MufasaCycle) -> usize {
    // SAFETY: the caller's duty.
    let Ok(cycle) = (unsafe { required(cycle) }) else { return MUFASA_SCRATCH_BYTES_MAX };
    // SAFETY: the caller's duty.
    unsafe { Counts::of(cycle) }.map_or(MUFASA_SCRATCH_BYTES_MAX, |counts| counts.bytes())
}

/// Decides one cycle. Unless `report` is null or misaligned it is always written; when the status
/// is not OK it is not safe. Use data of a cycle only when it is safe. No requester is told of it, so
/// that nothing falls back: a vehicle calls `mufasa_monitor_cycle`.
///
/// # Safety
/// Every pointer in the cycle is null or points to what its type says, in the number that is
/// given beside it, which nobody writes to during the call. `scratch` points to `scratch_bytes`
/// bytes that nobody else uses during the call and that overlap nothing in the cycle and not the
/// report; their content means nothing before and after.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_check(
    cycle: *const MufasaCycle,
    scratch: *mut c_void,
    scratch_bytes: usize,
    report: *mut MufasaReport,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let (status, told) = match unsafe { check(cycle, scratch, scratch_bytes) } {
        Ok(Ok(answer)) => (MufasaStatus::Ok, report::report_of(&answer)),
        Ok(Err(problem)) => (MufasaStatus::Ok, report::error(Some(problem))),
        Err(status) => (status, report::error(None)),
    };
    // SAFETY: the caller's duty.
    match unsafe { put(report, told) } {
        Ok(()) => status,
        Err(status) => status,
    }
}

/// # Safety
/// As for [`mufasa_check`].
unsafe fn check(
    raw: *const MufasaCycle,
    scratch: *mut c_void,
    scratch_bytes: usize,
) -> Result<Result<Report, InvalidInput>, MufasaStatus> {
    // SAFETY: the caller's duty.
    let raw = unsafe { required(raw) }?;
    // SAFETY: the caller's duty.
    let mut arena = unsafe { Arena::new(scratch, scratch_bytes) }?;
    // SAFETY: the caller's duty.
    let cycle = unsafe { convert::cycle(raw, &mut arena) }?;
    let sizes = convert::capped(Sizes::for_cycle(&cycle));
    let rows = arena.keep((0..sizes.rows).map(|_| Row::default()))?;
    let columns = arena.keep((0..sizes.columns).map(|_| Column::default()))?;
    Ok(cycle::check(&cycle, &mut Scratch::new(rows, columns)))
}
