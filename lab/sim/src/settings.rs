//! What a run is made of, beside town and scenario.

use std::time::Duration;

use mufasa::input::parameters::Parameters as StageParameters;
use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::monitor;
use mufasa::offloading::requester::Parameters as RequesterParameters;
use mufasa::services::configuration::Groups;

use crate::attack::Attack;
use crate::named::named;
use crate::radio;
use crate::services::detectors::Errors;
use crate::vehicle::TAU_S;
use crate::withheld::Withheld;

/// Time between two cycles, ns.
pub const PERIOD_NS: i64 = 100_000_000;

/// Where each group may be offloaded along the route (CODM), m: from, to.
pub type Areas = [(f64, f64); 2];

named! {
    /// What is checked of remote data.
    Variant {
        /// Quality of service alone: latency and inter-arrival time.
        Sofof = "sofof",
        /// And the five stages, as the paper has them.
        Paper = "paper",
        /// And the five stages with the hardened rules.
        Hardened = "hardened",
    }
}

impl Variant {
    /// By which its stages check, if it has any.
    pub const fn profile(self) -> Option<Profile> {
        match self {
            Self::Sofof => None,
            Self::Paper => Some(Profile::PAPER),
            Self::Hardened => Some(Profile::HARDENED),
        }
    }
}

/// Which cycles are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Each so many is; 0: none is.
    pub every: u64,
    /// The first is so many cycles after the start, modulo `every`.
    pub first: u64,
}

impl Share {
    /// All.
    pub const ALL: Self = Self { every: 1, first: 0 };
}

/// What a run is made of, beside town and scenario.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "switches of a run")]
pub struct Settings {
    /// What is checked of remote data.
    pub variant: Variant,
    /// By which rules: those of the variant, or a set of a study. None in `Sofof`.
    pub profile: Option<Profile>,
    /// Whether control drives on along what was verified however long nothing newer comes (F-47).
    pub drives_on: bool,
    /// Whether nothing measures the gap to the leading vehicle: the stages take a missing lead.
    pub has_no_lead: bool,
    /// What the stages do not get.
    pub withheld: Option<Withheld>,
    /// Time between two cycles, ns; `PERIOD_NS` but where a test is about another one.
    pub period_ns: i64,
    /// From when on the CAV brakes where its monitor, which is told to look (`supervise_local`), says so of its own
    /// plans, s (F-48). Not in `Sofof`.
    pub supervise_local: Option<f64>,
    /// Whether the station, and the CAV's own planner in `MotRemote`, ask the stages before they send. Not in `Sofof`.
    pub prechecks: bool,
    /// What the station offers.
    pub offers: Groups,
    /// Where along the route each group may be offloaded, m.
    pub areas: Areas,
    /// What goes wrong on purpose.
    pub attacks: Vec<Attack>,
    /// Parameters of the stages.
    pub stages: StageParameters,
    /// Parameters of the requester.
    pub requester: RequesterParameters,
    /// The link.
    pub radio: radio::Settings,
    /// What all detectors get wrong.
    pub errors: Errors,
    /// Seed of noise and link.
    pub seed: u64,
    /// Which of the cycles that the monitor decides are recorded.
    pub recorded: Share,
    /// Whether the calls of the monitor are logged, where all its cycles are recorded.
    pub logged: bool,
}

impl Settings {
    /// Without attacks: the paper's parameters, but `dt_max` of 150 ms, because at 10 Hz its 100 ms end
    /// every session at the first jitter; and `TAU_S`, of the hardened profile.
    pub fn new(variant: Variant, offers: Groups, seed: u64) -> Self {
        let requester =
            RequesterParameters { dt_max_ns: 150_000_000, ..RequesterParameters::default() };
        Self {
            variant,
            profile: variant.profile(),
            drives_on: false,
            has_no_lead: false,
            withheld: None,
            period_ns: PERIOD_NS,
            supervise_local: None,
            prechecks: true,
            offers,
            areas: [(0.0, f64::INFINITY); 2],
            attacks: Vec::new(),
            stages: StageParameters { tau: TAU_S, ..StageParameters::default() },
            requester,
            radio: radio::Settings::default(),
            errors: Errors::default(),
            seed,
            recorded: Share::default(),
            logged: false,
        }
    }

    /// By when control brakes along a plan of the CAV's own, ns: `tau` after the cycle in the hardened profile.
    pub(crate) fn brake_by(&self, now_ns: i64) -> i64 {
        let stops = self.profile.is_some_and(|it| it.has(HardenedRule::H14));
        let tau = Duration::from_secs_f64(self.stages.tau);
        let tau_ns = if stops { i64::try_from(tau.as_nanos()) } else { Ok(i64::MAX) };
        now_ns.saturating_add(tau_ns.unwrap_or(i64::MAX))
    }

    /// What the CAV's monitor of a profile is made with. It refuses a `tau` that is not above its period; a run that
    /// was kept from before that is made again with a period that is just below.
    pub(crate) fn monitor(&self, profile: Profile) -> monitor::Settings {
        let period = Duration::from_nanos(self.period_ns.unsigned_abs());
        let is_above = self.stages.tau > period.as_secs_f64();
        let period = if is_above { period } else { period.saturating_sub(Duration::from_nanos(1)) };
        let settings = monitor::Settings {
            profile,
            stages: self.stages,
            requester: self.requester,
            supervise_local: self.supervise_local.is_some(),
            ..monitor::Settings::new(period)
        };
        // Lent memory for all of the domain.
        settings.in_any_time().in_any_range()
    }
}
