//! Bounds of the rounding errors of the distances, by Gappa.
//!
//! The formulas are those of `spec/3-stages.md#distances` as a program in doubles would compute
//! them, written in Gappa's language. `tests/rounding.rs` holds the bounds
//! against exact numbers. The implementation computes in double-doubles with bounds of its own.

use std::io::{self, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::prove::Verdict;

/// Longest time for a bound.
const LIMIT: Duration = Duration::from_secs(20);

/// A bound on a rounding error.
#[derive(Debug)]
pub struct Bound {
    /// Its name.
    pub id: &'static str,
    /// What is claimed.
    pub statement: &'static str,
    /// Of which numbers.
    pub domain: &'static str,
    /// Gappa's text, `BOUND` in the place of the limit.
    script: &'static str,
    /// The limit claimed.
    limit: &'static str,
    /// A smaller one, for which there must be no proof.
    wrong: &'static str,
}

/// All bounds. The last one starts from the one before it.
pub const BOUNDS: [Bound; 3] = [
    Bound {
        id: "s_b_in_doubles_relative",
        statement: "abs(s_b in doubles - s_b) <= 2^-52 (1 + 2^-54) s_b",
        domain: "v from 1e-100 to 150 m/s, a_b from 0.1 to 100 m/s^2",
        script: include_str!("gappa/s_b-relative.g"),
        limit: "0x1.00000000000004p-52",
        wrong: "1b-53",
    },
    Bound {
        id: "s_b_in_doubles_absolute",
        statement: "abs(s_b in doubles - s_b) <= 4.6e-13 m",
        domain: "v to 70 m/s, a_b from 1 to 12 m/s^2",
        script: include_str!("gappa/s_b-absolute.g"),
        limit: "4.6e-13",
        wrong: "1e-14",
    },
    Bound {
        id: "s_follow_in_doubles_absolute",
        statement: "abs(s_follow in doubles - s_follow) <= 1.5e-12 m",
        domain: "speeds to 70 m/s, a_b from 1 to 12 m/s^2, safety_time to 2 s",
        script: include_str!("gappa/s_follow-absolute.g"),
        limit: "1.5e-12",
        wrong: "1e-13",
    },
];

/// The version of Gappa, or nothing where there is none.
pub fn version() -> Option<String> {
    let output = Command::new("gappa").arg("--version").output().ok()?;
    let text = [output.stdout, output.stderr].concat();
    Some(String::from_utf8(text).ok()?.trim().to_owned())
}

impl Bound {
    /// Proved, or not known: Gappa refutes nothing. The wrong bound must have no proof, or the
    /// verdict is not known either. Errors are those of running Gappa.
    pub fn judge(&self) -> io::Result<(Verdict, Duration)> {
        let start = Instant::now();
        let is_proved = self.is_proved(self.limit)? && !self.is_proved(self.wrong)?;
        let verdict = if is_proved { Verdict::Proved } else { Verdict::Unknown };
        Ok((verdict, start.elapsed()))
    }

    fn is_proved(&self, bound: &str) -> io::Result<bool> {
        let mut process = Command::new("gappa")
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()?;
        let script = self.script.replace("BOUND", bound);
        // Dropped at once, so that Gappa sees the end of its input.
        process.stdin.take().map_or(Ok(()), |mut input| input.write_all(script.as_bytes()))?;
        let end = Instant::now() + LIMIT;
        loop {
            if let Some(status) = process.try_wait()? {
                return Ok(status.success());
            }
            if Instant::now() > end {
                process.kill()?;
                process.wait()?;
                return Ok(false);
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}
