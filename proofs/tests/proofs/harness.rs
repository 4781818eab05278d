//! Runs every harness on the stand-in for Kani. Where a domain is finite all of it is run; else this
//! is testing, not proof, and says so.
//!
//! `HARNESS=name cargo test -p mufasa-proofs --test proofs every_harness -- --nocapture` runs those whose
//! path contains the name.

use std::collections::BTreeSet;
use std::panic::catch_unwind;

use mufasa_proofs::harness::ALL;
use mufasa_proofs::kani::{self, BUDGET, Budget, Evidence, judge_harness, run_harness};
use rayon::prelude::*;

use super::expected::expected;

#[test]
fn every_harness_holds_and_reaches_its_covers() {
    let only = std::env::var("HARNESS").unwrap_or_default();
    println!("`every`: all values of a finite domain were run. `some`: testing, not proof.");
    let mut asked = expected();
    asked.retain(|one| one.id.contains(&only));
    asked.par_iter().with_max_len(1).for_each(|expected| {
        let (_, harness) = ALL.iter().find(|(id, _)| *id == expected.id).expect("it is listed");
        let covers: BTreeSet<&str> = expected.covers.iter().map(String::as_str).collect();
        let verdict = judge_harness(*harness, &covers);
        let (kind, found) = match &verdict {
            Evidence::Every(run) => ("every", run),
            Evidence::Some(run) => ("some", run),
            Evidence::Vacuous(_) | Evidence::Refuted(_) => panic!("{}: {verdict:?}", expected.id),
        };
        println!("{}: {kind}, {} of {} runs held", expected.id, found.held, found.tried);
        println!("    {:?}", found.covers);
        assert_eq!(kind, expected.stand_in, "{}", expected.id);
    });
}

/// The engine itself: what it enumerates, rejects, counts and finds.
mod engine {
    use super::*;

    const FEW: Budget = Budget { every: 1_000, random: 2_000, seed: 1 };

    #[test]
    fn finite_domains_are_run_completely() {
        let found = run_harness(
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
        let large = run_harness(|| kani::assume(kani::any::<u8>() == kani::any::<u8>()), FEW);
        assert!(!large.exhaustive && large.tried == FEW.random && large.held > 0);
        let numbers =
            run_harness(|| assert!(kani::any::<i64>() < i64::MAX || kani::any()), BUDGET_OF_ONE);
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
            assert!(catch_unwind(|| run_harness(harness, BUDGET)).is_err());
        }
    }

    #[test]
    fn what_is_never_reached_shows_nothing() {
        let covers = |names: &[&'static str]| -> BTreeSet<&str> { names.iter().copied().collect() };
        let harness = || kani::cover(kani::any::<bool>() && kani::any(), "both");
        assert!(matches!(judge_harness(harness, &covers(&["both"])), Evidence::Every(_)));
        assert!(matches!(judge_harness(harness, &covers(&[])), Evidence::Vacuous(_)));
        assert!(matches!(
            judge_harness(harness, &covers(&["both", "other"])),
            Evidence::Vacuous(_)
        ));
        let never = || kani::cover(kani::below(2) > 1, "never");
        assert!(matches!(judge_harness(never, &covers(&["never"])), Evidence::Vacuous(_)));
        let rare = || kani::assume(kani::any::<f64>().to_bits() == 0x3ff8_1234_5678_9abc);
        assert!(matches!(judge_harness(rare, &covers(&[])), Evidence::Vacuous(_)));
        let wrong = || assert!(kani::any::<u8>() != 7, "seven");
        let refuted = judge_harness(wrong, &covers(&[]));
        assert!(matches!(&refuted, Evidence::Refuted(why) if why.contains("seven")), "{refuted:?}");
    }

    #[test]
    fn runs_are_repeatable() {
        let harness = || kani::cover(kani::any::<i64>() > kani::any(), "greater");
        assert_eq!(run_harness(harness, FEW), run_harness(harness, FEW));
    }
}
