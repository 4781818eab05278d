//! Compiled proof harnesses as one formula of bit vectors, decided by z3.

mod control;
pub mod machine;
mod memory;
pub mod module;
mod numeric;
pub mod prove;
mod simplify;
pub mod smt;
mod state;
pub mod term;
