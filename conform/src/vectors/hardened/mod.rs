//! The rules of `spec/3-stages.md#hardened-profile` on both sides of their thresholds, one file
//! per rule. H-08 is a rule of the protocol.

pub mod objects;
mod schedule;
mod trajectory;

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use crate::vectors::base::base;
use crate::vectors::book::Book;

/// Adds them.
pub fn add(book: &mut Book) {
    objects::add(book);
    schedule::add(book);
    trajectory::add(book);
}

/// The base cycle in PlanRemote without detections and grid, changed.
fn plan(change: impl FnOnce(&mut Cycle)) -> Cycle {
    let mut cycle = base(Profile::Hardened, PlanRemote);
    (cycle.detections, cycle.grid) = (None, None);
    change(&mut cycle);
    cycle
}
