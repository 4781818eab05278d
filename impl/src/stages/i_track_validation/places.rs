//! Where the tracks are that stage i compares with detections: where the list says, or where they are at
//! another time (`spec/3-stages.md#stage-i-track-validation`).

use crate::input::cycle::{Detection, Track, TrackList};
use crate::numbers::plane::{Vector, distance};
use crate::numbers::rounding::Real;
use crate::numbers::time::{elapsed_ns, seconds};

/// Tracks, and for how long each has moved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Places<'a> {
    pub(crate) tracks: &'a [Track],
    /// From the stamp of the tracks to that time, ns.
    pub(crate) ahead_ns: i64,
    /// The same in s.
    ahead: f64,
}

impl<'a> Places<'a> {
    /// Where tracks are at that time.
    pub(crate) fn at(tracks: &TrackList<'a>, time_ns: i64) -> Self {
        let ahead_ns = elapsed_ns(tracks.stamp_ns, time_ns);
        Self { tracks: tracks.items, ahead_ns, ahead: seconds(ahead_ns) }
    }

    /// Where the list says: tracks that have not moved.
    pub(crate) const fn standing(tracks: &'a [Track]) -> Self {
        Self { tracks, ahead_ns: 0, ahead: 0.0 }
    }

    /// Where a track is; within 4e-9 m when it has moved: coordinates are below 2^25 m.
    pub(crate) fn of(&self, track: &Track) -> [f64; 2] {
        [track.x + track.vx * self.ahead, track.y + track.vy * self.ahead]
    }

    /// The distance of a track to a detection in plain doubles, m: relative error below 4 * 2^-53
    /// for distances above 1e-130 and tracks that have not moved, else an error of less than
    /// 1e-10 m more.
    pub(crate) fn metres(&self, track: &Track, detection: &Detection) -> f64 {
        apart([track.x, track.y], self.moved(track), [detection.x, detection.y])
    }

    /// How far a track has moved, m.
    pub(crate) fn moved(&self, track: &Track) -> [f64; 2] {
        [track.vx * self.ahead, track.vy * self.ahead]
    }

    /// The same with its error.
    pub(crate) fn distance(&self, track: &Track, detection: &Detection) -> Real {
        let (at, seen) = ([track.x, track.y], [detection.x, detection.y]);
        if self.ahead_ns == 0 {
            return distance(at, seen);
        }
        let moved = Vector::new(track.vx, track.vy).times(Real::seconds(self.ahead_ns));
        (Vector::between(seen, at) + moved).norm()
    }
}

/// How far a point that has moved is from another one, m.
pub(crate) fn apart([ax, ay]: [f64; 2], [dx, dy]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (x, y) = ((ax - bx) + dx, (ay - by) + dy);
    libm::sqrt(x * x + y * y)
}
