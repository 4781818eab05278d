//! The monitor (`spec/monitor.md`) beside one station that is honest, silent, late, ahead of time or lying,
//! in cycles that an adversary decides.
//!
//! * `period`: what can happen in a period, the clock, the settings.
//! * `node`: the exact monitor as a part, and when two are alike.
//! * `observer`: the properties, judged from outside.
//!
//! What is bounded: one station, one group, one period of time between two cycles, time that runs forwards,
//! a cycle with detections in every period. Every state that is reached so is visited.

mod node;
mod observer;
mod period;

use indexmap::IndexMap;
use mufasa_model::input::profile::{HardenedRule, Profile};
use mufasa_model::offloading::requester::Group;
use rustc_hash::FxBuildHasher;

use self::node::{Likeness, Node};
use self::observer::Shown;
pub use self::observer::{Law, Scene};
pub use self::period::Period;

/// What the exploration of the monitor with one group found.
#[derive(Debug)]
pub struct MonitorOutcome {
    /// In which profile.
    pub profile: Profile,
    /// The group that is offered.
    pub group: Group,
    /// Reachable states, none like another.
    pub states: usize,
    /// Periods tried.
    pub periods: u64,
    /// The laws that are broken, each with the periods of a shortest way to it.
    pub broken: Vec<(Law, Vec<Period>)>,
    /// The scenes that were seen, each with the length of a shortest way to it, periods.
    pub seen: Vec<(Scene, usize)>,
    /// The most periods until something comes out again, from any state, without faults.
    pub back_within: usize,
}

impl MonitorOutcome {
    /// A shortest way to a step that breaks the law.
    pub fn way_to(&self, law: Law) -> Option<&[Period]> {
        let broken = self.broken.iter().find(|(broken, _)| *broken == law);
        broken.map(|(_, way)| way.as_slice())
    }

    /// The scenes that a law speaks of in this profile.
    pub fn expected(&self, law: Law) -> impl Iterator<Item = Scene> {
        let brakes = self.profile.has(HardenedRule::H14);
        let is_expected = move |scene: &Scene| brakes || *scene != Scene::BrakeByPasses;
        Scene::ALL.into_iter().filter(move |it| it.laws().contains(&law)).filter(is_expected)
    }

    /// Whether every scene was seen that the law speaks of.
    pub fn shows(&self, law: Law) -> bool {
        self.expected(law).all(|scene| self.seen.iter().any(|(seen, _)| *seen == scene))
    }
}

/// The states, each with its parent and the period between them.
type States = IndexMap<Likeness, (Node, usize, Period), FxBuildHasher>;

/// The last period of a way, from the state at a place in the order of the search.
type Step = (usize, Period);

/// The first step to each law that is broken and to each scene.
#[derive(Default)]
struct Found {
    broken: Vec<(Law, Step)>,
    seen: Vec<(Scene, Step)>,
}

impl Found {
    fn note(&mut self, shown: Shown, step: Step) {
        let Self { broken, seen } = self;
        let is_new = |law: &Law| broken.iter().all(|(known, _)| known != law);
        let laws: Vec<_> = shown.broken.iter().filter(is_new).collect();
        broken.extend(laws.into_iter().map(|law| (law, step)));
        let is_new = |scene: &Scene| seen.iter().all(|(known, _)| known != scene);
        let scenes: Vec<_> = shown.seen.iter().filter(is_new).collect();
        seen.extend(scenes.into_iter().map(|scene| (scene, step)));
    }
}

/// Visits every reachable state, the nearest first.
pub fn explore(profile: Profile, group: Group) -> MonitorOutcome {
    let start = Node::new(profile, group);
    let mut states = States::default();
    states.insert(start.likeness(), (start, 0, Period::HONEST));
    let mut honest = Vec::new();
    let mut found = Found::default();
    let (mut periods, mut done) = (0, 0);
    while done < states.len() {
        let node = states[done].0.clone();
        for period in Period::ALL {
            let Some((next, shown)) = node.after(period) else { continue };
            periods += 1;
            found.note(shown, (done, period));
            let place = states.entry(next.likeness());
            let index = place.index();
            place.or_insert((next, done, period));
            if period == Period::HONEST {
                honest.push((index, shown.seen.contains(Scene::ComesOut)));
            }
        }
        done += 1;
    }
    let back_within = back_within(&honest);
    if back_within.is_none() {
        found.broken.push((Law::OffloadingComesBack, (0, Period::HONEST)));
    }
    let way = |(from, last): Step| way_to(&states, from, last);
    MonitorOutcome {
        profile,
        group,
        states: states.len(),
        periods,
        broken: found.broken.into_iter().map(|(law, step)| (law, way(step))).collect(),
        seen: found.seen.into_iter().map(|(scene, step)| (scene, way(step).len())).collect(),
        back_within: back_within.unwrap_or(0),
    }
}

/// The most honest periods until something comes out, from any state; `None`: from some it never does.
/// Each state has one honest period after it: where it leads, and whether something came out.
fn back_within(honest: &[(usize, bool)]) -> Option<usize> {
    let mut longest = 0;
    let mut known: Vec<Option<usize>> = vec![None; honest.len()];
    for start in 0..honest.len() {
        let (mut way, mut at) = (Vec::new(), start);
        let mut left = loop {
            if let Some(left) = known[at] {
                break left;
            }
            if way.len() > honest.len() {
                return None;
            }
            way.push(at);
            let (next, comes_out) = honest[at];
            if comes_out {
                break 0;
            }
            at = next;
        };
        for place in way.into_iter().rev() {
            left += 1;
            known[place] = Some(left);
        }
        longest = longest.max(left);
    }
    Some(longest)
}

/// The periods from the start to a state, and one more.
fn way_to(states: &States, mut at: usize, last: Period) -> Vec<Period> {
    let mut way = vec![last];
    while at > 0 {
        let (_, parent, period) = &states[at];
        way.push(*period);
        at = *parent;
    }
    way.reverse();
    way
}
