//! Generators are worth something only near the thresholds. That half of what each draws is near a decision, and
//! that each verdict that it is for occurs, is asked where it is used (`assert_aimed`); here of each threshold of
//! H-14, and of each rule of a witness.

use std::collections::BTreeMap;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{Outcome, Reading, Rule};
use mufasa_props::conformance::name;
use mufasa_props::differential::{Generator, Tally, near_threshold, runner};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::{
    detections, fail_safe, grid, map_validation, roads, track_validation, tracks,
};
use mufasa_records::names::Words;
use proptest::strategy::{Strategy, ValueTree};

/// Draws per generator.
const DRAWS: u64 = 600;

fn measure(title: &str, generator: impl Fn(&mut Draw<'_>) -> Cycle, verdicts: &[&str]) {
    let mut runner = runner();
    let mut tally = Tally::default();
    for _ in 0..DRAWS {
        let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
        let cycle = generator(&mut Draw::new(&tape));
        tally.cases += 1;
        tally.sampled += 1;
        tally.near += u64::from(near_threshold(&cycle));
        let verdict = match check(&cycle, Reading::Exact) {
            Ok(report) => name(report.failed_stage),
            Err(_) => "error",
        };
        *tally.verdicts.entry(verdict).or_default() += 1;
    }
    println!("{title}: {tally}");
    tally.assert_aimed(verdicts);
}

#[test]
fn roads_alike_are_aimed() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        measure("roads alike", |draw| roads::alike(draw, profile), &["ii", "safe"]);
    }
}

/// Each threshold of H-14 by itself.
#[test]
fn the_fail_safe_rule_is_aimed_at() {
    for (aim, (title, _)) in fail_safe::AIMS.iter().enumerate() {
        let aimed = |draw: &mut Draw<'_>| fail_safe::aimed(draw, Profile::HARDENED, aim);
        measure(title, aimed, &["iv", "safe"]);
    }
}

/// Every rule of a witness decides some near case, so that no comparison stands outside of the
/// properties.
#[test]
fn every_rule_decides_near_a_threshold() {
    let generators: [Generator; 6] = [
        track_validation::cycle,
        map_validation::cycle,
        tracks::cycle,
        detections::cycle,
        grid::cycle,
        fail_safe::cycle,
    ];
    let mut seen: BTreeMap<Rule, u64> = BTreeMap::new();
    let mut runner = runner();
    for generator in generators {
        for _ in 0..2 * DRAWS {
            let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
            let cycle = generator(&mut Draw::new(&tape), Profile::HARDENED);
            if let Some(rule) = deciding(&cycle) {
                *seen.entry(rule).or_default() += 1;
            }
        }
    }
    println!("rules that decided near cases: {seen:?}");
    // Times are whole numbers, which no margin moves; work has none; the hardened profile asks more than theta_map.
    let others = [Rule::StartTime, Rule::StepTime, Rule::WorkLimit, Rule::ThetaMap];
    for rule in Rule::ALL {
        let count = seen.get(rule).copied().unwrap_or(0);
        assert!(count > 0 || others.contains(rule), "{rule:?} decides nothing");
    }
}

/// The rule by which the strict model rejects what the lax one accepts, at a margin of 1e-5 m.
fn deciding(cycle: &Cycle) -> Option<Rule> {
    let mut cycle = cycle.clone();
    cycle.parameters.delta = 1e-5;
    let lax = check(&cycle, Reading::Lax).ok()?;
    let strict = check(&cycle, Reading::Strict).ok()?;
    if lax.failed_stage == strict.failed_stage {
        return None;
    }
    strict.stages.into_iter().find_map(|outcome| match outcome {
        Outcome::Failed(witness) => Some(witness.rule),
        Outcome::Passed
        | Outcome::Skipped(_)
        | Outcome::NotApplicable(_)
        | Outcome::NotScheduled => None,
    })
}
