//! Tables of outcomes, for people.

use comfy_table::{CellAlignment, ContentArrangement, Row, Table, presets};
use mufasa_model::report::Stage;

use crate::check::tally::{StageTally, Tally};
use crate::check::words;

/// The outcomes by stage, of the implementation where they are others.
pub fn by_stage(model: &Tally, implementation: &Tally) -> String {
    if implementation == model {
        return stages(model);
    }
    format!("model\n{}implementation\n{}", stages(model), stages(implementation))
}

/// A line of the table over all drives.
pub struct Line {
    /// Name of the drive.
    pub name: String,
    /// The model's outcomes.
    pub tally: Tally,
    /// Fallbacks that the model's requester started.
    pub fallbacks: usize,
    /// Cycles whose remote data it used.
    pub offloaded: usize,
    /// Cycles that the implementation decides otherwise, within the rules or not.
    pub otherwise: usize,
    /// Cycles on which the two disagree beyond the rules.
    pub disagreements: usize,
}

/// The unsafe cycles of many drives by stage, with a sum when there are several.
pub fn by_drive(lines: &[Line]) -> String {
    let mut table = bare();
    let head = [
        "drive",
        "cycles",
        "safe",
        "unsafe",
        "i",
        "ii",
        "iii",
        "iv",
        "v",
        "other",
        "errors",
        "fallbacks",
        "offloaded",
        "implementation",
    ];
    table.set_header(head);
    let mut sum = Line {
        name: format!("all {} drives", lines.len()),
        tally: Tally::default(),
        fallbacks: 0,
        offloaded: 0,
        otherwise: 0,
        disagreements: 0,
    };
    for line in lines {
        table.add_row(cells(line));
        sum.tally.merge(&line.tally);
        sum.fallbacks += line.fallbacks;
        sum.offloaded += line.offloaded;
        sum.otherwise += line.otherwise;
        sum.disagreements += line.disagreements;
    }
    if lines.len() > 1 {
        table.add_row(cells(&sum));
    }
    numbers_right(&mut table, 1..13);
    finished(&table)
}

fn cells(line: &Line) -> Row {
    let Line { tally, .. } = line;
    let other = tally.input + tally.no_obstacle_check;
    let counts = [tally.cycles, tally.safe, tally.unsafe_cycles()]
        .into_iter()
        .chain(tally.stages.iter().map(|stage| stage.failed))
        .chain([other, tally.errors, line.fallbacks, line.offloaded])
        .map(|count| count.to_string());
    let agreement = match (line.otherwise, line.disagreements) {
        (0, 0) => "the same".to_owned(),
        (otherwise, 0) => format!("{otherwise} otherwise, within the margin"),
        (_, disagreements) => format!("{disagreements} DISAGREE"),
    };
    Row::from(std::iter::once(line.name.clone()).chain(counts).chain([agreement]))
}

/// Rows of outcomes, and of failures that belong to no stage, where there are such.
fn stages(tally: &Tally) -> String {
    let mut table = bare();
    table.set_header(["stage", "run", "passed", "failed", "skipped", "n/a", "not sched."]);
    let mut row = |name: &str, counts: [String; 6]| {
        table.add_row(Row::from(std::iter::once(name.to_owned()).chain(counts)));
    };
    for (stage, count) in Stage::ALL.into_iter().zip(&tally.stages) {
        let StageTally { passed, failed, skipped, not_applicable, not_scheduled } = *count;
        let counts = [count.run(), passed, failed, skipped, not_applicable, not_scheduled];
        row(words::stage(stage), counts.map(|n| n.to_string()));
    }
    for (name, count) in [
        ("no obstacle check", tally.no_obstacle_check),
        ("invalid remote input", tally.input),
        ("invalid local input", tally.errors),
    ] {
        if count > 0 {
            row(name, ["", "", &count.to_string(), "", "", ""].map(String::from));
        }
    }
    numbers_right(&mut table, 1..7);
    finished(&table)
}

fn bare() -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table
}

fn numbers_right(table: &mut Table, columns: std::ops::Range<usize>) {
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((0, 1));
        if columns.contains(&index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
}

fn finished(table: &Table) -> String {
    table.to_string().lines().flat_map(|line| [line.trim_end(), "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(failed: usize) -> Tally {
        let mut tally = Tally { cycles: 10, safe: 10 - failed, ..Tally::default() };
        tally.stages[2].failed = failed;
        tally.stages[2].passed = 10 - failed;
        tally
    }

    #[test]
    fn what_the_implementation_decides_otherwise_has_a_table_of_its_own() {
        let numbers = |text: &str, row: &str| -> Vec<Vec<u32>> {
            let lines = text.lines().filter(|line| line.starts_with(row));
            lines.map(|line| line.split(' ').filter_map(|it| it.parse().ok()).collect()).collect()
        };
        let same = by_stage(&tally(3), &tally(3));
        assert_eq!(numbers(&same, "iii "), [[10, 7, 3, 0, 0, 0]]);
        assert_eq!((same.lines().count(), same.contains("invalid")), (6, false));
        let both = by_stage(&tally(3), &Tally { input: 2, ..tally(4) });
        assert_eq!(numbers(&both, "iii "), [[10, 7, 3, 0, 0, 0], [10, 6, 4, 0, 0, 0]]);
        assert_eq!(numbers(&both, "invalid remote input"), [[2]]);
    }

    #[test]
    fn several_drives_are_summed_and_disagreements_stand_out() {
        let line = |name: &str, failed, disagreements| Line {
            name: name.to_owned(),
            tally: tally(failed),
            fallbacks: 1,
            offloaded: 10,
            otherwise: disagreements,
            disagreements,
        };
        let text = by_drive(&[line("a", 3, 0), line("b", 1, 2)]);
        let sum = text.lines().last().unwrap();
        let words: Vec<_> = sum.split_whitespace().collect();
        assert_eq!(words[..6], ["all", "2", "drives", "20", "16", "4"]);
        assert!(sum.ends_with("2 DISAGREE"));
        assert!(text.lines().nth(1).unwrap().ends_with("the same"));
        assert_eq!(by_drive(&[line("a", 3, 0)]).lines().count(), 2);
    }
}
