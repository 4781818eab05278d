use std::collections::BTreeSet;
use std::string::String;

use crate::input::profile::{HardenedRule, Profile};
use crate::report::Stage;

#[test]
fn the_paper_has_no_rule_and_the_hardened_profile_each() {
    for rule in HardenedRule::ALL {
        assert!(!Profile::PAPER.has(rule) && Profile::HARDENED.has(rule));
    }
    for stage in Stage::ALL {
        assert!(Profile::PAPER.runs(stage) && Profile::HARDENED.runs(stage));
    }
}

#[test]
fn a_profile_without_a_rule_or_a_stage_has_all_others() {
    for left_out in HardenedRule::ALL {
        let profile = Profile::HARDENED.without(left_out);
        for rule in HardenedRule::ALL {
            assert_eq!(profile.has(rule), rule != left_out);
        }
        assert_eq!(profile.without(left_out), profile);
        assert!(Stage::ALL.iter().all(|&stage| profile.runs(stage)));
    }
    for left_out in Stage::ALL {
        let profile = Profile::HARDENED.without_stage(left_out);
        for stage in Stage::ALL {
            assert_eq!(profile.runs(stage), stage != left_out);
        }
        assert_eq!(profile.without_stage(left_out), profile);
        assert!(HardenedRule::ALL.iter().all(|&rule| profile.has(rule)));
    }
    let none = HardenedRule::ALL.into_iter().fold(Profile::HARDENED, Profile::without);
    assert_eq!(none, Profile::PAPER);
}

#[test]
fn ids_of_rules_are_distinct_and_their_lists_have_nothing_twice() {
    let ids: BTreeSet<_> = HardenedRule::ALL.iter().map(|rule| rule.id()).collect();
    assert_eq!(ids.len(), HardenedRule::ALL.len());
    for rule in HardenedRule::ALL {
        assert_eq!(std::format!("{rule:?}"), rule.id().replace('-', ""));
        let findings: BTreeSet<_> = rule.findings().iter().collect();
        assert!(findings.len() == rule.findings().len() && !findings.is_empty());
        assert!(rule.witnesses().is_sorted() && rule.stages().is_sorted());
    }
}

/// What the documentation of `report::Rule` says of each: `H-nn` for each rule that can produce it.
#[test]
fn each_witness_rule_is_of_the_rules_that_its_documentation_names() {
    let source = include_str!("../../report.rs");
    let (_, from) = source.split_once("pub enum Rule {").unwrap_or_default();
    let (variants, _) = from.split_once("\n}").unwrap_or_default();
    let (mut said, mut seen) = (String::new(), 0);
    for line in variants.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("///") {
            said.push_str(text);
            continue;
        }
        let Some(name) = line.strip_suffix(',') else { continue };
        for rule in HardenedRule::ALL {
            let produces = rule.witnesses().iter().any(|it| std::format!("{it:?}") == name);
            assert_eq!(produces, said.contains(rule.id()), "{name}, {}", rule.id());
        }
        said.clear();
        seen += 1;
    }
    assert_eq!(seen, 25);
}
