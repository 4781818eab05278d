//! A vehicle at the start of a run.

use crate::traffic::idm::Idm;

/// A vehicle at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Index of its route.
    pub route: usize,
    /// Where its middle is, m.
    pub s: f64,
    /// m/s.
    pub speed: f64,
    /// m.
    pub length: f64,
    /// m.
    pub width: f64,
    /// How it drives.
    pub idm: Idm,
    /// Where it stops for a while, in order.
    pub halts: Vec<Halt>,
}

/// A stop on the lane, as of a delivery van.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Halt {
    /// Where the front stops, m.
    pub s: f64,
    /// How long, s.
    pub seconds: f64,
}
