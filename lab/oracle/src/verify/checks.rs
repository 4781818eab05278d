//! What is run, and what it shows: the table of `checks.toml`.

use std::env::{self, consts::EXE_SUFFIX};
use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const TABLE: &str = include_str!("checks.toml");
/// The folder of the logs in that of the evidence.
pub(super) const LOG: &str = "log";

/// Something that is run. The table says what each field means.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Check {
    /// Its name, and that of its log.
    pub name: String,
    /// A sentence.
    pub shows: String,
    /// A program and its arguments.
    pub command: Vec<String>,
    /// About how long it takes.
    pub seconds: u64,
    /// Whether it belongs to `--quick`.
    #[serde(default)]
    pub quick: bool,
    /// What has to be here.
    #[serde(default)]
    pub needs: Vec<Need>,
    /// The files that it leaves.
    #[serde(default)]
    pub writes: Vec<String>,
}

/// Something that has to be here.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Need {
    /// A program on PATH; with a `/` a file of the checkout.
    pub name: String,
    /// What brings it.
    pub package: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    check: Vec<Check>,
}

/// The checks of the project.
pub fn all() -> Result<Vec<Check>, String> {
    read(TABLE)
}

/// The checks of a table. Errors: in words.
pub fn read(text: &str) -> Result<Vec<Check>, String> {
    let table: Table = toml::from_str(text).map_err(|error| format!("checks: {error}"))?;
    Ok(table.check)
}

impl Check {
    /// The file with what it says, in the folder of the evidence.
    pub(super) fn log(&self) -> String {
        format!("{LOG}/{}.txt", self.name.replace(' ', "-"))
    }

    /// Whether it says of each test how it ended.
    pub(super) fn is_of_tests(&self) -> bool {
        self.command.starts_with(&["cargo".to_owned(), "test".to_owned()])
    }

    /// What it needs and is not here.
    pub(super) fn missing(&self, root: &Path) -> Option<&Need> {
        let is_here = |name: &str| match name.split_once('/') {
            Some(_) => root.join(name).exists(),
            None => is_on_path(name),
        };
        self.needs.iter().find(|need| !is_here(&need.name))
    }

    /// The line of its row in the table of the project.
    pub(super) fn row(&self) -> Option<usize> {
        let row = format!("name = \"{}\"", self.name);
        TABLE.lines().position(|line| line == row).map(|it| it + 1)
    }
}

/// Whether there is a program of this name.
pub(super) fn is_on_path(name: &str) -> bool {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path).any(|folder| folder.join(format!("{name}{EXE_SUFFIX}")).is_file())
}
