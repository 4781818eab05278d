//! The files of parts: how they are written, and read until all are there.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::io::Write;
use std::path::{Path, PathBuf};

use mufasa_records::files;
use mufasa_sim::experiment::checks::Checks;
use mufasa_sim::experiment::select::{Part, Shard};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::ended::{DISAGREES, Ended, cannot, said};

/// This program, as `mufasa --version` has it.
pub(super) fn version() -> String {
    env!("MUFASA_VERSION").to_owned()
}

/// I/N with I from 1 to N.
pub(super) fn shard(text: &str) -> Result<Shard, String> {
    let parts = text
        .split_once('/')
        .and_then(|(index, of)| Some(Shard { index: index.parse().ok()?, of: of.parse().ok()? }));
    parts.filter(|it| (1..=it.of).contains(&it.index)).ok_or_else(|| {
        String::from("a part is I/N, with I from 1 to N, such as 2/8 for the second of eight")
    })
}

/// Writes a part as a file that cannot be taken for the whole; `what` its runs are. The exit code.
pub(super) fn write<O: Serialize>(
    folder: &Path,
    part: &Part<O>,
    what: &str,
    out: &mut impl Write,
) -> Ended {
    let Shard { index, of } = part.shard;
    let file = folder.join(format!("{}.{index}-of-{of}.part.json", part.experiment));
    let text = serde_json::to_string_pretty(part).map_err(said)? + "\n";
    files::write(&file, &text).map_err(cannot(&file, "written"))?;
    writeln!(out, "{}: {} {what}, part {index} of {of}", file.display(), part.runs.len())?;
    Ok(if part.checks.disagreements.is_empty() { 0 } else { DISAGREES })
}

/// All runs of the parts, and what was checked in them, if these are all of one experiment.
pub(super) fn read<O>(files: &[PathBuf]) -> Result<Part<O>, String>
where
    O: Clone + PartialEq + Debug + DeserializeOwned,
{
    let mut whole: Option<Part<O>> = None;
    let mut from: BTreeMap<u32, &Path> = BTreeMap::new();
    for file in files {
        let part = part(file).map_err(|why| format!("{}: {why}", file.display()))?;
        if part.version != version() {
            let by = match part.version.as_str() {
                "" => "does not say which mufasa made it".to_owned(),
                other => format!("was made by mufasa {other}"),
            };
            let this = version();
            let file = file.display();
            return Err(format!(
                "{file}: it {by}, and this is {this}; merge with the program that made all parts"
            ));
        }
        let first = whole.get_or_insert_with(|| Part {
            runs: BTreeMap::new(),
            checks: Checks::default(),
            ..part.clone()
        });
        let is_same = first.experiment == part.experiment && first.options == part.options;
        if !is_same || first.shard.of != part.shard.of {
            return Err(format!(
                "{}: a part of {} with {:?} in {} parts, and {} is of {} with {:?} in {}",
                file.display(),
                part.experiment,
                part.options,
                part.shard.of,
                files[0].display(),
                first.experiment,
                first.options,
                first.shard.of,
            ));
        }
        if let Some(other) = from.insert(part.shard.index, file) {
            let [one, two] = [other.display(), file.display()];
            return Err(format!("{two}: part {} is there already: {one}", part.shard.index));
        }
        first.runs.extend(part.runs);
        first.checks.add(part.checks);
    }
    let whole = whole.ok_or("no part")?;
    let missing = (1..=whole.shard.of).filter(|index| !from.contains_key(index));
    let missing: Vec<String> = missing.take(10).map(|index| index.to_string()).collect();
    if missing.is_empty() {
        return Ok(whole);
    }
    Err(format!(
        "part {} of {} is missing; make it by `mufasa evaluate {} --shard {}/{}` with the same options",
        missing.join(", "),
        whole.shard.of,
        whole.experiment,
        missing[0],
        whole.shard.of
    ))
}

fn part<O: DeserializeOwned>(file: &Path) -> Result<Part<O>, String> {
    let text = std::fs::read_to_string(file).map_err(|error| error.to_string())?;
    let part: Part<O> = serde_json::from_str(&text).map_err(|error| {
        format!("no part of an experiment: {error}; give files named *.part.json (summaries of conform: mufasa conform merge)")
    })?;
    if part.interrupted {
        let Shard { index, of } = part.shard;
        return Err(format!(
            "it was interrupted, and is no part; make it by `mufasa evaluate {} --shard {index}/{of}` with the same \
             options",
            part.experiment
        ));
    }
    if !(1..=part.shard.of).contains(&part.shard.index) {
        return Err(format!("shard: part {} of {}", part.shard.index, part.shard.of));
    }
    Ok(part)
}

/// Whether a file is a part of this experiment.
pub(super) fn is_of(file: &Path, experiment: &str) -> bool {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let part: Result<Part<serde_json::Value>, _> = serde_json::from_str(&text);
    part.is_ok_and(|it| it.experiment == experiment)
}
