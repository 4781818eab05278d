//! Charts as SVG.
//!
//! Drawn here and not by a crate: what the paper published stands beside each value, colours come from a style
//! sheet, so that a dark screen has its own, and the elements are those of the other pictures
//! (`mufasa_drives::pictures`). `plotters` writes a colour into every element and knows no grouped bars.

pub(super) mod bars;
mod chart;
pub(super) mod dots;
mod failed;
pub(super) mod figures;
mod left_out;
pub(super) mod lines;
mod page;
pub(super) mod search;
