//! How near a run came to a collision: the time that was left to react.
//!
//! With hindsight: the others are where they were in the run. The CAV goes on along its route at its speed
//! for a while and then brakes as hard as it can; the longest while after which it touches nobody is the
//! time left to react. Below zero, nothing helps any more: the lower the faster it would be. Whoever comes
//! from behind does not count, and a CAV that stands has all the time.

use std::collections::BTreeMap;

use mufasa::report::{Outcome as StageOutcome, Stage};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cav::Cav;
use crate::cav::guard::Decided;
use crate::collision;
use crate::map::route::Route;
use crate::pose::{Pose, Rectangle};
use crate::run::{Cycle, Watcher};
use crate::snapshot::{EgoState, Object, Snapshot};
use crate::time::seconds;
use crate::vehicle::{A_B, TAU_S};

/// Cycles that are looked ahead.
const LOOKED: u8 = 40;
/// Time between two cycles, s.
const PERIOD_S: f64 = 0.1;
/// The time left where nothing is in the way, s: all that is looked at.
pub const FREE_S: f64 = LOOKED as f64 * PERIOD_S;
/// Slower than this the CAV stands, m/s.
const STANDING: f64 = 0.5;
/// Where nothing helps any more, the time left is so much below zero for each m/s of the impact, s.
const PER_SPEED: f64 = 0.02;
/// Farther away nobody is looked at, m.
const FAR: f64 = 80.0;

/// When remote results were used for the last time: the last safe cycle in which one was current. Control may follow it
/// for some cycles more.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LastUse {
    /// When, s.
    pub t_s: f64,
    /// Speed of the CAV then, m/s.
    pub speed_mps: f64,
}

impl LastUse {
    /// When the CAV could have stood, if it had braked from the next cycle on, s.
    pub fn stands_s(&self) -> f64 {
        self.t_s + PERIOD_S + TAU_S + self.speed_mps / A_B
    }
}

/// Keeps where everybody was.
#[derive(Clone, Debug, Default)]
pub struct Danger {
    moments: Vec<Moment>,
    /// Speed of the CAV in the last cycle, m/s.
    last_speed: f64,
}

#[derive(Clone, Debug)]
struct Moment {
    t: f64,
    ego: EgoState,
    nearest: Option<f64>,
    is_remote: bool,
    is_used: bool,
    others: Vec<(u32, Rectangle)>,
}

impl Watcher for Danger {
    fn cycle(&mut self, truth: &Snapshot, _: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.last_speed = truth.ego.speed;
        let moment = Moment::new(truth, cycle.t);
        let (nearest, is_remote) = (cycle.nearest, cycle.remote != 0);
        // A group can be remote and have nothing current: then nothing of it is used (F-43).
        let [mot, plan] = [0, 1].map(|bit| cycle.remote >> bit & 1 == 1);
        let has = (mot && ran(decided, Stage::I)) || (plan && ran(decided, Stage::Ii));
        let is_used = has && cycle.failed == 0;
        self.moments.push(Moment { nearest, is_remote, is_used, ..moment });
    }

    /// A collision is after the last cycle.
    fn ended(&mut self, truth: &Snapshot, _: &Cav<'_>) {
        self.moments.push(Moment::new(truth, seconds(truth.time_ns)));
    }
}

impl Moment {
    fn new(truth: &Snapshot, t: f64) -> Self {
        let ego = truth.ego;
        let near = |it: &&Object| it.rectangle.pose.at.distance(ego.rectangle.pose.at) < FAR;
        let others = truth.objects.iter().filter(near).map(|it| (it.id, it.rectangle)).collect();
        Self { t, ego, nearest: None, is_remote: false, is_used: false, others }
    }
}

impl Danger {
    /// The least time left to react from a time on, s.
    pub fn least_time_left(&self, route: &Route, from: f64) -> f64 {
        let from = self.moments.partition_point(|it| it.t < from);
        (from..self.moments.len()).map(|at| self.time_left(route, at)).fold(FREE_S, f64::min)
    }

    /// The least distance to another from a time on, m.
    pub fn least_distance(&self, from: f64) -> Option<f64> {
        let of = self.moments.iter().filter(|it| it.t >= from).filter_map(|it| it.nearest);
        of.min_by(f64::total_cmp)
    }

    /// Times of the cycles with something remote, s.
    pub fn remote_times(&self) -> Vec<f64> {
        self.moments.iter().filter(|it| it.is_remote).map(|it| it.t).collect()
    }

    /// The last safe cycle in which something remote was current.
    pub fn last_use(&self) -> Option<LastUse> {
        let moment = self.moments.iter().rfind(|it| it.is_used)?;
        Some(LastUse { t_s: moment.t, speed_mps: moment.ego.speed })
    }

    /// Speed of the CAV in the last cycle, m/s.
    pub const fn last_speed(&self) -> f64 {
        self.last_speed
    }

    /// Who came near, by number, the nearest first.
    pub fn near(&self, within: f64) -> Vec<u32> {
        let mut least: BTreeMap<u32, f64> = BTreeMap::new();
        for moment in &self.moments {
            for (id, rectangle) in &moment.others {
                let distance = rectangle.pose.at.distance(moment.ego.rectangle.pose.at);
                let entry = least.entry(*id).or_insert(distance);
                *entry = entry.min(distance);
            }
        }
        let mut near: Vec<(u32, f64)> = least.into_iter().filter(|it| it.1 < within).collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1));
        near.into_iter().map(|(id, _)| id).collect()
    }

    /// The time left to react at a moment, s.
    pub fn time_left(&self, route: &Route, at: usize) -> f64 {
        let moment = &self.moments[at];
        let speed = moment.ego.speed;
        if speed < STANDING {
            return FREE_S;
        }
        let future: Vec<&Moment> =
            self.moments[at..].iter().take(usize::from(LOOKED) + 1).collect();
        let is_behind = |rectangle: &Rectangle| {
            let own = moment.ego.rectangle;
            let (ahead, _) = own.pose.local(rectangle.pose.at);
            let same = own.pose.cos * rectangle.pose.cos + own.pose.sin * rectangle.pose.sin;
            ahead < 0.0 && same > 0.7
        };
        let behind: Vec<u32> =
            moment.others.iter().filter(|it| is_behind(&it.1)).map(|it| it.0).collect();
        let touches = |way: &dyn Fn(f64) -> f64| {
            (0_u32..).zip(&future).find(|(step, then)| {
                let own = moved(route, &moment.ego, way(PERIOD_S * f64::from(*step)));
                let hits = |it: &&(u32, Rectangle)| {
                    !behind.contains(&it.0) && collision::overlap(&own, &it.1)
                };
                then.others.iter().find(hits).is_some()
            })
        };
        let Some((first, _)) = touches(&|t| speed * t) else { return FREE_S };
        let braking = |while_s: f64| {
            move |t: f64| {
                let for_s = (t - while_s).clamp(0.0, speed / A_B);
                speed * t.min(while_s) + speed * for_s - A_B * for_s * for_s / 2.0
            }
        };
        for step in (0..=first).rev() {
            let while_s = PERIOD_S * f64::from(step);
            if touches(&braking(while_s)).is_none() {
                return while_s;
            }
        }
        let hit = touches(&braking(0.0)).map_or(0, |it| it.0);
        -PER_SPEED * (speed - A_B * PERIOD_S * f64::from(hit)).max(0.0)
    }
}

/// Whether a stage looked at something; always, where nothing is checked.
fn ran(decided: &Decided, stage: Stage) -> bool {
    match decided.report {
        None => true,
        Some(Err(_)) => false,
        Some(Ok(report)) => {
            let outcome = report.stages[stage as usize];
            matches!(outcome, StageOutcome::Passed | StageOutcome::Failed(_))
        }
    }
}

/// The CAV's rectangle a way farther along its route, as far aside as it is now.
fn moved(route: &Route, ego: &EgoState, way: f64) -> Rectangle {
    let along = route.path.pose_at(ego.s + way);
    let at = along.ahead(0.0, ego.left);
    Rectangle { pose: Pose { at, ..along }, ..ego.rectangle }
}
