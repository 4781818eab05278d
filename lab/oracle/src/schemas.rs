//! The JSON Schemas of all that the program reads and writes as JSON.

use std::io;
use std::path::Path;

use mufasa_conform::Summary;
use mufasa_drives::check;
#[cfg(feature = "link")]
use mufasa_link::station::StationSummary;
#[cfg(feature = "link")]
use mufasa_link::vehicle;
use mufasa_records::calls::Line;
use mufasa_records::{files, schema};
#[cfg(feature = "link")]
use mufasa_sim::experiment::made::Made;
#[cfg(feature = "link")]
use mufasa_sim::experiment::select::Part;
#[cfg(feature = "link")]
use mufasa_sim::experiment::{falsify, scenes};
use serde_json::Value;

use crate::explore::report::ExplorationReport;
use crate::prove::claim::Claim;
use crate::verify::evidence::Evidence;

/// The schemas by the stem of their file's name: those of records and answers, of a line of `check
/// --json`, of the summary of `conform`, of a line of `prove`, of a line of the log that `integrate` reads, of what `verify`, `vehicle` and `station` write at their end, of a line of the log of `vehicle` and of what
/// `explore` and `evaluate` write.
pub fn all() -> Vec<(&'static str, Value)> {
    let mut schemas = schema::all();
    schemas.extend(check::records::schemas());
    schemas.extend([
        ("conform-summary", schema::written::<Summary>()),
        ("claim", schema::written::<Claim>()),
        ("evidence", schema::written::<Evidence>()),
        ("loop-log", schema::written::<Line>()),
        ("exploration", schema::written::<Vec<ExplorationReport>>()),
    ]);
    #[cfg(feature = "link")]
    schemas.extend(of_link());
    schemas
}

/// Those of `vehicle`, `station` and `evaluate`.
#[cfg(feature = "link")]
fn of_link() -> Vec<(&'static str, Value)> {
    let made = [
        "evaluation-failures",
        "evaluation-readings",
        "evaluation-stages",
        "evaluation-attacks",
        "evaluation-combinations",
        "evaluation-availability",
        "evaluation-left-out",
    ];
    let mut schemas = made.map(|name| (name, schema::written::<Made>())).to_vec();
    schemas.extend([
        ("vehicle-summary", schema::written::<vehicle::summary::Summary>()),
        ("vehicle-log", schema::written::<vehicle::log::Entry>()),
        ("station-summary", schema::written::<StationSummary>()),
        ("evaluation-scenes", schema::written::<scenes::Scenes>()),
        ("evaluation-part", schema::written::<Part>()),
        ("evaluation-falsify", schema::written::<falsify::Falsified>()),
        ("evaluation-falsify-part", schema::written::<Part<falsify::Options>>()),
        ("evaluation-found", schema::written::<falsify::found::Found>()),
    ]);
    schemas
}

/// Writes each into a file of the folder; how many. Errors: those of writing.
pub fn write(folder: &Path) -> io::Result<usize> {
    files::prepare(folder)?;
    let schemas = all();
    for (name, schema) in &schemas {
        files::write(&folder.join(format!("{name}.schema.json")), &schema::text(schema))?;
    }
    Ok(schemas.len())
}
