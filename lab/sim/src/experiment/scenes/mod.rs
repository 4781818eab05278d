//! A search for avoidable collisions, of the kind that found W1 to W18: one other, straight ways and bends, every kind
//! of lie, trajectories that begin elsewhere, at another time, or end in the way.
//!
//! Each scene is drawn, driven in a closed loop with the monitor (`closed_loop`), and counted. What it asks the monitor are
//! cycles (`asked`); of the rules it knows nothing.

mod asked;
pub mod closed_loop;
pub mod kinds;
mod other;
mod pace;
pub mod scene;
#[cfg(test)]
mod tests;
mod way;
pub mod wrong;

use std::collections::BTreeMap;

use mufasa::cycle::check;
use mufasa::input::cycle::Cycle;
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row as Lent, Scratch, Sizes};
use mufasa_props::bridge;
use mufasa_records::{names, write};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use self::closed_loop::{Alarm, Brake, Driven, Hit, drive};
use self::kinds::{Drive, Lie, Motion, Remote, Shift, Side};
use self::scene::{Kinds, Scene};
use self::wrong::{Axis, Wrong};
use crate::cav::guard::Variant;
use crate::vehicle::A_B;

/// Its name.
pub const NAME: &str = "scenes";
/// A scene in which nobody comes nearer, if nobody reacts, is clean, m.
const CLEAN_M: f64 = 1.0;
/// Scenes that are drawn for each that is looked for.
const DRAWN: u64 = 10_000;
/// Causes of alarms that are named.
const NAMED: usize = 3;

/// What is searched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Options {
    /// What is checked.
    pub profile: Variant,
    /// From the measurement to the brake, s.
    pub tau_s: f64,
    /// Of what is drawn.
    pub seed: u64,
    /// Words that the kinds of a scene have to contain.
    pub only: Vec<String>,
    /// What is wrong with the assumptions, if something is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrong: Option<Wrong>,
}

/// A scene and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[expect(clippy::struct_excessive_bools, reason = "columns of a table")]
pub struct Run {
    /// Its number; with the seed it gives the scene again.
    pub scene: u64,
    /// What is remote.
    pub remote: Remote,
    /// How the trajectory is moved.
    pub shift: Shift,
    /// What is lied.
    pub lie: Lie,
    /// Where the other comes from.
    pub side: Side,
    /// What it does.
    pub motion: Motion,
    /// What the CAV does.
    pub drive: Drive,
    /// How near they come if nobody reacts, m.
    pub nearest_m: f64,
    /// Whether there is a collision that braking from the first cycle on avoids.
    pub is_avoidable: bool,
    /// When a cycle was rejected for the first time, s.
    pub rejected_s: Option<f64>,
    /// Why: what failed, and the rule.
    pub rejected_by: Option<String>,
    /// When they collide, s.
    pub collided_s: Option<f64>,
    /// Speed of the CAV then, m/s.
    pub speed_mps: Option<f64>,
    /// How long it had stood then, s.
    pub stood_s: Option<f64>,
    /// Whether that was avoidable, and not for the other to avoid.
    pub is_failure: bool,
    /// Whether it was avoidable, and for the other to avoid.
    pub is_hit_standing: bool,
    /// Whether going on would have avoided it.
    pub is_by_braking: bool,
}

/// Counts of scenes that have something in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Row {
    /// What they have in common: its kind, and its name.
    pub of: String,
    /// Its name.
    pub kind: String,
    /// Scenes.
    pub scenes: u64,
    /// Of them with a collision that braking at once avoids.
    pub avoidable: u64,
    /// Of them with one all the same, not for the other to avoid.
    pub collided: u64,
    /// Of those never rejected.
    pub never_rejected: u64,
    /// Of those where going on would have avoided it.
    pub by_braking: u64,
    /// Hit by who could have stopped, after it had stood for long.
    pub hit_standing: u64,
    /// Scenes in which nobody comes near.
    pub clean: u64,
    /// Of them rejected.
    pub alarms: u64,
    /// Most frequent first causes of those.
    pub by: String,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scenes {
    /// What was searched.
    pub options: Options,
    /// Counts by kinds.
    pub rows: Vec<Row>,
    /// Each scene.
    pub runs: Vec<Run>,
}

impl Scenes {
    /// Nothing yet.
    pub const fn nothing(options: Options) -> Self {
        Self { options, rows: Vec::new(), runs: Vec::new() }
    }

    /// So many scenes more; fewer only where hardly any is of the kinds that are looked for. `done` is told of each.
    pub fn add(&mut self, count: u64, done: &(impl Fn() + Sync)) {
        let options = &self.options;
        let first = self.runs.last().map_or(0, |it| it.scene + 1);
        let is_asked = |number: &u64| {
            let name = Scene::new(options.seed, *number).name();
            options.only.iter().all(|word| name.contains(word))
        };
        let most = first.saturating_add(count.saturating_mul(DRAWN));
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let numbers: Vec<u64> = if options.only.is_empty() {
            (first..most).take(count).collect()
        } else {
            (first..most).filter(is_asked).take(count).collect()
        };
        let one = |number: &u64| {
            let run = options.run(*number);
            done();
            run
        };
        let runs: Vec<Run> = numbers.par_iter().map(one).collect();
        self.runs.extend(runs);
        self.rows = rows(&self.runs);
    }

    /// Avoidable collisions.
    pub fn failures(&self) -> impl Iterator<Item = &Run> {
        self.runs.iter().filter(|it| it.is_failure)
    }
}

impl Options {
    fn parameters(&self) -> Parameters {
        Parameters { tau: self.tau_s, ..Parameters::default() }
    }

    const fn checked(&self) -> Option<Profile> {
        match self.profile {
            Variant::Sofof => None,
            Variant::Paper => Some(Profile::PAPER),
            Variant::Hardened => Some(Profile::HARDENED),
        }
    }

    /// Drives a scene.
    pub fn run(&self, number: u64) -> Run {
        let scene = Scene::new(self.seed, number);
        let driven = self.driven(&scene, |_| ());
        Run::new(number, &scene, &driven)
    }

    /// Drives a scene; `each` sees the cycles.
    fn driven(&self, scene: &Scene, mut each: impl FnMut(&Cycle<'_>)) -> Driven {
        let profile = self.checked();
        let (mut rows, mut columns) =
            (vec![Lent::default(); Sizes::MAX.rows], vec![Column::default(); Sizes::MAX.columns]);
        let mut monitor = |cycle: &Cycle<'_>| {
            each(cycle);
            profile?;
            let mut judge = |it: &Cycle<'_>| judged(it, &mut Scratch::new(&mut rows, &mut columns));
            match self.wrong {
                Some(wrong) => wrong.measured(cycle, judge),
                None => judge(cycle),
            }
        };
        let parameters = self.parameters();
        let [late_s, share] = [Axis::Latency, Axis::Friction].map(|it| Wrong::of(self.wrong, it));
        let brake = Brake { late_s, deceleration: A_B * (1.0 - share) };
        drive(scene, profile.unwrap_or(Profile::PAPER), parameters, brake, &mut monitor)
    }

    /// The cycles of a scene as records, up to the first rejected one or the collision.
    pub fn records(&self, number: u64) -> String {
        let scene = Scene::new(self.seed, number);
        let (mut lines, mut index) = (String::new(), 0);
        let _driven = self.driven(&scene, |cycle| {
            let id = format!("{}/{}-{number}/{index}", scene.name(), self.seed);
            lines += &write::cycle_to_line(&id, &bridge::from_impl(cycle));
            lines.push('\n');
            index += 1;
        });
        lines
    }
}

/// What the implementation says about a cycle.
fn judged(cycle: &Cycle<'_>, scratch: &mut Scratch<'_>) -> Option<Alarm> {
    let Ok(report) = check(cycle, scratch) else {
        return Some(Alarm { stage: "invalid", rule: "" });
    };
    let report = bridge::report_from_impl(&report);
    let stage = names::failed_stage(report.failed_stage?);
    let rule = report.witness().map_or("", |witness| names::rule(witness.rule));
    Some(Alarm { stage, rule })
}

impl Run {
    fn new(number: u64, scene: &Scene, driven: &Driven) -> Self {
        let Kinds { remote, shift, lie, side, motion, drive } = scene.kinds;
        let hit = |of: fn(Hit) -> f64| driven.hit.map(of);
        Self {
            scene: number,
            remote,
            shift,
            lie,
            side,
            motion,
            drive,
            nearest_m: driven.nearest_m,
            is_avoidable: driven.is_avoidable(),
            rejected_s: driven.rejected.map(|(t, _)| t),
            rejected_by: driven
                .rejected
                .map(|(_, Alarm { stage, rule })| format!("{stage} {rule}").trim_end().to_owned()),
            collided_s: hit(|it| it.t_s),
            speed_mps: hit(|it| it.speed_mps),
            stood_s: hit(|it| it.stood_s),
            is_failure: driven.failed().is_some(),
            is_hit_standing: driven.hit_at_once.is_none()
                && driven.hit.is_some_and(|it| it.has_not_yielded),
            is_by_braking: driven.failed().is_some() && driven.hit_going_on.is_none(),
        }
    }

    /// A name for a file.
    pub fn name(&self) -> String {
        let Self { scene, remote, shift, lie, side, motion, drive, .. } = self;
        let words =
            [remote.name(), shift.name(), lie.name(), side.name(), motion.name(), drive.name()];
        format!("{scene}-{}", words.join("-"))
    }
}

/// Counts by what scenes have in common.
fn rows(runs: &[Run]) -> Vec<Row> {
    let mut rows = vec![row("all", "", &runs.iter().collect::<Vec<_>>())];
    let mut group = |of: &str, kind: &dyn Fn(&Run) -> (usize, String)| {
        let mut kinds: BTreeMap<(usize, String), Vec<&Run>> = BTreeMap::new();
        for run in runs {
            kinds.entry(kind(run)).or_default().push(run);
        }
        for ((_, kind), runs) in kinds {
            rows.push(row(of, &kind, &runs));
        }
    };
    group("trajectory, remote", &|run| {
        let name = format!("{}, {}", run.shift.name(), run.remote.name());
        (run.shift as usize * Remote::ALL.len() + run.remote as usize, name)
    });
    group("lie", &|run| (run.lie as usize, run.lie.name().to_owned()));
    group("other comes", &|run| (run.side as usize, run.side.name().to_owned()));
    group("other", &|run| (run.motion as usize, run.motion.name().to_owned()));
    group("CAV", &|run| (run.drive as usize, run.drive.name().to_owned()));
    rows
}

fn row(of: &str, kind: &str, runs: &[&Run]) -> Row {
    let count = |which: fn(&Run) -> bool| {
        u64::try_from(runs.iter().filter(|it| which(it)).count()).unwrap_or(u64::MAX)
    };
    let is_alarm: fn(&Run) -> bool = |it| is_clean(it) && it.rejected_s.is_some();
    let mut causes: BTreeMap<&str, u64> = BTreeMap::new();
    for cause in runs.iter().filter(|it| is_alarm(it)).filter_map(|it| it.rejected_by.as_deref()) {
        *causes.entry(cause).or_default() += 1;
    }
    let mut causes: Vec<_> = causes.into_iter().collect();
    causes.sort_by_key(|(_, times)| core::cmp::Reverse(*times));
    let by = causes.iter().take(NAMED).map(|(cause, times)| format!("{cause} {times}"));
    Row {
        of: of.to_owned(),
        kind: kind.to_owned(),
        scenes: count(|_| true),
        avoidable: count(|it| it.is_avoidable),
        collided: count(|it| it.is_failure),
        never_rejected: count(|it| it.is_failure && it.rejected_s.is_none()),
        by_braking: count(|it| it.is_by_braking),
        hit_standing: count(|it| it.is_hit_standing),
        clean: count(is_clean),
        alarms: count(is_alarm),
        by: by.collect::<Vec<_>>().join(", "),
    }
}

fn is_clean(run: &Run) -> bool {
    run.nearest_m >= CLEAN_M
}
