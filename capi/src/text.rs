//! What numbers mean, in words for a log.

use core::ffi::{CStr, c_char};

/// By their numbers.
const STATUSES: [&CStr; 17] = [
    c"done",
    c"a pointer that must not be null is null",
    c"a pointer is misaligned",
    c"a value that does not exist, or no time",
    c"too little memory",
    c"a parameter or a number of sessions below 0",
    c"a station below 1",
    c"no place for another station",
    c"a parameter of the stages outside its domain",
    c"a period not above 0",
    c"dt_max not above the period",
    c"an invalid route",
    c"a time too short to be in ns",
    c"max_age below l_max",
    c"tau not above the period",
    c"a cycle may take longer than check_time",
    c"a setting that no road vehicle has",
];
const DROP_REASONS: [&CStr; 9] = [
    c"not dropped",
    c"too many tracks or points",
    c"not of the running session",
    c"generated after it arrived",
    c"latency above l_max",
    c"older than max_age",
    c"no cycle could use those before it",
    c"more than dt_max after the last arrival",
    c"not newer than the last one used",
];
/// From 1 on.
const ACTIONS: [&CStr; 5] = [
    c"send a request",
    c"send a release",
    c"start the local services",
    c"stop the local services",
    c"drop the element",
];

const ADVICE: [&CStr; 9] = [
    c"no advice",
    c"cycles come in another period than period_ns",
    c"no detections are current; is their stamp right?",
    c"no lead is current, as if nobody were ahead; is its stamp right?",
    c"no grid is current; is its stamp right?",
    c"the gap does not change as the speeds say; are they in m/s over ground?",
    c"the gap is longer than the way to the detection ahead; is it between bumpers?",
    c"the gap is shorter than the way to the detection ahead; are sizes and center_offset right?",
    c"no tick comes before the cycles; nothing is offloaded without it",
];
const FAILED_STAGES: [&CStr; 9] = [
    c"none failed",
    c"stage i, track validation",
    c"stage ii, trajectory to map",
    c"stage iii, trajectory with tracks",
    c"stage iv, trajectory with detections",
    c"stage v, trajectory with grid map",
    c"invalid remote data",
    c"a trajectory that nothing compared with obstacles",
    c"invalid local input, or a call that failed",
];

fn text(of: &[&'static CStr], number: u32) -> *const c_char {
    let known = usize::try_from(number).ok().and_then(|index| of.get(index).copied());
    known.unwrap_or(c"unknown").as_ptr()
}

/// A MufasaStatus in words, which live as long as the program.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_status_text(status: u32) -> *const c_char {
    text(&STATUSES, status)
}

/// A MufasaDropReason in words.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_drop_reason_text(reason: u32) -> *const c_char {
    text(&DROP_REASONS, reason)
}

/// A MufasaActionType in words.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_action_text(action_type: u32) -> *const c_char {
    text(&ACTIONS, action_type.wrapping_sub(1))
}

/// A MufasaAdvice in words.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_advice_text(advice: u32) -> *const c_char {
    text(&ADVICE, advice)
}

/// A MufasaFailedStage in words.
#[must_use]
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_failed_stage_text(failed_stage: u32) -> *const c_char {
    text(&FAILED_STAGES, failed_stage)
}
