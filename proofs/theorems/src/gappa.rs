//! Bounds of the rounding errors of the distances, by Gappa.
//!
//! The scripts are generated from the operations of `model/src/stages/distances.rs`, as a program in doubles
//! would do them in the order of the source. `tests/theorems/rounding.rs` holds the bounds against exact
//! numbers. The implementation computes in double-doubles with bounds of its own.

mod bound;
mod script;

use std::io;
use std::process::Command;
use std::time::{Duration, Instant};

pub use bound::Bound;

use crate::claim::Decision;
use crate::numbers::real::Real;
use crate::process;
use crate::stages::distances::{s_b, s_follow};
use bound::Known;
use script::Script;

/// Longest time for a script.
const LIMIT: Duration = Duration::from_secs(20);

const NOTHING: Known = Known { most: "0", error: "0" };

/// All bounds. The last one starts from the one before it.
pub const BOUNDS: [Bound; 3] = [
    Bound {
        id: "s_b_in_doubles_relative",
        statement: "abs(s_b in doubles - s_b) <= 2^-52 (1 + 2^-54) s_b",
        domain: "v from 1e-100 to 150 m/s, a_b from 0.1 to 100 m/s^2",
        formula: || braking("v"),
        inputs: &[("v", "1e-100", "150"), ("a_b", "0.1", "100")],
        relative: true,
        known: &[],
        lemma: NOTHING,
        of_max: NOTHING,
        limit: "0x1.00000000000004p-52",
        wrong: "1b-53",
    },
    Bound {
        id: "s_b_in_doubles_absolute",
        statement: "abs(s_b in doubles - s_b) <= 4.6e-13 m",
        domain: "v to 70 m/s, a_b from 1 to 12 m/s^2",
        formula: || braking("v"),
        inputs: &[("v", "0", "70"), ("a_b", "1", "12")],
        relative: false,
        known: &[],
        lemma: NOTHING,
        of_max: NOTHING,
        limit: "4.6e-13",
        wrong: "1e-14",
    },
    Bound {
        id: "s_follow_in_doubles_absolute",
        statement: "abs(s_follow in doubles - s_follow) <= 1.5e-12 m",
        domain: "speeds to 70 m/s, a_b from 1 to 12 m/s^2, safety_time to 2 s",
        formula: follow,
        inputs: &[("v_now", "0", "70"), ("safety_time", "0", "2")],
        relative: false,
        known: &[|| braking("v_now"), || braking("v_lead")],
        lemma: Known { most: "2450", error: "4.6e-13" },
        of_max: Known { most: "2450", error: "1.15e-12" },
        limit: "1.5e-12",
        wrong: "1e-13",
    },
];

fn braking(v: &str) -> Real {
    s_b(&Real::named(v), &Real::named("a_b"))
}

fn follow() -> Real {
    let [v_now, v_lead, a_b, safety_time] =
        ["v_now", "v_lead", "a_b", "safety_time"].map(Real::named);
    s_follow(&v_now, &v_lead, &a_b, &safety_time)
}

/// The version of Gappa, or nothing where there is none.
pub fn version() -> Option<String> {
    let output = Command::new("gappa").arg("--version").output().ok()?;
    let text = [output.stdout, output.stderr].concat();
    Some(String::from_utf8(text).ok()?.trim().to_owned())
}

impl Bound {
    /// Proved, or not known: Gappa refutes nothing. The wrong bound must have no proof, or the
    /// decision is not known either. Errors are those of running Gappa.
    pub fn judge(&self) -> io::Result<(Decision, Duration)> {
        let start = Instant::now();
        let is_proved = self.are_proved(self.limit)? && !self.are_proved(self.wrong)?;
        let decision = if is_proved { Decision::Proved } else { Decision::Unknown };
        Ok((decision, start.elapsed()))
    }

    /// The texts for Gappa that together claim this limit.
    pub fn scripts(&self, limit: &str) -> Vec<String> {
        Script::new(self).texts(limit)
    }

    fn are_proved(&self, limit: &str) -> io::Result<bool> {
        for script in self.scripts(limit) {
            let done = process::run(&mut Command::new("gappa"), &script, LIMIT)?;
            if !done.is_some_and(|done| done.status.success()) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
