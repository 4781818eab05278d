//! What the rules H-nn add to the stages (`spec/hardened/README.md`). The order
//! of the stages and stage v call them; H-08 is about the requester (`offloading::requester`).

pub(crate) mod detection_history;
pub(crate) mod h01_matched_pairs;
pub(crate) mod h02_h05_h10_schedule;
pub(crate) mod h04_gap;
pub(crate) mod h06_closed_cells;
pub(crate) mod h07_start;
pub(crate) mod h11_steps;
pub(crate) mod h14_fail_safe;
