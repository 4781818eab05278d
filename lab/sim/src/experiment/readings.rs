//! The paper's attack with empty track lists, in each reading of its text: which of them give its figure.
//!
//! The text: the attacker "spams the interface with empty track lists with a frequency of 100 Hz that are used by the
//! ENV service on the MEC server or the CAV". Open are whose lists, what becomes of the true ones, and whether an empty
//! list is a list (I-11). Scenarios and times are those of `failures`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::job::{self, Campaign, ExperimentError, Job, Options};
use super::watch::Watch;
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::guard::Variant;
use crate::cav::withheld::Withheld;
use crate::map::Town;
use crate::run::{End, Outcome};

/// Its name.
pub const NAME: &str = "readings";
/// As large as the paper's, on each route.
pub const OPTIONS: Options = Options::town(10, 15, 0);

/// A reading of the attack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Reading {
    /// Whose lists.
    pub lists: Lists,
    /// How they come.
    pub comes: Comes,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: bool,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Readings {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs of one reading and variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Row {
    /// Whose lists.
    pub lists: Lists,
    /// How they come.
    pub comes: Comes,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: bool,
    /// What is checked.
    pub variant: Variant,
    /// Runs.
    pub runs: usize,
    /// Those that ended in a collision.
    pub collided: usize,
    /// Those that did not reach the target in time.
    pub late: usize,
    /// Runs in which a stage found something while the attack went on.
    pub detected: usize,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// Whose lists.
    pub lists: Lists,
    /// How they come.
    pub comes: Comes,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: bool,
    /// What is checked.
    pub variant: Variant,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t_s: f64,
    /// Cycles with remote tracks.
    pub remote_mot: u64,
    /// Cycles with a remote trajectory.
    pub remote_plan: u64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// The first place where a cycle failed under the attack; none: in no cycle.
    pub first_by: Option<String>,
}

/// Every reading, and what an attacker still does where an empty list is none.
fn readings() -> impl Iterator<Item = Reading> {
    let whose = [Lists::Planner, Lists::Cav, Lists::Both].into_iter();
    let how = |lists| [Comes::Replaced, Comes::Interleaved, Comes::Farthest].map(|it| (lists, it));
    let both_ways = |(lists, comes)| {
        [true, false].map(|empty_is_a_list| Reading { lists, comes, empty_is_a_list })
    };
    whose.flat_map(how).flat_map(both_ways)
}

/// The runs. What nothing is compared with does not depend on I-11.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<Reading>> {
    let mut jobs = Vec::new();
    for reading in readings() {
        let variants: &[Variant] =
            if reading.empty_is_a_list { &Variant::ALL } else { &[Variant::Paper] };
        for &variant in variants {
            for (route, scenario) in job::starts(town, options) {
                let Reading { lists, comes, empty_is_a_list } = reading;
                let is = if empty_is_a_list { "list" } else { "none" };
                let word = format!("{}+{}+{is}", name_of_lists(lists), name_of_comes(comes));
                let place = (variant, route, scenario);
                let mut job = Job::new(NAME, (&word, reading), place, options)
                    .attacked(Some(Kind::TracksEmpty));
                for attack in &mut job.settings.attacks {
                    (attack.means.lists, attack.means.comes) = (lists, comes);
                }
                job.settings.withheld = (!empty_is_a_list).then_some(Withheld::EmptyLists);
                jobs.push(job);
            }
        }
    }
    jobs
}

/// Whose lists, in a word.
pub const fn name_of_lists(lists: Lists) -> &'static str {
    match lists {
        Lists::Both => "both",
        Lists::Cav => "cav",
        Lists::Planner => "planner",
    }
}

/// How lists come, in a word.
pub const fn name_of_comes(comes: Comes) -> &'static str {
    match comes {
        Comes::Last => "last",
        Comes::Replaced => "replaced",
        Comes::Interleaved => "interleaved",
        Comes::Farthest => "farthest",
    }
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<Readings, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::make(campaign, jobs(town, options), kept)?;
    let rows = runs.chunk_by(|a, b| key(a) == key(b)).map(row).collect();
    Ok(Readings { options, rows, runs })
}

const fn key(run: &Run) -> (Lists, Comes, bool, Variant) {
    (run.lists, run.comes, run.empty_is_a_list, run.variant)
}

fn kept(job: &Job<Reading>, outcome: &Outcome, watch: &Watch) -> Run {
    let Reading { lists, comes, empty_is_a_list } = job.what;
    Run {
        id: job.id.clone(),
        lists,
        comes,
        empty_is_a_list,
        variant: job.settings.variant,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        t_s: outcome.t,
        remote_mot: outcome.offloaded[0],
        remote_plan: outcome.offloaded[1],
        fallbacks: watch.fallbacks,
        first_by: watch.first.map(|first| first.by.name().to_owned()),
    }
}

fn row(runs: &[Run]) -> Row {
    let (lists, comes, empty_is_a_list, variant) = key(&runs[0]);
    let count = |is_it: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| is_it(run)).count();
    Row {
        lists,
        comes,
        empty_is_a_list,
        variant,
        runs: runs.len(),
        collided: count(&|run| run.end == End::Collided),
        late: count(&|run| run.end == End::Late),
        detected: count(&|run| run.first_by.is_some()),
    }
}
