//! A whole cycle of the implementation against the exact model: soundness
//! (IMPL-01), completeness (`.2`) and failing
//! stage (`.3`), as `conformance::conforms` has them:
//! IMPL-02,
//! IMPL-03, IMPL-04. The outcomes of all stages: SCHED-14. Witnesses: SCHED-19, SCHED-20.

use std::collections::BTreeSet;

use crate::map_validation::runs_ahead;
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Outcome, Reading, Report, Stage};
use mufasa_props::differential::{agree, near_threshold};
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::{grid, whole};
use mufasa_records::names;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

#[test]
fn paper() {
    agree("cycle", Profile::PAPER, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

#[test]
fn hardened() {
    agree("cycle", Profile::HARDENED, whole::cycle, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

/// Sets of rules, with a stage left out of some: of studies, and none of a record.
#[test]
fn any_set_of_rules() {
    agree("cycle of a study", Profile::HARDENED, study, near_threshold)
        .assert_aimed(&["i", "ii", "iii", "iv", "v", "safe"]);
}

fn study(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = match draw.below(8) {
        0 => runs_ahead(draw, profile),
        1 => grid::beside_iv(draw, profile),
        _ => whole::cycle(draw, profile),
    };
    for rule in HardenedRule::ALL {
        if draw.one_in(6) {
            cycle.profile = cycle.profile.without(rule);
        }
    }
    if draw.one_in(6) {
        cycle.profile = cycle.profile.without_stage(draw.pick(&Stage::ALL));
    }
    cycle
}

/// What a set of rules rejects and the paper accepts, one of its rules says that it can reject.
#[test]
fn a_rule_lists_its_witnesses() {
    let mut seen = BTreeSet::new();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..3000 {
        let tape: Vec<u32> = (&mut rng).random_iter().take(160).collect();
        let mut cycle = study(&mut Draw::new(&tape), Profile::HARDENED);
        let set = HardenedRule::ALL.into_iter().filter(|rule| cycle.profile.has(*rule));
        let listed: BTreeSet<&str> = set.flat_map(HardenedRule::witnesses).copied().collect();
        let Ok(Some(found)) = check(&cycle, Reading::Exact).map(failure) else { continue };
        for rule in HardenedRule::ALL {
            cycle.profile = cycle.profile.without(rule);
        }
        if check(&cycle, Reading::Exact).is_ok_and(|report| report.failed_stage.is_none()) {
            assert!(listed.contains(found.as_str()), "{found}: {cycle:?}");
            seen.insert(found);
        }
    }
    println!("{seen:?}");
    assert!(seen.len() >= 15, "{seen:?}");
}

/// What failed, in the words of the list.
fn failure(report: Report) -> Option<String> {
    let stage = names::failed_stage(report.failed_stage?);
    let witness = report.stages.into_iter().find_map(|outcome| match outcome {
        Outcome::Failed(witness) => Some(names::rule(witness.rule)),
        Outcome::Passed
        | Outcome::Skipped(_)
        | Outcome::NotApplicable(_)
        | Outcome::NotScheduled => None,
    });
    Some([Some(stage), witness].into_iter().flatten().collect::<Vec<_>>().join(" "))
}
