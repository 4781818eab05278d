//! The tables of the experiments, the paper's values beside ours.

use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::{
    attacks, availability, combinations, failures, falsify, left_out, readings, scenes, stages,
};

use super::published;
use crate::rows::{Rows, number, rows, text};

/// Failures by attack and variant.
pub fn failures(of: &failures::Failures) -> Rows {
    rows(
        &of.rows,
        &[
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
        ],
    )
}

/// Failures under empty lists, by the reading of the paper's text.
pub fn readings(of: &readings::Readings) -> Rows {
    rows(
        &of.rows,
        &[
            text("lists of", |row| readings::name_of_lists(row.lists).to_owned()),
            text("they come", |row| readings::name_of_comes(row.comes).to_owned()),
            text("an empty list is", |row| match (row.variant, row.empty_is_a_list) {
                (Variant::Sofof, _) => String::new(),
                (_, true) => String::from("a list"),
                (_, false) => String::from("no list"),
            }),
            text("checked by", |row| row.variant.name().to_owned()),
            number("runs", |row| row.runs.to_string()),
            number("collided", |row| row.collided.to_string()),
            number("late", |row| row.late.to_string()),
            number("detected", |row| row.detected.to_string()),
        ],
    )
}

/// Executions and detections by variant and stage.
pub fn stages(of: &stages::Stages) -> Rows {
    rows(
        &of.rows,
        &[
            text("checked by", |row| row.variant.name().to_owned()),
            text("stage", |row| row.stage.name().to_owned()),
            number("executions", |row| row.executions.to_string()),
            number("detections", |row| row.detections.to_string()),
            number("of 1000", |row| per_thousand(row.detections, row.executions)),
            number("executions in the paper", |row| row.paper_executions.to_string()),
            number("detections in the paper", |row| row.paper_detections.to_string()),
            number("of 1000", |row| per_thousand(row.paper_detections, row.paper_executions)),
        ],
    )
}

/// What found each attack, and when.
pub fn attacks(of: &attacks::Attacks) -> Rows {
    rows(
        &of.rows,
        &[
            text("attack", |row| kind_name(row.attack).to_owned()),
            text("offered", |row| row.offered.name().to_owned()),
            text("checked by", |row| row.variant.name().to_owned()),
            number("runs", |row| row.runs.to_string()),
            number("detected", |row| row.detected.to_string()),
            text("first by", |row| row.by.clone()),
            number("cycles", |row| row.median_cycles.map_or_else(String::new, |it| it.to_string())),
            number("m", |row| row.median_metres.map_or_else(String::new, |it| format!("{it:.1}"))),
            number("collided", |row| row.collided.to_string()),
            number("late", |row| row.late.to_string()),
            number("link lost", |row| row.lost.to_string()),
        ],
    )
}

/// Failures under combinations of attacks.
pub fn combinations(of: &combinations::Combinations) -> Rows {
    rows(
        &of.rows,
        &[
            text("offered", |row| row.offered.name().to_owned()),
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
        ],
    )
}

/// What the checks cost without an attack.
pub fn availability(of: &availability::Availability) -> Rows {
    rows(
        &of.rows,
        &[
            text("set", |row| row.factor.name().to_owned()),
            number("to", |row| row.value.to_string()),
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
        ],
    )
}

/// What is missed, and what is found without need, without what a stage needs.
pub fn left_out(of: &left_out::LeftOuts) -> Rows {
    rows(
        &of.rows,
        &[
            text("detectors", |row| row.detectors.name().to_owned()),
            text("checked by", |row| row.variant.name().to_owned()),
            text("left out", |row| row.left_out.name().to_owned()),
            number("runs", |row| row.runs.to_string()),
            number("collided offloading", |row| row.collided.to_string()),
            number("alone", |row| row.collided_local.to_string()),
            number("fallbacks in an hour", |row| format!("{:.0}", row.fallbacks_per_hour)),
            number("PLAN remote", |row| share(row.share_plan)),
            number("attacked runs", |row| row.attacked_runs.to_string()),
            number("collided offloading", |row| row.attacked_collided.to_string()),
            number("alone", |row| row.attacked_collided_local.to_string()),
            number("v ran", |row| row.executions_v.to_string()),
            number("v found", |row| row.detections_v.to_string()),
        ],
    )
}

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

/// Share of the time, to the percent.
fn share(of: f64) -> String {
    format!("{:.0} %", of * 100.0)
}

fn per_thousand(part: u64, of: u64) -> String {
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let share = |part: u64, of: u64| part as f64 / of as f64;
    if of == 0 { String::new() } else { format!("{:.1}", 1000.0 * share(part, of)) }
}
