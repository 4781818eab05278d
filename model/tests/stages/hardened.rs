//! `spec/hardened/README.md`: what the vectors of the rules leave out.

mod fail_safe;
mod history;
mod left_out;
mod start;
