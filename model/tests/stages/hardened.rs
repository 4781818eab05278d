//! `spec/3-stages.md#hardened-profile`: what the vectors of the rules leave out.

mod fail_safe;
mod history;
mod left_out;
mod start;
mod steps;
