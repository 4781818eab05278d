//! Theorems over the reals, proved of the model's source and not of a copy.
//!
//! The files of `model/src` that compute are compiled here a second time, with the symbolic
//! numbers of [`numbers::real`] in the place of the model's exact ones: `crate::numbers::real::Real` is the only
//! thing that differs. Executing a formula then yields a polynomial, and a comparison that is not
//! decided by what is known forks the execution. Each path that can be reached becomes one question
//! to z3: is there a counterexample?

pub mod claim;
pub mod drive;
pub mod input;
pub mod numbers;
pub mod prove;
pub mod solver;
pub mod theorem;
pub mod witness;
pub mod work;

pub use mufasa_model::{parameters, services};

#[path = "../../../model/src/cycle.rs"]
pub mod cycle;
#[path = "../../../model/src/hardened/mod.rs"]
pub mod hardened;
#[path = "../../../model/src/report.rs"]
pub mod report;
#[path = "../../../model/src/stages/mod.rs"]
pub mod stages;
