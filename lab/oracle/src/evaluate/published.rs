//! What the paper publishes of its evaluation (Sec. V), where it does.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;

/// How many of the runs failed.
#[derive(Clone, Copy)]
pub(super) struct Published {
    /// As a number; none: the paper does not give it.
    pub(super) number: Option<f64>,
    /// In words, for the table.
    pub(super) words: &'static str,
}

/// Failures: its numbers are in a figure, which has to be read by eye.
pub(super) const fn failures(attack: Option<Kind>, variant: Variant) -> Published {
    match (attack, variant) {
        (None, _) => Published { number: None, words: "not said" },
        (Some(_), Variant::Paper) => Published { number: Some(0.0), words: "0" },
        (Some(Kind::WrongMap | Kind::EmptyTracks), Variant::Sofof) => {
            Published { number: None, words: "several" }
        }
        (Some(_), Variant::Sofof) => Published { number: None, words: "in its figure" },
        (Some(_), Variant::Hardened) => Published { number: None, words: "" },
    }
}
