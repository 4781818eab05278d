//! `mufasa verify`: runs what shows that a checkout is right, as far as its tools are here, and leaves the evidence.

pub mod checks;
mod documents;
pub mod evidence;
mod figures;
mod forms;
mod locations;
mod report;
mod run;

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf, absolute};
use std::process::Command;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use clap::Args;
use mufasa_drives::progress;
use mufasa_records::files;

use self::checks::{Check, LOG};
use self::evidence::{Evidence, Outcome, RELEASE, Status};
use self::run::Place;
use crate::ended::{FAILED, INTERRUPTED, LEFT_OUT, Stopped, cannot, say};

/// Where the evidence is written in a checkout.
const FOLDER: &str = "target/evidence";
/// What tells a checkout from other folders.
const CHECKOUT: [&str; 2] = ["spec/requirements.lock", "lab/oracle/src/verify/checks.toml"];
const EVIDENCE: &str = "evidence.json";
const JUNIT: &str = "junit.xml";
const SARIF: &str = "results.sarif";
const REPORT: &str = "report.html";
const SUMS: &str = "SHA256SUMS";
/// What makes the checksums.
const SUMMER: &str = "sha256sum";

/// What is run.
#[derive(Args, Clone, Debug, Default)]
#[command(after_help = "\
Runs in the checkout that it is called in. Writes report.html, evidence.json, junit.xml, results.sarif, SHA256SUMS, logs, and what
checks leave.
Exit codes: 0 what was run passed, 1 a check failed, 2 bad input, such as no checkout, 4 nothing passed, or something was
not run and --release is given, 130 interrupted.")]
pub struct Settings {
    /// Only what takes less than 3 minutes together where the tests are built.
    #[arg(long)]
    pub quick: bool,
    /// What was not run counts as failed.
    #[arg(long, conflicts_with_all = ["quick", "only"])]
    pub release: bool,
    /// Also what takes hours.
    #[arg(long, conflicts_with_all = ["quick", "only"])]
    pub night: bool,
    /// Only the check of this name; may be given again.
    #[arg(long, value_name = "NAME", conflicts_with = "quick")]
    pub only: Vec<String>,
    /// Folder of the evidence [default: target/evidence in the checkout].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Runs the checks of the project in the checkout around the current folder. The exit code.
pub(crate) fn here(
    settings: &Settings,
    stop: &AtomicBool,
    out: &mut impl Write,
) -> Result<u8, Stopped> {
    let folder = env::current_dir()?;
    let is_root = |it: &&Path| CHECKOUT.iter().all(|file| it.join(file).exists());
    let root = folder.ancestors().find(is_root).ok_or_else(|| {
        format!("{}: is in no checkout of the project; call it in one", folder.display())
    })?;
    run(&checks::all()?, root, settings, stop, out)
}

/// Runs the checks of a table one after the other, names to `out` how each ended, and writes the evidence. The exit
/// code. Errors: those of writing, and what makes checking of no use.
pub fn run(
    table: &[Check],
    root: &Path,
    settings: &Settings,
    stop: &AtomicBool,
    out: &mut impl Write,
) -> Result<u8, Stopped> {
    let names: Vec<_> = table.iter().map(|check| check.name.as_str()).collect();
    if let Some(name) = settings.only.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(format!("{name}: no such check; there are {}", names.join(", ")).into());
    }
    if !checks::is_on_path(SUMMER) {
        return Err(format!("{SUMMER} is missing; it comes with Debian's package coreutils").into());
    }
    let root = absolute(root)?;
    let folder = settings.out.clone().map_or_else(|| Ok(root.join(FOLDER)), absolute)?;
    let prepared = files::prepare(&folder.join(LOG)).and_then(|()| clear(&folder, table));
    prepared.map_err(cannot(&folder, "written to"))?;
    let place = Place { root: &root, out: folder };
    let mut evidence = Evidence::new(settings.asked(), &root);
    place.write(EVIDENCE, &json(&evidence)?)?;
    let is_run = |it: &&Check| settings.leaves_out(it).is_none() && it.missing(&root).is_none();
    let all = table.iter().filter(is_run).map(|it| it.seconds).sum();
    let bar = progress::bar(all, "{bar:30} {msg}");
    let (start, mut before) = (Instant::now(), 0);
    for check in table {
        let outcome = if let Some(why) = settings.leaves_out(check) {
            Outcome::not_run(check, why)
        } else {
            let meanwhile = |taken: u64| {
                let done = before + taken.min(check.seconds);
                let left = progress::in_words(left(start.elapsed(), done, all));
                bar.set_position(done);
                bar.set_message(format!("{}, about {left} left", check.name));
            };
            let ran = run::outcome(check, &place, stop, meanwhile);
            let Some(outcome) = ran.map_err(|error| format!("{}: {error}", check.name))? else {
                bar.finish_and_clear();
                writeln!(
                    out,
                    "INTERRUPTED: {} is not complete",
                    place.out.join(EVIDENCE).display()
                )?;
                return Ok(INTERRUPTED);
            };
            before += if outcome.taken > 0.0 { check.seconds } else { 0 };
            bar.suspend(|| writeln!(out, "{}", line(&outcome)).and_then(|()| out.flush()))?;
            outcome
        };
        evidence.checks.push(outcome);
        place.write(EVIDENCE, &json(&evidence)?)?;
    }
    bar.finish_and_clear();
    leave(&mut evidence, table, &place)?;
    let counts = Status::ALL.map(|it| format!("{} {}", evidence.count(it), it.name()));
    writeln!(out, "{}", counts.join(", "))?;
    say(&[place.out.join(REPORT)], out)?;
    Ok(code(&evidence))
}

/// The time that is left when so many seconds of all are done: as the table says, or longer as it took longer so far.
fn left(elapsed: Duration, done: u64, all: u64) -> Duration {
    let rest = Duration::from_secs(all.saturating_sub(done));
    let slower = elapsed.as_secs_f64() / Duration::from_secs(done.max(1)).as_secs_f64();
    rest.mul_f64(if done > 0 { slower.max(1.0) } else { 1.0 })
}

/// The files that checks left.
fn leavings<'t>(folder: &Path, table: &'t [Check]) -> impl Iterator<Item = String> + use<'t> {
    let folder = folder.to_owned();
    let logs = table.iter().map(Check::log);
    let all = table.iter().flat_map(|check| check.writes.iter().cloned()).chain(logs);
    all.filter(move |name| folder.join(name).exists())
}

/// Nothing of an earlier run is taken for one of this. Files of other names stay.
fn clear(folder: &Path, table: &[Check]) -> io::Result<()> {
    let own = [SUMS, REPORT, JUNIT, SARIF, EVIDENCE].into_iter().map(str::to_owned);
    let own = own.filter(|name| folder.join(name).exists());
    own.chain(leavings(folder, table)).try_for_each(|name| fs::remove_file(folder.join(name)))
}

/// Writes what is complete, the checksums last.
fn leave(evidence: &mut Evidence, table: &[Check], place: &Place<'_>) -> Result<(), Stopped> {
    evidence.complete = true;
    let sarif = serde_json::to_string_pretty(&forms::sarif(evidence, place.root))
        .map_err(io::Error::from)?;
    let written = [
        (JUNIT, forms::junit(evidence)),
        (SARIF, sarif),
        (REPORT, report::page(evidence, place)),
        (EVIDENCE, json(evidence)?),
    ];
    for (name, text) in &written {
        place.write(name, text)?;
    }
    let names = written.into_iter().map(|(name, _)| name.to_owned());
    let mut names: Vec<_> = names.chain(leavings(&place.out, table)).collect();
    names.sort();
    let sums = Command::new(SUMMER).arg("--").args(names).current_dir(&place.out).output();
    let sums = sums.map_err(cannot(Path::new(SUMMER), "run"))?;
    if !sums.status.success() {
        return Err(format!("{SUMS}: {}", String::from_utf8_lossy(&sums.stderr)).into());
    }
    Ok(place.write(SUMS, &String::from_utf8_lossy(&sums.stdout))?)
}

fn json(evidence: &Evidence) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(evidence)? + "\n")
}

/// What is said of a check on a terminal.
fn line(outcome: &Outcome) -> String {
    let Outcome { check, status, reason, taken, .. } = outcome;
    let word = match status {
        Status::Passed => "passed ",
        Status::NotRun => "NOT RUN",
        Status::Failed => "FAILED ",
    };
    let left_out = match (reason, outcome.count(Status::NotRun)) {
        (Some(reason), _) => format!("; {reason}"),
        (None, 0) => String::new(),
        (None, count) => format!("; left out: {count}"),
    };
    format!("{word}  {}: {taken:.1} s{left_out}", check.name)
}

/// Where nothing passed, nothing was shown.
fn code(evidence: &Evidence) -> u8 {
    match evidence.worst() {
        Status::Failed => FAILED,
        _ if evidence.count(Status::Passed) == 0 => LEFT_OUT,
        Status::NotRun if evidence.is_release() => LEFT_OUT,
        Status::NotRun | Status::Passed => 0,
    }
}

impl Settings {
    fn asked(&self) -> &'static str {
        match self {
            Self { release: true, .. } => RELEASE,
            Self { quick: true, .. } => "quick",
            Self { night: true, .. } => "night",
            Self { only, .. } if only.is_empty() => "all",
            Self { .. } => "some",
        }
    }

    /// Why a check is not asked for, if it is not.
    fn leaves_out(&self, check: &Check) -> Option<String> {
        if self.quick && !check.quick {
            return Some("--quick leaves it out".to_owned());
        }
        if !self.only.is_empty() {
            let is_named = self.only.contains(&check.name);
            return (!is_named).then(|| "--only leaves it out".to_owned());
        }
        let call = check.command.join(" ");
        (check.night && !self.night).then(|| format!("it takes hours; --night runs it: {call}"))
    }
}

impl Place<'_> {
    fn write(&self, name: &str, text: &str) -> Result<(), String> {
        let file = self.out.join(name);
        files::write(&file, text).map_err(cannot(&file, "written"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_longer_where_all_took_longer_so_far() {
        let left = |elapsed, done| left(Duration::from_secs(elapsed), done, 100).as_secs();
        assert_eq!([left(0, 0), left(10, 20), left(60, 20), left(300, 100)], [100, 80, 240, 0]);
    }
}
