//! Parts of an experiment that are made on different machines, and put together.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use mufasa_sim::experiment::select::{Part, Select, Shard};
use serde_json::Value;

use super::merge::MergeArguments;
use super::tables::{EXPERIMENTS, named};
use super::{
    Results, Task, draw, ended, falsify, in_threads, maps, page_of, parts, prepared, tell,
};
use crate::ended::{Ended, cannot};

/// Writes what was kept of the runs of a part, as a file that cannot be taken for the whole.
pub(super) fn write(
    folder: &Path,
    shard: Shard,
    results: &Results,
    select: Select<'_>,
    out: &mut impl Write,
) -> Ended {
    let (experiment, options) = (results.name.to_owned(), results.options);
    let runs = select.kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    let checks = select.checks.into_inner().unwrap_or_else(PoisonError::into_inner);
    let drawn = select.drawn.into_inner().unwrap_or_else(PoisonError::into_inner);
    tell(&checks, out)?;
    draw(folder, &drawn).map_err(cannot(folder, "written to"))?;
    let part = Part {
        version: parts::version(),
        experiment,
        options,
        shard,
        interrupted: false,
        runs,
        checks,
    };
    parts::write(folder, &part, "runs", out)
}

/// Puts parts together: what comes out is, byte for byte, what one run of the whole would write. Its exit code.
pub fn merge(arguments: &MergeArguments, out: &mut impl Write) -> Ended {
    if arguments.parts.first().is_some_and(|it| parts::is_of(it, falsify::NAME)) {
        return falsify::merge(arguments, out);
    }
    let folder = arguments.out.as_deref();
    prepared(folder, "")?;
    let Part { experiment, options, runs, checks, .. } = parts::read(&arguments.parts)?;
    let drawn = folder.map_or_else(BTreeMap::new, |_| drawn(&runs, &arguments.parts));
    let (checks, drawn) = (Mutex::new(checks), Mutex::new(drawn));
    let select = Select { made: Some(&runs), checks, drawn, ..Select::default() };
    let shown = named(&experiment).ok_or_else(|| {
        let names = EXPERIMENTS.map(|(it, _)| it.name).join(", ");
        format!("{experiment}: no such experiment; there are {names}")
    })?;
    let task = Task { sized: &|_| options, select: &select };
    let town = maps::same(arguments.map.as_deref(), options.map, "the parts")?;
    let results = in_threads(None, &town, &task, shown)?;
    ended(results, select, folder, out)
}

/// The pages of runs that failed, by their ids, as far as they are still beside the parts.
fn drawn(runs: &BTreeMap<String, Value>, parts: &[PathBuf]) -> BTreeMap<String, String> {
    let folders: BTreeSet<&Path> = parts.iter().filter_map(|it| it.parent()).collect();
    let page = |id: &String| {
        let mut found = folders.iter().map(|folder| fs::read_to_string(folder.join(page_of(id))));
        Some((id.clone(), found.find_map(Result::ok)?))
    };
    runs.keys().filter_map(page).collect()
}
