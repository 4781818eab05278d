//! What `mufasa prove` is asked for.

use std::path::PathBuf;

/// What is run and where the answers go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Only lines whose id contains one of these, or of such an engine; all without any.
    pub names: Vec<String>,
    /// A list of the claims that have to be proved, which alone are run.
    pub required: Option<PathBuf>,
    /// JSON Lines of the proofs on compiled code, as `scripts/prove-wasm` writes them.
    pub cbmc: PathBuf,
    /// The checkout that these have to be about.
    pub sources: PathBuf,
    /// Where the lines are written as JSON Lines.
    pub out: Option<PathBuf>,
    /// Print the table as Markdown.
    pub markdown: bool,
    /// A document whose table is replaced.
    pub into: Option<PathBuf>,
}
