//! The lines as a table, for people and for documents.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::claim::{Claim, EngineAnswer, Status};
use super::engines::Missing;

/// Width of a table, characters.
const WIDTH: u16 = 150;

/// For a terminal, with the drives that refute wrong variants.
pub fn text(lines: &[Claim]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH);
    table.set_header(["id", "statement", "engine", "domain", "verdict", "seconds"]);
    for line in lines {
        let cells = [
            line.id.replace('_', " "),
            line.statement.clone(),
            line.answer.engine.to_owned(),
            line.domain.clone(),
            verdict(line),
            seconds(&line.answer),
        ];
        table.add_row(cells);
    }
    if let Some(column) = table.column_mut(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let trimmed: String =
        table.to_string().lines().flat_map(|line| [line.trim_end(), "\n"]).collect();
    format!("{trimmed}{}", drives(lines))
}

fn drives(lines: &[Claim]) -> String {
    let drives = lines.iter().filter_map(|line| {
        let (wrong, drive) = line.refuted_variant.as_ref().zip(line.drive.as_ref())?;
        Some(format!("\nFalse: {wrong} ({})\n\n{drive}\n\n", line.id))
    });
    drives.collect()
}

/// The engines that are not here, a line for each.
pub fn missing(missing: &[Missing]) -> String {
    let line = |it: &Missing| {
        let Missing { engine, claims, package } = it;
        format!("{engine} is missing (claims: {claims}): {package}\n")
    };
    missing.iter().map(line).collect()
}

/// For documents: the number of verdicts of each engine, then every line.
pub fn markdown(lines: &[Claim]) -> String {
    let mut text =
        format!("{}\nClaims, each by the answer that counts: {}.\n", engines(lines), counts(lines));
    text.push_str("\n<details open><summary>Every line</summary>\n\n");
    text.push_str("| id | statement | engine | domain | verdict | s | fails when |\n");
    text.push_str("|---|---|---|---|---|--:|---|\n");
    for line in lines {
        let cells = [
            format!("`{}`", line.id),
            line.statement.clone(),
            line.answer.engine.to_owned(),
            line.domain.clone(),
            verdict(line),
            seconds(&line.answer),
            line.mutants.join("; "),
        ];
        let cells = cells.map(|cell| cell.replace('|', "\\|"));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text.push_str("\n</details>\n");
    text
}

/// What does not depend on a run of the lines of such a table: id, statement, domain, what makes
/// them fail.
pub fn claims(markdown: &str) -> Vec<[&str; 4]> {
    let rows = markdown.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.trim_matches(['|', ' ']).split(" | ").collect::<Vec<_>>());
    cells
        .filter_map(|cells| match cells.as_slice() {
            &[id, statement, _, domain, _, _, mutants] => Some([id, statement, domain, mutants]),
            _ => None,
        })
        .collect()
}

/// How often each engine gave each verdict. An engine may speak of a claim that another decides.
fn engines(lines: &[Claim]) -> String {
    let answers = || lines.iter().flat_map(|line| [&line.answer].into_iter().chain(&line.others));
    let mut names: Vec<&str> = Vec::new();
    for answer in answers() {
        if !names.contains(&answer.engine) {
            names.push(answer.engine);
        }
    }
    let mut text = String::from("| answers of |");
    let _ = writeln!(text, " {} |", Status::ALL.map(Status::name).join(" | "));
    let _ = writeln!(text, "|---|{}", "--:|".repeat(Status::ALL.len()));
    for name in names {
        let count = |status| {
            let those = answers().filter(|it| it.engine == name && it.status == status);
            those.count().to_string()
        };
        let _ = writeln!(text, "| {name} | {} |", Status::ALL.map(count).join(" | "));
    }
    text
}

/// The verdict that counts, what was run, why it is no better, and what else was said.
fn verdict(line: &Claim) -> String {
    let mut text = said(&line.answer);
    for other in &line.others {
        let brief = EngineAnswer { ran: None, ..other.clone() };
        let _ = write!(text, "; {} {}", other.engine, said(&brief));
    }
    text
}

fn said(answer: &EngineAnswer) -> String {
    let mut text = answer.status.name().to_owned();
    if let Some(ran) = &answer.ran {
        let _ = write!(text, " ({ran})");
    }
    if let Some(reason) = answer.reason.as_ref().filter(|reason| !reason.is_empty()) {
        let _ = write!(text, ": {reason}");
    }
    text
}

fn seconds(answer: &EngineAnswer) -> String {
    answer.seconds.map_or_else(String::new, |seconds| format!("{seconds:.2}"))
}

/// The number of each verdict.
pub fn counts<'l>(lines: impl IntoIterator<Item = &'l Claim>) -> String {
    let given: Vec<Status> = lines.into_iter().map(|line| line.answer.status).collect();
    let count = |status| given.iter().filter(|it| **it == status).count();
    let counts = Status::ALL.map(|status| format!("{} {}", count(status), status.name()));
    counts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(answers: Vec<EngineAnswer>) -> Claim {
        let nothing = EngineAnswer::not_run("z3", "no z3 here");
        let mutants = vec![String::from("a change")];
        let line = Claim { mutants, ..Claim::new(["an_id", "a | b", "all"], nothing) };
        line.answered(answers)
    }

    #[test]
    fn what_was_not_run_or_only_tested_is_not_counted_as_proved() {
        let proved = line(vec![EngineAnswer::given("z3", Status::Proved, 0.5)]);
        let ran = Some(String::from("7 cases"));
        let tested = EngineAnswer { ran, ..EngineAnswer::given("sampling", Status::Tested, 0.5) };
        let tested = line(vec![tested, EngineAnswer::not_run("kani", "not here")]);
        let lines = [line(Vec::new()), proved.clone(), proved, tested];
        let text = text(&lines);
        assert!(text.contains("not run: no z3 here"), "{text}");
        let counts = "2 proved, 0 refuted, 0 unknown, 1 tested, 1 not run";
        assert_eq!(super::counts(&lines), counts);
        let markdown = markdown(&lines);
        let row = "| `an_id` | a \\| b | z3 | all | not run: no z3 here |  | a change |";
        assert!(markdown.contains(row), "{markdown}");
        assert!(markdown.contains("| sampling | all | tested (7 cases); kani not run: not here |"));
        assert!(markdown.contains("| z3 | 2 | 0 | 0 | 0 | 1 |"), "{markdown}");
        assert!(markdown.contains("| kani | 0 | 0 | 0 | 0 | 1 |"), "{markdown}");
        assert!(markdown.contains(counts));
        assert_eq!(claims(&markdown), [["`an_id`", "a \\| b", "all", "a change"]; 4]);
    }

    #[test]
    fn the_strongest_answer_counts_and_a_refutation_most() {
        use Status::{NotRun, Proved, Refuted, Tested, Unknown};
        let of = |verdicts: &[Status]| {
            let answers = verdicts.iter().map(|&verdict| EngineAnswer::given("z3", verdict, 0.0));
            line(answers.collect()).answer.status
        };
        assert_eq!(of(&[Tested, Proved, NotRun]), Proved);
        assert_eq!(of(&[Proved, Refuted]), Refuted);
        assert_eq!(of(&[Tested, Unknown]), Unknown);
        assert_eq!(of(&[NotRun, Tested]), Tested);
        assert_eq!(of(&[NotRun]), NotRun);
    }
}
