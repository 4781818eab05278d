//! What is run, and what it shows: the table of `checks.toml`.

use std::env::{self, consts::EXE_SUFFIX};
use std::path::Path;
use std::process::{Command, Stdio};

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
    /// Whether it takes so long that only `--night` or `--only` runs it.
    #[serde(default)]
    pub night: bool,
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
    /// A command that succeeds where it is here, if its name does not tell.
    #[serde(default)]
    pub asks: Vec<String>,
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
        self.needs.iter().find(|need| !need.is_here(root))
    }

    /// The line of its row in the table of the project.
    pub(super) fn row(&self) -> Option<usize> {
        let row = format!("name = \"{}\"", self.name);
        TABLE.lines().position(|line| line == row).map(|it| it + 1)
    }
}

impl Need {
    fn is_here(&self, root: &Path) -> bool {
        match self.asks.split_first() {
            Some((program, arguments)) => {
                let mut command = Command::new(program);
                command.args(arguments).current_dir(root).stdin(Stdio::null());
                let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
                status.is_ok_and(|it| it.success())
            }
            None if self.name.contains('/') => root.join(&self.name).exists(),
            None => is_on_path(&self.name),
        }
    }
}

/// Whether there is a program of this name.
pub(super) fn is_on_path(name: &str) -> bool {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path).any(|folder| folder.join(format!("{name}{EXE_SUFFIX}")).is_file())
}
