//! The profiles (`spec/hardened/README.md`): the stages of the paper, and which rules H-nn are
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

/// The list of the rules of the hardened profile, and the only place where they stand on this side:
/// `hardened_rules!(callback)` expands to `callback! { .. }` with one entry for each, in the order of
/// the table: `/// documentation` `name = id witnesses [..];`, a witness being the stage that fails and
/// the word of [`crate::report::Rule`], as `scripts/availability` reads them, too.
#[macro_export]
macro_rules! hardened_rules {
    ($callback:ident) => {
        $callback! {
            /// Stage i matches every gated track, at its place, closely.
            H01 = "H-01" witnesses ["i mean_cost", "i no_assignment", "i work_limit"];
            /// A stage iii on a list that nothing checked is no obstacle check.
            H02 = "H-02" witnesses ["no_obstacle_check"];
            /// Stages iv and v look as far as the CAV needs to stop.
            H04 = "H-04" witnesses ["iv gap", "v occupied", "v unknown", "v outside"];
            /// No trajectory without an obstacle check.
            H05 = "H-05" witnesses ["no_obstacle_check", "v occupied", "v unknown", "v outside"];
            /// Stage v takes the closed squares of cells, and what is unknown.
            H06 = "H-06" witnesses ["v occupied", "v unknown", "v outside"];
            /// The trajectory starts now and here, and keeps to the route.
            H07 = "H-07" witnesses [
                "ii start_time", "ii position", "ii start_heading", "ii start_offset",
                "ii corridor", "ii direction"
            ];
            /// Make before break.
            H08 = "H-08" witnesses [];
            /// Stage v runs whatever else ran.
            H10 = "H-10" witnesses ["v occupied", "v unknown", "v outside"];
            /// A vehicle can drive the steps of the trajectory.
            H11 = "H-11" witnesses [
                "ii step_time", "ii step_length", "ii step_speed", "ii step_forward",
                "ii step_lateral", "ii step_turn", "ii slide"
            ];
            /// The fail-safe rule.
            H14 = "H-14" witnesses ["ii reach", "ii corridor", "iv fail_safe", "iv work_limit"];
        }
    };
}

macro_rules! enumerate {
    ($($(#[$doc:meta])* $name:ident = $id:literal witnesses [$($witness:literal),*];)*) => {
        /// A rule of the hardened profile.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum HardenedRule {
            $($(#[$doc])* $name,)*
        }

        impl HardenedRule {
            /// All rules in the order of the table.
            pub const ALL: [Self; [$($id),*].len()] = [$(Self::$name),*];

            /// As the text names it.
            pub const fn id(self) -> &'static str {
                match self {
                    $(Self::$name => $id,)*
                }
            }

            /// What can fail a cycle that the paper accepts: stage and rule of the witness, or
            /// `no_obstacle_check`.
            pub const fn witnesses(self) -> &'static [&'static str] {
                match self {
                    $(Self::$name => &[$($witness),*],)*
                }
            }
        }
    };
}

crate::hardened_rules!(enumerate);

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
