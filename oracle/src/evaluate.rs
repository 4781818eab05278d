//! The closed loop from the command line.

pub mod replay;

use std::io::{self, Write};

use clap::{Args, Subcommand};

use self::replay::ReplayArguments;

/// What `mufasa evaluate` can be asked for.
#[derive(Args)]
pub struct EvaluateArguments {
    /// What is to be made.
    #[command(subcommand)]
    pub experiment: Experiment,
}

/// What can be made.
#[derive(Subcommand)]
pub enum Experiment {
    /// Write one run as a page: frames from above around what happened, and a timeline.
    Replay(ReplayArguments),
}

/// Does it. Returns the exit code. Errors: those of writing to `out`.
pub fn run(
    arguments: &EvaluateArguments,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    match &arguments.experiment {
        Experiment::Replay(arguments) => replay::run(arguments, out, err),
    }
}
