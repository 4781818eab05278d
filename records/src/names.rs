//! The words that records and answers use (`spec/5-interfaces.md`, `spec/3-stages.md#schedule`),
//! each of them once.

use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::messages::Dropped;
use mufasa_model::report::{FailedStage, Input, Reason, Rule, Stage};
use mufasa_model::services::configuration::{Configuration, Group};
use mufasa_model::services::orchestrator::Rule as PlacementRule;

/// Values that records and answers call by words.
pub trait Words: Copy + 'static {
    /// Their name in the schema.
    const NAME: &'static str;
    /// What they are.
    const DESCRIPTION: &'static str;
    /// All of them.
    const ALL: &'static [Self];

    /// The word of this one.
    fn word(self) -> &'static str;
}

/// The kinds of records.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A cycle.
    Cycle,
    /// An offloading trace.
    Offloading,
    /// A composition.
    Composition,
    /// A sequence of the monitor.
    Monitor,
}

macro_rules! words {
    ($(
        #[doc = $description:literal]
        $function:ident($type:ty as $name:literal $(, else $other:literal)?) {
            $($first:tt $(:: $rest:ident)? $(($($inner:tt)*))? => $word:literal,)*
        }
    )*) => {$(
        #[doc = $description]
        pub const fn $function(value: $type) -> &'static str {
            match value {
                $($first $(:: $rest)? $(($($inner)*))? => $word,)*
                $(_ => $other,)?
            }
        }

        impl Words for $type {
            const NAME: &'static str = $name;
            const DESCRIPTION: &'static str = $description.trim_ascii();
            const ALL: &'static [Self] = &[$($first $(:: $rest)? $(($($inner)*))?),*];

            fn word(self) -> &'static str {
                $function(self)
            }
        }
    )*};
}

words! {
    /// What a line asks.
    kind(Kind as "Kind") {
        Kind::Cycle => "cycle",
        Kind::Offloading => "offloading",
        Kind::Composition => "composition",
        Kind::Monitor => "monitor",
    }

    /// Which rules apply.
    profile(Profile as "Profile", else "study") {
        Profile::PAPER => "paper",
        Profile::HARDENED => "hardened",
    }

    /// Which groups are remote.
    configuration(Configuration as "Configuration") {
        Configuration::Local => "Local",
        Configuration::MotRemote => "MotRemote",
        Configuration::AllRemote => "AllRemote",
        Configuration::PlanRemote => "PlanRemote",
    }

    /// Verdict of a cycle: safe where no stage failed.
    verdict(bool as "Verdict") {
        true => "safe",
        false => "unsafe",
    }

    /// One of the five stages.
    stage(Stage as "Stage") {
        Stage::I => "i",
        Stage::Ii => "ii",
        Stage::Iii => "iii",
        Stage::Iv => "iv",
        Stage::V => "v",
    }

    /// What made a cycle unsafe: invalid remote data, a stage, or no check for obstacles (H-05).
    failed_stage(FailedStage as "FailedStage") {
        FailedStage::Input => "input",
        FailedStage::Stage(Stage::I) => "i",
        FailedStage::Stage(Stage::Ii) => "ii",
        FailedStage::Stage(Stage::Iii) => "iii",
        FailedStage::Stage(Stage::Iv) => "iv",
        FailedStage::Stage(Stage::V) => "v",
        FailedStage::NoObstacleCheck => "no_obstacle_check",
    }

    /// The key of an input in the record.
    input(Input as "Missing") {
        Input::Trajectory => "trajectory",
        Input::Tracks => "tracks",
        Input::Detections => "detections",
        Input::Grid => "grid",
    }

    /// Why a stage did not run.
    reason(Reason as "Reason") {
        Reason::AfterFailure => "after_failure",
        Reason::OtherStageRan => "other_stage_ran",
        Reason::NoCurrent(Input::Trajectory) => "no_current_trajectory",
        Reason::NoCurrent(Input::Tracks) => "no_current_tracks",
        Reason::NoCurrent(Input::Detections) => "no_current_detections",
        Reason::NoCurrent(Input::Grid) => "no_current_grid",
    }

    /// A group of services.
    group(Group as "Group") {
        Group::Mot => "mot",
        Group::Plan => "plan",
    }

    /// Why the monitor dropped an element.
    dropped(Dropped as "Dropped") {
        Dropped::OtherSession => "other_session",
        Dropped::DoesNotFit => "does_not_fit",
        Dropped::Stale => "stale",
        Dropped::Starved => "starved",
        Dropped::Late => "late",
        Dropped::Repeated => "repeated",
        Dropped::Older => "older",
    }

    /// The rule of a composition that cannot be kept.
    placement_rule(PlacementRule as "PlacementRule") {
        PlacementRule::SameStation => "same_station",
        PlacementRule::LocalOnly => "local_only",
        PlacementRule::Acyclic => "acyclic",
    }
}

macro_rules! of_witnesses {
    ($($(#[$doc:meta])* $name:ident = $word:literal;)*) => { words! {
        /// The rule of a witness, in the order of spec/3-stages.md.
        rule(Rule as "Rule") {
            $(Rule::$name => $word,)*
        }
    } };
}

mufasa_model::witness_rules!(of_witnesses);

#[cfg(test)]
mod tests {
    use mufasa_model::input::profile::HardenedRule;

    use super::*;

    #[test]
    fn rules_name_stages_and_witnesses_by_their_words() {
        for witness in HardenedRule::ALL.into_iter().flat_map(HardenedRule::witnesses) {
            let (place, kind) = witness.split_once(' ').unwrap_or((witness, ""));
            let known = FailedStage::ALL.iter().any(|it| failed_stage(*it) == place);
            assert!(
                known && (kind.is_empty() || Rule::ALL.iter().any(|it| rule(*it) == kind)),
                "{witness}"
            );
        }
    }
}
