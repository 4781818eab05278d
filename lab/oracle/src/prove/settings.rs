//! What `mufasa prove` is asked for.

use std::path::PathBuf;

use clap::Args;

/// Where `scripts/prove-wasm` writes what it found.
pub const CBMC: &str = "target/proofs/cbmc.json";

/// What is run and where the answers go.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Engines: z3 (theorems over the reals), exploration (the protocol), harnesses (of impl; most are proved
only where scripts/prove-wasm was run before, else tested); those that are not here are listed as not run.
The first lines say which are missing, and where they come from; without --require the next one how much
of what a release proves (proofs/required.txt) was proved here.

Exit codes: 0 whatever was run is proved, or tested where no engine proves it, 1 something is refuted or
not known, 2 bad input or an engine broke down. With --require 1 also where a claim of the list is not
proved, and 4 where it is not proved because an engine is missing.")]
pub struct Settings {
    /// Only claims whose id contains one of these, or of such an engine.
    pub names: Vec<String>,
    /// Run the claims of a list, such as proofs/required.txt, whose ids are one a line: all have to be proved.
    #[arg(long = "require", value_name = "FILE", conflicts_with = "names")]
    pub required: Option<PathBuf>,
    /// What scripts/prove-wasm wrote.
    #[arg(long, value_name = "FILE", default_value = CBMC)]
    pub cbmc: PathBuf,
    /// The checkout whose compiled code that has to be about.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub sources: PathBuf,
    /// Write the claims with their verdicts as JSON Lines [default: target/proofs/prove.json; with NAMES or
    /// --require none].
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Put the table into a document, between the lines that mark its place.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["names", "required"])]
    pub into: Option<PathBuf>,
    /// Print the table as Markdown.
    #[arg(long)]
    pub markdown: bool,
    /// Print the numbers alone, not the table.
    #[arg(long, conflicts_with = "markdown")]
    pub summary: bool,
}
