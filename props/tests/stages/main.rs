//! The implementation against the exact model, stage by stage and in whole cycles; what an
//! implementation must be besides; and results of others.

mod agreed;
mod aim;
mod detections;
mod determinism;
mod distance;
mod fail_safe;
mod filter;
mod grid;
mod implementation;
mod indexed;
mod input;
mod laws;
mod lies;
mod map_validation;
mod own;
mod path;
mod peers;
mod precheck;
mod readings;
mod schedule;
mod track_validation;
mod tracks;
mod whole;
