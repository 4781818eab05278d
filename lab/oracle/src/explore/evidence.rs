//! What shows that a property is not empty.

use mufasa_exploration::properties::{Property, Sight};
use mufasa_exploration::run::WorldOutcome;
use mufasa_model::input::cycle::Profile;

/// Sights with the length of a shortest trace to them, and the reach of endless runs.
pub fn of_property(property: Property, profile: Profile, outcomes: &[WorldOutcome]) -> String {
    let mut parts = Vec::new();
    let reaches = outcomes.iter().flat_map(|outcome| &outcome.results);
    let reaches =
        reaches.filter(|finding| finding.property == property).filter_map(|finding| finding.ahead);
    if let Some((ahead, ticks)) = reaches.reduce(|one, other| (one.0 + other.0, one.1.max(other.1)))
    {
        parts.push(format!("from {} states within {ticks} ticks", grouped(wide(ahead))));
    }
    for sight in property.companions().iter().filter(|sight| sight.is_expected(profile)) {
        parts.push(match moves_to(property, *sight, outcomes) {
            Some(moves) => format!("{} ({moves})", sight.name()),
            None => format!("not seen: {}", sight.name()),
        });
    }
    parts.join("\n")
}

/// What a property of the profile speaks of, was asked about, and was not seen.
pub fn unseen(property: Property, profile: Profile, outcomes: &[WorldOutcome]) -> Vec<Sight> {
    let sights = property.companions().iter().filter(|sight| sight.is_expected(profile));
    sights.filter(|sight| moves_to(property, **sight, outcomes).is_none()).copied().collect()
}

/// Moves of a shortest trace that shows it, in a world that asks the property.
fn moves_to(property: Property, sight: Sight, outcomes: &[WorldOutcome]) -> Option<usize> {
    outcomes.iter().filter_map(|outcome| outcome.moves_to(property, sight)).min()
}

/// A number with its thousands apart.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.char_indices() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count in 64 bits.
pub fn wide(count: usize) -> u64 {
    u64::try_from(count).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_000), "1,000");
        assert_eq!(grouped(1_330_746), "1,330,746");
    }
}
