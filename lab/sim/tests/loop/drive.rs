//! A short run, and who watched it.

use mufasa::services::configuration::Groups;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Outcome, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;

/// Start of the attacks, s.
pub const FROM: f64 = 5.0;

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
