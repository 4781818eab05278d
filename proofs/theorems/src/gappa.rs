//! Bounds of the rounding errors of the distances, by Gappa.
//!
//! The scripts are generated from the operations of `model/src/stages/distances.rs`, as a program in doubles
//! would do them in the order of the source. `tests/rounding.rs` holds the bounds against exact
//! numbers. The implementation computes in double-doubles with bounds of its own.

mod bound;
mod process;
mod script;

use std::io;
use std::time::{Duration, Instant};

pub use bound::Bound;
pub use process::version;

use crate::numbers::real::Real;
use crate::prove::Decision;
use crate::stages::distances::{s_b, s_follow};
use bound::Known;
use script::Script;

const NOTHING: Known = Known { most: "0", error: "0" };

/// All bounds. The last one starts from the one before it.
pub const BOUNDS: [Bound; 3] = [
    Bound {
        id: "s_b_in_doubles_relative",
        statement: "abs(s_b in doubles - s_b) <= 2^-52 (1 + 2^-54) s_b",
        domain: "v from 1e-100 to 150 m/s, a_b from 0.1 to 100 m/s^2",
        formula: || s_b(&v(), &a_b()),
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
        formula: || s_b(&v(), &a_b()),
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
        formula: || s_follow(&v_now(), &v_lead(), &a_b(), &Real::named("safety_time")),
        inputs: &[("v_now", "0", "70"), ("safety_time", "0", "2")],
        relative: false,
        known: &[|| s_b(&v_now(), &a_b()), || s_b(&v_lead(), &a_b())],
        lemma: Known { most: "2450", error: "4.6e-13" },
        of_max: Known { most: "2450", error: "1.15e-12" },
        limit: "1.5e-12",
        wrong: "1e-13",
    },
];

fn v() -> Real {
    Real::named("v")
}

fn v_now() -> Real {
    Real::named("v_now")
}

fn v_lead() -> Real {
    Real::named("v_lead")
}

fn a_b() -> Real {
    Real::named("a_b")
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
            if !process::is_proved(&script)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
