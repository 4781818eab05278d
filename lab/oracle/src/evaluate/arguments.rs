//! What `mufasa evaluate` can be asked for.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use mufasa_sim::experiment::select::{Options, Shard};

use super::falsify::FalsifyArguments;
use super::margins::MarginsArguments;
use super::parts::shard;
use super::replay::ReplayArguments;
use super::scenes::ScenesArguments;
use crate::limits::whole;

/// Experiments in a closed loop: a CAV drives through a town, offloads to a station, and is attacked.
///
/// Without an experiment: failures.
#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "\
What comes back is checked in one of three ways: sofof, its age alone; paper, the five stages as published; hardened,
with the rules that close their gaps.

Of the cycles that the stages decide one in a hundred is checked by the exact model, too.

Exit codes: 0 done, 1 a run that was checked by the hardened profile failed (a collision, or too late), 2 bad input or a
file cannot be written, 3 model and implementation disagree."
)]
pub struct EvaluateArguments {
    /// The experiment.
    #[command(subcommand)]
    pub experiment: Option<Asked>,
    /// How large it is, if it is not named.
    #[command(flatten)]
    pub size: SizeArguments,
}

impl EvaluateArguments {
    /// Whether it is the search for collisions, which may take hours and keeps what it has when it is interrupted.
    pub const fn is_search(&self) -> bool {
        matches!(self.experiment, Some(Asked::Falsify(_)))
    }
}

/// The experiments.
#[derive(Subcommand)]
pub enum Asked {
    /// Collisions and targets not reached under each attack of the paper: none checked, paper, hardened.
    Failures(SizeArguments),
    /// The attack with empty track lists in each reading of the paper's text: which of them give its figure.
    Readings(SizeArguments),
    /// How often each stage runs and finds a safety issue, under random attacks.
    Stages(SizeArguments),
    /// Every attack with tracking, planning or both offered: which stage finds it first, and when.
    Attacks(SizeArguments),
    /// Failures under attacks of all kinds, drawn at random over time, some of them at once.
    Combinations(SizeArguments),
    /// Fallbacks and time not offloaded without an attack, by errors of detectors, link and wait.
    Availability(SizeArguments),
    /// What each stage and rule is for: collisions and false alarms without it, without the grid (is stage v needed?) and
    /// without detections, by what detectors see.
    LeftOut(SizeArguments),
    /// Search for collisions: attacks, their times and their sizes, by an attacker who knows every rule.
    Falsify(FalsifyArguments),
    /// Search for avoidable collisions with one other that comes to where the CAV will be: all kinds of lies, trajectories
    /// that begin elsewhere, at another time, or end in its way.
    Scenes(ScenesArguments),
    /// How wrong an assumption may be: the same scenes, with one error of growing size.
    Margins(MarginsArguments),
    /// Write one run as a page: frames from above around what happened, and a timeline.
    Replay(ReplayArguments),
}

/// How large an experiment is, and where its results go.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct SizeArguments {
    /// Scenarios of each combination, on each of two routes [default: failures, readings and combinations 10, others 2]; of
    /// `stages`: in all [default: 4].
    #[arg(long, value_name = "N", value_parser = whole(1_u64, 10_000), allow_negative_numbers = true)]
    pub scenarios: Option<u64>,
    /// Other vehicles in the town [default: 15]; of `stages`: at most [default: 30].
    #[arg(long, value_name = "N", value_parser = whole(0_u16, 200), allow_negative_numbers = true)]
    pub vehicles: Option<u16>,
    /// Seed of the first scenario; the others follow.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub seed: u64,
    /// Drive on the map in this folder, not in the town: that of uulm-mrm/tpl's `data`, Ulm-Lehr.
    #[arg(long, value_name = "FOLDER")]
    pub map: Option<PathBuf>,
    /// The station, and the CAV's own planner beside remote tracks, send what they have: they do not ask the stages
    /// before, of tracks and of a few plans.
    #[arg(long)]
    pub without_precheck: bool,
    /// Only runs whose id is this or begins with these parts, such as failures/paper/empty-tracks/0/3.
    #[arg(long, value_name = "ID")]
    pub only: Option<String>,
    /// Only one of N parts of the runs, such as 2/8, for other machines to make the others; `mufasa merge` puts
    /// the parts together.
    #[arg(long, value_name = "I/N", value_parser = shard, requires = "out", conflicts_with = "only")]
    pub shard: Option<Shard>,
    /// Check every cycle that the stages decide by the exact model, not one in a hundred.
    #[arg(long)]
    pub check_all: bool,
    /// Threads [default: all processors]. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1_u16, 1024), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Write into this folder: table and runs as CSV and JSON, replays of runs that failed (each
    /// of the hardened profile, of others those of the first three scenarios on a route), and all of it in
    /// report.html.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl SizeArguments {
    /// With the defaults of an experiment where nothing is said.
    pub fn options(&self, defaults: Options) -> Options {
        Options {
            scenarios: self.scenarios.unwrap_or(defaults.scenarios),
            vehicles: self.vehicles.map_or(defaults.vehicles, usize::from),
            seed: self.seed,
            map: defaults.map,
            without_precheck: self.without_precheck,
        }
    }
}
