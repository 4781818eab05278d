//! A witness of every finding of `spec/3-stages.md#findings`, one file per finding: what the paper
//! profile answers, and the hardened one where a rule closes the finding. F-19 has none, see the
//! README of the vectors.

mod assumptions;
mod lasting;
mod published;

use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::services::configuration::Configuration;

use crate::vectors::base::base;
use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{Expected, safe};

/// Adds them.
pub fn add(book: &mut Book) {
    published::add(book);
    assumptions::add(book);
    lasting::add(book);
}

/// The topic of a finding and the file of that name.
const fn finding(file: &'static str, name: &'static str) -> Topic {
    Topic::new(file, name)
}

/// A witness: accepted in the paper profile, and what the hardened profile says.
fn witness(
    book: &mut Book,
    topic: Topic,
    (name, note): (&str, &str),
    hardened: &Expected,
    cycle: impl Fn(Profile) -> Cycle,
) {
    let name = |profile: &str| {
        if name.is_empty() { profile.to_owned() } else { format!("{name}-{profile}") }
    };
    book.cycle(topic, &name("paper"), note, &cycle(Profile::Paper), &safe());
    book.cycle(topic, &name("hardened"), note, &cycle(Profile::Hardened), hardened);
}

/// The base cycle without the inputs of other stages, changed.
fn bare(profile: Profile, configuration: Configuration, change: impl FnOnce(&mut Cycle)) -> Cycle {
    let mut cycle = base(profile, configuration);
    (cycle.tracks, cycle.detections, cycle.grid) = (None, None, None);
    change(&mut cycle);
    cycle
}
