//! The profiles, as sets of rules (`spec/3-stages.md#hardened-profile`).

use crate::report::{Rule, Stage};

/// A rule of the hardened profile. Source: `spec/3-stages.md#hardened-profile`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HardenedRule {
    /// Stage i pairs each gated track but a few backed ones, and closely.
    H01,
    /// Tracks that stage i could not check are no obstacle check.
    H02,
    /// Look as far as the CAV needs to stop.
    H04,
    /// No trajectory without an obstacle check.
    H05,
    /// Closed cells, unknown ones, the border of the grid.
    H06,
    /// Start, corridor and direction of a trajectory.
    H07,
    /// Make before break.
    H08,
    /// Stage v whatever else ran.
    H10,
    /// Steps and turns that can be driven.
    H11,
    /// The fail-safe rule.
    H14,
}

/// What is said of a rule: its id, witnesses, findings and stages.
type Said = (&'static str, &'static [Rule], &'static [&'static str], &'static [Stage]);

impl HardenedRule {
    /// All rules in their order. Source: `spec/3-stages.md#hardened-profile`.
    pub const ALL: [Self; 10] = [
        Self::H01,
        Self::H02,
        Self::H04,
        Self::H05,
        Self::H06,
        Self::H07,
        Self::H08,
        Self::H10,
        Self::H11,
        Self::H14,
    ];

    #[rustfmt::skip]
    const fn said(self) -> Said {
        use Rule::{FailSafe, Gap, NoAssignment, Outside, Reach, Unknown, WorkLimit};
        use Rule::{Corridor, Direction, StartHeading, StartOffset, StartPosition, StartTime};
        use Rule::{Slide, StepForward, StepLateral, StepLength, StepSpeed, StepTime, StepTurn};
        use Stage::{I, Ii, Iii, Iv, V};
        match self {
            Self::H01 => ("H-01", &[NoAssignment], &["F-01", "F-02", "F-32"], &[I]),
            Self::H02 => ("H-02", &[], &["F-18"], &[Iii]),
            Self::H04 => ("H-04", &[Gap], &["F-04", "F-05", "F-06", "F-17", "F-27"], &[Iv, V]),
            Self::H05 => ("H-05", &[], &["F-07"], &[V]),
            Self::H06 => ("H-06", &[Unknown, Outside], &["F-08", "F-21"], &[V]),
            Self::H07 => ("H-07", &[StartTime, StartPosition, StartHeading, StartOffset, Corridor, Direction], &["F-09", "F-10", "F-16", "F-36", "F-37"], &[Ii]),
            Self::H08 => ("H-08", &[], &["F-12", "F-25"], &[]),
            Self::H10 => ("H-10", &[], &["F-14", "F-15", "F-34"], &[V]),
            Self::H11 => ("H-11", &[StepTime, StepLength, StepSpeed, StepForward, StepLateral, StepTurn, Slide], &["F-10", "F-11", "F-17", "F-28", "F-29", "F-35", "F-41"], &[Ii]),
            Self::H14 => ("H-14", &[WorkLimit, Reach, FailSafe], &["F-03", "F-05", "F-06", "F-11", "F-13", "F-14", "F-15", "F-16", "F-17", "F-22", "F-23", "F-26", "F-27", "F-28", "F-29", "F-30", "F-31", "F-35", "F-36", "F-37", "F-41", "F-04", "F-38", "F-40", "F-42", "F-44", "F-46"], &[Ii, Iv]),
        }
    }

    /// As the text names it. Source: `spec/3-stages.md#hardened-profile`.
    pub const fn id(self) -> &'static str {
        self.said().0
    }

    /// The witness rules that `report` marks with it. What it changes in a comparison of the paper keeps the
    /// name that this has there. Source: `spec/3-stages.md#hardened-profile`.
    pub const fn witnesses(self) -> &'static [Rule] {
        self.said().1
    }

    /// The findings that it closes, alone or with others, then those that it closes in part. Source:
    /// `spec/3-stages.md#hardened-profile`.
    pub const fn findings(self) -> &'static [&'static str] {
        self.said().2
    }

    /// The stages that it touches. Source: `spec/3-stages.md#hardened-profile`.
    pub const fn stages(self) -> &'static [Stage] {
        self.said().3
    }

    /// Of a set, the bit of this rule.
    const fn bit(self) -> u16 {
        1_u16.wrapping_shl(self as u32)
    }
}

/// A set of rules: the published method, read as the interpretations I-nn say, with the rules H-nn that
/// are in it. Source: `spec/3-stages.md#hardened-profile`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Profile {
    /// A bit for each rule in force, then a bit for each stage that is left out.
    bits: u16,
}

impl Profile {
    /// The published method: no rule. Source: `spec/3-stages.md#hardened-profile`.
    pub const PAPER: Self = Self { bits: 0 };
    /// Every rule. Source: `spec/3-stages.md#hardened-profile`.
    pub const HARDENED: Self = Self { bits: (1 << RULES) - 1 };

    /// For studies: without one rule. Neither records nor the C interface can name such a set. Source:
    /// `spec/3-stages.md#hardened-profile`.
    pub const fn without(self, rule: HardenedRule) -> Self {
        Self { bits: self.bits & !rule.bit() }
    }

    /// For studies: without one stage of the paper, which then counts as not scheduled, and without what
    /// rules add to it. Source: `spec/3-stages.md#schedule`.
    pub const fn without_stage(self, stage: Stage) -> Self {
        Self { bits: self.bits | bit_of(stage) }
    }

    /// Whether a rule is in force. Source: `spec/3-stages.md#hardened-profile`.
    #[inline]
    pub const fn has(self, rule: HardenedRule) -> bool {
        self.bits & rule.bit() != 0
    }

    /// Whether a stage is not left out. Source: `spec/3-stages.md#schedule`.
    #[inline]
    pub const fn runs(self, stage: Stage) -> bool {
        self.bits & bit_of(stage) == 0
    }
}

/// How many rules there are: the first bit of the stages.
const RULES: u32 = HardenedRule::H14 as u32 + 1;

/// The bit of a stage that is left out.
const fn bit_of(stage: Stage) -> u16 {
    1_u16.wrapping_shl(RULES.wrapping_add(stage as u32))
}

#[cfg(test)]
mod tests;
