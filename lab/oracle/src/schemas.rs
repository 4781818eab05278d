//! The JSON Schemas of all that the program reads and writes as JSON.

use std::io;
use std::path::Path;

use mufasa_conform::Summary;
use mufasa_drives::check;
use mufasa_link::station::StationSummary;
use mufasa_link::vehicle;
use mufasa_records::{files, schema};
use mufasa_sim::experiment::made::Made;
use mufasa_sim::experiment::select::Part;
use mufasa_sim::experiment::{falsify, scenes};
use serde_json::Value;

use crate::explore::report::ExplorationReport;
use crate::prove::claim::Claim;

/// What the program writes as JSON: the command, its option (none: standard output), and the schemas of what
/// is written, each of a file or of a line.
pub const WRITTEN: [(&str, &str, &[&str]); 19] = [
    ("check", "json", &["checked-cycle", "checked-drive", "checked"]),
    ("oracle", "", &["cycle-answer", "offloading-answer", "composition-answer", "error-answer"]),
    ("conform", "out", &["conform-summary"]),
    ("explore", "out", &["exploration"]),
    ("prove", "out", &["claim"]),
    ("evaluate", "out", &["evaluation-failures"]),
    ("evaluate failures", "out", &["evaluation-failures"]),
    ("evaluate readings", "out", &["evaluation-readings"]),
    ("evaluate stages", "out", &["evaluation-stages"]),
    ("evaluate attacks", "out", &["evaluation-attacks"]),
    ("evaluate combinations", "out", &["evaluation-combinations"]),
    ("evaluate availability", "out", &["evaluation-availability"]),
    ("evaluate left-out", "out", &["evaluation-left-out"]),
    ("evaluate falsify", "out", &["evaluation-falsify", "evaluation-found"]),
    ("evaluate scenes", "out", &["evaluation-scenes"]),
    (
        "merge",
        "out",
        &["evaluation-part", "evaluation-falsify-part", "evaluation-failures", "conform-summary"],
    ),
    ("vehicle", "json", &["vehicle-summary"]),
    ("vehicle", "log", &["vehicle-log"]),
    ("station", "json", &["station-summary"]),
];

/// The schemas by the stem of their file's name: those of records and answers, of a line of `check
/// --json`, of the summary of `conform`, of a line of `prove`, of what `vehicle` and `station` write at their end, of a line of the log of `vehicle` and of what
/// `explore` and `evaluate` write.
pub fn all() -> Vec<(&'static str, Value)> {
    let mut schemas = schema::all();
    schemas.extend(check::records::schemas());
    schemas.push(("conform-summary", schema::written::<Summary>()));
    schemas.push(("claim", schema::written::<Claim>()));
    schemas.push(("vehicle-summary", schema::written::<vehicle::summary::Summary>()));
    schemas.push(("vehicle-log", schema::written::<vehicle::log::Entry>()));
    schemas.push(("station-summary", schema::written::<StationSummary>()));
    schemas.push(("exploration", schema::written::<Vec<ExplorationReport>>()));
    let made = [
        "evaluation-failures",
        "evaluation-readings",
        "evaluation-stages",
        "evaluation-attacks",
        "evaluation-combinations",
        "evaluation-availability",
        "evaluation-left-out",
    ];
    schemas.extend(made.map(|name| (name, schema::written::<Made>())));
    schemas.push(("evaluation-scenes", schema::written::<scenes::Scenes>()));
    schemas.push(("evaluation-part", schema::written::<Part>()));
    schemas.push(("evaluation-falsify", schema::written::<falsify::Falsified>()));
    let part = schema::written::<Part<falsify::Options>>();
    schemas.push(("evaluation-falsify-part", part));
    schemas.push(("evaluation-found", schema::written::<falsify::found::Found>()));
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
