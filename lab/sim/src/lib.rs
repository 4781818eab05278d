//! A closed loop: a CAV drives through a town with services of its own and of a station, while somebody
//! attacks what comes over the link.
//!
//! The same seed gives the same bytes, by argument on any machine: numbers go through IEEE operations and libm alone,
//! time is simulated, and everything is kept in an order.

pub mod attack;
pub mod cav;
pub mod collision;
pub mod experiment;
pub mod ids;
pub mod map;
mod named;
pub mod path;
pub mod pictures;
pub mod planner;
pub mod pose;
pub mod radio;
pub mod replay;
pub mod run;
pub mod scenario;
pub mod services;
pub mod settings;
pub mod snapshot;
pub mod station;
pub mod time;
pub mod traffic;
pub mod vehicle;
pub mod withheld;
pub mod world;
