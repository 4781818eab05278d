//! Runs every harness on the stand-in for Kani. Where a domain is finite all of it is run; else this
//! is testing, not proof, and says so.
//!
//! `HARNESS=name cargo test -p mufasa-proofs --test harness -- --nocapture` runs those whose path
//! contains the name.

use std::collections::BTreeSet;
use std::panic::catch_unwind;

use mufasa_proofs::harness::ALL;
use mufasa_proofs::kani::{self, Budget, Run, run};

#[path = "support/expected.rs"]
mod expected;

/// The largest finite domain, that of the compositions, has 607,360 values.
const BUDGET: Budget = Budget { every: 1_000_000, random: 150_000, seed: 20_250_617 };
/// Runs in which every assumption has to hold, where runs are random.
const LEAST_HELD: u64 = 1_000;

#[test]
fn every_harness_holds_and_reaches_its_covers() {
    let only = std::env::var("HARNESS").unwrap_or_default();
    println!("`every`: all values of a finite domain were run. `some`: testing, not proof.");
    for expected in expected::expected().iter().filter(|one| one.id.contains(&only)) {
        let (_, harness) = ALL.iter().find(|(id, _)| *id == expected.id).expect("it is listed");
        let found = run(*harness, BUDGET);
        let kind = if found.exhaustive { "every" } else { "some" };
        println!("{}: {kind}, {} of {} runs held", expected.id, found.held, found.tried);
        println!("    {:?}", found.covers);
        assert_eq!(kind, expected.stand_in, "{}", expected.id);
        assert!(found.exhaustive || found.held >= LEAST_HELD, "{}: vacuous", expected.id);
        assert_reached(&expected.id, &expected.covers, &found);
    }
}

fn assert_reached(id: &str, covers: &BTreeSet<String>, found: &Run) {
    let seen: BTreeSet<String> = found.covers.keys().map(|&name| name.to_owned()).collect();
    assert_eq!(seen, *covers, "{id}: other covers than expected");
    let missed: Vec<_> = found.covers.iter().filter(|&(_, &runs)| runs == 0).collect();
    assert!(missed.is_empty(), "{id}: never reached: {missed:?}");
}

/// The engine itself: what it enumerates, rejects, counts and finds.
mod engine {
    use super::*;

    const FEW: Budget = Budget { every: 1_000, random: 2_000, seed: 1 };

    #[test]
    fn finite_domains_are_run_completely() {
        let found = run(
            || {
                let (a, b): (bool, u8) = (kani::any(), kani::below(5));
                kani::assume(a || b > 0);
                kani::cover(a && b == 4, "the last");
                kani::cover(!a && b == 0, "rejected");
            },
            FEW,
        );
        assert!(found.exhaustive);
        assert_eq!((found.tried, found.held), (10, 9));
        assert_eq!(
            found.covers.into_iter().collect::<Vec<_>>(),
            [("rejected", 0), ("the last", 1)]
        );
    }

    #[test]
    fn domains_too_large_or_of_numbers_are_sampled() {
        let large = run(|| kani::assume(kani::any::<u8>() == kani::any::<u8>()), FEW);
        assert!(!large.exhaustive && large.tried == FEW.random && large.held > 0);
        let numbers = run(|| assert!(kani::any::<i64>() < i64::MAX || kani::any()), BUDGET_OF_ONE);
        assert!(!numbers.exhaustive);
    }

    const BUDGET_OF_ONE: Budget = Budget { every: 1_000, random: 1, seed: 1 };

    #[test]
    fn rare_values_are_found() {
        let harnesses: [fn(); 6] = [
            || assert!(!kani::any::<f64>().is_nan()),
            || assert!(kani::any::<i64>() != i64::MIN),
            || assert!(kani::any::<i64>() != kani::any::<i64>()),
            || assert!(kani::any::<f64>().to_bits() != kani::any::<f64>().to_bits() + 1),
            || assert!(kani::any::<i64>().checked_add(kani::any()) != Some(kani::any())),
            || assert!((0.0..=1.0).contains(&kani::near(0.0, 1.0))),
        ];
        for harness in harnesses {
            assert!(catch_unwind(|| run(harness, BUDGET)).is_err());
        }
    }

    #[test]
    fn runs_are_repeatable() {
        let harness = || kani::cover(kani::any::<i64>() > kani::any(), "greater");
        assert_eq!(run(harness, FEW), run(harness, FEW));
    }
}
