//! The profiles (`spec/3-stages.md#hardened-profile`): the stages of the paper, and which rules H-nn are
//! in force beside them.

/// The five stages in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Track validation.
    I,
    /// Trajectory to map.
    Ii,
    /// Trajectory with tracks.
    Iii,
    /// Trajectory with detections.
    Iv,
    /// Trajectory with grid map.
    V,
}

impl Stage {
    /// All stages in the order in which they run.
    pub const ALL: [Self; 5] = [Self::I, Self::Ii, Self::Iii, Self::Iv, Self::V];
}

/// A rule of the hardened profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum HardenedRule {
    /// Stage i matches every gated track, at its place, closely.
    H01,
    /// A stage iii on a list that nothing checked is no obstacle check.
    H02,
    /// Stages iv and v look as far as the CAV needs to stop.
    H04,
    /// No trajectory without an obstacle check.
    H05,
    /// Stage v takes the closed squares of cells, and what is unknown.
    H06,
    /// The trajectory starts now and here, and keeps to the route.
    H07,
    /// Make before break.
    H08,
    /// Stage v runs whatever else ran.
    H10,
    /// A vehicle can drive the steps of the trajectory.
    H11,
    /// The fail-safe rule.
    H14,
}

impl HardenedRule {
    /// All rules in the order of the table.
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
}

/// A set of rules H-nn beside the published method, read as the interpretations I-nn say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Profile {
    /// A bit for each rule in force.
    rules: u16,
    /// A bit for each stage that is left out.
    left_out: u8,
}

impl Profile {
    /// The published method.
    pub const PAPER: Self = Self { rules: 0, left_out: 0 };

    /// The published method and all rules.
    pub const HARDENED: Self = Self { rules: (1 << HardenedRule::ALL.len()) - 1, left_out: 0 };

    /// For studies: without one rule. Neither records nor a vehicle's interface can name such a set.
    pub const fn without(self, rule: HardenedRule) -> Self {
        Self { rules: self.rules & !(1 << rule as u16), ..self }
    }

    /// For studies: without one stage of the paper, which then counts as not scheduled. With it goes
    /// what rules report as its own.
    pub const fn without_stage(self, stage: Stage) -> Self {
        Self { left_out: self.left_out | 1 << stage as u8, ..self }
    }

    /// Whether the rule is in force.
    pub const fn has(self, rule: HardenedRule) -> bool {
        self.rules & 1 << rule as u16 != 0
    }

    /// Whether the stage is there.
    pub const fn runs(self, stage: Stage) -> bool {
        self.left_out & 1 << stage as u8 == 0
    }
}
