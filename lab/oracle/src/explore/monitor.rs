//! The monitor explored: its laws, as a table.

use mufasa_exploration::monitor::{self, Law, MonitorOutcome, Scene};
use mufasa_model::input::profile::Profile;
use mufasa_model::offloading::requester::Group;
use schemars::JsonSchema;
use serde::Serialize;

use super::evidence::{grouped, wide};
use crate::rows::{Column, Rows, text};

/// The name by which the monitor alone is asked for.
pub const NAME: &str = "monitor";

/// A law of the monitor with its verdicts.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LawRow {
    /// Its sentence.
    pub law: &'static str,
    /// Whether it holds in every state.
    pub holds: bool,
    /// Where PLAN is offered: that it holds in so many states, or after how many periods it fails.
    pub plan: String,
    /// Where MOT is offered.
    pub mot: String,
    /// What shows that it is not empty, with the length of a shortest way to it, periods.
    pub shown_by: String,
}

/// Explores the monitor in a profile, with each group.
pub fn laws(profile: Profile) -> Vec<LawRow> {
    let [plan, mot] = [Group::Plan, Group::Mot].map(|group| monitor::explore(profile, group));
    let row = |law: Law| LawRow {
        law: law.name(),
        holds: [&plan, &mot].iter().all(|it| it.way_to(law).is_none() && it.shows(law)),
        plan: verdict(law, &plan),
        mot: verdict(law, &mot),
        shown_by: shown_by(law, &plan),
    };
    Law::ALL.into_iter().map(row).collect()
}

fn verdict(law: Law, outcome: &MonitorOutcome) -> String {
    match outcome.way_to(law) {
        Some(way) => format!("FAILS after {} periods", way.len()),
        None if law == Law::OffloadingComesBack => {
            format!("holds: within {} periods", outcome.back_within)
        }
        None => format!("holds in {} states", grouped(wide(outcome.states))),
    }
}

fn shown_by(law: Law, outcome: &MonitorOutcome) -> String {
    let part = |scene: Scene| match outcome.seen.iter().find(|(seen, _)| *seen == scene) {
        Some((_, periods)) => format!("{} ({periods})", scene.name()),
        None => format!("not seen: {}", scene.name()),
    };
    let parts: Vec<String> = outcome.expected(law).map(part).collect();
    parts.join("\n")
}

/// The table.
pub fn table(laws: &[LawRow]) -> Rows {
    let columns: [Column<LawRow>; 4] = [
        text("law of the monitor", |it| it.law.to_owned()),
        text("PLAN offered", |it| it.plan.clone()),
        text("MOT offered", |it| it.mot.clone()),
        text("shown by (periods)", |it| it.shown_by.clone()),
    ];
    Rows::new(laws, &columns)
}
