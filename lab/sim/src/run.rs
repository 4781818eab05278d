//! One run: a scenario, a variant, attacks, and how it ended.

use mufasa::input::cycle::Route;
use mufasa::monitor::MonitorError;
use mufasa::offloading::requester::StationRecord;
use mufasa::report::Outcome as StageOutcome;
use mufasa::services::configuration::{Configuration, Group};
use mufasa_link::message::{self, EncodeError, Frame};
use mufasa_props::lent::Lent;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::attack::Attacker;
use crate::cav::guard::{Decided, Guard};
use crate::cav::{Cav, DECIDES_NS};
use crate::map::Town;
use crate::radio::{Radio, To};
use crate::scenario::Scenario;
pub use crate::settings::{PERIOD_NS, Settings};
use crate::snapshot::Snapshot;
use crate::station::Station;
use crate::time::seconds;
use crate::vehicle::Command;
use crate::world::World;

/// Most detections of a list, and cross sections of a route.
const MOST: (usize, usize) = (128, 2048);

/// How a run ended.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// In the target zone.
    Arrived,
    /// The CAV touched somebody: a failure.
    Collided,
    /// Not in the target zone within the time limit: a failure.
    Late,
}

impl End {
    /// As the paper has it.
    pub const fn is_failure(self) -> bool {
        matches!(self, Self::Collided | Self::Late)
    }
}

/// A cycle of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cycle {
    /// When it was decided, s.
    pub t: f64,
    /// Place of the CAV on its route, m.
    pub s: f64,
    /// Its speed, m/s.
    pub speed: f64,
    /// Distance to the nearest other, m; none in an empty town.
    pub nearest: Option<f64>,
    /// Which groups were remote: bit 0 MOT, bit 1 PLAN.
    pub remote: u8,
    /// 0: nothing found, or nothing checked; 1 to 5: the stage that failed; 6: no obstacle check; 7: input.
    pub failed: u8,
    /// Whether an attack went on.
    pub attacked: bool,
    /// Whether some part of the CAV was outside of its corridor.
    pub off_road: bool,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// How it ended.
    pub end: End,
    /// When, s.
    pub t: f64,
    /// With whom it collided.
    pub with: Option<u32>,
    /// Least distance to another, m.
    pub least_distance: f64,
    /// How often each stage ran while a group was remote, and found a safety issue.
    pub stages: [[u64; 2]; 5],
    /// Cycles that failed for another reason: no obstacle check, invalid input.
    pub other_failures: u64,
    /// Cycles with each group remote.
    pub offloaded: [u64; 2],
    /// Cycles in all.
    pub cycles: u64,
    /// Cycles with a failure and without an attack.
    pub false_alarms: u64,
    /// Cycles with some part of the CAV outside of its corridor.
    pub off_road: u64,
}

/// Why a run cannot be made.
#[derive(Debug, Error)]
#[error(transparent)]
pub enum RunError {
    /// Settings that no monitor can keep.
    Monitor(MonitorError),
    /// A route that it cannot keep.
    Route(mufasa::report::InvalidInput),
    /// A town too far from its origin for the messages.
    Frame(EncodeError),
}

/// Who looks at a run.
pub trait Watcher {
    /// A cycle was decided.
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle);

    /// The CAV took a message that arrived at a time, ns.
    fn took(&mut self, _: i64, _: &Cav<'_>) {}

    /// Control wants this at a time, ns: in each step of the world.
    fn commanded(&mut self, _: i64, _: &Cav<'_>, _: Command) {}

    /// The run is over; the last cycle was up to a period ago.
    fn ended(&mut self, _: &Snapshot, _: &Cav<'_>) {}
}

/// Nobody looks.
impl Watcher for () {
    fn cycle(&mut self, _: &Snapshot, _: &Cav<'_>, _: &Decided, _: &Cycle) {}
}

/// Makes a run. The same arguments give the same outcome on any machine.
///
/// Errors: settings, a route or a town that cannot be.
pub fn simulate(
    town: &Town,
    scenario: &Scenario,
    settings: &Settings,
    watcher: &mut impl Watcher,
) -> Result<Outcome, RunError> {
    let mut world = World::new(town, scenario, settings.seed);
    let route = world.route();
    let at = route.path.pose_at(0.0).at;
    let frame = Frame::new(484_000_000, 99_500_000, [at.x, at.y]).map_err(RunError::Frame)?;
    let (mut table, mut lent) = (vec![StationRecord::FREE; 4], Lent::new(4, MOST.0, MOST.1));
    let cross_sections = route.cross_sections(0.0, f64::INFINITY);
    let corridor = Route { closed: false, cross_sections: &cross_sections };
    let mut guard =
        Guard::new(settings, &mut table, lent.memory(), &corridor).map_err(RunError::Monitor)?;
    guard.set_route(&corridor).map_err(RunError::Route)?;
    let place = (town, route);
    let mut cav = Cav::new(place, *world.body(), frame, settings, &cross_sections, guard);
    let mut station = Station::new(place, frame, settings, &cross_sections);
    let mut radio = Radio::new(settings.radio, settings.seed);
    let elsewhere = elsewhere(town, scenario.ego_route, scenario.ego_s);
    let mut attacker = Attacker::new(settings.attacks.clone(), elsewhere);
    let mut outcome = Outcome::default();
    loop {
        let now_ns = world.time_ns();
        let truth = world.snapshot();
        while let Some((arrival_ns, to, bytes)) = radio.receive(now_ns) {
            match to {
                To::Station => station.take(arrival_ns, &bytes, &mut attacker, &mut radio),
                To::Vehicle => {
                    receive(&mut cav, arrival_ns, &bytes, &frame, &attacker, &mut radio);
                    watcher.took(arrival_ns, &cav);
                }
            }
        }
        if now_ns % settings.period_ns == 0 {
            attacker.look(now_ns, &truth);
            station.sense(now_ns, &truth, &mut radio);
            cav.sense(now_ns, &truth, &mut radio);
        }
        attacker.forge(now_ns, &frame, &mut radio);
        if now_ns % settings.period_ns == DECIDES_NS {
            let configuration = cav.guard().configuration();
            if let Some(decided) = cav.decide(now_ns, &truth, &mut radio) {
                let cycle = outcome.cycle(&world, configuration, &decided, attacker.is_on(now_ns));
                watcher.cycle(&truth, &cav, &decided, &cycle);
            }
        }
        let command = cav.command(now_ns, &truth);
        watcher.commanded(now_ns, &cav, command);
        world.step(command);
        if let Some(end) = ended(&world) {
            outcome.end = end;
            outcome.t = seconds(world.time_ns());
            outcome.with = world.collision();
            watcher.ended(&world.snapshot(), &cav);
            return Ok(outcome);
        }
    }
}

fn ended(world: &World<'_>) -> Option<End> {
    if world.collision().is_some() {
        Some(End::Collided)
    } else if world.has_arrived() {
        Some(End::Arrived)
    } else {
        world.is_late().then_some(End::Late)
    }
}

fn receive(
    cav: &mut Cav<'_>,
    now_ns: i64,
    bytes: &[u8],
    frame: &Frame,
    attacker: &Attacker<'_>,
    radio: &mut Radio,
) {
    let Ok(mut message) = message::decode(bytes, frame) else {
        cav.counts.malformed += 1;
        return;
    };
    attacker.decoded(&mut message);
    cav.take(now_ns, message, radio);
}

/// Another route of motor vehicles: of those whose path comes near the CAV's start or way, the one that leaves
/// it; so the planner with the wrong map goes on and leaves the corridor.
fn elsewhere(town: &Town, own: usize, s: f64) -> Option<&crate::map::route::Route> {
    let path = &town.routes[own].path;
    let (near, far) = (path.pose_at(s + 40.0), path.pose_at(path.length()));
    let others = town.roads().filter(|&index| index != own).map(|index| &town.routes[index]);
    let distance = |at: crate::pose::Pose, of: &crate::map::route::Route| {
        let seen = of.path.project(at.at);
        of.path.pose_at(seen.s).at.distance(at.at)
    };
    let leaving = others.filter(|it| distance(near, it) < 8.0 && distance(far, it) > 20.0);
    leaving.min_by(|a, b| distance(near, a).total_cmp(&distance(near, b)))
}

impl Default for Outcome {
    fn default() -> Self {
        Self {
            end: End::Late,
            t: 0.0,
            with: None,
            least_distance: f64::INFINITY,
            stages: [[0; 2]; 5],
            other_failures: 0,
            offloaded: [0; 2],
            cycles: 0,
            false_alarms: 0,
            off_road: 0,
        }
    }
}

impl Outcome {
    fn cycle(
        &mut self,
        world: &World<'_>,
        configuration: Configuration,
        decided: &Decided,
        attacked: bool,
    ) -> Cycle {
        self.cycles += 1;
        let remote = Group::ALL.map(|group| configuration.is_remote(group));
        for (count, is_remote) in self.offloaded.iter_mut().zip(remote) {
            *count += u64::from(is_remote);
        }
        if let Some(Ok(report)) = &decided.report {
            for (counts, outcome) in self.stages.iter_mut().zip(&report.stages) {
                let failed = matches!(outcome, StageOutcome::Failed(_));
                counts[0] += u64::from(failed || matches!(outcome, StageOutcome::Passed));
                counts[1] += u64::from(failed);
            }
        }
        let failed = decided.code();
        self.other_failures += u64::from(failed > 5);
        self.false_alarms += u64::from(failed > 0 && !attacked);
        let nearest = world.nearest().map(|(distance, _)| distance);
        self.least_distance = nearest.map_or(self.least_distance, |it| self.least_distance.min(it));
        let truth = world.snapshot();
        let off_road = world.is_off_road();
        self.off_road += u64::from(off_road);
        Cycle {
            t: seconds(truth.time_ns),
            s: truth.ego.s,
            speed: truth.ego.speed,
            nearest,
            remote: u8::from(remote[0]) | u8::from(remote[1]) << 1,
            failed,
            attacked,
            off_road,
        }
    }
}
