//! The CAV's own plans, examined (F-48): `Settings::supervise_local`.

use std::path::Path;

use mufasa::services::configuration::Groups;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::decided::Decided;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::falsify::found::Found;
use mufasa_sim::map::streets;
use mufasa_sim::run::{Cycle, End, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;

/// How many own plans were examined, and how many of them failed.
#[derive(Default)]
struct Examined([u64; 2]);

impl Watcher for Examined {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, _: &Cycle) {
        self.0 = cav.examined();
    }
}

/// Kept collisions that came of what the CAV's own planner did, and when the stages found them, s: with plans examined
/// from then on, and not before, each is the same run up to there.
const OWN: [(&str, f64); 2] = [
    ("hardened-both-delay-and-tracks-empty-0-1018-after", 57.94),
    ("hardened-both-silent-and-tracks-empty-0-1018-after", 57.94),
];

#[test]
fn what_came_of_the_own_planner_does_not_collide_when_its_plans_are_examined() {
    let town = streets::town();
    for (name, found_s) in OWN {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("found/{name}.json"));
        let text = std::fs::read_to_string(file).expect(name);
        let found: Found = serde_json::from_str(&text).expect(name);
        let mut job = found.case.job();
        // That it collides without is tested in `falsify`.
        let mut examined = Examined::default();
        job.settings.supervise_local = Some(found_s);
        let outcome = job.run(&town, &mut examined).expect(name);
        assert_eq!(outcome.end, End::Arrived, "{name}");
        assert!(examined.0[1] > 0, "{name}: no plan failed");
    }
}

/// Of 20 clean drives with its own services alone all arrive, though some plans fail.
#[test]
fn clean_drives_arrive_though_own_plans_are_examined() {
    let town = streets::town();
    let mut all = [0, 0];
    for route in town.ego_routes() {
        for seed in 0..10 {
            let scenario = Scenario::draw(&town, route, 15, seed);
            let settings = Settings {
                supervise_local: Some(0.0),
                ..Settings::new(Variant::Hardened, Groups::NONE, seed)
            };
            let mut examined = Examined::default();
            let outcome = simulate(&town, &scenario, &settings, &mut examined).expect("it can be");
            assert_eq!(outcome.end, End::Arrived, "{route} {seed}");
            assert_eq!(examined.0[0], outcome.cycles, "in `Local` each plan is examined");
            all = [all[0] + examined.0[0], all[1] + examined.0[1]];
        }
    }
    // Each plan that fails costs braking, here in drives that arrive without it, too: fewer than one in ten.
    assert!(all[1] > 0 && all[1] * 10 < all[0], "{all:?}");
}
