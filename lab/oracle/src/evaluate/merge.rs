//! The arguments of `mufasa merge`.

use std::path::PathBuf;

use clap::Args;

/// Part files, and where the results go.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
#[command(after_help = "\
Exit codes: as those of the experiment made in one go; 2 a part is missing, is there twice, or is of something
else.")]
pub struct MergeArguments {
    /// The files that `mufasa evaluate EXPERIMENT --shard I/N --out DIR` wrote: all N of one experiment; or the
    /// summaries of `mufasa conform --shard I/N`.
    #[arg(value_name = "FILE", required = true)]
    pub parts: Vec<PathBuf>,
    /// The folder of the map on which the parts were made, if it is not the town.
    #[arg(long, value_name = "FOLDER")]
    pub map: Option<PathBuf>,
    /// Write into this folder: table and runs as CSV and JSON, pages of runs that failed (those that
    /// are beside the parts), and all of it in report.html.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
