//! What comes with a map: how its vehicles drive, and where they are at a start.

use crate::traffic::idm::Idm;
use crate::traffic::start::Start;

/// What comes with a map; nothing, where scenarios are drawn freely.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// One of these is each driver who is drawn; none: drivers are drawn, too.
    pub drivers: Vec<Idm>,
    /// Starts, at most one for each route of the ego.
    pub starts: Vec<GivenStart>,
    /// Whether others let the ego go that evidently goes, if they can still stop. Not in the town: runs of it are
    /// kept, and would be other ones.
    pub lets_ego_go: bool,
}

/// Where the ego and others are at a start.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenStart {
    /// Index of the ego's route.
    pub ego_route: usize,
    /// Where its middle is on it, m.
    pub ego_s: f64,
    /// m/s.
    pub ego_speed: f64,
    /// The others.
    pub actors: Vec<Start>,
}
