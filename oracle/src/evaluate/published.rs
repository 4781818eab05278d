//! What the paper publishes of its evaluation (Sec. V), where it does.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::cpu::Who;

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
        (Some(Kind::MapReplaced | Kind::TracksEmpty), Variant::Sofof) => {
            Published { number: None, words: "several" }
        }
        (Some(_), Variant::Sofof) => Published { number: None, words: "in its figure" },
        (Some(_), Variant::Hardened) => Published { number: None, words: "" },
    }
}

/// CPU usage, %, in a time, s.
pub(super) type Usage = (f64, f64);

/// Usage while a service is active and while it is not; of ENV and TPL, which are one here, both.
pub(super) const fn cpu(variant: Variant, who: Who) -> [&'static [Usage]; 2] {
    match (variant, who) {
        (Variant::Hardened, _) => [&[], &[]],
        (Variant::Paper, Who::Guard) => [&[(2.3, 594.5)], &[]],
        (Variant::Paper, Who::Mot) => [&[(5.23, 551.6)], &[(1.3, 42.1)]],
        (Variant::Paper, Who::EnvTpl) => {
            [&[(18.75, 536.3), (18.7, 537.6)], &[(1.2, 57.4), (0.9, 54.9)]]
        }
        (Variant::Sofof, Who::Guard) => [&[(2.13, 594.5)], &[]],
        (Variant::Sofof, Who::Mot) => [&[(5.36, 541.0)], &[(1.1, 53.3)]],
        (Variant::Sofof, Who::EnvTpl) => {
            [&[(18.6, 488.4), (18.6, 488.9)], &[(0.7, 105.1), (0.6, 105.1)]]
        }
    }
}
