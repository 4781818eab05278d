//! `spec/hardened/README.md`: the rules, and sets of them.

use mufasa_model::input::cycle::Profile;
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::Stage;

use crate::base::*;

const SPEC: &str = include_str!("../../../spec/hardened/README.md");

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

/// The rows of the table are the rules.
#[test]
fn the_model_knows_the_rules_of_the_table() {
    let rows = SPEC.lines().filter_map(|line| line.strip_prefix("| [H-"));
    let ids: Vec<String> = rows.map(|row| format!("H-{}", &row[..2])).collect();
    assert_eq!(HardenedRule::ALL.map(HardenedRule::id).to_vec(), ids);
}
