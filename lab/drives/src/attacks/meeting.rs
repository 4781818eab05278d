//! What becomes of a CAV that drives what an attacker sends it, and that nothing stops.

use mufasa_model::input::cycle::{Cycle, Track};

use crate::geometry::{Rectangle, add, scale};
use crate::seconds;

/// A collision of the attacked CAV with an object that the CAV of the clean drive does not touch in
/// that cycle, as a note; `at_s` is the cycle's time. The objects are the tracks of the clean drive,
/// moved on to the cycle's time.
pub(super) fn note(attacked: &Cycle, clean: &Cycle, at_s: f64) -> Option<String> {
    let tracks = clean.tracks.as_ref()?;
    let later = seconds(tracks.stamp_ns, clean.now_ns);
    let met = tracks.items.iter().find(|track| {
        let object = object(track, later);
        cav(attacked).meets(&object) && !cav(clean).meets(&object)
    })?;
    // Braking at a_b from here on ends a way v^2 / (2 a_b) ahead, which takes v / (2 a_b).
    let until_s = at_s - attacked.ego.speed / (2.0 * attacked.parameters.a_b);
    Some(format!(
        "the CAV meets object {} at {at_s:.1} s, braking helps until {until_s:.1} s",
        met.id
    ))
}

fn object(track: &Track, later: f64) -> Rectangle {
    Rectangle {
        center: add([track.x, track.y], scale([track.vx, track.vy], later)),
        heading: track.sin.atan2(track.cos),
        length: track.length,
        width: track.width,
    }
}

fn cav(cycle: &Cycle) -> Rectangle {
    let ego = &cycle.ego;
    let ahead = scale([ego.cos, ego.sin], ego.center_offset);
    Rectangle {
        center: add([ego.x, ego.y], ahead),
        heading: ego.sin.atan2(ego.cos),
        length: ego.length,
        width: ego.width,
    }
}
