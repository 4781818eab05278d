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
fn a_rule_is_called_as_in_the_text() {
    for rule in HardenedRule::ALL {
        assert_eq!(std::format!("{rule:?}"), rule.id().replace('-', ""));
    }
}
