//! Reads drives from files. What a source does not say (which groups are remote, what the sensors
//! saw, how old the data are) comes from [`Options`] and is written down in [`Drive::notes`].

mod commonroad;
mod content;
mod corridor;
pub mod error;
mod formats;
mod lanes;
mod left_out;
mod lines;
mod map;
pub mod npy;
mod order;
pub mod route;
mod scenario;
mod sides;
mod solution;
mod source;
mod strip;
mod surface;
mod vehicle;
mod xml;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::DEMO;
use crate::drive::{Drive, Stream};
use crate::options::Options;
use crate::spool::Spool;
use content::Content;
use error::ReadError;
use scenario::Scenario;
use source::Source;

/// Reads drives from files, each recognised by its content: a `CommonRoad` scenario (2018b,
/// 2020a), a solution of the scenario before it, a map of control points, or cycles as JSON
/// Lines (`spec/5-interfaces.md#cycle`; the options do not touch them); each may be packed as gz, and may be a
/// pipe; what is packed, and all but lines, is read up to 1 GiB. Cycles are read line by line and kept in a
/// temporary file.
///
/// A scenario directly followed by solutions gives one drive for each of them, a scenario alone
/// one drive of a recorded vehicle; a solution named elsewhere goes to the scenario of its benchmark
/// id. The results are in the order of the files; an error names
/// file, place and value, and does not stop the others. A file gives one error at most: the lines
/// of JSON that are no cycles are in it together, and come before the drive of those that are.
pub fn read(paths: &[PathBuf], options: &Options) -> Vec<Result<Drive, ReadError>> {
    streams(paths, options).into_iter().map(|drive| drive.and_then(Stream::collect)).collect()
}

/// Whether a solution of a scenario was named.
enum Solved {
    No,
    Yes,
    /// This file cannot be read.
    Perhaps(PathBuf),
}

/// Reads drives from files as [`read`] does, and makes their cycles when they are asked for.
pub fn streams(paths: &[PathBuf], options: &Options) -> Vec<Result<Stream, ReadError>> {
    let mut drives = Vec::new();
    // The scenario last read, and whether a solution of it was named.
    let mut scenario: Option<(PathBuf, Scenario, Solved)> = None;
    let spool = Arc::new(Spool::default());
    for mut source in order::solutions_behind_scenarios(Source::all(paths)) {
        let is_solution = order::is_solution(&mut source);
        let content = source.open().and_then(|bytes| Content::of(&source.path, bytes));
        let path = &source.path;
        // What cannot be read may be the solution of the scenario before it, which is no reason to drive another way.
        // The scenario itself, named once more, is none.
        if let (Err(_), Some((file, _, solved @ Solved::No))) = (&content, &mut scenario)
            && file != path
        {
            *solved = if is_solution { Solved::Yes } else { Solved::Perhaps(path.clone()) };
        }
        if !matches!(content, Ok(Content::Solution(_)) | Err(_)) {
            drives.extend(unsolved(scenario.take(), options));
        }
        match content {
            Ok(Content::Scenario(text)) => match scenario::read(path, &text) {
                Ok(read) => scenario = Some((source.path, read, Solved::No)),
                Err(error) => drives.push(Err(error)),
            },
            Ok(Content::Solution(text)) => drives.push(match &mut scenario {
                Some((file, scenario, solved)) => {
                    *solved = Solved::Yes;
                    solution::read(path, &text)
                        .and_then(|s| commonroad::solved(scenario, &s, [file, path], options))
                }
                None => Err(ReadError::file(
                    path,
                    "no scenario that can be read is before it; name its scenario as well",
                )),
            }),
            Ok(Content::Map(bytes)) => drives.push(map::drive(path, &bytes, options)),
            Ok(Content::Lines(text)) => drives.extend(lines::drive(path, text, &spool, options)),
            Err(error) => drives.push(Err(error)),
        }
    }
    drives.extend(unsolved(scenario, options));
    name_apart(&mut drives);
    drives
}

/// The drive of the demo, which is built in.
///
/// Errors: an option that no cycle of it can be made with.
pub fn demo(options: &Options) -> Result<Stream, ReadError> {
    let [(scenario_file, scenario), (solution_file, solution)] = DEMO;
    let files = [scenario_file, solution_file].map(Path::new);
    let scenario = scenario::read(files[0], scenario)?;
    commonroad::solved(&scenario, &solution::read(files[1], solution)?, files, options)
}

/// Gives drives of the same name numbers from 2 on.
fn name_apart(drives: &mut [Result<Stream, ReadError>]) {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    for drive in drives.iter_mut().flatten() {
        let n = count.entry(drive.name.clone()).or_insert(0);
        *n += 1;
        if *n > 1 {
            drive.name = format!("{} ({n})", drive.name);
        }
    }
}

fn unsolved(
    scenario: Option<(PathBuf, Scenario, Solved)>,
    options: &Options,
) -> Option<Result<Stream, ReadError>> {
    match scenario {
        Some((file, scenario, Solved::No)) => Some(commonroad::recorded(&scenario, &file, options)),
        Some((file, _, Solved::Perhaps(behind))) => {
            let behind = behind.display();
            let words = format!(
                "left out: {behind} behind it cannot be read and may be its solution; if it has none, name the \
                 scenario alone"
            );
            Some(Err(ReadError::file(&file, words)))
        }
        Some((_, _, Solved::Yes)) | None => None,
    }
}
