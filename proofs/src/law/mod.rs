//! Laws: sentences about the implementation as plain functions of what was seen of it.
//!
//! A law is `true` of everything that the implementation may do. It is written once and called by
//! whoever runs the implementation: an exhaustive run, proptest, a fuzzer, a model checker. Each
//! is refuted by a wrong variant in `proofs/tests`, so that none holds of nothing.

pub mod distances;
pub mod requester;
pub mod schedule;
