//! The arguments of `mufasa conform`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Subcommand};
use mufasa_conform::Kind;
use mufasa_model::input::cycle::Profile;

use crate::limits::{number, one_of, profile, whole};

/// What a program under test has to do, and what the exit codes say.
const CONFORM_HELP: &str = "\
The program reads one JSON record per line on standard input, until its end, and writes one answer
per line on standard output, in the same order, each at once (flushed):

    in   {\"kind\": \"cycle\", \"id\": \"c-17\", \"profile\": \"paper\", ...}
    out  {\"id\": \"c-17\", \"verdict\": \"unsafe\", \"failed_stage\": \"iii\"}

spec/5-interfaces.md has the fields of records and answers, docs/conformance.md an introduction.

    mufasa conform --profile paper --kinds cycle -- node program.mjs

Exit codes: 0 no disagreement (none beyond --tolerance, which is no conformance), 1 some, 2 bad
input, nothing was compared, or (merge) a shard is missing or was interrupted, 130 interrupted: the
files hold what was known.";

#[derive(Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = CONFORM_HELP
)]
pub(super) struct ConformArguments {
    #[command(subcommand)]
    pub(super) merge: Option<MergeCommand>,
    /// Profile of generated cases and of recorded drives.
    #[arg(long, default_value = "hardened", value_parser = profile(), ignore_case = true)]
    pub(super) profile: Profile,
    /// Number of cases behind the vectors, all shards together; by default 10000, or all that the drives give.
    /// Without it none is asked where more than a fifth of the vectors is answered wrongly.
    #[arg(long, value_name = "N", value_parser = whole(0, u64::MAX))]
    pub(super) cases: Option<u64>,
    /// Seed of the cases.
    #[arg(long, value_name = "S", default_value = "0", value_parser = whole(0, u64::MAX))]
    pub(super) seed: u64,
    /// Longest time that an answer may take, ms.
    #[arg(long, value_name = "MS", default_value = "1000", value_parser = whole(1_u64, 3_600_000))]
    pub(super) time_limit: u64,
    /// Longest time to make records small, at the end, s.
    #[arg(long, value_name = "S", default_value = "60", value_parser = whole(0_u64, 86_400))]
    pub(super) shrinking: u64,
    /// Kinds of records; `line` is one that breaks the schema or is no JSON. `monitor`, a sequence of events and
    /// cycles, is asked only when it is named: few programs are monitors.
    #[arg(
        long,
        value_name = "KINDS",
        value_delimiter = ',',
        value_parser = one_of(Kind::ALL, Kind::name),
        default_value = "cycle,offloading,composition,line"
    )]
    pub(super) kinds: Vec<Kind>,
    /// Ask only the cases whose number leaves I when divided by N, such as 0/8.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(super) shard: Option<(u64, u64)>,
    /// Leave out the vectors, which are asked first, but never with drives.
    #[arg(long)]
    pub(super) no_vectors: bool,
    /// Take the cycles of drives, clean and attacked, in place of generated ones.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "kinds")]
    pub(super) drives: Vec<PathBuf>,
    /// Let pass what a margin of so many metres explains, 1e-8 to 1e-2, and a rounded norm.
    #[arg(long, value_name = "M", value_parser = number(1e-8, 1e-2))]
    pub(super) tolerance: Option<f64>,
    /// Folder for the summary (JSON), the report (JUnit XML) and the shrunk records
    /// [default: mufasa-conform].
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// The program under test and its arguments.
    #[arg(last = true, required = true)]
    pub(super) command: Vec<OsString>,
}

#[derive(Subcommand)]
pub(super) enum MergeCommand {
    /// Join the summaries of shards.
    Merge {
        /// Summaries of all shards of one campaign.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Folder for the joined files.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
}

/// `I/N` with I below N.
fn shard(text: &str) -> Result<(u64, u64), String> {
    let (at, of) = text.split_once('/').ok_or("must be I/N, such as 0/8")?;
    match (at.parse(), of.parse()) {
        (Ok(at), Ok(of)) if at < of => Ok((at, of)),
        (Ok(_), Ok(_)) => Err(String::from("I must be below N; shards are counted from 0")),
        (_, _) => Err(String::from("must be two whole numbers I/N, such as 0/8")),
    }
}
