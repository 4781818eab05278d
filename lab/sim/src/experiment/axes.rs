//! What is special about a run: its axes, as values and as settings.

use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::report::Stage;
use mufasa::services::configuration::{Group, Groups};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::attack::means::{Comes, Lists};
use crate::attack::{Attack, Kind};
use crate::cav::guard::Variant;
use crate::named::named;
use crate::run::Settings;
use crate::services::detectors::Errors;
use crate::time::seconds;
use crate::withheld::Withheld;

/// When the attack of a run begins that has one, s.
pub const FROM: f64 = 5.0;
/// One object in so many is not detected by anyone who is blind.
const ONE_IN: f64 = 2.0;

/// The axes of all experiments; one that a run does not have is empty.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Axes {
    /// The attack, from 5 s after the start on; none in the control.
    pub attack: Option<Kind>,
    /// Whose lists an attack on lists spoils.
    pub lists: Option<Lists>,
    /// How its lists come.
    pub comes: Option<Comes>,
    /// Whether an empty list is a list to the stages (I-11).
    pub empty_is_a_list: Option<bool>,
    /// What the station offers.
    pub offered: Offered,
    /// What is set, and to what.
    pub set: Option<(Factor, f64)>,
    /// How wrong detectors are.
    pub detectors: Option<Detectors>,
    /// What is left out.
    pub left_out: Option<LeftOut>,
}

impl Axes {
    /// Sets what they say. The attack draws by the seed that is set.
    pub fn apply(&self, settings: &mut Settings) {
        settings.offers = self.offered.groups();
        if let Some((factor, value)) = self.set {
            factor.set(settings, value);
        }
        if let Some(detectors) = self.detectors {
            detectors.set(settings);
        }
        if let Some(left_out) = self.left_out {
            left_out.set(settings);
        }
        if self.empty_is_a_list == Some(false) {
            settings.withheld = Some(Withheld::EmptyLists);
        }
        if let Some(kind) = self.attack {
            let mut attack = Attack::new(kind, FROM, f64::INFINITY, settings.seed);
            attack.means.lists = self.lists.unwrap_or(attack.means.lists);
            attack.means.comes = self.comes.unwrap_or(attack.means.comes);
            settings.attacks.push(attack);
        }
    }
}

named! {
    /// What the station offers.
    #[derive(Default)]
    Offered {
        /// Tracking alone.
        Mot = "mot",
        /// Planning alone.
        Plan = "plan",
        /// Both.
        #[default]
        Both = "both",
    }
}

impl Offered {
    /// As the station has it.
    pub fn groups(self) -> Groups {
        match self {
            Self::Mot => Groups::of(&[Group::Mot]),
            Self::Plan => Groups::of(&[Group::Plan]),
            Self::Both => Groups::ALL,
        }
    }
}

named! {
    /// What is set.
    Factor {
        /// Share of the visible objects that a cycle's detections leave out.
        Missed = "missed",
        /// Mean number of detections of nothing in a cycle.
        Clutter = "clutter",
        /// Standard deviation of each coordinate of a detection, m.
        PositionM = "position-m",
        /// Mean of what comes on top of a message's least latency, ms.
        JitterMs = "jitter-ms",
        /// Share of the messages that never arrive, in both directions.
        Loss = "loss",
        /// The wait after a failure, s.
        TWaitS = "t-wait-s",
    }
}

impl Factor {
    /// What it is set to; the default is among them.
    pub const fn values(self) -> &'static [f64] {
        match self {
            Self::Missed => &[0.0, 0.01, 0.05, 0.1],
            Self::Clutter => &[0.0, 0.1, 1.0],
            Self::PositionM => &[0.02, 0.05, 0.1, 0.2],
            Self::JitterMs => &[0.0, 2.0, 5.0, 10.0],
            Self::Loss => &[0.0, 0.001, 0.01, 0.05, 0.1],
            Self::TWaitS => &[1.0, 10.0, 60.0],
        }
    }

    /// What it is where nothing sets it.
    pub fn of_default(self) -> f64 {
        let settings = Settings::new(Variant::Hardened, Groups::ALL, 0);
        match self {
            Self::Missed => settings.errors.missed,
            Self::Clutter => settings.errors.clutter,
            Self::PositionM => settings.errors.position,
            Self::JitterMs => 1e3 * seconds(settings.radio.jitter_ns),
            Self::Loss => settings.radio.loss,
            Self::TWaitS => seconds(settings.requester.t_wait_ns),
        }
    }

    fn set(self, settings: &mut Settings, value: f64) {
        #[expect(clippy::cast_possible_truncation, reason = "at most a minute")]
        let ns = |seconds: f64| (seconds * 1e9) as i64;
        match self {
            Self::Missed => settings.errors.missed = value,
            Self::Clutter => settings.errors.clutter = value,
            Self::PositionM => settings.errors.position = value,
            Self::JitterMs => settings.radio.jitter_ns = ns(value / 1e3),
            Self::Loss => settings.radio.loss = value,
            Self::TWaitS => settings.requester.t_wait_ns = ns(value),
        }
    }
}

named! {
    /// How wrong all detectors are.
    Detectors {
        /// Not at all.
        Exact = "exact",
        /// As in the other experiments: 0.05 m, and one object in a hundred missed in a cycle.
        Noisy = "noisy",
        /// The same with 0.2 m.
        VeryNoisy = "very-noisy",
        /// As `Noisy`, blind for one object in two, and nothing measures the gap to the leading vehicle.
        Blind = "blind",
    }
}

impl Detectors {
    fn set(self, settings: &mut Settings) {
        let noisy = Errors::default();
        settings.errors = match self {
            Self::Exact => Errors::NONE,
            Self::Noisy => noisy,
            Self::VeryNoisy => Errors { position: 0.2, ..noisy },
            Self::Blind => Errors { blind: 1.0 / ONE_IN, ..noisy },
        };
        settings.has_no_lead = self == Self::Blind;
    }
}

/// What is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(into = "String", try_from = "String")]
#[schemars(with = "String")]
pub enum LeftOut {
    /// Nothing.
    Nothing,
    /// The grid, hence stage v.
    Grid,
    /// The detections, and what rests on them.
    Detections,
    /// A stage of the paper; v is `Grid`.
    Stage(Stage),
    /// A rule of the hardened profile.
    Rule(HardenedRule),
}

impl LeftOut {
    /// What is left out of a variant: stages and rules with two of the detectors.
    pub fn all(variant: Variant, detectors: Detectors) -> Vec<Self> {
        let mut all = vec![Self::Nothing, Self::Grid, Self::Detections];
        if matches!(detectors, Detectors::Noisy | Detectors::Blind) {
            all.extend([Stage::I, Stage::Ii, Stage::Iii, Stage::Iv].map(Self::Stage));
            if variant == Variant::Hardened {
                all.extend(HardenedRule::ALL.map(Self::Rule));
            }
        }
        all
    }

    /// In tables and ids.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Grid => "grid",
            Self::Detections => "detections",
            Self::Stage(Stage::I) => "stage-i",
            Self::Stage(Stage::Ii) => "stage-ii",
            Self::Stage(Stage::Iii) => "stage-iii",
            Self::Stage(Stage::Iv) => "stage-iv",
            Self::Stage(Stage::V) => "stage-v",
            Self::Rule(rule) => rule.id(),
        }
    }

    fn set(self, settings: &mut Settings) {
        let without = |profile: Profile| match self {
            Self::Stage(stage) => profile.without_stage(stage),
            Self::Rule(rule) => profile.without(rule),
            Self::Nothing | Self::Grid | Self::Detections => profile,
        };
        settings.profile = settings.profile.map(without);
        settings.withheld = match self {
            Self::Grid => Some(Withheld::Grid),
            Self::Detections => Some(Withheld::Detections),
            Self::Nothing | Self::Stage(_) | Self::Rule(_) => None,
        };
    }
}

impl From<LeftOut> for String {
    fn from(of: LeftOut) -> Self {
        of.name().to_owned()
    }
}

impl TryFrom<String> for LeftOut {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let mut all = Self::all(Variant::Hardened, Detectors::Noisy).into_iter();
        all.find(|it| it.name() == name).ok_or(name)
    }
}
