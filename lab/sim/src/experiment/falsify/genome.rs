//! Attacks as points of the unit cube, so that a search can move among them.
//!
//! | gene | what |
//! |---|---|
//! | 0 | offered: both up to 0.6, planning alone up to 0.85, tracking alone |
//! | 1 | one attack up to 0.5, else two |
//! | 2 to 9, 10 to 17 | an attack each: kind, start, how long, target, lists, and three magnitudes a, b, c |
//!
//! Start: evenly over the cycles of the clean run with something remote. How long: 0.3 s to 60 s, evenly in its logarithm. Target: up to
//! 0.5 whom the kind says, else one of those who came near the CAV in the clean run. Lists: both up to 0.6,
//! the CAV's up to 0.8, the planner's. The magnitudes are evenly between the limits of `magnitudes`.

use super::super::axes::Offered;
use crate::attack::means::{Lists, Means};
use crate::attack::{Attack, Kind};

/// How many genes there are.
pub const GENES: usize = 2 + 2 * GENES_OF_ATTACK;
const GENES_OF_ATTACK: usize = 8;

/// What the search attacks with: all but what an attacker gets nothing from (`flood` and `slow` cost time
/// that a run does not know).
pub const KINDS: [Kind; 21] = [
    Kind::WrongMap,
    Kind::EmptyTracks,
    Kind::GhostTracks,
    Kind::MissingTrack,
    Kind::CrossingStands,
    Kind::GhostInMean,
    Kind::FalseVelocities,
    Kind::ExchangedPasts,
    Kind::Replay,
    Kind::Drift,
    Kind::StartsLate,
    Kind::EndsEarly,
    Kind::Backwards,
    Kind::IntoLead,
    Kind::Swerve,
    Kind::MadeUpLead,
    Kind::Delay,
    Kind::NotFinite,
    Kind::StampsAhead,
    Kind::Silent,
    Kind::HeldBack,
];

/// What the attacker knows of a run without an attack.
#[derive(Clone, Debug, PartialEq)]
pub struct Clean {
    /// Times of the cycles with something remote, s: at others nothing can be attacked.
    pub remote: Vec<f64>,
    /// Who came near the CAV, by number, the nearest first.
    pub near: Vec<u32>,
    /// For what the attacks draw.
    pub seed: u64,
}

/// What is offered, and the attacks of these kinds, of a point; coordinates outside of [0, 1] are folded back.
pub fn decode(genes: &[f64; GENES], kinds: &[Kind], clean: &Clean) -> (Offered, Vec<Attack>) {
    let genes = genes.map(folded);
    let offered = match genes[0] {
        share if share < 0.6 => Offered::Both,
        share if share < 0.85 => Offered::Plan,
        _ => Offered::Mot,
    };
    let count = if genes[1] < 0.5 { 1 } else { 2 };
    let parts = genes[2..].chunks_exact(GENES_OF_ATTACK).take(count);
    (offered, parts.map(|part| attack(part, kinds, clean)).collect())
}

fn attack(genes: &[f64], kinds: &[Kind], clean: &Clean) -> Attack {
    let kind = kinds[pick(genes[0], kinds.len())];
    let from = clean.remote.get(pick(genes[1], clean.remote.len())).copied().unwrap_or(1.0);
    let lasts = 0.3 * libm::pow(200.0, genes[2]);
    let chosen = (genes[3] >= 0.5).then(|| 2.0 * (genes[3] - 0.5));
    let target = chosen.and_then(|share| clean.near.get(pick(share, clean.near.len())).copied());
    let means = Means { target, ..means(kind, [genes[4], genes[5], genes[6], genes[7]]) };
    Attack { kind, from, until: from + lasts, seed: clean.seed, means }
}

/// Which lists an attack of a kind spoils, and by how much: of four shares from 0 to 1.
pub fn means(kind: Kind, [lists, a, b, c]: [f64; 4]) -> Means {
    let lists = match lists {
        share if share < 0.6 => Lists::Both,
        share if share < 0.8 => Lists::Cav,
        _ => Lists::Planner,
    };
    Means { lists, ..magnitudes(kind, [a, b, c]) }
}

/// What the three genes a, b, c of an attack are for its kind.
fn magnitudes(kind: Kind, [a, b, c]: [f64; 3]) -> Means {
    let none = Means::of(kind);
    let turn = |share| between(share, -core::f64::consts::PI, core::f64::consts::PI);
    let at = |(near, far)| {
        let (ahead_m, left_m) = (between(a, near, far), between(b, -4.0, 4.0));
        Means { ahead_m, left_m, speed_mps: between(c, -15.0, 15.0), ..none }
    };
    match kind {
        Kind::GhostTracks => at((-10.0, 40.0)),
        Kind::GhostInMean => at((-10.0, 10.0)),
        Kind::MadeUpLead => at((3.0, 60.0)),
        Kind::CrossingStands | Kind::FalseVelocities => {
            Means { factor: between(a, -1.5, 1.5), turn_rad: turn(b), ..none }
        }
        Kind::Drift => Means { speed_mps: 3.0 * a * a, turn_rad: turn(b), ..none },
        Kind::Replay => Means { late_s: between(a, 0.1, 8.0), ..none },
        Kind::StartsLate | Kind::StampsAhead => Means { late_s: between(a, 0.02, 2.0), ..none },
        Kind::HeldBack => Means { late_s: between(a, 0.005, 0.3), ..none },
        Kind::Delay => Means { late_s: between(a, 0.005, 0.1), ..none },
        Kind::EndsEarly => Means { ahead_m: between(a, 0.0, 6.0), ..none },
        Kind::IntoLead => Means {
            speed_mps: between(a, 0.0, 20.0),
            acceleration_mps2: between(b, -3.0, 3.0),
            ..none
        },
        Kind::Swerve => {
            Means { left_m: between(a, -3.0, 3.0), ahead_m: between(b, 3.0, 40.0), ..none }
        }
        _ => none,
    }
}

fn between(share: f64, least: f64, most: f64) -> f64 {
    least + (most - least) * share
}

/// One of so many.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a few"
)]
fn pick(share: f64, of: usize) -> usize {
    ((share * of as f64) as usize).min(of.saturating_sub(1))
}

/// A coordinate, mirrored at 0 and 1 until it is between them.
fn folded(gene: f64) -> f64 {
    let round = gene - 2.0 * (gene / 2.0).floor();
    if round > 1.0 { 2.0 - round } else { round }
}
