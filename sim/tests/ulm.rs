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
        let line = format!(
            "NOT RUN: {}: no maps of Ulm in {}; set MUFASA_DATA\n",
            std::thread::current().name().unwrap_or("a test"),
            places[0].display()
        );
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

/// A folder with one map file for all ways, made by `change` from a good table of 800 rows.
fn copy(name: &str, change: impl Fn(&mut String, &mut Vec<f64>)) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("mufasa-ulm-{}-{name}", std::process::id()));
    let set = folder.join("maps/ulm");
    std::fs::create_dir_all(set.join("extern")).unwrap();
    let ways = [
        "west_to_east",
        "west_to_north",
        "east_to_west",
        "east_to_north",
        "north_to_east",
        "north_to_west",
    ];
    let maps: Vec<String> =
        ways.map(|way| format!("\"{way}\": {{\"name\": \"lehr_crossing_{way}\"}}")).to_vec();
    std::fs::write(set.join("state.json"), format!("{{{}}}", maps.join(", "))).unwrap();
    let row = |i: i32| [571_450.0 + 0.5 * f64::from(i), 5_364_810.0, 2.0, 2.5, 10.0, 500.0];
    let mut cells: Vec<f64> = (0..800).flat_map(row).collect();
    let mut header = String::from("{'descr': '<f8', 'fortran_order': False, 'shape': (800, 6), }");
    change(&mut header, &mut cells);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(cells.iter().flat_map(|cell| cell.to_le_bytes()));
    for way in ways {
        std::fs::write(set.join(format!("extern/{way}.control_points.npy")), &bytes).unwrap();
    }
    folder
}

#[test]
fn a_map_is_read_or_its_broken_field_is_named() {
    let good = copy("good", |_, _| {});
    let town = lehr(&good).unwrap().town;
    let route = &town.routes[0];
    assert!((route.path.length() - 389.5).abs() < 1.0, "{}", route.path.length());
    assert_eq!(route.half_widths_at(100.0), (2.0, 2.5));
    assert!(
        (route.path.pose_at(0.0).at.x + 195.0).abs() < 1.0
            && route.limits[9].to_bits() == 10.0_f64.to_bits()
    );
    let field = |name: &str, change: &dyn Fn(&mut String, &mut Vec<f64>)| {
        let folder = copy(name, change);
        let error = lehr(&folder).unwrap_err();
        std::fs::remove_dir_all(&folder).unwrap();
        error.field
    };
    assert_eq!(field("a", &|h, _| *h = h.replace("<f8", "<f4")), "descr");
    assert_eq!(field("b", &|h, _| *h = h.replace("False", "True")), "fortran_order");
    assert_eq!(field("c", &|h, _| *h = h.replace("800", "801")), "shape");
    assert_eq!(field("d", &|h, _| *h = h.replace(", 6", ", 5")), "shape");
    assert_eq!(field("e", &|_, c| c[6 * 7 + 4] = f64::NAN), "speed_limit[7]");
    assert_eq!(field("f", &|_, c| c.iter_mut().step_by(6).for_each(|x| *x = 0.0)), "x");
    std::fs::remove_file(good.join("maps/ulm/extern/north_to_west.control_points.npy")).unwrap();
    assert!(lehr(&good).unwrap_err().file.ends_with("north_to_west.control_points.npy"));
    std::fs::write(good.join("maps/ulm/state.json"), "{}").unwrap();
    assert_eq!(lehr(&good).unwrap_err().field, "name");
    std::fs::remove_dir_all(&good).unwrap();
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
