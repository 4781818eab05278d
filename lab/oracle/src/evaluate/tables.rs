//! The tables of the experiments, the paper's values beside ours.

use std::fmt::Write;

use comfy_table::{CellAlignment, Table, presets};
use mufasa_drives::pictures::escape;
use mufasa_sim::attack::means::{Comes, Lists};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::axes::{Detectors, Factor, LeftOut, Offered};
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::watch::By;
use mufasa_sim::experiment::{falsify, scenes};

use super::published;

/// A table of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// Of every column, with whether it holds numbers.
    header: Vec<(&'static str, bool)>,
    rows: Vec<Vec<String>>,
}

/// A column: its name, whether it holds numbers, and what a row has there.
pub type Column<R> = (&'static str, bool, fn(&R) -> String);

const fn text<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, false, cell)
}

const fn number<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, true, cell)
}

/// A table with a line for each.
pub fn rows<R>(of: &[R], columns: &[Column<R>]) -> Rows {
    let header = columns.iter().map(|(name, is_number, _)| (*name, *is_number)).collect();
    let row = |row: &R| columns.iter().map(|(.., cell)| cell(row)).collect();
    Rows { header, rows: of.iter().map(row).collect() }
}

impl Rows {
    /// For a terminal.
    pub fn text(&self) -> String {
        let mut table = Table::new();
        table.load_style(presets::UTF8_FULL_CONDENSED);
        table.set_header(self.header.iter().map(|(name, _)| *name));
        for row in &self.rows {
            table.add_row(row);
        }
        for (column, (_, is_number)) in table.column_iter_mut().zip(&self.header) {
            if *is_number {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        format!("{table}\n")
    }

    /// For a page.
    pub fn html(&self) -> String {
        let mut out = String::from("<table>\n<tr>");
        for (name, _) in &self.header {
            // A string takes whatever is written.
            let _ = write!(out, "<th>{}</th>", escape(name));
        }
        out.push_str("</tr>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for (cell, (_, is_number)) in row.iter().zip(&self.header) {
                let class = if *is_number { " class=\"number\"" } else { "" };
                let _ = write!(out, "<td{class}>{}</td>", escape(cell));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</table>\n");
        out
    }

    /// For a document.
    pub fn markdown(&self) -> String {
        let names: Vec<&str> = self.header.iter().map(|(name, _)| *name).collect();
        let mut out = format!("| {} |\n|", names.join(" | "));
        for (_, is_number) in &self.header {
            out.push_str(if *is_number { "--:|" } else { "---|" });
        }
        out.push('\n');
        for row in &self.rows {
            // A string takes whatever is written.
            let _ = writeln!(out, "| {} |", row.join(" | "));
        }
        out
    }
}

/// Failures by attack and variant.
pub const FAILURES: &[Column<Row>] = &[
    text("attack", |row| kind_name(row.attack).to_owned()),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("failures", |row| row.failures.to_string()),
    number("collided", |row| row.collided.to_string()),
    number("late", |row| row.late.to_string()),
    number("left the corridor", |row| row.off_road.to_string()),
    text("failures in the paper", |row| {
        published::failures(row.attack, row.variant).words.to_owned()
    }),
];

/// Failures under empty lists, by the reading of the paper's text.
pub const READINGS: &[Column<Row>] = &[
    text("lists of", |row| word(row.lists.map(Lists::name))),
    text("they come", |row| word(row.comes.map(Comes::name))),
    text("an empty list is", |row| match (row.variant, row.empty_is_a_list) {
        (Variant::Sofof, _) => String::new(),
        (_, Some(false)) => String::from("no list"),
        (_, _) => String::from("a list"),
    }),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("collided", |row| row.collided.to_string()),
    number("late", |row| row.late.to_string()),
    number("detected", |row| row.detected.to_string()),
];

/// Executions and detections by variant and stage.
pub const STAGES: &[Column<Row>] = &[
    text("checked by", |row| row.variant.name().to_owned()),
    text("stage", |row| word(row.stage.map(By::name))),
    number("executions", |row| row.executions.to_string()),
    number("detections", |row| row.detections.to_string()),
    number("of 1000", |row| per_thousand(row.detections, row.executions)),
    number("executions in the paper", |row| or_nothing(row.paper_executions)),
    number("detections in the paper", |row| or_nothing(row.paper_detections)),
    number("of 1000", |row| {
        row.paper_detections
            .zip(row.paper_executions)
            .map_or_else(String::new, |(part, of)| per_thousand(part, of))
    }),
];

/// What found each attack, and when.
pub const ATTACKS: &[Column<Row>] = &[
    text("attack", |row| kind_name(row.attack).to_owned()),
    text("offered", |row| word(row.offered.map(Offered::name))),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("detected", |row| row.detected.to_string()),
    text("first by", |row| row.by.clone()),
    number("cycles", |row| or_nothing(row.median_cycles)),
    number("m", |row| row.median_metres.map_or_else(String::new, |it| format!("{it:.1}"))),
    number("collided", |row| row.collided.to_string()),
    number("late", |row| row.late.to_string()),
    number("link lost", |row| row.lost.to_string()),
];

/// Failures under combinations of attacks.
pub const COMBINATIONS: &[Column<Row>] = &[
    text("offered", |row| word(row.offered.map(Offered::name))),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("failures", |row| row.failures.to_string()),
    number("collided", |row| row.collided.to_string()),
    number("late", |row| row.late.to_string()),
    number("left the corridor", |row| row.off_road.to_string()),
    number("attacks", |row| row.attacks.to_string()),
    number("two or more at a time", |row| share(row.share_several)),
    number("fallbacks", |row| row.fallbacks.to_string()),
    number("MOT remote", |row| share(row.share_mot)),
    number("PLAN remote", |row| share(row.share_plan)),
];

/// What the checks cost without an attack.
pub const AVAILABILITY: &[Column<Row>] = &[
    text("set", |row| word(row.factor.map(Factor::name))),
    number("to", |row| or_nothing(row.value)),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("failures", |row| row.failures.to_string()),
    number("minutes", |row| format!("{:.1}", row.hours * 60.0)),
    number("fallbacks", |row| row.fallbacks.to_string()),
    number("in an hour", |row| format!("{:.0}", row.fallbacks_per_hour)),
    number("link lost", |row| row.lost.to_string()),
    number("MOT remote", |row| share(row.share_mot)),
    number("PLAN remote", |row| share(row.share_plan)),
    number("both", |row| share(row.share_both)),
];

/// What is missed, and what is found without need, without what a stage needs.
pub const LEFT_OUT: &[Column<Row>] = &[
    text("detectors", |row| word(row.detectors.map(Detectors::name))),
    text("checked by", |row| row.variant.name().to_owned()),
    text("left out", |row| word(row.left_out.map(LeftOut::name))),
    number("runs", |row| row.runs.to_string()),
    number("collided offloading", |row| row.collided_remote.to_string()),
    number("alone", |row| (row.collided - row.collided_remote).to_string()),
    number("fallbacks in an hour", |row| format!("{:.0}", row.fallbacks_per_hour)),
    number("PLAN remote", |row| share(row.share_plan)),
    number("attacked runs", |row| row.attacked_runs.to_string()),
    number("collided offloading", |row| row.attacked_collided_remote.to_string()),
    number("alone", |row| (row.attacked_collided - row.attacked_collided_remote).to_string()),
    number("v ran", |row| row.executions.to_string()),
    number("v found", |row| row.detections.to_string()),
];

/// How near the runs of a search came, by kind of attack.
pub fn falsified(of: &falsify::Falsified) -> Rows {
    rows(
        &of.rows,
        &[
            text("attack", |row| kind_name(row.attack).to_owned()),
            number("runs", |row| row.runs.to_string()),
            number("collided", |row| row.collided.to_string()),
            number("of them when it could have stood", |row| row.after.to_string()),
            number("least time left, s", |row| format!("{:.1}", row.least_time_left_s)),
            number("least distance, m", |row| {
                row.least_distance_m.map_or_else(String::new, |it| format!("{it:.2}"))
            }),
        ],
    )
}

/// Avoidable collisions with one other, by kinds of scenes.
pub fn scenes(of: &scenes::Scenes) -> Rows {
    rows(
        &of.rows,
        &[
            text("", |row| row.of.clone()),
            text("kind", |row| row.kind.clone()),
            number("scenes", |row| row.scenes.to_string()),
            number("avoidable", |row| row.avoidable.to_string()),
            number("collided all the same", |row| row.collided.to_string()),
            number("never rejected", |row| row.never_rejected.to_string()),
            number("by braking", |row| row.by_braking.to_string()),
            number("hit while standing", |row| row.hit_standing.to_string()),
            number("clean", |row| row.clean.to_string()),
            number("rejected", |row| row.alarms.to_string()),
            text("clean ones rejected by", |row| row.by.clone()),
        ],
    )
}

fn word(of: Option<&'static str>) -> String {
    of.unwrap_or_default().to_owned()
}

fn or_nothing(of: Option<impl ToString>) -> String {
    of.map_or_else(String::new, |it| it.to_string())
}

/// Share of the time, to the percent.
fn share(of: f64) -> String {
    format!("{:.0} %", of * 100.0)
}

fn per_thousand(part: u64, of: u64) -> String {
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let share = |part: u64, of: u64| part as f64 / of as f64;
    if of == 0 { String::new() } else { format!("{:.1}", 1000.0 * share(part, of)) }
}
