//! What each stage and each rule is for: what is found, and missed, without it, and without what stages need.
//!
//! The paper leaves open "if the grid validation stage is actually necessary" (Sec. V-B). Here the stages do not get the
//! grid (no stage v) or the detections (no stages i and iv), or a stage or a rule is left out, with detectors that are
//! exact, noisy, or blind for one object in two, with tracking, planning or both offered, without an attack and under
//! seven. Rays meet whom a detector is blind for: the grid has them. The CAV's and the station's detectors are blind for
//! the same ones.

use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::report::Stage;
use mufasa::services::configuration::Group;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::attacks::Offered;
use super::job::{self, Campaign, ExperimentError, Job, Options, kind_name};
use super::watch::Watch;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::cav::withheld::Withheld;
use crate::map::Town;
use crate::run::{End, Outcome, PERIOD_NS, Settings};
use crate::services::detectors::Errors;
use crate::services::way::seconds;

/// Its name.
pub const NAME: &str = "left-out";
/// A few scenarios on each route of many combinations.
pub const OPTIONS: Options = Options::town(2, 15, 0);
/// One object in so many is not detected by anyone.
const ONE_IN: f64 = 2.0;
/// A collision this soon after something was remote is one of offloading, s.
const AFTER: f64 = 3.0;
/// Attacks that hide somebody, lie about somebody, or drive into somebody.
const ATTACKS: [Kind; 7] = [
    Kind::TracksEmpty,
    Kind::OneRemoved,
    Kind::FalseVelocities,
    Kind::Ghosts,
    Kind::IntoLead,
    Kind::Swerve,
    Kind::StartsLate,
];

/// How wrong all detectors are.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Detectors {
    /// Not at all.
    Exact,
    /// As in the other experiments: 0.05 m, and one object in a hundred missed in a cycle.
    Noisy,
    /// The same with 0.2 m.
    VeryNoisy,
    /// As `Noisy`, blind for one object in two, and nothing measures the gap to the leading vehicle.
    Blind,
}

impl Detectors {
    /// All.
    pub const ALL: [Self; 4] = [Self::Exact, Self::Noisy, Self::VeryNoisy, Self::Blind];

    /// Its name in tables and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Noisy => "noisy",
            Self::VeryNoisy => "very-noisy",
            Self::Blind => "blind",
        }
    }

    fn set(self, settings: &mut Settings) {
        let noisy = Errors::default();
        settings.errors = match self {
            Self::Exact => Errors::NONE,
            Self::Noisy => noisy,
            Self::VeryNoisy => Errors { position: 0.2, ..noisy },
            Self::Blind => Errors { blind: 1.0 / ONE_IN, ..noisy },
        };
        settings.has_no_lead = self == Self::Blind;
    }
}

/// What is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(into = "String", try_from = "String")]
#[schemars(with = "String")]
pub enum LeftOut {
    /// Nothing.
    Nothing,
    /// The grid, hence stage v.
    Grid,
    /// The detections, and what rests on them.
    Detections,
    /// A stage of the paper; v is `Grid`.
    Stage(Stage),
    /// A rule of the hardened profile.
    Rule(HardenedRule),
}

impl LeftOut {
    /// What is left out of a variant: stages and rules with two of the detectors.
    pub fn all(variant: Variant, detectors: Detectors) -> Vec<Self> {
        let mut all = vec![Self::Nothing, Self::Grid, Self::Detections];
        if matches!(detectors, Detectors::Noisy | Detectors::Blind) {
            all.extend([Stage::I, Stage::Ii, Stage::Iii, Stage::Iv].map(Self::Stage));
            if variant == Variant::Hardened {
                all.extend(HardenedRule::ALL.map(Self::Rule));
            }
        }
        all
    }

    /// In tables and ids.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Grid => "grid",
            Self::Detections => "detections",
            Self::Stage(Stage::I) => "stage-i",
            Self::Stage(Stage::Ii) => "stage-ii",
            Self::Stage(Stage::Iii) => "stage-iii",
            Self::Stage(Stage::Iv) => "stage-iv",
            Self::Stage(Stage::V) => "stage-v",
            Self::Rule(rule) => rule.id(),
        }
    }

    fn set(self, settings: &mut Settings) {
        let without = |profile: Profile| match self {
            Self::Stage(stage) => profile.without_stage(stage),
            Self::Rule(rule) => profile.without(rule),
            Self::Nothing | Self::Grid | Self::Detections => profile,
        };
        settings.profile = settings.profile.map(without);
        settings.withheld = match self {
            Self::Grid => Some(Withheld::Grid),
            Self::Detections => Some(Withheld::Detections),
            Self::Nothing | Self::Stage(_) | Self::Rule(_) => None,
        };
    }
}

impl From<LeftOut> for String {
    fn from(of: LeftOut) -> Self {
        of.name().to_owned()
    }
}

impl TryFrom<String> for LeftOut {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let mut all = Self::all(Variant::Hardened, Detectors::Noisy).into_iter();
        all.find(|it| it.name() == name).ok_or(name)
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LeftOuts {
    /// How large it was.
    pub options: Options,
    /// The table.
    pub rows: Vec<Row>,
    /// Every run.
    pub runs: Vec<Run>,
}

/// Runs with the same detectors, variant and what is left out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Row {
    /// How wrong detectors are.
    pub detectors: Detectors,
    /// What is checked.
    pub variant: Variant,
    /// What is left out.
    pub left_out: LeftOut,
    /// Runs without an attack.
    pub runs: usize,
    /// Those that collided while something was remote or within 3 s after, and those that did later.
    pub collided: usize,
    /// See `collided`.
    pub collided_local: usize,
    /// Fallbacks in an hour, each a false alarm where nobody is missed by the services.
    pub fallbacks_per_hour: f64,
    /// Share of the cycles with a remote trajectory.
    pub share_plan: f64,
    /// Runs under an attack.
    pub attacked_runs: usize,
    /// Those that collided while something was remote or within 3 s after, and those that did later.
    pub attacked_collided: usize,
    /// See `attacked_collided`.
    pub attacked_collided_local: usize,
    /// How often stage v ran, in all runs.
    pub executions_v: u64,
    /// How often it found something.
    pub detections_v: u64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// By which it can be repeated.
    pub id: String,
    /// How wrong detectors are.
    pub detectors: Detectors,
    /// What is checked.
    pub variant: Variant,
    /// What is left out.
    pub left_out: LeftOut,
    /// The attack; none in the control.
    pub attack: Option<Kind>,
    /// What the station offers.
    pub offered: Offered,
    /// Which route.
    pub route: usize,
    /// Which scenario on it.
    pub scenario: u64,
    /// How it ended.
    pub end: End,
    /// Whether something was remote in the last 3 s, within which the CAV stops from any speed that it has here.
    pub is_remote_at_end: bool,
    /// Cycles in all.
    pub cycles: u64,
    /// Those with a remote trajectory.
    pub remote_plan: u64,
    /// Fallbacks for a safety issue.
    pub fallbacks: u64,
    /// How often stage v ran.
    pub executions_v: u64,
    /// How often it found something.
    pub detections_v: u64,
}

/// Detectors, what is left out, the attack, and what is offered.
pub type What = (Detectors, LeftOut, Option<Kind>, Offered);

/// The runs.
pub fn jobs(town: &Town, options: Options) -> Vec<Job<What>> {
    let mut jobs = Vec::new();
    for detectors in Detectors::ALL {
        for variant in [Variant::Paper, Variant::Hardened] {
            for left_out in LeftOut::all(variant, detectors) {
                let same = (detectors, variant, left_out);
                for attack in [None].into_iter().chain(ATTACKS.map(Some)) {
                    let of = |offered| of_one_kind(town, options, same, (attack, offered));
                    jobs.extend(Offered::ALL.into_iter().flat_map(of));
                }
            }
        }
    }
    jobs
}

fn of_one_kind(
    town: &Town,
    options: Options,
    (detectors, variant, left_out): (Detectors, Variant, LeftOut),
    (attack, offered): (Option<Kind>, Offered),
) -> Vec<Job<What>> {
    let (detected, by, to) = (detectors.name(), kind_name(attack), offered.name());
    let name = left_out.name();
    let word = format!("{detected}+{name}+{by}+{to}");
    let one = |(route, scenario)| {
        let what = (detectors, left_out, attack, offered);
        let mut job = Job::new(NAME, (&word, what), (variant, route, scenario), options);
        left_out.set(&mut job.settings);
        job.settings.offers = offered.groups();
        detectors.set(&mut job.settings);
        job.attacked(attack)
    };
    job::starts(town, options).into_iter().map(one).collect()
}

/// Makes the runs. Errors: those of [`job::make`].
pub fn experiment(campaign: &Campaign<'_>) -> Result<LeftOuts, ExperimentError> {
    let &Campaign { town, options, .. } = campaign;
    let runs = job::make(campaign, jobs(town, options), kept)?;
    let key = |run: &Run| (run.detectors, run.variant, run.left_out);
    let rows = runs.chunk_by(|a, b| key(a) == key(b)).map(row).collect();
    Ok(LeftOuts { options, rows, runs })
}

fn kept(job: &Job<What>, outcome: &Outcome, watch: &Watch) -> Run {
    let (detectors, left_out, attack, offered) = job.what;
    Run {
        id: job.id.clone(),
        detectors,
        variant: job.settings.variant,
        left_out,
        attack,
        offered,
        route: job.route,
        scenario: job.scenario,
        end: outcome.end,
        is_remote_at_end: watch.remote_at.is_some_and(|t| outcome.t - t < AFTER),
        cycles: outcome.cycles,
        remote_plan: outcome.offloaded[Group::Plan as usize],
        fallbacks: watch.fallbacks,
        executions_v: outcome.stages[4][0],
        detections_v: outcome.stages[4][1],
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn row(runs: &[Run]) -> Row {
    let (plain, attacked): (Vec<&Run>, Vec<&Run>) =
        runs.iter().partition(|run| run.attack.is_none());
    let collided = |runs: &[&Run], remote: bool| {
        let is_it = |run: &&&Run| run.end == End::Collided && run.is_remote_at_end == remote;
        runs.iter().filter(is_it).count()
    };
    let sum = |of: fn(&Run) -> u64| plain.iter().map(|run| of(run)).sum::<u64>() as f64;
    let cycles = sum(|run| run.cycles);
    Row {
        detectors: runs[0].detectors,
        variant: runs[0].variant,
        left_out: runs[0].left_out,
        runs: plain.len(),
        collided: collided(&plain, true),
        collided_local: collided(&plain, false),
        fallbacks_per_hour: sum(|run| run.fallbacks) * 3600.0 / (cycles * seconds(PERIOD_NS)),
        share_plan: sum(|run| run.remote_plan) / cycles,
        attacked_runs: attacked.len(),
        attacked_collided: collided(&attacked, true),
        attacked_collided_local: collided(&attacked, false),
        executions_v: runs.iter().map(|run| run.executions_v).sum(),
        detections_v: runs.iter().map(|run| run.detections_v).sum(),
    }
}
