//! How much of what an attack does, and to whom.

use mufasa_drives::Attack as Kind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::named::named;

named! {
    /// Which lists of tracks are spoiled.
    Lists {
        /// That of the CAV and that of the station's planner.
        Both = "both",
        /// What the CAV is sent alone.
        Cav = "cav",
        /// What the station's planner believes in alone.
        Planner = "planner",
    }
}

named! {
    /// How the lists of `empty-tracks` come (`docs/evaluation.md#readings`).
    #[derive(Default)]
    Comes {
        /// Empty, at 100 Hz between the true ones; the last before the planner plans is always one of them.
        #[default]
        Last = "last",
        /// Empty, each in the place of a true one, at 10 Hz.
        Replaced = "replaced",
        /// Empty, at 100 Hz between the true ones; the planner plans at any time, so that now and then a true one is the last.
        Interleaved = "interleaved",
        /// Each with the farthest of its tracks alone, in the place of the true one.
        Farthest = "farthest",
    }
}

/// Magnitudes of an attack. What a kind does not use has no effect on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Means {
    /// Who is lied about, by number; none: those whom the kind says.
    pub target: Option<u32>,
    /// Which lists are spoiled.
    pub lists: Lists,
    /// How lists come that are empty.
    #[serde(default)]
    pub comes: Comes,
    /// How far ahead of the CAV something is made up, m; `ghost-tracks` and `ghost-in-mean`: this on top of where
    /// they are; `swerve`: way until the trajectory is aside; `ends-early`: how far behind where the CAV can
    /// stop the trajectory ends.
    pub ahead_m: f64,
    /// How far to the left of that, m; `swerve`: how far the trajectory is aside.
    pub left_m: f64,
    /// Speed of what is made up, m/s; `drift`: how fast; `into-lead`: speed of a CAV that is slower.
    pub speed_mps: f64,
    /// Velocities are multiplied by this ...
    pub factor: f64,
    /// ... and turned left by this, rad; `drift`: the direction, from the left of the CAV on.
    pub turn_rad: f64,
    /// `delay`, `starts-late`, `replay` and `held-back`: how much later, s; `stamps-ahead`: how far ahead.
    pub late_s: f64,
    /// `into-lead`: acceleration from the present speed on, m/s^2.
    pub acceleration_mps2: f64,
}

impl Means {
    /// Nothing at all.
    pub const NONE: Self = Self {
        target: None,
        lists: Lists::Both,
        comes: Comes::Last,
        ahead_m: 0.0,
        left_m: 0.0,
        speed_mps: 0.0,
        factor: 1.0,
        turn_rad: 0.0,
        late_s: 0.0,
        acceleration_mps2: 0.0,
    };

    /// Those of an attack of the experiments.
    pub const fn of(kind: Kind) -> Self {
        let mut means = Self::NONE;
        match kind {
            Kind::CrossingStands => means.factor = 0.0,
            Kind::FalseVelocities => means.factor = -1.0,
            Kind::Drift => means.speed_mps = 0.1,
            Kind::MadeUpLead => means.ahead_m = 15.0,
            Kind::Replay => means.late_s = 3.0,
            Kind::StartsLate | Kind::StampsAhead => means.late_s = 1.0,
            Kind::Delay => means.late_s = 0.03,
            Kind::HeldBack => means.late_s = 0.1,
            Kind::IntoLead => means.speed_mps = 5.0,
            Kind::Swerve => (means.left_m, means.ahead_m) = (1.5, 15.0),
            _ => {}
        }
        means
    }

    /// Whether a list is spoiled that is the CAV's or the planner's.
    pub(super) fn spoils(&self, list: Lists) -> bool {
        self.lists == Lists::Both || self.lists == list
    }
}
