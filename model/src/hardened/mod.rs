//! What the rules H-nn add to the stages (`spec/hardened/README.md`), a file for each rule
//! or group of rules. H-08 is a rule of the requester ([`crate::offloading::requester`]).

pub mod detection_history;
pub mod h01_matched_pairs;
pub mod h02_h05_h10_schedule;
pub mod h04_gap;
pub mod h06_closed_cells;
pub mod h07_start;
pub mod h11_steps;
pub mod h14_fail_safe;
