//! The junction of Ulm-Lehr, read where it lies; says so when it does not.

mod common;

use std::io::Write;
use std::path::{Path, PathBuf};

use mufasa_sim::map::ulm::lehr;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::world::World;

/// The folder of the maps, below `MUFASA_DATA` or `shared/data` beside the workspace.
fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    // A checkout may lie one folder deeper.
    let deeper = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let named = std::env::var_os("MUFASA_DATA").map(PathBuf::from);
    let places = named.map_or(vec![beside, deeper], |named| vec![named]);
    let found = places.iter().map(|place| place.join("ulm")).find(|place| place.is_dir());
    if found.is_none() {
        let line = format!("NOT RUN: no maps of Ulm in {}; set MUFASA_DATA\n", places[0].display());
        std::io::stderr().write_all(line.as_bytes()).expect("standard error can be written");
    }
    found
}

#[test]
fn the_junction_has_its_ways_and_their_conflicts() {
    let Some(folder) = folder() else { return };
    let town = lehr(&folder).unwrap().town;
    assert_eq!(town.routes.len(), 6);
    for route in &town.routes {
        assert!(
            (250.0..480.0).contains(&route.path.length()),
            "{} {}",
            route.name,
            route.path.length()
        );
        assert!(route.left.iter().chain(&route.right).all(|d| (1.5..8.0).contains(d)));
        assert!(route.limits.iter().all(|v| (5.0..30.0).contains(v)));
        eprintln!("{} {:.0} m {:?}", route.name, route.path.length(), route.passages);
        for c in &route.conflicts {
            eprintln!(
                "   {} {:.0?} {:.0?} {}",
                town.routes[c.with].name, c.here, c.there, c.gives_way
            );
        }
    }
    // Who turns left from the west waits for those from the east, who do not wait.
    let between =
        |a: usize, b: usize| town.routes[a].conflicts.iter().find(|c| c.with == b).copied();
    assert!(between(1, 2).unwrap().gives_way && !between(2, 1).unwrap().gives_way);
    // The road from the north gives way to both.
    assert!(between(4, 0).unwrap().gives_way && between(4, 2).unwrap().gives_way);
    // To the north and from the north are two lanes.
    assert!(between(3, 5).is_none());
}

#[test]
fn the_scenario_of_the_institute_runs() {
    let Some(folder) = folder() else { return };
    let lehr = lehr(&folder).unwrap();
    let file = folder.join("scenarios/test/intersection_lehr/state.json");
    let scenario = lehr.scenario(&file).unwrap();
    assert_eq!(scenario.actors.len(), 4);
    assert!((scenario.ego_speed - 6.953_881_458_831_216).abs() < 1e-12);
    let far = lehr.scenario(&folder.join("scenarios/test/traffic_jam/state.json")).unwrap_err();
    assert_eq!(far.field, "ego");
    let mut world = World::new(&lehr.town, &scenario, 0);
    for _ in 0..6000 {
        let command = common::drive(&world);
        world.step(command);
        assert!(world.collision().is_none() && world.collisions_of_others().is_empty());
    }
}

#[test]
fn nobody_collides_at_lehr() {
    let Some(folder) = folder() else { return };
    let town = lehr(&folder).unwrap().town;
    let mut arrived = 0;
    for seed in 0..40 {
        let scenario = Scenario::draw(&town, usize::from(seed % 2 == 1), 20, seed);
        let mut world = World::new(&town, &scenario, seed);
        let mut there = false;
        for step in 0..12000 {
            let command = common::drive(&world);
            world.step(command);
            there |= world.has_arrived();
            assert!(there || !world.is_off_road(), "seed {seed} step {step}");
            if step % 5 == 0 {
                let (ego, others) = (world.collision(), world.collisions_of_others());
                assert!(there || ego.is_none(), "seed {seed}, step {step}: {ego:?}");
                assert!(others.is_empty(), "seed {seed}, step {step}: {others:?}");
            }
        }
        assert_eq!(world.forced(), 0, "seed {seed}");
        arrived += i32::from(there);
    }
    assert!(arrived >= 36, "{arrived} of 40 egos arrived");
}
