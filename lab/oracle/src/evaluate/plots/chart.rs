//! What all charts share.

use mufasa_sim::cav::guard::Variant;

use super::page::Series;

/// A chart and the name of its file.
pub struct Figure {
    pub file: String,
    pub svg: String,
}

pub(super) fn figure(file: &str, svg: String) -> Figure {
    Figure { file: format!("{file}.svg"), svg }
}

pub(super) const fn series(variant: Variant) -> Series {
    match variant {
        Variant::Sofof => Series::SOFOF,
        Variant::Paper => Series::PAPER,
        Variant::Hardened => Series::HARDENED,
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
pub(super) fn float(count: u64) -> f64 {
    count as f64
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
pub(super) fn ratio(part: usize, of: usize) -> f64 {
    if of == 0 { 0.0 } else { part as f64 / of as f64 }
}
