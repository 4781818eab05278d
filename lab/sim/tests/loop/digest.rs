//! A watcher that takes down what a run does, as a number for each cycle.

use std::hash::{DefaultHasher, Hasher};

use mufasa::services::configuration::Groups;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Cycle, Outcome, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;

/// Start of the attacks, s.
pub const FROM: f64 = 5.0;

/// One number for each cycle: everything that the CAV has and does.
#[derive(Default)]
pub struct Log {
    pub cycles: Vec<(f64, u64)>,
    /// Where the CAV was, and how fast, bit for bit.
    pub moves: Vec<[u64; 2]>,
}

impl Watcher for Log {
    fn cycle(&mut self, truth: &Snapshot, cav: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        let mut hasher = DefaultHasher::new();
        // `attacked` says that there is an attack, not what it does.
        let cycle = Cycle { attacked: false, ..*cycle };
        let text = format!(
            "{truth:?} {:?} {:?} {:?} {:?} {decided:?} {cycle:?}",
            cav.points(),
            cav.tracks(),
            cav.counts,
            cav.services().executions
        );
        hasher.write(text.as_bytes());
        self.cycles.push((cycle.t, hasher.finish()));
        self.moves.push([cycle.s.to_bits(), cycle.speed.to_bits()]);
    }
}

/// A run of so many seconds, and who watched it.
pub fn drive<W: Watcher + Default>(
    variant: Variant,
    kind: Option<Kind>,
    (route, seed): (usize, u64),
    seconds: f64,
) -> (Outcome, W) {
    let town = town();
    let route = town.ego_routes().nth(route).expect("a route");
    let scenario = Scenario { time_limit: seconds, ..Scenario::draw(&town, route, 12, seed) };
    let mut settings = Settings::new(variant, Groups::ALL, seed);
    let attack = |kind| Attack::new(kind, FROM, 1e9, seed);
    settings.attacks = kind.into_iter().map(attack).collect();
    let mut watcher = W::default();
    let outcome = simulate(&town, &scenario, &settings, &mut watcher).expect("settings");
    (outcome, watcher)
}
