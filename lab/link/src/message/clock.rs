//! Times as the formats count them (`spec/6-link.md#times`). ms are rounded down: what is measured is
//! never said to be younger than it is.

use super::error::{DecodeError, EncodeError, Place, Problem};

const NS_PER_MS: i64 = 1_000_000;
/// ms that a time of measurement may be before or after the generation.
const MEASURED_MS: [i64; 2] = [-1500, 1500];
/// ms that the time of a pose may be before or after the generation: half of what a generation delta
/// time can tell.
const POSE_MS: [i64; 2] = [-32_768, 32_767];
const NS_PER_US: i64 = 1_000;
/// us that a point of a trajectory may be before or after its stamp.
const POINT_US: i32 = 1 << 27;
const POINT: Place = Place::of("points", "t_ns");
const STAMP: Place = Place::of("message", "stamp_ns");

/// The generation delta time of a time: its ms modulo 65536.
pub(super) fn delta_time(time_ns: i64) -> u16 {
    low_bits(time_ns.div_euclid(NS_PER_MS))
}

/// ms from the generation to a measurement.
pub(super) fn measured(generated_ns: i64, stamp_ns: i64) -> Result<i16, EncodeError> {
    since(generated_ns, stamp_ns, MEASURED_MS)
}

/// The generation delta time of a pose.
pub(super) fn pose_time(generated_ns: i64, stamp_ns: i64) -> Result<u16, EncodeError> {
    since(generated_ns, stamp_ns, POSE_MS).map(|_| delta_time(stamp_ns))
}

/// The time so many ms after the generation.
pub(super) fn read_measured(generated_ns: i64, ms: i16) -> Result<i64, DecodeError> {
    let ms = generated_ns.div_euclid(NS_PER_MS) + i64::from(ms);
    ms.checked_mul(NS_PER_MS).ok_or(DecodeError::OutOfRange(STAMP))
}

/// The time nearest to the generation with this generation delta time.
pub(super) fn read_pose_time(generated_ns: i64, time: u16) -> Result<i64, DecodeError> {
    read_measured(generated_ns, time.wrapping_sub(delta_time(generated_ns)).cast_signed())
}

/// us from the stamp of a trajectory to one of its points, the nearest.
pub(super) fn point_time(stamp_ns: i64, t_ns: i64) -> Result<i32, EncodeError> {
    let us = t_ns.checked_sub(stamp_ns).and_then(|ns| ns.checked_add(NS_PER_US / 2));
    let us = us.and_then(|ns| i32::try_from(ns.div_euclid(NS_PER_US)).ok());
    us.filter(|us| (-POINT_US..POINT_US).contains(us)).ok_or_else(|| {
        let edge = |us: i32| nanoseconds(stamp_ns) + f64::from(us) * 1e3;
        let (least, most) = (edge(-POINT_US), edge(POINT_US - 1));
        EncodeError { place: POINT, problem: Problem::OutOfRange { least, most } }
    })
}

/// The time so many us after the stamp.
pub(super) fn read_point_time(stamp_ns: i64, us: i32) -> Result<i64, DecodeError> {
    let t_ns = stamp_ns.checked_add(i64::from(us) * NS_PER_US);
    t_ns.ok_or(DecodeError::OutOfRange(POINT))
}

fn since(generated_ns: i64, stamp_ns: i64, limits: [i64; 2]) -> Result<i16, EncodeError> {
    let generated_ms = generated_ns.div_euclid(NS_PER_MS);
    let ms = stamp_ns.div_euclid(NS_PER_MS) - generated_ms;
    let is_inside = (limits[0]..=limits[1]).contains(&ms);
    i16::try_from(ms).ok().filter(|_| is_inside).ok_or_else(|| {
        let [least, most] = limits.map(|limit| nanoseconds(generated_ms + limit) * 1e6);
        EncodeError { place: STAMP, problem: Problem::OutOfRange { least, most } }
    })
}

#[allow(clippy::cast_precision_loss, reason = "for a message to people")]
fn nanoseconds(count: i64) -> f64 {
    count as f64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the low 16 bits")]
fn low_bits(ms: i64) -> u16 {
    ms as u16
}
