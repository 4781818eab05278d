//! Ways along a path that may be closed, and times.

use crate::path::Path;

/// How far an arc length is ahead of another, m; negative behind. On a closed path the nearer way round.
pub fn ahead_of(path: &Path, from: f64, to: f64) -> f64 {
    let (way, length) = (to - from, path.length());
    if path.is_closed() { way - (way / length).round() * length } else { way }
}

/// A time, ns, in seconds.
#[allow(clippy::cast_precision_loss)] // differences of stamps, far below 2^53
pub fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}
