//! The lines as a table, for people and for documents.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::line::{Line, Verdict};

/// Width of a table, characters.
const WIDTH: u16 = 150;

/// For a terminal, with the number of each verdict below.
pub fn text(lines: &[Line]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH);
    table.set_header(["id", "statement", "engine", "domain", "verdict", "seconds"]);
    for line in lines {
        let verdict = match &line.reason {
            Some(reason) => format!("{}: {reason}", line.verdict.name()),
            None => line.verdict.name().to_owned(),
        };
        let cells =
            [&line.id.replace('_', " "), &line.statement, &line.engine, &line.domain, &verdict];
        table.add_row(cells.into_iter().cloned().chain([seconds(line)]));
    }
    if let Some(column) = table.column_mut(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let trimmed: String =
        table.to_string().lines().flat_map(|line| [line.trim_end(), "\n"]).collect();
    format!("{trimmed}{}\n", counts(lines))
}

/// For the README.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = String::from(
        "| id | statement | engine | domain | verdict | s |\n|---|---|---|---|---|---|\n",
    );
    for line in lines {
        let cells = [&line.id.replace('_', " "), &line.statement, &line.engine, &line.domain]
            .map(|cell| cell.replace('|', "\\|"));
        let (verdict, seconds) = (line.verdict.name(), seconds(line));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {} | {verdict} | {seconds} |", cells.join(" | "));
    }
    format!("{text}\n{}\n", counts(lines))
}

fn seconds(line: &Line) -> String {
    line.seconds.map_or_else(String::new, |seconds| format!("{seconds:.2}"))
}

fn counts(lines: &[Line]) -> String {
    let verdicts = [Verdict::Proved, Verdict::Refuted, Verdict::Unknown, Verdict::NotRun];
    let count = |verdict| lines.iter().filter(|line| line.verdict == verdict).count();
    let counts = verdicts.map(|verdict| format!("{} {}", count(verdict), verdict.name()));
    counts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_run_is_not_counted_as_proved() {
        let line = Line::not_run("z3", ["an_id", "a | b", "all"], "no z3 here");
        let proved = Line { verdict: Verdict::Proved, reason: None, ..line.clone() };
        let lines = [line, proved.clone(), proved];
        let text = text(&lines);
        assert!(text.contains("not run: no z3 here"), "{text}");
        assert!(text.ends_with("2 proved, 0 refuted, 0 unknown, 1 not run\n"), "{text}");
        assert!(markdown(&lines).contains("| an id | a \\| b | z3 | all | not run |  |"));
    }
}
