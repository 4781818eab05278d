//! Vectors on both sides of a threshold and on it.

use mufasa_model::input::cycle::Cycle;

use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::Expected;

/// How far from the threshold the outer vectors are; every margin delta used is smaller.
const CLEAR: f64 = 1e-3;

/// A number that decides.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    threshold: f64,
    side: Side,
    equal: Equal,
    clear: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Above,
    Below,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Equal {
    Accepted,
    Rejected,
}

/// Numbers above the threshold are rejected; the threshold itself is accepted.
pub const fn above(threshold: f64) -> Edge {
    Edge { threshold, side: Side::Above, equal: Equal::Accepted, clear: CLEAR }
}

/// Numbers from the threshold on are rejected.
pub const fn from(threshold: f64) -> Edge {
    Edge { threshold, side: Side::Above, equal: Equal::Rejected, clear: CLEAR }
}

/// Numbers up to the threshold are rejected.
pub const fn up_to(threshold: f64) -> Edge {
    Edge { threshold, side: Side::Below, equal: Equal::Rejected, clear: CLEAR }
}

/// Numbers below the threshold are rejected; the threshold itself is accepted.
pub const fn below(threshold: f64) -> Edge {
    Edge { threshold, side: Side::Below, equal: Equal::Accepted, clear: CLEAR }
}

impl Edge {
    /// With the outer vectors at this distance.
    pub const fn clear(self, clear: f64) -> Self {
        Self { clear, ..self }
    }

    /// The numbers from accepted to rejected: name, number, whether it is rejected.
    fn numbers(self) -> [(&'static str, f64, bool); 5] {
        let Self { threshold, side, equal, clear } = self;
        let (accepted, just_accepted, just_rejected, rejected) = match side {
            Side::Above => {
                (threshold - clear, threshold.next_down(), threshold.next_up(), threshold + clear)
            }
            Side::Below => {
                (threshold + clear, threshold.next_up(), threshold.next_down(), threshold - clear)
            }
        };
        [
            ("accepted", accepted, false),
            ("just-accepted", just_accepted, false),
            ("equal", threshold, equal == Equal::Rejected),
            ("just-rejected", just_rejected, true),
            ("rejected", rejected, true),
        ]
    }
}

/// A number at its threshold: what is compared, where, and what comes of it on either side.
pub struct Sides<'a> {
    /// Begin of the names of the vectors.
    pub name: &'a str,
    /// What is compared.
    pub note: &'a str,
    /// The threshold.
    pub edge: Edge,
    /// Answer on the accepted side.
    pub accepted: Expected,
    /// Answer on the rejected side.
    pub rejected: Expected,
}

impl Book {
    /// The cycle of a number on both sides of its threshold, one double beside it, and on it.
    pub fn sides(&mut self, topic: Topic, sides: &Sides<'_>, cycle: impl Fn(f64) -> Cycle) {
        for (side, number, is_rejected) in sides.edge.numbers() {
            let name = format!("{}-{side}", sides.name);
            let note = format!("{} Here: {number:?}.", sides.note);
            let expected = if is_rejected { &sides.rejected } else { &sides.accepted };
            self.cycle(topic, &name, &note, &cycle(number), expected);
        }
    }
}
