//! What was found, kept as vectors.

use std::io;
use std::path::{Path, PathBuf};

use mufasa_exploration::properties::Property;
use mufasa_exploration::replay::{self, Episode, ReplayError};
use mufasa_exploration::run::{Counterexample, WorldOutcome};
use mufasa_exploration::system::System;
use mufasa_model::input::cycle::Profile;

use super::vector;
use mufasa_conform::vectors::flag;
use mufasa_records::files;
use mufasa_records::{Trace, names};

/// A counterexample, told with real numbers.
pub struct Story<'a> {
    /// Its name: that of the finding, or of the property.
    pub name: String,
    /// The property that fails.
    pub property: Property,
    /// The system in which it was found.
    pub system: &'a System,
    /// What happens.
    pub episodes: Vec<Episode>,
}

/// The stories of all properties that fail: one without an attacker rather than one with, and
/// the shortest. Errors: a counterexample cannot be walked by the real parts.
pub fn stories(profile: Profile, outcomes: &[WorldOutcome]) -> Result<Vec<Story<'_>>, ReplayError> {
    let stories =
        Property::ALL.into_iter().filter_map(|property| story(property, profile, outcomes));
    stories.collect()
}

fn story(
    property: Property,
    profile: Profile,
    outcomes: &[WorldOutcome],
) -> Option<Result<Story<'_>, ReplayError>> {
    let failures = outcomes.iter().filter_map(|outcome| {
        let finding = outcome.results.iter().find(|finding| finding.property == property)?;
        Some((&*outcome.system, finding.counterexample.as_ref()?))
    });
    let length = |it: &Counterexample| it.trace.len() + it.circle.len();
    let (system, found) = failures.min_by_key(|(system, found)| {
        (system.world().attacker, system.world().requesters, length(found))
    })?;
    let name = if property.is_claimed(profile) {
        format!("explored-{}-{}", property.name(), names::profile(profile))
    } else {
        String::from("explored-F-12")
    };
    let episodes = replay::walk(system, &[found.trace.as_slice(), &found.circle].concat());
    Some(episodes.map(|episodes| Story { name, property, system, episodes }))
}

/// Writes the vectors of every story. Errors name the file.
pub fn write(folder: &Path, stories: &[Story<'_>]) -> Result<Vec<PathBuf>, (PathBuf, io::Error)> {
    let mut written = Vec::new();
    for story in stories {
        let file = folder.join(format!("{}.jsonl", files::name(&story.name)));
        let write = story.vectors().and_then(|content| files::write(&file, &content));
        write.map_err(|error| (file.clone(), error))?;
        written.push(file);
    }
    Ok(written)
}

impl Story<'_> {
    /// The vector of the first CAV in its profile, and the same events in the other one.
    pub fn vectors(&self) -> io::Result<String> {
        let events = vector::events(&self.episodes, 0);
        let profile = self.system.profile();
        let mut lines = String::new();
        for profile in [profile, flag::other(profile)] {
            let trace = Trace {
                profile,
                parameters: self.system.world().parameters(),
                events: events.clone(),
            };
            let id = format!("{}-{}", self.name, names::profile(profile));
            let vector = vector::of_trace(&id, self.requirement(), self.note(profile), &trace)?;
            lines.extend([vector.to_string().as_str(), "\n"]);
        }
        Ok(lines)
    }

    fn requirement(&self) -> &'static str {
        match self.property {
            Property::NoStopBeforeSafeCycle => "F-12",
            property => property.requirement(),
        }
    }

    fn note(&self, profile: Profile) -> &'static str {
        match (self.property, profile) {
            (Property::NoStopBeforeSafeCycle, Profile::PAPER) => {
                "Break before make: the local services of the group stop at the confirmation, \
                 before any result of the station"
            }
            (Property::NoStopBeforeSafeCycle, Profile::HARDENED) => {
                "Make before break: after the same events the local services of the group compute"
            }
            _ => "Shortest trace that the exploration found",
        }
    }
}
