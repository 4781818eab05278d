//! Generators are worth something only near the thresholds: at least half of the draws of every
//! generator lie within 1e-5 of a decision, and every verdict that a generator is for occurs.

use std::collections::BTreeMap;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::{Outcome, Reading, Rule};
use mufasa_props::conformance::name;
use mufasa_props::differential::{Generator, Tally, near_threshold, runner};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::{
    detections, fail_safe, grid, input, map_validation, roads, schedule, track_validation, tracks,
    whole,
};
use proptest::strategy::{Strategy, ValueTree};

/// Draws per generator and profile.
const DRAWS: u64 = 600;

fn measure(title: &str, generator: Generator, is_near: fn(&Cycle) -> bool, verdicts: &[&str]) {
    measure_in(&[Profile::PAPER, Profile::HARDENED], title, generator, is_near, verdicts);
}

fn measure_in(
    profiles: &[Profile],
    title: &str,
    generator: impl Fn(&mut Draw<'_>, Profile) -> Cycle,
    is_near: fn(&Cycle) -> bool,
    verdicts: &[&str],
) {
    for &profile in profiles {
        let mut runner = runner();
        let mut tally = Tally::default();
        let start = std::time::Instant::now();
        for _ in 0..DRAWS {
            let tape = tape().new_tree(&mut runner).expect("a tape is always drawn").current();
            let cycle = generator(&mut Draw::new(&tape), profile);
            tally.cases += 1;
            tally.sampled += 1;
            tally.near += u64::from(is_near(&cycle));
            let verdict = |reading| match check(&cycle, reading) {
                Ok(report) => name(report.failed_stage),
                Err(_) => "error",
            };
            tally.undecided += u64::from(verdict(Reading::Exact) != verdict(Reading::Strict));
            let verdict = verdict(Reading::Exact);
            *tally.verdicts.entry(verdict).or_default() += 1;
        }
        println!("{title}, {profile:?}: {tally} in {:?}", start.elapsed());
        tally.assert_aimed(verdicts);
    }
}

#[test]
fn track_validation_is_aimed() {
    measure("stage i", track_validation::cycle, near_threshold, &["i", "safe"]);
}

#[test]
fn map_validation_is_aimed() {
    measure("stage ii", map_validation::cycle, near_threshold, &["ii", "safe"]);
}

#[test]
fn roads_are_aimed() {
    measure("roads", roads::cycle, near_threshold, &["ii", "safe"]);
    measure("roads alike", roads::alike, near_threshold, &["ii", "safe"]);
}

#[test]
fn tracks_are_aimed() {
    measure("stage iii", tracks::cycle, near_threshold, &["iii", "safe"]);
    measure("stage iii before its list", tracks::before, near_threshold, &["iii", "safe"]);
}

#[test]
fn detections_are_aimed() {
    measure("stage iv", detections::cycle, near_threshold, &["iv", "safe"]);
}

#[test]
fn grids_are_aimed() {
    measure("stage v", grid::cycle, near_threshold, &["v", "safe"]);
}

#[test]
fn schedules_are_aimed() {
    measure("schedule", schedule::cycle, schedule::is_near, &["i", "ii", "iv", "v", "safe"]);
}

#[test]
fn inputs_are_aimed() {
    measure("input", input::cycle, input::is_near, &["error", "input", "safe"]);
}

#[test]
fn whole_cycles_are_aimed() {
    measure("cycle", whole::cycle, near_threshold, &["i", "ii", "iii", "iv", "v", "safe"]);
}

/// Each threshold of H-14 by itself.
#[test]
fn the_fail_safe_rule_is_aimed_at() {
    let hardened = [Profile::HARDENED];
    measure_in(&hardened, "H-14", fail_safe::cycle, near_threshold, &["iv", "safe"]);
    for (aim, (title, _)) in fail_safe::AIMS.iter().enumerate() {
        let aimed = |draw: &mut Draw<'_>, profile| fail_safe::aimed(draw, profile, aim);
        measure_in(&hardened, title, aimed, near_threshold, &["iv", "safe"]);
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
    let timed = [Rule::StartTime, Rule::StepTime];
    for rule in RULES {
        let count = seen.get(&rule).copied().unwrap_or(0);
        assert!(count > 0 || timed.contains(&rule), "{rule:?} decides nothing");
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

const RULES: [Rule; 23] = [
    Rule::Ambiguous,
    Rule::MeanCost,
    Rule::NoAssignment,
    Rule::StartTime,
    Rule::StartPosition,
    Rule::StartHeading,
    Rule::StartOffset,
    Rule::Corridor,
    Rule::Direction,
    Rule::StepTime,
    Rule::StepLength,
    Rule::StepSpeed,
    Rule::StepForward,
    Rule::StepLateral,
    Rule::StepTurn,
    Rule::Slide,
    Rule::Reach,
    Rule::Gap,
    Rule::Collision,
    Rule::FailSafe,
    Rule::Occupied,
    Rule::Unknown,
    Rule::Outside,
];
