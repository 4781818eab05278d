//! Drives: cycles made from recorded traffic, from maps, or read as records.
//!
//! A drive is a sequence of cycles for the monitor. What the source does not say (which groups
//! are remote, what the sensors saw, how old the data are) comes from [`Options`] and is written
//! down in [`Drive::notes`].

mod commonroad;
mod error;
mod geometry;
mod lanes;
mod lead;
mod object;
mod options;
mod route;
mod scenario;
mod scene;
mod sensor;
mod solution;
mod xml;

pub use error::ReadError;
pub use options::{GridSize, Options, Sensor, Tail};

use std::path::{Path, PathBuf};

use mufasa_model::cycle::Cycle;

use scenario::Scenario;

/// A sequence of cycles with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Short name, unique among the drives of one run.
    pub name: String,
    /// Files that it was read from.
    pub source: String,
    /// Cycles in order of time.
    pub cycles: Vec<DriveCycle>,
    /// Decisions of the reader that a judgement of this drive depends on.
    pub notes: Vec<String>,
}

/// One cycle of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveCycle {
    /// Identity of the cycle, unique within the drive.
    pub id: String,
    /// The record.
    pub cycle: Cycle,
}

/// Reads drives from files, each recognised by its content: a `CommonRoad` scenario (2018b, 2020a;
/// XML), or a solution of the scenario before it.
///
/// A scenario directly followed by solutions gives one drive for each of them, a scenario alone
/// one drive of a recorded vehicle. The results are in the order of the files; an error names
/// file, place and value, and does not stop the others.
pub fn read(paths: &[PathBuf], options: &Options) -> Vec<Result<Drive, ReadError>> {
    let mut drives = Vec::new();
    // The scenario last read, and whether a drive was made of it.
    let mut scenario: Option<(&Path, Scenario, bool)> = None;
    for path in paths {
        let content = load(path);
        if !matches!(content, Ok(Content::Solution(_))) {
            drives.extend(unsolved(scenario.take(), options));
        }
        match content {
            Ok(Content::Scenario(text)) => match scenario::read(path, &text) {
                Ok(read) => scenario = Some((path, read, false)),
                Err(error) => drives.push(Err(error)),
            },
            Ok(Content::Solution(text)) => drives.push(match &mut scenario {
                Some((file, scenario, used)) => {
                    *used = true;
                    solution::read(path, &text)
                        .and_then(|s| commonroad::solved(scenario, &s, [file, path], options))
                }
                None => Err(ReadError::file(path, "a solution needs its scenario named before it")),
            }),
            Err(error) => drives.push(Err(error)),
        }
    }
    drives.extend(unsolved(scenario, options));
    drives
}

fn unsolved(
    scenario: Option<(&Path, Scenario, bool)>,
    options: &Options,
) -> Option<Result<Drive, ReadError>> {
    match scenario {
        Some((file, scenario, false)) => Some(commonroad::recorded(&scenario, file, options)),
        Some((_, _, true)) | None => None,
    }
}

/// A file by what it holds.
enum Content {
    Scenario(String),
    Solution(String),
}

fn load(path: &Path) -> Result<Content, ReadError> {
    let bytes = std::fs::read(path).map_err(|e| ReadError::file(path, e.to_string()))?;
    let text = String::from_utf8(bytes)
        .map_err(|e| ReadError::file(path, format!("neither text nor a known binary form: {e}")))?;
    // A byte order mark is no content.
    let text = text.trim_start_matches('\u{feff}').to_owned();
    if !text.trim_start().starts_with('<') {
        return Err(ReadError::file(path, "not recognised: no XML"));
    }
    match xml::with_root(path, &text, |root| Ok(root.name().to_owned()))?.as_str() {
        "commonRoad" => Ok(Content::Scenario(text)),
        "CommonRoadSolution" => Ok(Content::Solution(text)),
        other => {
            let message = format!("`{other}` is neither `commonRoad` nor `CommonRoadSolution`");
            Err(ReadError::file(path, message))
        }
    }
}
