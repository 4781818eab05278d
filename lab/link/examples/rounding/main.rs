//! What the rounding of the link does to verdicts: the cycles of drives, as `mufasa check` makes them, with
//! remote tracks and trajectory as they were and as they arrive, judged by the implementation.
//!
//! `cargo run --release -p mufasa-link --example rounding -- [--json FILE] [--sigma M] FILES`: CommonRoad
//! scenarios and solutions, and records; `--sigma`: noise of detected positions, per axis. Prints the tables of
//! `docs/link-messages.md`; FILE gets every changed cycle.

mod sent;
mod tally;

use std::ffi::OsString;
use std::path::PathBuf;

use mufasa_drives::check::judge::{in_order, is_safe};
use mufasa_drives::{Options, Sensor, Stream, streams};
use mufasa_link::message::{EncodeError, Frame};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_props::bridge::check_impl;

use sent::Way;
use tally::{Change, Tally};

/// Latitude and longitude of every reference position, 0.1 microdegree: Ulm. The map's place is that of the
/// CAV in the first cycle of its drive.
const REFERENCE: [i32; 2] = [484_223_000, 99_560_000];

fn main() {
    let arguments = Arguments::read(std::env::args_os().skip(1));
    let Arguments { json, sigma_m, files } = arguments.unwrap_or_else(|wrong| stop(&wrong));
    let mut tallies = Vec::new();
    for (name, profile) in [("paper", Profile::PAPER), ("hardened", Profile::HARDENED)] {
        let sensor = Sensor { sigma_m, ..Sensor::default() };
        let drives: Vec<Stream> =
            streams(&files, &Options { profile, sensor, ..Options::default() })
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
        done.unwrap_or_else(|error| stop(&format!("no frame: {error}")));
        tallies.extend(of_profile);
    }
    print!("{}", tally::tables(&tallies));
    if let Some(file) = json {
        let written = std::fs::write(&file, tally::json(&tallies));
        written.unwrap_or_else(|error| stop(&format!("{}: {error}", file.display())));
    }
}

struct Arguments {
    json: Option<PathBuf>,
    sigma_m: f64,
    files: Vec<PathBuf>,
}

impl Arguments {
    fn read(mut arguments: impl Iterator<Item = OsString>) -> Result<Self, String> {
        let mut read = Self { json: None, sigma_m: Sensor::default().sigma_m, files: Vec::new() };
        while let Some(argument) = arguments.next() {
            if argument == "--json" {
                read.json = Some(arguments.next().ok_or("--json needs a file")?.into());
            } else if argument == "--sigma" {
                let number = arguments.next().and_then(|it| it.to_str()?.parse().ok());
                read.sigma_m = number.ok_or("--sigma needs a number of metres")?;
            } else {
                read.files.push(argument.into());
            }
        }
        Ok(read)
    }
}

fn stop(wrong: &str) -> ! {
    eprintln!("rounding: {wrong}");
    std::process::exit(2)
}

/// Every cycle of a drive, on each way.
fn judge(drive: &Stream) -> Result<[Vec<Change>; Way::ALL.len()], EncodeError> {
    let mut changes = Way::ALL.map(|_| Vec::new());
    let mut frame = None;
    for made in drive.cycles() {
        let made = made.unwrap_or_else(|error| stop(&error.to_string()));
        let ego = &made.cycle.ego;
        let here = Frame::new(REFERENCE[0], REFERENCE[1], [ego.x, ego.y])?;
        let frame = frame.get_or_insert(here);
        let before = check_impl(&made.cycle);
        for (way, changes) in Way::ALL.into_iter().zip(&mut changes) {
            let after = way.arrives(&made.cycle, frame).map(|cycle| check_impl(&cycle));
            let before = before.clone();
            let is_turned = after.as_ref().is_ok_and(|after| is_safe(after) != is_safe(&before));
            let slack_m = if is_turned { slack_m(&made.cycle) } else { None };
            let (drive, cycle) = (drive.name.clone(), made.id.clone());
            changes.push(Change { drive, cycle, before, after, slack_m });
        }
    }
    Ok(changes)
}

/// How little the CAV has to be larger on each side (of an unsafe cycle: smaller) for the cycle to be judged
/// the other way before anything is sent, m; `None` where 0.2 m does not do it.
fn slack_m(cycle: &Cycle) -> Option<f64> {
    let safe = is_safe(&check_impl(cycle));
    let is_turned = |by_m: f64| {
        let by_m = if safe { by_m } else { -by_m };
        let mut cycle = cycle.clone();
        cycle.ego.length += 2.0 * by_m;
        cycle.ego.width += 2.0 * by_m;
        is_safe(&check_impl(&cycle)) != safe
    };
    let [mut least, mut most] = [0.0, 0.2];
    if !is_turned(most) {
        return None;
    }
    for _ in 0..30 {
        let middle = f64::midpoint(least, most);
        if is_turned(middle) { most = middle } else { least = middle }
    }
    Some(most)
}
