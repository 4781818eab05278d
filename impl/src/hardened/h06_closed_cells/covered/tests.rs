//! Which cells a detection certainly covers, beside plain doubles with a margin.

use super::{certainly_covers, grown, plain_square, square};
use crate::input::cycle::{Detection, Grid};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::Rectangle;
use crate::numbers::rounding::Real;
use crate::random::Random;
use crate::stages::llcc::sweep::MovingRectangle;

/// A detection at a place, of up to 6.5 m by 6.5 m.
fn detection(random: &mut Random, [x, y]: [f64; 2]) -> Detection {
    let [cos, sin] = random.direction();
    let mut size = || 3.3 + random.number(3.2);
    Detection { x, y, cos, sin, length: size(), width: size() }
}

fn grid([x, y]: [f64; 2], [cos, sin]: [f64; 2], resolution: f64) -> Grid<'static> {
    let (width, height, occupied) = (4, 4, &[]);
    Grid { stamp_ns: 0, x, y, cos, sin, resolution, width, height, occupied, unknown: None }
}

#[test]
fn what_grows_is_rounded_down() {
    let mut random = Random::new(61);
    let (mut exact, mut less) = (0, 0);
    for _ in 0..20_000 {
        let given = detection(&mut random, [0.0; 2]);
        let [length, _] = grown(&given).size;
        let more = Real::difference(length, given.length);
        assert!(more.certainly_at_most(Real::new(0.5)), "{given:?}");
        assert!(Real::new(0.5 - 4e-15).certainly_below(more), "{given:?}");
        exact += u32::from(!more.possibly_below(Real::new(0.5)));
        less += u32::from(more.certainly_below(Real::new(0.5)));
    }
    assert!(exact > 1_000 && less > 1_000, "{exact} {less}");
}

#[test]
fn a_cell_is_covered_exactly_when_it_touches_what_is_grown() {
    let mut random = Random::new(62);
    let (mut covered, mut beside) = (0, 0);
    for round in 0..40_000 {
        let far = [0.0, 1e7][round % 2];
        let direction = random.direction();
        let resolution = [0.1, 0.5, 3.0][round % 3];
        let grid = grid([far, -far], direction, resolution);
        let place = [far + random.number(5.0), random.number(5.0) - far];
        let given = detection(&mut random, place);
        let (i, k) = (random.below(4) as i64, random.below(4) as i64);
        let plain = plain_square(&grid, i, k);
        let covers = certainly_covers(&given, &plain, || square(&grid, i, k));
        let apart = |less: f64| {
            let it = MovingRectangle::detection(&given);
            let it = MovingRectangle { size: it.size.map(|size| size + 0.5 - less), ..it };
            plain.certainly_apart(&it)
        };
        assert!(!(covers && apart(0.0)), "{given:?} {grid:?} {i} {k}");
        assert!(covers || apart(1e-4), "{given:?} {grid:?} {i} {k}");
        covered += u32::from(covers);
        // Beside what is detected, and with it grown.
        beside += u32::from(covers && apart(0.5));
    }
    assert!((5_000..35_000).contains(&covered) && beside > 500, "{covered} {beside}");
}

/// A square that reaches 5e-7 m into what is grown, which plain doubles do not tell, or does not, when its centre is not
/// known so well.
#[test]
fn what_possibly_touches_is_not_covered() {
    let given = Detection { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 };
    let grid = grid([2.25 - 5e-7, 0.0], [1.0, 0.0], 1.0);
    let covers = |by: f64| {
        let known = square(&grid, 0, 0);
        let centre = Vector { x: known.centre.x.widened(by), ..known.centre };
        certainly_covers(&given, &plain_square(&grid, 0, 0), || Rectangle { centre, ..known })
    };
    assert!(covers(0.0) && covers(4e-7) && !covers(6e-7));
}
