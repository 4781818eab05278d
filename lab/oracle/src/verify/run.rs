//! One check: its command with what it says in a log, and what came of it.

use std::env;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::checks::Check;
use super::evidence::{Case, Outcome, Status};

/// Between two looks at a command that runs.
const PAUSE: Duration = Duration::from_millis(50);
/// What stands before what a test or a script left out.
const NOT_RUN: &str = "NOT RUN: ";

/// Where checks run and what they leave.
pub(super) struct Place<'p> {
    /// Root of the checkout.
    pub(super) root: &'p Path,
    /// Folder of the evidence.
    pub(super) out: PathBuf,
}

/// Runs a check, and calls `meanwhile` with the seconds so far; none: it was stopped. Errors: those of its log.
pub(super) fn outcome(
    check: &Check,
    place: &Place<'_>,
    stop: &AtomicBool,
    meanwhile: impl Fn(u64),
) -> io::Result<Option<Outcome>> {
    if let Some(need) = check.missing(place.root) {
        let why = format!("{} is missing; it comes with {}", need.name, need.package);
        return Ok(Some(Outcome::not_run(check, why)));
    }
    let log = place.out.join(check.log());
    let start = Instant::now();
    let mut child = match place.command(check, File::create(&log)?)?.spawn() {
        Ok(child) => child,
        Err(error) => {
            fs::remove_file(&log)?;
            let is_missing = error.kind() == io::ErrorKind::NotFound;
            let status = if is_missing { Status::NotRun } else { Status::Failed };
            let why = format!("{} cannot be run: {error}", check.command[0]);
            return Ok(Some(Outcome { status, ..Outcome::not_run(check, why) }));
        }
    };
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if stop.load(Ordering::Relaxed) {
            end(&mut child)?;
            return Ok(None);
        }
        thread::sleep(PAUSE);
        meanwhile(start.elapsed().as_secs());
    };
    let mut cases = cases(&String::from_utf8_lossy(&fs::read(&log)?));
    let written = check.writes.iter().map(|name| place.out.join(name));
    for file in written.filter(|file| file.extension().is_some_and(|it| it == "jsonl")) {
        cases.extend(claims(&fs::read_to_string(file).unwrap_or_default()));
    }
    let taken = start.elapsed().as_secs_f64();
    let (status, reason) = judge(check, place, status, &cases);
    Ok(Some(Outcome { check: check.clone(), status, reason, taken, cases }))
}

/// How a check ended whose command did so, and why if it did not pass. What leaves out all that it says something of
/// was not run, and what says nothing of its tests or leaves no file shows nothing.
fn judge(
    check: &Check,
    place: &Place<'_>,
    status: ExitStatus,
    cases: &[Case],
) -> (Status, Option<String>) {
    let of = |status| cases.iter().find(|case| case.status == status);
    let unwritten = check.writes.iter().find(|name| !place.out.join(name).exists());
    let failed = if let Some(case) = of(Status::Failed) {
        Some(format!("{} failed", case.name))
    } else if !status.success() {
        Some(status.to_string())
    } else if check.is_of_tests() && cases.is_empty() {
        Some(String::from("no test was run"))
    } else {
        unwritten.map(|name| format!("{name} was not written"))
    };
    match (failed, of(Status::Passed), of(Status::NotRun)) {
        (Some(why), ..) => (Status::Failed, Some(why)),
        (None, None, Some(case)) => (Status::NotRun, Some(case.name.clone())),
        (None, ..) => (Status::Passed, None),
    }
}

/// The tests of which the output of `cargo test` says how they ended, and what it says was left out.
fn cases(text: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for line in text.lines() {
        let test = line.strip_prefix("test ").and_then(|it| it.rsplit_once(" ... "));
        let case = if let Some((_, left_out)) = line.split_once(NOT_RUN) {
            let reason = Some(String::from("it says NOT RUN"));
            Case { name: left_out.trim().to_owned(), status: Status::NotRun, reason }
        } else if let Some((name, end)) = test {
            let status = match end {
                "ok" => Status::Passed,
                "FAILED" => Status::Failed,
                _ if end.starts_with("ignored") => Status::NotRun,
                _ => continue,
            };
            let reason = (status == Status::NotRun).then(|| end.to_owned());
            Case { name: name.to_owned(), status, reason }
        } else {
            continue;
        };
        // A test shows what it printed once more.
        if case.status != Status::NotRun || !cases.contains(&case) {
            cases.push(case);
        }
    }
    cases
}

/// The claims of `mufasa prove`. A claim that was tested where no engine proves it passed, as there.
fn claims(lines: &str) -> Vec<Case> {
    let claim = |line: &str| {
        let line: Value = serde_json::from_str(line).ok()?;
        let said = |field: &str| line[field].as_str().map(str::to_owned);
        let verdict = said("verdict")?;
        let status = match verdict.as_str() {
            "proved" | "tested" => Status::Passed,
            "not run" => Status::NotRun,
            _ => Status::Failed,
        };
        let words = [Some(verdict), said("engine"), said("reason")];
        let words: Vec<_> = words.into_iter().flatten().filter(|it| !it.is_empty()).collect();
        Some(Case { name: said("id")?, status, reason: Some(words.join(", ")) })
    };
    lines.lines().filter_map(claim).collect()
}

impl Place<'_> {
    /// The command of a check, which says all into its log.
    fn command(&self, check: &Check, log: File) -> io::Result<Command> {
        let own = env::current_exe()?;
        let program = match check.command[0].as_str() {
            "mufasa" => own.clone(),
            script if script.contains('/') => self.root.join(script),
            program => PathBuf::from(program),
        };
        let out = self.out.display().to_string();
        let arguments = check.command[1..].iter().map(|it| it.replace("{out}", &out));
        let mut command = Command::new(program);
        command.args(arguments).current_dir(self.root).stdin(Stdio::null());
        // What a script would else build.
        command
            .env("MUFASA", own)
            .env("CARGO_TERM_COLOR", "never")
            .env("NO_COLOR", "1")
            .env("TERM", "dumb");
        command.stderr(log.try_clone()?).stdout(log);
        // Of its own, so that it can be ended with all that it started.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        Ok(command)
    }
}

/// Ends a command with all that it started.
fn end(child: &mut Child) -> io::Result<()> {
    let group = format!("-{}", child.id());
    let ended = cfg!(unix)
        && Command::new("kill").args(["-TERM", "--", &group]).status().is_ok_and(|it| it.success());
    if !ended {
        child.kill()?;
    }
    child.wait().map(drop)
}
