//! The one harness of the differential properties: draws cycles, compares the implementation with
//! the model, and counts what was seen, so that a property of nothing does not pass.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Outcome, Reading, Report, Rule, Witness};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

use crate::bridge::check_impl;
use crate::conformance::{Answer, conforms, name};
use crate::strategy::draw::{Draw, tape};

/// Cases per property unless `MUFASA_CASES` says otherwise.
const CASES: u32 = 20_000;

/// Every so many cases the distance to a threshold is measured, which costs two more runs of the
/// model.
const SAMPLE: u64 = 16;

/// Half width of "near a threshold", m: strict and lax model differ at this margin.
const NEAR_M: f64 = 1e-5;

/// A generator of cycles in a profile.
pub type Generator = fn(&mut Draw<'_>, Profile) -> Cycle;

/// What a property has seen.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Cases by the exact model's failing stage, by `safe` or by `error`.
    pub verdicts: BTreeMap<&'static str, u64>,
    /// Cases in which strict and exact model name different stages.
    pub undecided: u64,
    /// Cases whose distance to a threshold was measured.
    pub sampled: u64,
    /// Those of them that were near.
    pub near: u64,
    /// All cases.
    pub cases: u64,
    /// Whether one of them failed.
    pub failed: bool,
}

impl Tally {
    /// How often the exact model came to a verdict: the name of a stage, `safe` or `error`.
    pub fn count(&self, verdict: &str) -> u64 {
        self.verdicts.get(verdict).copied().unwrap_or(0)
    }

    /// Share of near cases in percent.
    pub fn near_percent(&self) -> u64 {
        100 * self.near / self.sampled.max(1)
    }

    /// Half of the cases near a threshold, and each of these verdicts in at least one case of a
    /// hundred. Fewer cases than the default are not asked: their shares are chance.
    ///
    /// # Panics
    /// When it is not so.
    pub fn assert_aimed(&self, verdicts: &[&str]) {
        if !are_enough() {
            return;
        }
        assert!(2 * self.near >= self.sampled, "only {}% near a threshold", self.near_percent());
        for verdict in verdicts {
            let count = self.count(verdict);
            assert!(100 * count >= self.cases, "{verdict}: only {count} of {} cases", self.cases);
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} cases, {}% near a threshold, ", self.cases, self.near_percent())?;
        write!(f, "{} between strict and exact, verdicts {:?}", self.undecided, self.verdicts)
    }
}

/// Cases per property: `MUFASA_CASES`, or 20,000.
pub fn cases() -> u32 {
    std::env::var("MUFASA_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(CASES)
}

/// Whether there are so many that what they cover is asked for.
pub fn are_enough() -> bool {
    cases() >= CASES
}

/// A runner with as many cases as `cases` says; the same draws in every run unless `MUFASA_SEED`
/// asks for others.
pub fn runner() -> TestRunner {
    runner_of(cases())
}

fn runner_of(cases: u32) -> TestRunner {
    let seed: u64 =
        std::env::var("MUFASA_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let config = Config {
        cases,
        failure_persistence: None,
        max_shrink_iters: Config::default().max_shrink_iters.min(20_000),
        ..Config::default()
    };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes))
}

/// A property of one cycle, given the answers of the exact and of the strict model; what is wrong
/// in words.
pub type Property = fn(&Cycle, &Answer, &Answer) -> Result<(), String>;

/// Runs `conforming` over cycles of a generator.
///
/// # Panics
/// With the smallest cycle found, when it does not.
pub fn agree(
    title: &str,
    profile: Profile,
    generator: Generator,
    is_near: fn(&Cycle) -> bool,
) -> Tally {
    hold(cases(), title, profile, generator, is_near, conforming)
}

/// Runs a property over so many cycles of a generator.
///
/// # Panics
/// With the smallest cycle found, when it does not hold.
pub fn hold(
    cases: u32,
    title: &str,
    profile: Profile,
    generator: Generator,
    is_near: fn(&Cycle) -> bool,
    property: Property,
) -> Tally {
    let tally = RefCell::new(Tally::default());
    let cycles = tape().prop_map(|tape| generator(&mut Draw::new(&tape), profile));
    let result = runner_of(cases).run(&cycles, |cycle| {
        let strict = check(&cycle, Reading::Strict);
        // What the strict model accepts the exact one accepts with the same outcomes: `props/tests/stages/readings.rs` asks
        // it of three generators, and each property of one case of so many.
        let is_safe = strict.as_ref().is_ok_and(|report| report.failed_stage.is_none());
        let is_asked = tally.borrow().cases.is_multiple_of(SAMPLE);
        let exact =
            if is_safe && !is_asked { strict.clone() } else { check(&cycle, Reading::Exact) };
        let held = property(&cycle, &exact, &strict);
        let mut tally = tally.borrow_mut();
        // What shrinking tries after a failure is not counted.
        if !tally.failed {
            tally.failed = held.is_err();
            count(&mut tally, &cycle, &exact, &strict, is_near);
        }
        held.map_err(TestCaseError::fail)
    });
    let tally = tally.into_inner();
    println!("{title}, {profile:?}: {tally}");
    if let Err(error) = result {
        panic!("{title}, {profile:?}: {error}");
    }
    tally
}

/// Conformance of the implementation in one cycle; equal outcomes of every stage wherever strict and exact model fail in the
/// same stage; and their witness wherever both name the same one (`spec/3-stages.md#schedule`), except where the work
/// limit may come first. The numbers that were compared may be rounded.
pub fn conforming(cycle: &Cycle, exact: &Answer, strict: &Answer) -> Result<(), String> {
    let implementation = check_impl(cycle);
    let told = |what: &dyn fmt::Display| told(what, exact, strict, &implementation);
    conforms(exact, strict, &implementation).map_err(|disagreement| told(&disagreement))?;
    if let (Ok(exact), Ok(strict), Ok(implementation)) = (exact, strict, &implementation)
        && exact.failed_stage == strict.failed_stage
        && !exact.stages.iter().zip(&implementation.stages).all(is_same)
    {
        return Err(told(&"the outcomes of the stages differ"));
    }
    if let (Ok(exact), Ok(strict), Ok(implementation)) = (exact, strict, &implementation)
        && has_other_witness(cycle, exact, strict, implementation)
    {
        return Err(told(&"the witnesses differ"));
    }
    Ok(())
}

fn has_other_witness(
    cycle: &Cycle,
    exact: &Report,
    strict: &Report,
    implementation: &Report,
) -> bool {
    let outcomes = exact.stages.iter().zip(&strict.stages).zip(&implementation.stages);
    outcomes.into_iter().any(|outcome| {
        let ((Outcome::Failed(one), Outcome::Failed(two)), Outcome::Failed(found)) = outcome else {
            return false;
        };
        // In a cycle that fails anyway an implementation may count more steps than the model, and stop there.
        let has_stopped = matches!(one.rule, Rule::FailSafe | Rule::MeanCost)
            && found.rule == Rule::WorkLimit
            && found.compared[0] > found.compared[1];
        place(one) == place(two)
            && close(cycle, one, two)
            && !has_stopped
            && (place(one) != place(found) || !close(cycle, one, found))
    })
}

/// A disagreement with the three answers.
fn told(what: &dyn fmt::Display, exact: &Answer, strict: &Answer, found: &Answer) -> String {
    format!("{what}\nexact {exact:?}\nstrict {strict:?}\nimplementation {found:?}")
}

/// Whether strict and lax model differ at a margin of 1e-5 m.
pub fn near_threshold(cycle: &Cycle) -> bool {
    let mut cycle = cycle.clone();
    cycle.parameters.delta = NEAR_M;
    let stage = |reading| check(&cycle, reading).map(|report| report.failed_stage);
    stage(Reading::Strict) != stage(Reading::Lax)
}

fn count(
    tally: &mut Tally,
    cycle: &Cycle,
    exact: &Answer,
    strict: &Answer,
    is_near: fn(&Cycle) -> bool,
) {
    let verdict = |answer: &Answer| match answer {
        Ok(report) => name(report.failed_stage),
        Err(_) => "error",
    };
    if tally.cases.is_multiple_of(SAMPLE) {
        tally.sampled += 1;
        tally.near += u64::from(is_near(cycle));
    }
    tally.cases += 1;
    tally.undecided += u64::from(verdict(exact) != verdict(strict));
    *tally.verdicts.entry(verdict(exact)).or_default() += 1;
}

/// The same outcome, witnesses aside.
fn is_same((one, other): (&Outcome, &Outcome)) -> bool {
    matches!((one, other), (Outcome::Failed(_), Outcome::Failed(_))) || one == other
}

/// A witness without the numbers that were compared, and without the nearest segment where the
/// distance to it decides: of two that are equally near up to rounding either may be named.
fn place(witness: &Witness) -> impl PartialEq + use<> {
    let Witness { rule, point, track, detection, item, age_ns, segment, disk, cell, compared: _ } =
        *witness;
    let by_distance = matches!(rule, Rule::ThetaMap | Rule::Corridor);
    let segment = if by_distance { None } else { segment };
    (rule, point, track, detection, item, age_ns, segment, disk, cell)
}

/// The numbers that were compared, the same except for rounding. Of two cells on whose border the centre of a disk lies either
/// may be measured (S5-05).
fn close(cycle: &Cycle, one: &Witness, other: &Witness) -> bool {
    let resolution = cycle.grid.as_ref().map_or(0.0, |grid| grid.resolution);
    if one.rule == Rule::Occupied
        && !cycle.profile.has(HardenedRule::H06)
        && (one.compared[0] - other.compared[0]).abs() <= 1.5 * resolution
        && other.compared[0] <= other.compared[1] + 1e-6
    {
        return (one.compared[1] - other.compared[1]).abs() <= 1e-6 * (1.0 + one.compared[1]);
    }
    let pairs = one.compared.iter().zip(other.compared);
    pairs.into_iter().all(|(one, other)| (one - other).abs() <= 1e-6 * (1.0 + one.abs()))
}
