//! The tables of the experiments, the paper's values beside ours.

use std::fmt::Write;

use comfy_table::{CellAlignment, Table, presets};
use mufasa_drives::pictures::escape;
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::{
    attacks, availability, combinations, cpu, failures, falsify, rules, stages,
};

use super::published;

/// A table of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// Of every column, with whether it holds numbers.
    header: Vec<(&'static str, bool)>,
    rows: Vec<Vec<String>>,
}

impl Rows {
    fn new<const N: usize>(header: [(&'static str, bool); N], rows: Vec<[String; N]>) -> Self {
        Self { header: header.to_vec(), rows: rows.into_iter().map(Vec::from).collect() }
    }

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
pub fn failures(of: &failures::Failures) -> Rows {
    let header = [
        ("attack", false),
        ("checked by", false),
        ("runs", true),
        ("failures", true),
        ("collided", true),
        ("late", true),
        ("left the corridor", true),
        ("failures in the paper", false),
    ];
    let row = |row: &failures::Row| {
        [
            kind_name(row.attack).to_owned(),
            row.variant.name().to_owned(),
            row.runs.to_string(),
            row.failures.to_string(),
            row.collided.to_string(),
            row.late.to_string(),
            row.off_road.to_string(),
            published::failures(row.attack, row.variant).words.to_owned(),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// Executions and detections by variant and stage.
pub fn stages(of: &stages::Stages) -> Rows {
    let header = [
        ("checked by", false),
        ("stage", false),
        ("executions", true),
        ("detections", true),
        ("of 1000", true),
        ("executions in the paper", true),
        ("detections in the paper", true),
        ("of 1000", true),
    ];
    let row = |row: &stages::Row| {
        [
            row.variant.name().to_owned(),
            row.stage.name().to_owned(),
            row.executions.to_string(),
            row.detections.to_string(),
            per_thousand(row.detections, row.executions),
            row.paper_executions.to_string(),
            row.paper_detections.to_string(),
            per_thousand(row.paper_detections, row.paper_executions),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// What found each attack, and when.
pub fn attacks(of: &attacks::Attacks) -> Rows {
    let header = [
        ("attack", false),
        ("offered", false),
        ("checked by", false),
        ("runs", true),
        ("detected", true),
        ("first by", false),
        ("cycles", true),
        ("m", true),
        ("collided", true),
        ("late", true),
        ("link lost", true),
    ];
    let row = |row: &attacks::Row| {
        [
            kind_name(row.attack).to_owned(),
            row.offered.name().to_owned(),
            row.variant.name().to_owned(),
            row.runs.to_string(),
            row.detected.to_string(),
            row.by.clone(),
            row.median_cycles.map_or_else(String::new, |it| it.to_string()),
            row.median_metres.map_or_else(String::new, |it| format!("{it:.1}")),
            row.collided.to_string(),
            row.late.to_string(),
            row.lost.to_string(),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// Failures under combinations of attacks.
pub fn combinations(of: &combinations::Combinations) -> Rows {
    let header = [
        ("offered", false),
        ("checked by", false),
        ("runs", true),
        ("failures", true),
        ("collided", true),
        ("late", true),
        ("left the corridor", true),
        ("attacks", true),
        ("two or more at a time", true),
        ("fallbacks", true),
        ("MOT remote", true),
        ("PLAN remote", true),
    ];
    let row = |row: &combinations::Row| {
        [
            row.offered.name().to_owned(),
            row.variant.name().to_owned(),
            row.runs.to_string(),
            row.failures.to_string(),
            row.collided.to_string(),
            row.late.to_string(),
            row.off_road.to_string(),
            row.attacks.to_string(),
            format!("{:.0} %", row.share_several * 100.0),
            row.fallbacks.to_string(),
            format!("{:.0} %", row.share_mot * 100.0),
            format!("{:.0} %", row.share_plan * 100.0),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// What the checks cost without an attack.
pub fn availability(of: &availability::Availability) -> Rows {
    let header = [
        ("set", false),
        ("to", true),
        ("checked by", false),
        ("runs", true),
        ("failures", true),
        ("minutes", true),
        ("fallbacks", true),
        ("in an hour", true),
        ("link lost", true),
        ("MOT remote", true),
        ("PLAN remote", true),
    ];
    let row = |row: &availability::Row| {
        [
            row.factor.name().to_owned(),
            row.value.to_string(),
            row.variant.name().to_owned(),
            row.runs.to_string(),
            row.failures.to_string(),
            format!("{:.1}", row.hours * 60.0),
            row.fallbacks.to_string(),
            format!("{:.0}", row.fallbacks_per_hour),
            row.lost.to_string(),
            format!("{:.0} %", row.share_mot * 100.0),
            format!("{:.0} %", row.share_plan * 100.0),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// The price of each rule.
pub fn rules(of: &rules::Rules) -> Rows {
    let header = [
        ("checked by", false),
        ("without", false),
        ("runs", true),
        ("failures", true),
        ("minutes", true),
        ("fallbacks", true),
        ("in an hour", true),
        ("overruled", true),
        ("link lost", true),
        ("MOT remote", true),
        ("PLAN remote", true),
        ("fallbacks by stage and rule of the witness", false),
    ];
    let row = |row: &rules::Row| {
        [
            row.variant.name().to_owned(),
            row.without.map_or_else(String::new, |it| it.name().to_owned()),
            row.runs.to_string(),
            row.failures.to_string(),
            format!("{:.1}", row.hours * 60.0),
            row.fallbacks.to_string(),
            format!("{:.0}", row.fallbacks_per_hour),
            row.without.map_or_else(String::new, |_| row.overruled.to_string()),
            row.lost.to_string(),
            format!("{:.1} %", row.share_mot * 100.0),
            format!("{:.1} %", row.share_plan * 100.0),
            row.by.clone(),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// Processor time of the CAV's services and of what checks them.
pub fn cpu(of: &cpu::Cpu) -> Rows {
    let header = [
        ("checked by", false),
        ("what", false),
        ("active: CPU %", true),
        ("s", true),
        ("inactive: CPU %", true),
        ("s", true),
        ("active in the paper", false),
        ("inactive in the paper", false),
    ];
    let percent = |cpu_s: f64, of_s: f64| {
        if of_s > 0.0 { format!("{:.3}", 100.0 * cpu_s / of_s) } else { String::new() }
    };
    let row = |row: &cpu::Row| {
        let [active, inactive] = published::cpu(row.variant, row.who).map(usage);
        [
            row.variant.name().to_owned(),
            row.who.name().to_owned(),
            percent(row.active_cpu_s, row.active_s),
            format!("{:.1}", row.active_s),
            percent(row.inactive_cpu_s, row.inactive_s),
            format!("{:.1}", row.inactive_s),
            active,
            inactive,
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

/// How near the runs of a search came, by kind of attack.
pub fn falsified(of: &falsify::Falsified) -> Rows {
    let header = [
        ("attack", false),
        ("runs", true),
        ("collided", true),
        ("of them when it could have stood", true),
        ("least time left, s", true),
        ("least distance, m", true),
    ];
    let row = |row: &falsify::Row| {
        [
            kind_name(row.attack).to_owned(),
            row.runs.to_string(),
            row.collided.to_string(),
            row.after.to_string(),
            format!("{:.1}", row.least_time_left_s),
            row.least_distance_m.map_or_else(String::new, |it| format!("{it:.2}")),
        ]
    };
    Rows::new(header, of.rows.iter().map(row).collect())
}

fn usage(of: &[published::Usage]) -> String {
    let one = |(percent, in_s): &published::Usage| format!("{percent} % in {in_s:.1} s");
    of.iter().map(one).collect::<Vec<_>>().join(", ")
}

fn per_thousand(part: u64, of: u64) -> String {
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let share = |part: u64, of: u64| part as f64 / of as f64;
    if of == 0 { String::new() } else { format!("{:.1}", 1000.0 * share(part, of)) }
}
