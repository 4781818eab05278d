//! `spec/3-stages.md#hardened-profile`: the rules as data, and sets of them.

use std::collections::BTreeSet;

use mufasa_model::input::cycle::{Lead, Profile};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::{Outcome, Rule, Stage};
use mufasa_model::stages::readings;

use crate::base::*;

const SPEC: &str = include_str!("../../../spec/3-stages.md");
const REPORT: &str = include_str!("../../src/report.rs");

#[test]
fn the_model_has_no_rule_in_paper_and_all_in_hardened() {
    for rule in HardenedRule::ALL {
        assert!(!Profile::PAPER.has(rule) && Profile::HARDENED.has(rule), "{rule:?}");
    }
    for stage in Stage::ALL {
        assert!(PROFILES.iter().all(|profile| profile.runs(stage)), "{stage:?}");
    }
}

#[test]
fn the_model_leaves_out_exactly_one_rule_or_stage() {
    for without in HardenedRule::ALL {
        let profile = Profile::HARDENED.without(without);
        let left = HardenedRule::ALL.into_iter().filter(|rule| !profile.has(*rule));
        assert_eq!(left.collect::<Vec<_>>(), [without]);
        assert_eq!(profile.without(without), profile);
        assert!(Stage::ALL.iter().all(|stage| profile.runs(*stage)));
    }
    for without in Stage::ALL {
        let profile = Profile::HARDENED.without_stage(without);
        let left = Stage::ALL.into_iter().filter(|stage| !profile.runs(*stage));
        assert_eq!(left.collect::<Vec<_>>(), [without]);
        assert!(HardenedRule::ALL.iter().all(|rule| profile.has(*rule)));
    }
}

/// `F-13 to F-15` names three.
fn findings(cell: &str) -> Vec<String> {
    let mut found: Vec<usize> = Vec::new();
    for (at, _) in cell.match_indices("F-") {
        let number = cell[at + 2..at + 4].parse().expect("two digits");
        let first = if cell[..at].ends_with(" to ") { found[found.len() - 1] + 1 } else { number };
        found.extend(first..=number);
    }
    found.iter().map(|number| format!("F-{number:02}")).collect()
}

/// The rows of the table are the rules, with what they close.
#[test]
fn the_model_knows_the_rules_of_the_table() {
    let rows = SPEC.lines().filter(|line| line.starts_with("| H-"));
    let rows: Vec<Vec<&str>> = rows.map(|line| line.split(" | ").collect()).collect();
    let ids: Vec<&str> = rows.iter().map(|row| row[0].trim_start_matches("| ")).collect();
    assert_eq!(HardenedRule::ALL.map(HardenedRule::id).to_vec(), ids);
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), HardenedRule::ALL.len());
    for (row, rule) in rows.iter().zip(HardenedRule::ALL) {
        assert_eq!(rule.findings(), findings(row[row.len() - 1]), "{rule:?}");
    }
}

/// Those whose comment names a rule H-nn belong to it and to no other, and no others belong to any.
#[test]
fn the_model_gives_each_witness_rule_to_the_rule_that_marks_it() {
    let (_, rules) = REPORT.split_once("pub enum Rule {").expect("the enum");
    let (rules, _) = rules.split_once("\n}").expect("its end");
    let mut marked = Vec::new();
    let mut comment = String::new();
    for line in rules.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("///") {
            comment.push_str(text);
            continue;
        }
        let of = HardenedRule::ALL.into_iter().filter(|it| comment.contains(it.id()));
        marked.extend(of.map(|rule| (line.trim_end_matches(',').to_owned(), rule)));
        comment.clear();
    }
    let named = |rule: HardenedRule| {
        rule.witnesses().iter().map(move |witness| (format!("{witness:?}"), rule))
    };
    let named: BTreeSet<_> = HardenedRule::ALL.into_iter().flat_map(named).collect();
    let witnesses: BTreeSet<_> = named.iter().map(|(witness, _)| witness).collect();
    assert_eq!(witnesses.len(), named.len(), "a witness rule of two rules");
    assert_eq!(named, marked.into_iter().collect());
    assert!(named.contains(&("NoAssignment".to_owned(), HardenedRule::H01)));
    assert!(HardenedRule::H14.witnesses().contains(&Rule::FailSafe));
}

/// Every set of rules accepts the cycle that is safe in both profiles; every one, without one of the
/// stages, decides one that is not.
#[test]
fn the_model_runs_with_every_set_of_rules() {
    let sets = 1u32 << HardenedRule::ALL.len();
    let mut unsafe_cycles = 0;
    for set in 0..sets {
        let left_out = HardenedRule::ALL.into_iter().filter(|rule| set >> *rule as u32 & 1 == 1);
        let profile = left_out.fold(Profile::HARDENED, Profile::without);
        for configuration in REMOTE {
            assert_eq!(
                failed(&base(profile, configuration)),
                None,
                "{profile:?} {configuration:?}"
            );
            let without = Stage::ALL[set as usize % 5];
            let mut cycle = base(profile.without_stage(without), configuration);
            cycle.tracks = cycle.tracks.filter(|_| set % 3 > 0);
            cycle.detections = cycle.detections.filter(|_| set % 7 > 2);
            cycle.lead = Some(Lead { stamp_ns: NOW, gap: 5.0, speed: 0.0 });
            for report in readings(&cycle).expect("local input is valid") {
                assert_eq!(report.stages[without as usize], Outcome::NotScheduled);
                unsafe_cycles += u32::from(report.failed_stage.is_some());
            }
        }
    }
    assert!((sets..7 * sets).contains(&unsafe_cycles), "{unsafe_cycles}");
}
