//! Every operation against exact rationals.

use super::Real;
use crate::random::Random;
use dashu_ratio::RBig;

fn exact(value: f64) -> RBig {
    RBig::try_from(value).expect("a finite number")
}

fn ends(x: Real) -> (RBig, RBig) {
    let (centre, err) = (exact(x.hi) + exact(x.lo), exact(x.err));
    (centre.clone() - err.clone(), centre + err)
}

fn holds(x: Real, value: &RBig) -> bool {
    let (low, high) = ends(x);
    low <= *value && *value <= high
}

/// A random number with a random point of its interval.
fn draw(random: &mut Random) -> (Real, RBig) {
    let values = random.related(2);
    let sharp = Real::difference(values[0], values[1]);
    let centre = exact(values[0]) - exact(values[1]);
    if random.below(2) == 0 {
        return (sharp, centre);
    }
    let by = random.double().abs() * 1e-20;
    let away = exact(by) * RBig::from_parts((random.below(201) as i64 - 100).into(), 100_u8.into());
    (sharp.widened(by), centre + away)
}

#[test]
fn results_are_within_their_bounds() {
    let mut random = Random::new(1);
    for _ in 0..40_000 {
        let ((a, x), (b, y)) = (draw(&mut random), draw(&mut random));
        assert!(holds(a, &x) && holds(b, &y));
        assert!(holds(a + b, &(&x + &y)), "{a:?} + {b:?}");
        assert!(holds(a - b, &(&x - &y)), "{a:?} - {b:?}");
        assert!(holds(a * b, &(&x * &y)), "{a:?} * {b:?}");
        assert!(holds(-a, &-x.clone()));
        let (least, most) = if x < y { (&x, &y) } else { (&y, &x) };
        assert!(holds(a.max(b), most) && holds(a.min(b), least), "{a:?} {b:?}");
        let size = if x < exact(0.0) { -x.clone() } else { x.clone() };
        assert!(holds(a.abs(), &size), "{a:?}");
        assert!(exact(a.magnitude()) >= size, "{a:?}");
        if y != exact(0.0) {
            let quotient = a.over(b);
            let overflows = !quotient.hi.is_finite() || !quotient.err.is_finite();
            assert!(overflows || holds(quotient, &(&x / &y)), "{a:?} / {b:?}");
        }
        let root = a.abs().sqrt();
        let (low, high) = ends(root);
        assert!(low <= exact(0.0) || &low * &low <= size, "root of {a:?}");
        assert!(high >= exact(0.0) && &high * &high >= size, "root of {a:?}");
    }
}

#[test]
fn comparisons_are_certain_only_when_they_hold() {
    let mut random = Random::new(2);
    let mut certain = 0;
    for _ in 0..40_000 {
        let ((a, x), (b, y)) = (draw(&mut random), draw(&mut random));
        assert!(!a.certainly_below(b) || x < y, "{a:?} < {b:?}");
        assert!(!a.certainly_at_most(b) || x <= y, "{a:?} <= {b:?}");
        assert!(a.possibly_below(b) || x >= y, "{a:?} < {b:?}");
        assert!(a.possibly_at_most(b) || x > y, "{a:?} <= {b:?}");
        certain += u32::from(a.certainly_below(b) || b.certainly_below(a));
    }
    assert!(certain > 20_000, "only {certain} comparisons were certain");
}

/// Completeness rests on this: bounds far below the least margin on the whole domain.
#[test]
fn bounds_of_lengths_are_tiny() {
    let mut random = Random::new(3);
    for _ in 0..10_000 {
        let v = random.related(4);
        let (dx, dy) = (Real::difference(v[0], v[1]), Real::difference(v[2], v[3]));
        let length = (dx.squared() + dy.squared()).sqrt();
        assert!(length.err <= length.hi * 1e-27 + 1e-140, "{length:?}");
        let ratio = dx.over(Real::new(0.01));
        assert!(ratio.err <= ratio.hi.abs() * 1e-27 + 1e-290, "{ratio:?}");
    }
}

/// A quotient of doubles is known much better than the general one, and exactly where it is a double.
#[test]
fn quotients_of_doubles() {
    let mut random = Random::new(38);
    let mut exact_ones = 0;
    for _ in 0..40_000 {
        let mut whole = |bits: u64| {
            let most = 2 << random.below(bits);
            1.0 + random.below(most - 1) as f64
        };
        let (a, b) = (whole(52) - 1.0, whole(52));
        let scale = libm::exp2(random.number(300.0).floor());
        for (a, b) in [(a, b), (a * scale, b), (-a, b * scale)] {
            let quotient = Real::quotient(a, b);
            assert!(holds(quotient, &(exact(a) / exact(b))), "{a} / {b}: {quotient:?}");
            assert!(quotient.err <= quotient.hi.abs() * 1e-31, "{a} / {b}: {quotient:?}");
            let is_double = exact(quotient.hi) * exact(b) == exact(a);
            assert_eq!(
                quotient.err + quotient.lo.abs() == 0.0,
                is_double,
                "{a} / {b}: {quotient:?}"
            );
            exact_ones += u32::from(is_double);
        }
    }
    assert!((2000..100_000).contains(&exact_ones), "{exact_ones}");
}

#[test]
fn integers_and_seconds() {
    for value in [0, 1, -1, 1 << 31, -(1 << 31) - 1, 120_000_000_000, i64::MAX, i64::MIN] {
        let real = Real::integer(value);
        assert!(real.err == 0.0 && holds(real, &RBig::from(value)), "{real:?}");
        assert!(holds(
            Real::seconds(value),
            &RBig::from_parts(value.into(), 1_000_000_000_u32.into())
        ));
    }
}

#[test]
fn nan_is_never_certain_and_always_possible() {
    let (nan, one) = (Real::new(f64::NAN), Real::ONE);
    for (a, b) in [(nan, one), (one, nan), (Real::ONE.over(Real::ZERO), one)] {
        assert!(!a.certainly_below(b) && !a.certainly_at_most(b));
        assert!(a.possibly_below(b) && a.possibly_at_most(b));
    }
}
