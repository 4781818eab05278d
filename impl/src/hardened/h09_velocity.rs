//! Tracks that the previous list holds, and those that it does not (H-09 of
//! `spec/3-stages.md#hardened-profile`).

use crate::input::cycle::{Cycle, Track, TrackList};
use crate::input::profile::Profile;
use crate::numbers::plane::Vector;
use crate::numbers::rounding::Real;
use crate::numbers::time::elapsed_ns;
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::llcc::sweep::MovingRectangle;
use crate::stages::llcc::{CavMotion, Collision};

const SECOND_NS: i64 = 1_000_000_000;

/// `previous_tracks` when the difference of stamps is in (0, 1 s] and they are not too old to be
/// used at all.
pub(crate) fn previous_in_use<'c, 'a>(
    cycle: &'c Cycle<'a>,
    tracks: &TrackList<'_>,
    usable: bool,
) -> Option<&'c TrackList<'a>> {
    let previous = cycle.previous_tracks.as_ref()?;
    let dt_ns = elapsed_ns(previous.stamp_ns, tracks.stamp_ns);
    let in_use = cycle.profile == Profile::Hardened && usable && 0 < dt_ns && dt_ns <= SECOND_NS;
    in_use.then_some(previous)
}

/// Stage i: abs(p - `p_prev` - v dt) <= `theta_velocity` dt for every track whose id is held.
pub(crate) fn velocity_failure(
    cycle: &Cycle<'_>,
    tracks: &TrackList<'_>,
    previous: &TrackList<'_>,
) -> Option<Witness> {
    let dt = Real::seconds(elapsed_ns(previous.stamp_ns, tracks.stamp_ns));
    let limit = Real::new(cycle.parameters.theta_velocity) * dt;
    let mut hint = 0_usize;
    tracks.items.iter().find_map(|track| {
        // Trackers keep their order, so that most tracks follow one another in both lists.
        if previous.items.get(hint).is_none_or(|held| held.id != track.id) {
            hint = previous.items.iter().position(|held| held.id == track.id)?;
        }
        let held = previous.items.get(hint)?;
        hint = hint.saturating_add(1);
        // Plain doubles err by less than 2^-22 m.
        let (x, y) =
            (track.x - held.x - track.vx * dt.value(), track.y - held.y - track.vy * dt.value());
        let least = limit.value() - 1e-6;
        if least > 0.0 && x * x + y * y < least * least {
            return None;
        }
        let moved = Vector::between([held.x, held.y], [track.x, track.y]);
        let off = (moved - Vector::new(track.vx, track.vy).times(dt)).norm();
        let witness = Witness::of(Rule::Velocity, [off.value(), limit.value()]);
        let fits = off.certainly_at_most(limit);
        (!fits).then_some(Witness { track: Some(track.id), ..witness })
    })
}

/// Stage iii: whether tracks that are not held are examined as standing still, too.
pub(crate) fn examines_standing(cycle: &Cycle<'_>) -> bool {
    cycle.profile == Profile::Hardened && cycle.configuration == Configuration::AllRemote
}

/// Stage iii: the first collision with a track that is not held, taken as standing still.
pub(crate) fn collision_standing(
    motion: &CavMotion<'_, '_>,
    tracks: &TrackList<'_>,
    held: Option<&TrackList<'_>>,
) -> Option<Collision> {
    let is_held = |id: i64| held.is_some_and(|list| list.items.iter().any(|old| old.id == id));
    let counts = |index: usize| tracks.items.get(index).is_some_and(|track| !is_held(track.id));
    let still =
        |track: &Track| MovingRectangle { velocity: [0.0; 2], ..MovingRectangle::track(track) };
    motion.first_collision(tracks.items.iter().map(still), counts)
}
