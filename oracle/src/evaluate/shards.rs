//! Parts of an experiment that are made on different machines, and put together.

use std::io::{self, Write};
use std::path::Path;
use std::sync::PoisonError;

use mufasa_sim::experiment::select::{Part, Select, Shard};

use super::merge::MergeArguments;
use super::{EXPERIMENTS, Results, Task, ended, falsify, in_threads, parts, prepared};

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
    let part = Part { experiment, options, shard, runs };
    parts::write(folder, &part, "runs", out, err)
}

/// Puts parts together: what comes out is, byte for byte, what one run of the whole would write. Its exit code.
/// Errors: those of writing to `out`.
pub fn merge(
    arguments: &MergeArguments,
    out: &mut impl Write,
    err: &mut impl Write,
) -> io::Result<u8> {
    if arguments.parts.first().is_some_and(|it| parts::is_of(it, falsify::NAME)) {
        return falsify::merge(arguments, out, err);
    }
    let folder = arguments.out.as_deref();
    let read = |()| parts::read(&arguments.parts);
    let made = prepared(folder).and_then(read).and_then(|whole: Part| {
        let named = EXPERIMENTS.iter().find(|(name, _)| *name == whole.experiment);
        let (_, make) = named.ok_or_else(|| {
            let names = EXPERIMENTS.map(|(name, _)| name).join(", ");
            format!("{}: no such experiment; there are {names}", whole.experiment)
        })?;
        let select = Select { made: Some(&whole.runs), ..Select::default() };
        let task = Task { sized: &|_| whole.options, select: &select };
        in_threads(None, &task, *make)
    });
    ended(made, folder, arguments.into.as_deref(), out, err)
}
