//! The services of a vehicle and of a station. Each is used twice: on the vehicle, and on the station that
//! it is offloaded to.

pub mod control;
pub mod detectors;
pub mod env;
pub mod grid;
pub mod mot;
pub mod tpl;
