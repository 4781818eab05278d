//! The tables of the experiments, the paper's values beside ours.

use std::io::{self, Write};

use mufasa_sim::attack::Kind;
use mufasa_sim::attack::means::{Comes, Lists};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::ATTACKS;
use mufasa_sim::experiment::availability::AVAILABILITY;
use mufasa_sim::experiment::axes::{Detectors, Factor, LeftOut, Offered};
use mufasa_sim::experiment::combinations::COMBINATIONS;
use mufasa_sim::experiment::failures::FAILURES;
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::made::Experiment;
use mufasa_sim::experiment::readings::READINGS;
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::stages::STAGES;
use mufasa_sim::experiment::watch::By;
use mufasa_sim::experiment::{falsify, scenes};

use crate::rows::{Column, Rows, number, text};

/// The table, and under it what the names of its checks mean.
pub fn write(table: &Rows, out: &mut impl Write) -> io::Result<()> {
    let text = table.text(None);
    write!(out, "{text}")?;
    if text.contains(Variant::Sofof.name()) {
        writeln!(
            out,
            "sofof checks the age alone of what comes back, paper the five stages as published, hardened these and the \
             rules that close their gaps"
        )?;
    }
    Ok(())
}

/// The experiments, with the columns of their tables.
pub const EXPERIMENTS: [(Experiment, &[Column<Row>]); 7] = [
    (FAILURES, FAILURES_COLUMNS),
    (READINGS, READINGS_COLUMNS),
    (STAGES, STAGES_COLUMNS),
    (ATTACKS, ATTACKS_COLUMNS),
    (COMBINATIONS, COMBINATIONS_COLUMNS),
    (AVAILABILITY, AVAILABILITY_COLUMNS),
    (LEFT_OUT, LEFT_OUT_COLUMNS),
];

/// The one of this name, and its columns.
pub fn named(name: &str) -> Option<(Experiment, &'static [Column<Row>])> {
    EXPERIMENTS.into_iter().find(|(it, _)| it.name == name)
}

/// Failures by attack and variant.
const FAILURES_COLUMNS: &[Column<Row>] = &[
    text("attack", |row| kind_name(row.attack).to_owned()),
    text("checked by", |row| row.variant.name().to_owned()),
    number("runs", |row| row.runs.to_string()),
    number("failures", |row| row.failures.to_string()),
    number("collided", |row| row.collided.to_string()),
    number("late", |row| row.late.to_string()),
    number("left the corridor", |row| row.off_road.to_string()),
    text("failures in the paper", |row| published(row.attack, row.variant).to_owned()),
];

/// Failures under empty lists, by the reading of the paper's text.
const READINGS_COLUMNS: &[Column<Row>] = &[
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
const STAGES_COLUMNS: &[Column<Row>] = &[
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
const ATTACKS_COLUMNS: &[Column<Row>] = &[
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
const COMBINATIONS_COLUMNS: &[Column<Row>] = &[
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
const AVAILABILITY_COLUMNS: &[Column<Row>] = &[
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
const LEFT_OUT_COLUMNS: &[Column<Row>] = &[
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
    Rows::new(
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
    Rows::new(
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

/// Failures as the paper gives them (Sec. V): its numbers are in a figure, which has to be read by eye.
const fn published(attack: Option<Kind>, variant: Variant) -> &'static str {
    match (attack, variant) {
        (None, _) => "not said",
        (Some(_), Variant::Paper) => "0",
        (Some(Kind::WrongMap | Kind::EmptyTracks), Variant::Sofof) => "several",
        (Some(_), Variant::Sofof) => "in its figure",
        (Some(_), Variant::Hardened) => "",
    }
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
