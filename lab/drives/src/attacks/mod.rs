//! Attacks on the remote services, injected into a drive (paper Sec. V-B, and the findings of
//! `findings/README.md`). An attack changes what the CAV receives, never what it measures
//! itself: detections and their history, route and grid stay as they are (but for
//! [`catalogue::Attack::BlindDetectors`]), and so do ego and lead unless the CAV is shown driving what it is
//! sent.
//!
//! Data are received where the configuration of the cycle says that their group is remote: tracks
//! in `AllRemote` and `MotRemote`, the trajectory in `AllRemote` and `PlanRemote`. Local data of
//! the other group may change in one way: in `MotRemote` the local planner plans with the received
//! tracks, so where those hide objects the local trajectory believes them, too. In `PlanRemote`
//! the tracks are the CAV's own, and an attack on tracks is none.

pub mod catalogue;
mod change;
mod course;
pub mod error;
pub mod injection;
mod meeting;
mod objects;
mod planner;

use crate::attacks::change::apply;
use crate::attacks::course::Course;
use crate::attacks::error::InjectError;
use crate::attacks::injection::Injection;
use crate::drive::Stream;

/// The same drive under attack. The drive is gone through once for what the attack does, and its cycles
/// are made again when they are asked for: none is kept.
///
/// Attacks that hide objects or their motion are dangerous only when the CAV drives what it is
/// sent, so in these it does: it leaves its recorded motion at the first attacked cycle, and the
/// drive ends with the last one, because nobody recorded what comes then. Its notes say what the
/// CAV would drive into.
///
/// Errors: no cycle is changed, because none is in the span, or the data of the attack are local,
/// absent, or as it would make them; or a cycle cannot be read again. An attacked drive that is safe is so in spite of the attack.
pub fn inject(drive: &Stream, injection: &Injection) -> Result<Stream, InjectError> {
    let (course, onset) = Course::of(drive, *injection)?;
    let (attack, clean, targets) = (injection.attack, drive.clone(), course.targets);
    let name = format!("{}+{}", drive.name, attack.name());
    let count = targets.len();
    let mut attacked = Stream::fallible(name, drive.source.clone(), count, move |index| {
        let mut made = clean.cycle(index)?;
        if let Some(target) = targets[index] {
            apply(&mut made.cycle, attack, &onset, target.before);
        }
        Ok(made)
    });
    attacked.lead_range_m = drive.lead_range_m;
    attacked.notes = drive.notes.iter().cloned().chain(course.notes).collect();
    Ok(attacked)
}
