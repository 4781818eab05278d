//! What becomes of a CAV that drives what an attacker sends it, and that nothing stops.

use mufasa_model::input::cycle::{Cycle, Track};

use crate::drive::DriveCycle;
use crate::geometry::{Rectangle, add, scale};

/// The first collision of the attacked CAV with an object that the CAV of the clean drive does not
/// touch in that cycle, as a note; `since_s` gives the time of a cycle. The objects are the tracks
/// of the clean drive, moved on to the cycle's time.
pub(super) fn note(
    attacked: &[DriveCycle],
    clean: &[DriveCycle],
    since_s: impl Fn(&Cycle) -> f64,
) -> Option<String> {
    attacked.iter().zip(clean).find_map(|(attacked, clean)| {
        let (attacked, clean) = (&attacked.cycle, &clean.cycle);
        let tracks = clean.tracks.as_ref()?;
        let later = super::seconds(clean.now_ns.saturating_sub(tracks.stamp_ns));
        let met = tracks.items.iter().find(|track| {
            let object = object(track, later);
            cav(attacked).meets(&object) && !cav(clean).meets(&object)
        })?;
        let at = since_s(attacked);
        // Braking at a_b from here on ends a way v^2 / (2 a_b) ahead, which takes v / (2 a_b).
        let until = at - attacked.ego.speed / (2.0 * attacked.parameters.a_b);
        Some(format!(
            "the CAV meets object {} at {at:.1} s, braking helps until {until:.1} s",
            met.id
        ))
    })
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
