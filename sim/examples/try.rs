//! Runs one experiment by hand: `try VEHICLES SCENARIOS [ATTACK...]`.

use mufasa::services::configuration::Groups;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Settings, run};
use mufasa_sim::scenario::Scenario;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |index: usize| arguments.get(index).and_then(|it| it.parse().ok());
    let (vehicles, scenarios) = (number(0).unwrap_or(10), number(1).unwrap_or(3));
    let town = town();
    let mut kinds: Vec<Option<Kind>> = vec![None];
    for name in arguments.iter().skip(2) {
        kinds.extend(
            Kind::ALL.into_iter().filter(|it| it.name() == name || name == "all").map(Some),
        );
    }
    for kind in kinds {
        for variant in Variant::ALL {
            for route in town.ego_routes() {
                for seed in 0..scenarios {
                    let scenario = Scenario::draw(&town, route, vehicles, seed as u64);
                    let mut settings = Settings::new(variant, Groups::ALL, seed as u64);
                    if let Some(kind) = kind {
                        settings.attacks =
                            vec![Attack { kind, from: 5.0, until: 1e9, seed: seed as u64 }];
                    }
                    let it = run(&town, &scenario, &settings, &mut ()).expect("settings");
                    println!(
                        "{:16} {:9} route {route} seed {seed}: {:?} at {:.1} s with {:?}, least {:.2} m, \
                         remote {:?} of {}, stages {:?} other {} false {} off {}",
                        kind.map_or("-", Kind::name),
                        variant.name(),
                        it.end,
                        it.t,
                        it.with,
                        it.least_distance,
                        it.offloaded,
                        it.cycles,
                        it.stages,
                        it.other_failures,
                        it.false_alarms,
                        it.off_road
                    );
                }
            }
        }
    }
}
