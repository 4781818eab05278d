//! The norm check of directions, which no margin moves (`spec/4-arithmetic.md#strict-and-lax`): a
//! program in doubles decides it by rounding where a direction lies at the bound.

use mufasa_model::input::cycle::Cycle;
use mufasa_props::strategy::input::directions;

/// The bound on abs(cos^2 + sin^2 - 1) (`spec/4-arithmetic.md#domain`).
const BOUND: f64 = 1e-6;

/// A thousand times what doubles round in cos^2 + sin^2 - 1, a millionth of the bound.
const ROUNDING: f64 = 1e-12;

/// The cycle in every way to decide its directions within rounding of the bound that can have an answer of its
/// own: all of them inside, and each of them outside with the others inside, as the first problem is the answer.
/// Nothing when there is no such direction.
pub fn either_way(cycle: &Cycle) -> impl Iterator<Item = Cycle> {
    let mut inside = cycle.clone();
    let mut near = Vec::new();
    for (at, (cos, sin)) in directions(&mut inside).into_iter().enumerate() {
        if (excess(*cos, *sin).abs() - BOUND).abs() <= ROUNDING {
            put(cos, sin, BOUND - 2.0 * ROUNDING);
            near.push(at);
        }
    }
    let all = (!near.is_empty()).then(|| inside.clone());
    let outside = near.into_iter().map(move |at| {
        let mut cycle = inside.clone();
        let (cos, sin) = directions(&mut cycle).swap_remove(at);
        put(cos, sin, BOUND + 2.0 * ROUNDING);
        cycle
    });
    all.into_iter().chain(outside)
}

/// cos^2 + sin^2 - 1
fn excess(cos: f64, sin: f64) -> f64 {
    cos * cos + sin * sin - 1.0
}

/// Scales a direction until its norm is so far off 1, on its side of it.
fn put(cos: &mut f64, sin: &mut f64, far: f64) {
    let excess = excess(*cos, *sin);
    let scale = ((1.0 + far.copysign(excess)) / (1.0 + excess)).sqrt();
    (*cos, *sin) = (*cos * scale, *sin * scale);
}
