//! What plain doubles decide, by the error bounds of `rectangle`.

use std::vec::Vec;

use super::{MovingRectangle, SLACK, Sweep, minus};
use crate::input::cycle::{Ego, TrajectoryPoint};
use crate::numbers::plane::Vector;
use crate::numbers::rectangle::{Rectangle, certainly_touch, possibly_touch};
use crate::numbers::rounding::Real;
use crate::random::Random;
use crate::stages::llcc::{Pose, footprint};

fn rectangle(moving: &MovingRectangle, t_ns: i64) -> Rectangle {
    let vector = |[x, y]: [f64; 2]| Vector::new(x, y);
    let moved = vector(moving.velocity).times(Real::seconds(t_ns));
    let [length, width] = moving.size;
    let direction = vector(moving.direction);
    Rectangle { centre: vector(moving.centre) + moved, direction, length, width }
}

fn object(random: &mut Random, far: f64) -> MovingRectangle {
    MovingRectangle {
        centre: [random.number(12.0) + far, random.number(12.0) - far],
        direction: random.direction(),
        velocity: [random.number(20.0), random.number(20.0)],
        size: [3.0 + random.number(2.9), 2.0 + random.number(1.9)],
    }
}

/// Beside or ahead of the CAV after so many seconds, with or without a tiny gap.
fn near(random: &mut Random, cav: &MovingRectangle, seconds: f64) -> MovingRectangle {
    let other = object(random, 0.0);
    let size = other.size;
    let gap = [0.0, 1e-9, -1e-9, 5e-9, 1.2e-8][random.below(5) as usize];
    let along = random.below(2) as usize;
    let reach = 0.5 * (cav.size[along] + size[along]) + gap;
    let [cos, sin] = cav.direction;
    let [ahead, left] = if along == 0 { [cos, sin] } else { [-sin, cos] };
    let ([x, y], [vx, vy]) = (cav.centre, other.velocity);
    let centre = [x + reach * ahead - vx * seconds, y + reach * left - vy * seconds];
    MovingRectangle { centre, direction: cav.direction, ..other }
}

fn larger(it: Rectangle, halves: f64) -> Rectangle {
    let [length, width] = [it.length, it.width].map(|size| size + 2.0 * halves);
    Rectangle { length, width, ..it }
}

/// By the bounds of `rectangle`; what is clear in the strict model with the least margin is found to be so.
#[test]
fn what_is_clear_does_not_touch_and_nothing_else_is() {
    let mut random = Random::new(11);
    let (mut clear, mut missed, mut touching, mut between_both) = (0, 0, 0, 0);
    for round in 0..20_000 {
        let far = [0.0, 1e7][round % 2];
        let ego = Ego {
            x: far,
            y: -far,
            cos: 1.0,
            sin: 0.0,
            speed: 5.0,
            length: 4.8,
            width: 1.9,
            center_offset: random.number(2.0),
        };
        let (sin, cos) = random.number(3.2).sin_cos();
        let points: Vec<TrajectoryPoint> = (0..4_i64)
            .map(|i| {
                let turn = random.number(0.3);
                let [x, y] = [far + cos * i as f64, -far + sin * i as f64];
                let (sin, cos) = (sin + turn, cos - turn);
                let norm = sin.hypot(cos);
                TrajectoryPoint { t_ns: i * 100_000_000, x, y, cos: cos / norm, sin: sin / norm }
            })
            .collect();
        let of = MovingRectangle::footprint(&ego, &points[round % 4]);
        let object = match random.below(2) {
            0 => object(&mut random, far),
            _ => near(&mut random, &of, (round % 4) as f64 / 10.0),
        };
        let sweep = Sweep::new(&ego, &points, [0.0, 0.3]);
        let misses = sweep.misses(&object);
        missed += u32::from(misses);
        for point in &points {
            let (cav, it) = (footprint(&ego, &Pose::of(point)), rectangle(&object, point.t_ns));
            let [touches, may_touch] = [0.0, 1e-8].map(|m| possibly_touch(&larger(cav, m), &it));
            let seconds = point.t_ns as f64 / 1e9;
            let plain = MovingRectangle::cav(&ego, [point.cos, point.sin]);
            let between = minus(object.seen_from([point.x, point.y]).after(seconds), plain.centre);
            let is_clear = plain.is_apart(&object, between, SLACK);
            assert!(!(touches && (misses || is_clear)), "{object:?} {point:?}");
            assert!(is_clear || may_touch, "{object:?} {point:?}");
            // The centre of the CAV's rectangle rounds at far places; the object's, too.
            let still = MovingRectangle { centre: object.after(seconds), ..object };
            let far = MovingRectangle::footprint(&ego, point).certainly_far(&still, 5.0);
            assert!(!far || !(it.centre - cav.centre).norm().possibly_at_most(Real::new(5.0)));
            clear += u32::from(is_clear);
            touching += u32::from(touches);
            between_both += u32::from(may_touch && !touches);
        }
    }
    assert!(clear > 10_000 && missed > 1_000 && touching > 4_000, "{clear} {missed} {touching}");
    assert!(between_both > 2_000, "{between_both}");
}

/// Beside the CAV, or ahead of it, and moves past, away, or so little that products underflow.
#[test]
fn what_is_clear_of_a_way_touches_nowhere_on_it() {
    let mut random = Random::new(13);
    let (mut clear, mut touching) = (0, 0);
    for _ in 0..20_000 {
        let far = [0.0, 300.0][random.below(2) as usize];
        let cav = MovingRectangle { velocity: [0.0; 2], ..object(&mut random, far) };
        let it = near(&mut random, &cav, 0.0);
        let is_turned = random.below(2) > 0;
        let direction = if is_turned { random.direction() } else { it.direction };
        let it = MovingRectangle { direction, ..it };
        let speed = [0.0, 5e-324, 1e-300, 1e-9, 1.0, 30.0][random.below(6) as usize];
        let [cos, sin] = cav.direction;
        let ways = [[cos, sin], [-sin, cos], [sin, -cos], random.direction()];
        let way = random.below(4) as usize;
        let moved = ways[way].map(|part| part * speed);
        let is_clear = cav.is_clear_of(&it, minus(it.centre, cav.centre), moved, SLACK);
        let touches = |halves: f64| {
            (0..=64).any(|k| {
                let by = |part: f64| Real::new(part) * Real::new(f64::from(k) / 64.0);
                let still = rectangle(&MovingRectangle { velocity: [0.0; 2], ..it }, 0);
                let centre = still.centre + Vector { x: by(moved[0]), y: by(moved[1]) };
                let cav = larger(rectangle(&cav, 0), halves);
                possibly_touch(&cav, &Rectangle { centre, ..still })
            })
        };
        assert!(!(is_clear && touches(0.0)), "{cav:?} {it:?} {moved:?}");
        // What goes along a side is nearest at an end.
        let ends_tell = !is_turned && way < 3 || speed < 1e-8;
        assert!(is_clear || !ends_tell || touches(1e-8), "{cav:?} {it:?} {moved:?}");
        clear += u32::from(is_clear);
        touching += u32::from(!is_clear);
    }
    assert!(clear > 4_000 && touching > 4_000, "{clear} {touching}");
}

/// No side of the two separates them, but the axis across the way.
#[test]
fn what_passes_a_corner_is_clear() {
    let (centre, direction, velocity) = ([0.0; 2], [1.0, 0.0], [0.0; 2]);
    let car = MovingRectangle { centre, direction, velocity, size: [4.0, 2.0] };
    for (gap, is_clear) in [(8e-9, true), (1e-9, false), (-1e-9, false)] {
        let away = 3.0 + gap * core::f64::consts::FRAC_1_SQRT_2;
        let between = [-away - 10.0, away - 10.0];
        assert_eq!(car.is_clear_of(&car, between, [20.0; 2], SLACK), is_clear, "{gap}");
    }
}

#[test]
fn what_certainly_touches_shares_a_point() {
    let mut random = Random::new(12);
    let (mut touching, mut off) = (0, 0);
    for round in 0..40_000 {
        let far = [0.0, 1e7][round % 2];
        let [one, other] = [(); 2].map(|()| object(&mut random, far));
        let shares = certainly_touch(&rectangle(&one, 0), &rectangle(&other, 0));
        let certain = one.certainly_touches(&other);
        assert!(shares || !certain, "{one:?} {other:?}");
        // Few are within a margin of a side.
        touching += u32::from(certain);
        off += u32::from(shares && !certain);
    }
    assert!(touching > 1_000 && off < 5, "{touching} {off}");
    // A direction that is shorter than 1 makes the rectangle smaller, by 2e-5 m.
    let (centre, size) = ([0.0; 2], [100.0; 2]);
    let cell = MovingRectangle { centre, size, direction: [1.0, 0.0], velocity: [0.0; 2] };
    let short = MovingRectangle { direction: [1.0 - 4e-7, 0.0], ..cell };
    let at = |x: f64| short.certainly_touches(&MovingRectangle { centre: [x, 0.0], ..cell });
    assert!(at(99.999_97) && !at(99.999_99));
}
