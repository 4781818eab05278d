//! Tables of an exploration, for people.

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use mufasa_exploration::properties::{Law, Sight};
use mufasa_exploration::run::Outcome;
use mufasa_model::input::cycle::Profile;

use super::report::Property;

/// Width of a table, characters.
const WIDTH: u16 = 118;

/// The worlds with their sizes.
pub fn worlds(outcomes: &[Outcome]) -> String {
    let mut table = bare();
    table.set_header([
        "world",
        "requester: states",
        "steps compared",
        "states",
        "moves",
        "depth",
        "seconds",
        "MB",
        "stateright: states",
        "seconds",
    ]);
    for outcome in outcomes {
        let requesters = outcome.system.requesters();
        let (states, seconds) = match &outcome.second {
            None => (String::from("not asked"), String::new()),
            Some((second, time)) => {
                (grouped(wide(second.states)), format!("{:.1}", time.as_secs_f64()))
            }
        };
        table.add_row([
            outcome.system.world().name.to_owned(),
            grouped(wide(requesters.len())),
            grouped(wide(requesters.reactions())),
            grouped(wide(outcome.states)),
            grouped(outcome.transitions),
            outcome.depth.to_string(),
            format!("{:.1}", outcome.time.as_secs_f64()),
            outcome.bytes.div_ceil(1 << 20).to_string(),
            states,
            seconds,
        ]);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("{table}\n")
}

/// The properties with their verdicts over all worlds, and what shows that they are not empty.
pub fn properties(profile: Profile, outcomes: &[Outcome]) -> String {
    let mut table = bare();
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(["property", "", "verdict", "shown by"]);
    for law in Law::ALL {
        let property = Property::new(law, profile, outcomes);
        table.add_row([&property.name, property.kind, &property.verdict(), &property.shown_by]);
    }
    format!("{table}\n")
}

/// Sights with the length of a shortest trace to them, and the reach of endless runs.
pub fn evidence(law: Law, profile: Profile, outcomes: &[Outcome]) -> String {
    let mut parts = Vec::new();
    let reaches = outcomes.iter().flat_map(|outcome| &outcome.results);
    let reaches = reaches.filter(|finding| finding.law == law).filter_map(|finding| finding.ahead);
    if let Some((ahead, ticks)) = reaches.reduce(|one, other| (one.0 + other.0, one.1.max(other.1)))
    {
        parts.push(format!("from {} states within {ticks} ticks", grouped(wide(ahead))));
    }
    for sight in law.companions().iter().filter(|sight| sight.is_expected(profile)) {
        parts.push(match moves_to(law, *sight, outcomes) {
            Some(moves) => format!("{} ({moves})", sight.name()),
            None => format!("not seen: {}", sight.name()),
        });
    }
    parts.join("\n")
}

/// What a property of the profile speaks of, was asked about, and was not seen.
pub fn unseen(law: Law, profile: Profile, outcomes: &[Outcome]) -> Vec<Sight> {
    let sights = law.companions().iter().filter(|sight| sight.is_expected(profile));
    sights.filter(|sight| moves_to(law, **sight, outcomes).is_none()).copied().collect()
}

/// Moves of a shortest trace that shows it, in a world that asks the property.
fn moves_to(law: Law, sight: Sight, outcomes: &[Outcome]) -> Option<usize> {
    outcomes.iter().filter_map(|outcome| outcome.moves_to(law, sight)).min()
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

fn bare() -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED);
    table
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
