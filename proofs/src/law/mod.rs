//! Laws: sentences about the implementation as plain functions of what was seen of it.
//!
//! A law is `true` of everything that the implementation may do. It is written once and called by
//! whoever runs the implementation: proptest, a fuzzer, a model checker. `props/tests/stages/laws.rs` asks them
//! of random cycles and traces, and refutes each by a wrong report or step, so that none holds of nothing.

pub mod requester;
pub mod schedule;
