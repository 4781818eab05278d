//! The profiles, as sets of rules (`spec/hardened/README.md`).

use crate::report::Stage;

macro_rules! rules {
    ($($(#[doc = $what:literal])* $name:ident = $id:literal;)*) => {
        /// A rule of the hardened profile. Source: `spec/hardened/README.md`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum HardenedRule {
            $($(#[doc = $what])* $name,)*
        }

        impl HardenedRule {
            /// All rules in their order. Source: `spec/hardened/README.md`.
            pub const ALL: [Self; [$($id),*].len()] = [$(Self::$name,)*];

            /// As the text names it. Source: `spec/hardened/README.md`.
            pub const fn id(self) -> &'static str {
                match self {
                    $(Self::$name => $id,)*
                }
            }
        }
    };
}

// The list: nothing else names all rules.
rules! {
    /// Stage i pairs each gated track but a few backed ones, and closely.
    H01 = "H-01";
    /// Tracks that stage i could not check are no obstacle check.
    H02 = "H-02";
    /// Look as far as the CAV needs to stop.
    H04 = "H-04";
    /// No trajectory without an obstacle check.
    H05 = "H-05";
    /// Closed cells, unknown ones, the border of the grid.
    H06 = "H-06";
    /// Start, corridor and direction of a trajectory.
    H07 = "H-07";
    /// Make before break.
    H08 = "H-08";
    /// Stage v whatever else ran.
    H10 = "H-10";
    /// Steps and turns that can be driven.
    H11 = "H-11";
    /// The fail-safe rule.
    H14 = "H-14";
}

impl HardenedRule {
    /// Of a set, the bit of this rule.
    const fn bit(self) -> u16 {
        1_u16.wrapping_shl(self as u32)
    }
}

/// A set of rules: the published method, read as the interpretations I-nn say, with the rules H-nn that
/// are in it. Source: `spec/hardened/README.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Profile {
    /// A bit for each rule in force, then a bit for each stage that is left out.
    bits: u16,
}

impl Profile {
    /// The published method: no rule. Source: `spec/hardened/README.md`.
    pub const PAPER: Self = Self { bits: 0 };
    /// Every rule. Source: `spec/hardened/README.md`.
    pub const HARDENED: Self = Self { bits: (1 << RULES) - 1 };

    /// For studies: without one rule. Neither records nor the C interface can name such a set. Source:
    /// `spec/hardened/README.md`.
    pub const fn without(self, rule: HardenedRule) -> Self {
        Self { bits: self.bits & !rule.bit() }
    }

    /// For studies: without one stage of the paper, which then counts as not scheduled, and without what
    /// rules add to it. Source: `spec/3-stages.md#schedule`.
    pub const fn without_stage(self, stage: Stage) -> Self {
        Self { bits: self.bits | bit_of(stage) }
    }

    /// Whether a rule is in force. Source: `spec/hardened/README.md`.
    #[inline]
    pub const fn has(self, rule: HardenedRule) -> bool {
        self.bits & rule.bit() != 0
    }

    /// Whether a rule asks what the CAV saw itself, hence for earlier detections: H-01 which tracks are
    /// backed, H-14 what has moved. Source: SEEN-08.
    #[inline]
    pub const fn looks_back(self) -> bool {
        self.has(HardenedRule::H01) || self.has(HardenedRule::H14)
    }

    /// Whether a stage is not left out. Source: `spec/3-stages.md#schedule`.
    #[inline]
    pub const fn runs(self, stage: Stage) -> bool {
        self.bits & bit_of(stage) == 0
    }
}

/// How many rules there are: the first bit of the stages.
#[allow(clippy::cast_possible_truncation, reason = "a dozen")]
const RULES: u32 = HardenedRule::ALL.len() as u32;

/// The bit of a stage that is left out.
const fn bit_of(stage: Stage) -> u16 {
    1_u16.wrapping_shl(RULES.wrapping_add(stage as u32))
}

#[cfg(test)]
mod tests;
