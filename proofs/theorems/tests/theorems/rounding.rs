//! The bounds that Gappa proves (`src/gappa`) against exact rationals, on numbers with long
//! mantissas and at the ends of the domain; and the margins of the spec against the bounds.

use std::cell::RefCell;

use dashu_ratio::RBig;
use proptest::prelude::*;

/// Smallest margin delta of the domain, m (`spec/4-arithmetic.md#domain`).
const LEAST_DELTA: f64 = 1e-8;
const S_B_ABSOLUTE: f64 = 4.6e-13;
const S_FOLLOW_ABSOLUTE: f64 = 1.5e-12;

fn exact(value: f64) -> RBig {
    RBig::try_from(value).expect("the number is finite")
}

/// As a program in doubles computes it.
fn s_b(v: f64, a_b: f64) -> f64 {
    v * v / (2.0 * a_b)
}

fn exact_s_b(v: f64, a_b: f64) -> RBig {
    exact(v) * exact(v) / (RBig::from(2) * exact(a_b))
}

fn s_follow([v_now, v_lead, a_b, safety_time]: [f64; 4]) -> f64 {
    (s_b(v_now, a_b) - s_b(v_lead, a_b)).max(0.0) + safety_time * v_now
}

fn exact_s_follow([v_now, v_lead, a_b, safety_time]: [f64; 4]) -> RBig {
    let longer = exact_s_b(v_now, a_b) - exact_s_b(v_lead, a_b);
    let longer = if longer > RBig::ZERO { longer } else { RBig::ZERO };
    longer + exact(safety_time) * exact(v_now)
}

/// Distance of a double to an exact number, m, as a double near it.
fn error(value: f64, exact_value: &RBig) -> f64 {
    (exact(value) - exact_value).to_f64().value().abs()
}

/// Anything within the ends, half of the time within 1e-3 of one.
fn near_the_ends(least: f64, most: f64) -> impl Strategy<Value = f64> {
    let near = (most - least) * 1e-3;
    prop_oneof![
        2 => least..=most,
        1 => least..=least + near,
        1 => most - near..=most,
    ]
}

/// Runs 20,000 cases and returns the largest error.
fn worst(names: [(f64, f64); 4], error: impl Fn([f64; 4]) -> Result<f64, TestCaseError>) -> f64 {
    let [a, b, c, d] = names.map(|(least, most)| near_the_ends(least, most));
    let worst = RefCell::new(0.0_f64);
    let config = ProptestConfig { cases: 20_000, failure_persistence: None, ..Default::default() };
    proptest!(config, |((a, b, c, d) in (a, b, c, d))| {
        let error = error([a, b, c, d])?;
        worst.replace_with(|worst| worst.max(error));
    });
    worst.into_inner()
}

#[test]
fn s_b_in_doubles_is_within_the_bounds() {
    let domain = [(0.0, 70.0), (1.0, 12.0), (1e-3, 150.0), (0.1, 100.0)];
    let worst = worst(domain, |[v, a_b, any_v, any_a_b]| {
        let absolute = error(s_b(v, a_b), &exact_s_b(v, a_b));
        prop_assert!(absolute <= S_B_ABSOLUTE, "{v} {a_b}: {absolute}");
        let exact_value = exact_s_b(any_v, any_a_b);
        let relative = error(s_b(any_v, any_a_b), &exact_value) / exact_value.to_f64().value();
        // The quotient of two doubles is rounded, too.
        prop_assert!(relative <= f64::EPSILON * (1.0 + 1e-14), "{any_v} {any_a_b}: {relative}");
        Ok(absolute)
    });
    println!("largest error found: {worst:e} m of {S_B_ABSOLUTE:e}");
    assert!(worst > S_B_ABSOLUTE / 4.0, "the draws come nowhere near the bound");
}

#[test]
fn s_follow_in_doubles_is_within_the_bound() {
    let domain = [(0.0, 70.0), (0.0, 70.0), (1.0, 12.0), (0.0, 2.0)];
    let worst = worst(domain, |case| {
        let absolute = error(s_follow(case), &exact_s_follow(case));
        prop_assert!(absolute <= S_FOLLOW_ABSOLUTE, "{case:?}: {absolute}");
        Ok(absolute)
    });
    println!("largest error found: {worst:e} m of {S_FOLLOW_ABSOLUTE:e}");
    assert!(worst > S_FOLLOW_ABSOLUTE / 8.0, "the draws come nowhere near the bound");
}

#[test]
fn the_margin_covers_the_bounds() {
    // A program in doubles that compares on the safe side of half the margin accepts nothing that
    // the exact model rejects and everything that the strict model accepts.
    let half = LEAST_DELTA / 2.0;
    for bound in [S_B_ABSOLUTE, S_FOLLOW_ABSOLUTE] {
        assert!(bound < half, "{bound}");
    }
    let bounds = mufasa_theorems::gappa::BOUNDS.each_ref().map(|bound| bound.statement);
    assert!(bounds[1].contains("4.6e-13") && bounds[2].contains("1.5e-12"));
}
