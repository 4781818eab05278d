//! `mufasa::cycle::check` for C.

use core::ffi::c_void;
use core::ptr::null;

use mufasa::cycle;
use mufasa::input::indexes::Indexes;
use mufasa::input::parameters::Parameters;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::report::{InvalidInput, Report};

use crate::convert::{self, Counts};
use crate::cycle::MufasaCycle;
use crate::detection_index::{Kept, MufasaDetectionIndex};
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
/// is not OK it is not safe. Use data of a cycle only when it is safe, and tell the
/// requester of every other one as unsafe.
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
    unsafe { mufasa_check_with(cycle, null(), 0, scratch, scratch_bytes, report) }
}

/// As `mufasa_check`, with what the caller keeps of the cycle's lists of detections, in any order: an
/// array of `indexes_len` pointers to indexes, of which each may be null. An index of another list
/// is not used. The answer is the same.
///
/// # Safety
/// As for `mufasa_check`; `indexes` points to `indexes_len` pointers, each of which is null or comes
/// from `mufasa_detection_index_init`, in memory that nobody else writes to during the call.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_check_with(
    cycle: *const MufasaCycle,
    indexes: *const *const MufasaDetectionIndex,
    indexes_len: usize,
    scratch: *mut c_void,
    scratch_bytes: usize,
    report: *mut MufasaReport,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let kept = unsafe { Kept::new(indexes, indexes_len) };
    // SAFETY: the caller's duty.
    let answer = kept.and_then(|kept| unsafe { check(cycle, kept, scratch, scratch_bytes) });
    let (status, told) = match answer {
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
/// As for [`mufasa_check_with`].
unsafe fn check(
    raw: *const MufasaCycle,
    kept: Kept<'_>,
    scratch: *mut c_void,
    scratch_bytes: usize,
) -> Result<Result<Report, InvalidInput>, MufasaStatus> {
    // SAFETY: the caller's duty.
    let raw = unsafe { required(raw) }?;
    // SAFETY: the caller's duty.
    let mut arena = unsafe { Arena::new(scratch, scratch_bytes) }?;
    // SAFETY: the caller's duty.
    let cycle = unsafe { convert::cycle(raw, kept, &mut arena) }?;
    let sizes = convert::capped(Sizes::for_cycle(&cycle));
    let rows = arena.keep((0..sizes.rows).map(|_| Row::default()))?;
    let columns = arena.keep((0..sizes.columns).map(|_| Column::default()))?;
    // SAFETY: the caller's duty.
    let (indexes, count) = unsafe { convert::indexes(raw, kept) }?;
    let detections = indexes.get(..count).unwrap_or(&[]);
    let indexes = Indexes { route: None, detections };
    Ok(cycle::check_with(&cycle, &indexes, &mut Scratch::new(rows, columns)))
}
