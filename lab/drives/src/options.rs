//! How a recording becomes cycles: what the recording itself does not say.

use mufasa_model::input::cycle::Profile;
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

/// What a recording does not say about the cycles to be made from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Profile of every cycle.
    pub profile: Profile,
    /// Parameters of every cycle.
    pub parameters: Parameters,
    /// Which groups are remote.
    pub configuration: Configuration,
    /// Id of the recorded vehicle that is the CAV; `None` picks one. Ignored with a solution.
    pub ego: Option<i64>,
    /// Length of the planned trajectories, s.
    pub horizon_s: f64,
    /// What happens at the end of a recording.
    pub tail: Tail,
    /// The local detectors, now and in the history.
    pub sensor: Sensor,
    /// Age of the track lists, ns; what they hold is exact, and that old.
    pub track_age_ns: i64,
    /// The local grid map.
    pub grid: GridSize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            profile: Profile::HARDENED,
            parameters: Parameters::default(),
            configuration: Configuration::AllRemote,
            ego: None,
            horizon_s: 5.0,
            tail: Tail::default(),
            sensor: Sensor::default(),
            track_age_ns: 30_000_000,
            grid: GridSize::default(),
        }
    }
}

/// Near its end a recording holds no more plan than the rest of it. Where the CAV cannot stop within it, H-14
/// examines a way straight on that nobody drove.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tail {
    /// No cycle once the rest is shorter than the braking time `v / a_b`, or than one step.
    #[default]
    Stop,
    /// A cycle for every step, however short its trajectory.
    Keep,
}

/// The local detectors, drawn from `ChaCha8` so that equal seeds give equal drives.
///
/// Defaults: every object within 80 m is seen (in the paper profile a missed one among few far
/// clutter points fails stage i, F-20; that price is to be asked for, not hidden in a default), with 5 cm of
/// noise per axis (a mean distance of 6 cm against `theta_tr` of 20 cm), and one clutter
/// detection every other scan, anywhere within range.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Range, m.
    pub range_m: f64,
    /// Range of the sensor of the leading vehicle, m; 0 for none.
    pub lead_range_m: f64,
    /// Standard deviation of a detected position, per axis, m.
    pub sigma_m: f64,
    /// Probability that an object within range is detected.
    pub probability: f64,
    /// Mean number of clutter detections in a scan.
    pub clutter: f64,
    /// Seed of the generator.
    pub seed: u64,
}

impl Default for Sensor {
    fn default() -> Self {
        Self {
            range_m: 80.0,
            lead_range_m: 80.0,
            sigma_m: 0.05,
            probability: 1.0,
            clutter: 0.5,
            seed: 1,
        }
    }
}

/// The local grid map; it lies along the CAV's direction, a third of its length behind the CAV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSize {
    /// Side of a cell, m.
    pub resolution_m: f64,
    /// Cells along the CAV.
    pub width: u32,
    /// Cells across.
    pub height: u32,
}

impl Default for GridSize {
    fn default() -> Self {
        Self { resolution_m: 0.2, width: 500, height: 300 }
    }
}
