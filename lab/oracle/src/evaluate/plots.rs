//! Charts as SVG, drawn by `plotters`.

mod chart;
pub(super) mod figures;
