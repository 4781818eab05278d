//! The stages of the model on both sides of every threshold and on it. Each test names the
//! requirement, rule or interpretation that it decides.

mod arithmetic;
mod base;
mod detections;
mod distances;
mod exact;
mod grid;
mod hardened;
mod hardened_trajectory;
mod input;
mod map_validation;
mod schedule;
mod track_validation;
mod tracks;
