//! Ways along a path that may be closed.

use crate::path::Path;

/// How far an arc length is ahead of another, m; negative behind. On a closed path the nearer way round.
pub fn ahead_of(path: &Path, from: f64, to: f64) -> f64 {
    let (way, length) = (to - from, path.length());
    if path.is_closed() { way - (way / length).round() * length } else { way }
}
