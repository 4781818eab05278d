//! Steps to be measured (`spec/4-arithmetic.md#steps`): pairs of rectangles, of which each counts
//! as 20. That takes 770 ps a step where the slowest input of `scripts/steps` takes 740.

use core::hint::black_box;

use crate::input::cycle::Ego;
use crate::stages::llcc::sweep::{MovingRectangle, minus};

const SIDE: u32 = 72;
const PAIR: u64 = 20;

/// The pairs of as many poses of a CAV, along a street, and cars beside it; how many steps that is.
pub(super) fn run() -> u64 {
    let at = |index: u32| f64::from(black_box(index));
    let ego = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 10.0,
        length: 4.8,
        width: 1.9,
        center_offset: 1.4,
    };
    let mut apart = 0_u64;
    for point in 0..SIDE {
        let cav = MovingRectangle::cav(&ego, [0.8, 0.6]);
        for car in 0..SIDE {
            let car = MovingRectangle {
                centre: [at(car), 5.0],
                direction: [0.6, 0.8],
                velocity: [1.0, 0.0],
                size: [4.5, 1.8],
            };
            let between = minus(car.seen_from([at(point), 0.0]).after(0.1), cav.centre);
            let is_clear = cav.is_clear_of(black_box(&car), between, [0.0; 2], 1e-6);
            apart = apart.saturating_add(u64::from(is_clear));
        }
    }
    black_box(apart);
    u64::from(SIDE).saturating_mul(u64::from(SIDE)).saturating_mul(PAIR)
}
