//! The norm check of directions, which no margin moves (`spec/4-arithmetic.md#strict-and-lax`): a
//! program in doubles decides it by rounding where a direction lies at the bound.

use mufasa_model::input::cycle::Cycle;
use mufasa_props::strategy::input::directions;

/// The bound on abs(cos^2 + sin^2 - 1) (`spec/4-arithmetic.md#domain`).
const BOUND: f64 = 1e-6;

/// A thousand times what doubles round in cos^2 + sin^2 - 1, a millionth of the bound.
const ROUNDING: f64 = 1e-12;

/// The cycle with every direction within rounding of the bound moved inside, and moved outside;
/// `None` when there is no such direction.
pub fn either_side(cycle: &Cycle) -> Option<[Cycle; 2]> {
    let [mut inside, mut outside] = [cycle.clone(), cycle.clone()];
    let moved =
        [(&mut inside, -2.0 * ROUNDING), (&mut outside, 2.0 * ROUNDING)].map(|(cycle, by)| {
            let mut near = 0;
            for (cos, sin) in directions(cycle) {
                let excess = *cos * *cos + *sin * *sin - 1.0;
                if (excess.abs() - BOUND).abs() <= ROUNDING {
                    let square = 1.0 + (BOUND + by).copysign(excess);
                    let scale = (square / (1.0 + excess)).sqrt();
                    (*cos, *sin) = (*cos * scale, *sin * scale);
                    near += 1;
                }
            }
            near
        });
    (moved != [0, 0]).then_some([inside, outside])
}
