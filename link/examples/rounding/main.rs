//! What the rounding of the link does to verdicts: the cycles of drives, as `mufasa check` makes them, with
//! remote tracks and trajectory as they were and as they arrive, judged by the implementation.
//!
//! `cargo run --release -p mufasa-link --example rounding -- [--json FILE] FILES`: CommonRoad scenarios and
//! solutions, and records. Prints the tables of `docs/link.md`; FILE gets every changed cycle.

mod sent;
mod tally;

use std::path::PathBuf;

use mufasa_drives::check::judge::in_order;
use mufasa_drives::{Options, Stream, streams};
use mufasa_link::message::{EncodeError, Frame};
use mufasa_model::input::cycle::Profile;
use mufasa_props::bridge::check_impl;

use sent::Way;
use tally::{Change, Tally};

/// Latitude and longitude of every reference position, 0.1 microdegree: Ulm. The map's place is that of the
/// CAV in the first cycle of its drive.
const REFERENCE: [i32; 2] = [484_223_000, 99_560_000];

fn main() {
    let mut arguments: Vec<_> = std::env::args_os().skip(1).collect();
    let json = (arguments.first().is_some_and(|it| it == "--json") && arguments.len() > 1)
        .then(|| arguments.drain(..2).nth(1))
        .flatten();
    let files: Vec<PathBuf> = arguments.into_iter().map(PathBuf::from).collect();
    let mut tallies = Vec::new();
    for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
        let drives: Vec<Stream> = streams(&files, &Options { profile, ..Options::default() })
            .into_iter()
            .filter_map(|drive| drive.inspect_err(|error| eprintln!("rounding: {error}")).ok())
            .collect();
        let mut of_profile = Way::ALL.map(|way| Tally::new(name, way.name()));
        let done: Result<(), EncodeError> = in_order(
            drives.len(),
            |index| judge(&drives[index]),
            |judged| {
                for (tally, changes) in of_profile.iter_mut().zip(judged?) {
                    tally.drives += 1;
                    changes.into_iter().for_each(|change| tally.add(change));
                }
                Ok(())
            },
        );
        if let Err(error) = done {
            eprintln!("rounding: no frame: {error}");
            std::process::exit(2);
        }
        tallies.extend(of_profile);
    }
    print!("{}", tally::tables(&tallies));
    if let Some(file) = json
        && let Err(error) = std::fs::write(&file, tally::json(&tallies))
    {
        eprintln!("rounding: {}: {error}", PathBuf::from(file).display());
        std::process::exit(2);
    }
}

/// Every cycle of a drive, on each way.
fn judge(drive: &Stream) -> Result<[Vec<Change>; Way::ALL.len()], EncodeError> {
    let mut changes = Way::ALL.map(|_| Vec::new());
    let mut frame = None;
    for made in drive.cycles() {
        let ego = &made.cycle.ego;
        let here = Frame::new(REFERENCE[0], REFERENCE[1], [ego.x, ego.y])?;
        let frame = frame.get_or_insert(here);
        let before = check_impl(&made.cycle);
        for (way, changes) in Way::ALL.into_iter().zip(&mut changes) {
            let after = way.arrives(&made.cycle, frame).map(|cycle| check_impl(&cycle));
            let before = before.clone();
            changes.push(Change {
                drive: drive.name.clone(),
                cycle: made.id.clone(),
                before,
                after,
            });
        }
    }
    Ok(changes)
}
