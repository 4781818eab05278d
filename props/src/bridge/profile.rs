//! Profiles of the model in the implementation's type and back: the same rules and stages.

use mufasa::input::profile as twin;
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::report::Stage;

use super::verdict::stage_to_impl;

/// The profile in the implementation's type.
pub fn profile_to_impl(profile: Profile) -> twin::Profile {
    let rules = HardenedRule::ALL.into_iter().filter(|it| !profile.has(*it));
    let set = rules.map(rule_to_impl).fold(twin::Profile::HARDENED, twin::Profile::without);
    let stages = Stage::ALL.into_iter().filter(|it| !profile.runs(*it));
    stages.map(stage_to_impl).fold(set, twin::Profile::without_stage)
}

/// The profile in the model's type.
pub fn profile_from_impl(profile: twin::Profile) -> Profile {
    let rules = HardenedRule::ALL.into_iter().filter(|it| !profile.has(rule_to_impl(*it)));
    let set = rules.fold(Profile::HARDENED, Profile::without);
    let stages = Stage::ALL.into_iter().filter(|it| !profile.runs(stage_to_impl(*it)));
    stages.fold(set, Profile::without_stage)
}

macro_rules! same_rules {
    ($($(#[$doc:meta])* $name:ident = $id:literal witnesses $witnesses:tt;)*) => { same_variants! {
        /// A rule in the implementation's type.
        pub fn rule_to_impl(HardenedRule) -> twin::HardenedRule { $($name,)* }
    } };
}

mufasa_model::hardened_rules!(same_rules);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_of_rules_and_stages_comes_back_as_it_was() {
        let mut sets = vec![Profile::HARDENED];
        for rule in HardenedRule::ALL {
            sets.extend(sets.clone().into_iter().map(|it| it.without(rule)));
        }
        assert_eq!((sets.len(), sets.last()), (1024, Some(&Profile::PAPER)));
        for (set, stage) in sets.into_iter().zip(Stage::ALL.into_iter().cycle()) {
            for set in [set, set.without_stage(stage)] {
                assert_eq!(profile_from_impl(profile_to_impl(set)), set);
            }
        }
        assert_eq!(profile_to_impl(Profile::HARDENED), twin::Profile::HARDENED);
        assert_eq!(profile_to_impl(Profile::PAPER), twin::Profile::PAPER);
    }
}
