//! What stands still: lanes, routes through them, crossings for people, and signals.

pub mod conflicts;
pub mod given;
pub mod id;
pub mod route;
pub mod streets;
pub mod ulm;

use crate::map::given::Given;
use crate::map::id::MapId;
use crate::map::route::Route;
use crate::path::Path;

/// A map with everything that may be followed through it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Town {
    /// Which map it is.
    pub id: MapId,
    /// What is paved, for pictures.
    pub lanes: Vec<Lane>,
    /// Where people cross.
    pub crossings: Vec<Crossing>,
    /// What may be followed, by vehicles and across crossings.
    pub routes: Vec<Route>,
    /// Programs of the signals, by group.
    pub signals: Vec<Program>,
    /// Drivers and starts that come with the map.
    pub given: Given,
}

/// A strip of pavement.
#[derive(Clone, Debug, PartialEq)]
pub struct Lane {
    /// Its middle, in driving direction.
    pub path: Path,
    /// Its whole width, m.
    pub width: f64,
}

/// A crossing for people on foot or on bicycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Index of the route across.
    pub route: usize,
    /// Width of the marked strip, m.
    pub width: f64,
}

/// What a signal shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Light {
    /// Go, if the way is free.
    Green,
    /// Stop, if that is possible at an ordinary deceleration.
    Yellow,
    /// Stop.
    Red,
}

/// A fixed-time program of one group of signals: green, yellow and red for the rest of the cycle, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Program {
    /// Start of the green within the cycle, s.
    pub green_from: f64,
    /// Length of the green, s.
    pub green: f64,
    /// Length of the yellow after it, s.
    pub yellow: f64,
    /// Length of the cycle, s.
    pub cycle: f64,
}

impl Program {
    /// What the group shows at a time, s.
    pub fn light(self, time: f64) -> Light {
        let at = time - self.green_from;
        let at = at - (at / self.cycle).floor() * self.cycle;
        if at < self.green {
            Light::Green
        } else if at < self.green + self.yellow {
            Light::Yellow
        } else {
            Light::Red
        }
    }
}

impl Town {
    /// Indexes of the routes that the ego may be given.
    pub fn ego_routes(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.routes.len()).filter(|&index| self.routes[index].task.is_some())
    }

    /// Indexes of the routes of motor vehicles.
    pub fn roads(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.routes.len()).filter(|&index| self.routes[index].kind == route::RouteKind::Road)
    }
}
