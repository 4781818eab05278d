//! Parts of an experiment that are made on different machines, and put together.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use mufasa_drives::check::complain;
use mufasa_records::files;
use mufasa_sim::experiment::checks::Checks;
use mufasa_sim::experiment::select::{Part, Select, Shard};

use super::arguments::MergeArguments;
use super::codes::{BAD_INPUT, DISAGREES};
use super::{EXPERIMENTS, Results, Task, draw, ended, in_threads, prepared, tell};

/// Writes what was kept of the runs of a part, as a file that cannot be taken for the whole.
pub(super) fn write(
    folder: &Path,
    shard: Shard,
    results: &Results,
    select: Select<'_>,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let (experiment, options) = (results.name.to_owned(), results.options);
    let runs = select.kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    let checks = select.checks.into_inner().unwrap_or_else(PoisonError::into_inner);
    let drawn = select.drawn.into_inner().unwrap_or_else(PoisonError::into_inner);
    tell(&checks, out, err)?;
    let (many, has_disagreed) = (runs.len(), !checks.disagreements.is_empty());
    let part = Part { experiment, options, shard, runs, checks };
    let file = folder.join(format!("{}.{}-of-{}.part.json", results.name, shard.index, shard.of));
    let text = serde_json::to_string_pretty(&part).map_err(io::Error::other)? + "\n";
    if let Err(error) = files::write(&file, &text).and_then(|()| draw(folder, &drawn)) {
        complain(err, &format!("{}: cannot be written: {error}", file.display()));
        return Ok(BAD_INPUT);
    }
    writeln!(out, "{}: {many} runs, part {} of {}", file.display(), shard.index, shard.of)?;
    Ok(if has_disagreed { DISAGREES } else { 0 })
}

/// Puts parts together: what comes out is, byte for byte, what one run of the whole would write. Its exit code.
/// Errors: those of writing to `out`.
pub fn merge(
    arguments: &MergeArguments,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    let folder = arguments.out.as_deref();
    let whole = match prepared(folder).and_then(|()| read(&arguments.parts)) {
        Ok(whole) => whole,
        Err(message) => {
            complain(err, &message);
            return Ok(BAD_INPUT);
        }
    };
    let checks = Mutex::new(whole.checks.clone());
    let select = Select { made: Some(&whole.runs), checks, ..Select::default() };
    let named = EXPERIMENTS.iter().find(|it| it.name == whole.experiment).ok_or_else(|| {
        let names = EXPERIMENTS.map(|it| it.name).join(", ");
        format!("{}: no such experiment; there are {names}", whole.experiment)
    });
    let made = named.and_then(|named| {
        let task = Task { sized: &|_| whole.options, select: &select };
        in_threads(None, &task, named.make)
    });
    let made = made.map(|results| (results, select));
    ended(made, folder, arguments.into.as_deref(), out, err)
}

/// All runs of the parts, if these are all of one experiment.
fn read(files: &[PathBuf]) -> Result<Part, String> {
    let mut whole: Option<Part> = None;
    let mut from: BTreeMap<u32, &Path> = BTreeMap::new();
    for file in files {
        let part = part(file).map_err(|why| format!("{}: {why}", file.display()))?;
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

fn part(file: &Path) -> Result<Part, String> {
    let text = std::fs::read_to_string(file).map_err(|error| error.to_string())?;
    let part: Part = serde_json::from_str(&text).map_err(|error| {
        format!("no part of an experiment: {error}; give files named *.part.json")
    })?;
    if !(1..=part.shard.of).contains(&part.shard.index) {
        return Err(format!("shard: part {} of {}", part.shard.index, part.shard.of));
    }
    Ok(part)
}
