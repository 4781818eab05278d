//! Tables of an exploration, for people.

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::WorldOutcome;
use mufasa_model::input::cycle::Profile;

use super::evidence::{grouped, wide};
use super::report::PropertyRow;

/// Width of a table, characters.
const WIDTH: u16 = 118;

/// The worlds with their sizes.
pub fn worlds(outcomes: &[WorldOutcome]) -> String {
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
pub fn properties(profile: Profile, outcomes: &[WorldOutcome]) -> String {
    let mut table = bare();
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(["property", "", "verdict", "shown by"]);
    for property in Property::ALL {
        let property = PropertyRow::new(property, profile, outcomes);
        table.add_row([&property.name, property.kind, &property.verdict(), &property.shown_by]);
    }
    format!("{table}\n")
}

fn bare() -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED);
    table
}
