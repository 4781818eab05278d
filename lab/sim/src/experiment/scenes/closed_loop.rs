//! A scene in a closed loop: the CAV drives on while the monitor is content, brakes when it is not, and stands.

use mufasa::input::cycle::Cycle;
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::asked::{Asked, PERIOD_S, time};
use super::kinds::Drive;
use super::scene::Scene;
use crate::collision;
use crate::vehicle::A_B;

/// Between two looks for a collision, s.
const STEP_S: f64 = 0.01;
/// How long a scene goes on after the meeting, s, and where the CAV stops by itself.
const AFTER_S: f64 = 3.0;
const STOPPED_S: f64 = 8.0;
/// How long a CAV that braked stands, s.
const STANDS_S: f64 = 10.0;
/// Who could have stopped before a CAV that stands, reacting after this time, s, and braking this much, m/s^2, did
/// not yield.
const REACTS_S: f64 = 2.0;
const YIELDS: f64 = 3.0;

/// Why a cycle was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Alarm {
    /// What failed.
    pub stage: &'static str,
    /// The rule of the witness; empty where there is none.
    pub rule: &'static str,
}

/// A collision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Hit {
    /// When, s after the start.
    pub t_s: f64,
    /// Speed of the CAV, m/s.
    pub speed_mps: f64,
    /// How long the CAV had stood, s.
    pub stood_s: f64,
    /// Whether the CAV stood, and the other could have stopped since it began to brake.
    pub has_not_yielded: bool,
}

/// What came of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Driven {
    /// The first cycle that was rejected, s after the start, and why.
    pub rejected: Option<(f64, Alarm)>,
    /// The collision.
    pub hit: Option<Hit>,
    /// That of a CAV that goes on whatever happens.
    pub hit_going_on: Option<Hit>,
    /// How near that one came, m.
    pub nearest_m: f64,
    /// That of a CAV that brakes from the first cycle on.
    pub hit_at_once: Option<Hit>,
}

/// What is asked about each cycle: why it is to be rejected.
pub trait Monitor: FnMut(&Cycle<'_>) -> Option<Alarm> {}
impl<M: FnMut(&Cycle<'_>) -> Option<Alarm>> Monitor for M {}

/// How the CAV brakes.
#[derive(Clone, Copy, Debug)]
pub struct Brake {
    /// Later than `tau` after the last safe cycle, s.
    pub late_s: f64,
    /// m/s^2
    pub deceleration: f64,
}

impl Brake {
    /// As assumed.
    pub const ASSUMED: Self = Self { late_s: 0.0, deceleration: A_B };
}

/// Drives a scene. What braking at once avoids is that of a CAV that brakes as assumed.
pub fn drive(
    scene: &Scene,
    profile: Profile,
    parameters: Parameters,
    brake: Brake,
    monitor: &mut impl Monitor,
) -> Driven {
    let after = if scene.kinds.drive == Drive::Stops { STOPPED_S } else { AFTER_S };
    let end = scene.meeting + after;
    let mut nearest_m = f64::INFINITY;
    let hit_going_on = ride(scene, None, end, |apart| nearest_m = nearest_m.min(apart));
    let last = hit_going_on.map_or(end, |it| it.t_s);
    let asked = Asked::new(scene, profile, parameters);
    let mut alarms = (0_i32..).take_while(|number| time(*number) < last);
    let rejected = alarms.find_map(|number| Some((time(number), asked.ask(number, monitor)?)));
    let braking = |from: f64, Brake { late_s, deceleration }: Brake| {
        // tau counts from the last safe cycle.
        let from = (from - PERIOD_S).max(0.0) + parameters.tau + late_s;
        let stands = from + scene.pace.at(from).1 / deceleration;
        ride(scene, Some((from, deceleration)), stands + STANDS_S, |_| ())
    };
    let hit = rejected.map_or(hit_going_on, |(from, _)| braking(from, brake));
    let hit_at_once = braking(0.0, Brake::ASSUMED);
    Driven { rejected, hit, hit_going_on, nearest_m, hit_at_once }
}

/// The collision of a CAV that brakes from a time on, s, by so much, m/s^2, until another time, s; each distance is
/// told, m.
fn ride(
    scene: &Scene,
    brakes: Option<(f64, f64)>,
    end: f64,
    mut apart: impl FnMut(f64),
) -> Option<Hit> {
    let braked = brakes.map(|(from, by)| scene.pace.braking(from, by));
    let pace = braked.as_ref().unwrap_or(&scene.pace);
    let mut stands_from: Option<f64> = None;
    let mut least = f64::INFINITY;
    for step in 0.. {
        let t = f64::from(step) * STEP_S;
        if t > end {
            return None;
        }
        let (driven, speed_mps) = pace.at(t);
        stands_from = if speed_mps < 1e-9 { stands_from.or(Some(t)) } else { None };
        let (cav, other) = (scene.cav_at(driven), scene.object(t));
        let reach = (cav.length + cav.width + other.length + other.width) / 2.0;
        if cav.pose.at.distance(other.pose.at) - reach > least {
            continue;
        }
        let now = collision::distance(&cav, &other);
        least = least.min(now);
        apart(now);
        if now <= 0.0 {
            let stood_s = stands_from.map_or(0.0, |from| t - from);
            let since = brakes.map(|it| it.0).or(stands_from);
            let could = |from| stands_from.is_some() && could_stop(scene, from, t);
            let has_not_yielded = since.is_some_and(could);
            return Some(Hit { t_s: t, speed_mps, stood_s, has_not_yielded });
        }
    }
    None
}

/// Whether the other could have stopped before a CAV that began to brake at one time, until another, s.
fn could_stop(scene: &Scene, from: f64, until: f64) -> bool {
    let ((start, speed), (end, _)) = (scene.other.pace.at(from), scene.other.pace.at(until));
    let needed = REACTS_S * speed + speed * speed / (2.0 * YIELDS);
    end - start > needed
}

impl Driven {
    /// Whether a collision, of the drive or of one that goes on, would not have been if the CAV had braked at once.
    pub fn is_avoidable(&self) -> bool {
        self.hit_at_once.is_none() && (self.hit.is_some() || self.hit_going_on.is_some())
    }

    /// An avoidable collision for which the other is not to blame.
    pub fn failed(&self) -> Option<Hit> {
        self.hit.filter(|hit| self.hit_at_once.is_none() && !hit.has_not_yielded)
    }
}
