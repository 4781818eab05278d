//! What the vectors of `vectors/` do not say of the model (`props/tests/vectors.rs` holds it to them): the
//! readings margin by margin, decisions against decisions made otherwise, properties of all cycles.

mod arithmetic;
mod base;
mod distances;
mod exact;
mod hardened;
mod input;
mod near;
mod profile;
mod schedule;
mod work;
