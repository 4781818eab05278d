//! The junction of Ulm-Lehr, read where it lies; says so when it does not.

use std::path::PathBuf;

use crate::common::maps::maps;
use mufasa_sim::map::id::MapId;
use mufasa_sim::map::ulm::lehr;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::traffic::idm::Idm;
use mufasa_sim::world::World;
use serde_json::{Value, json};

#[test]
fn the_junction_has_its_ways_and_their_conflicts() {
    let Some(folder) = maps() else { return };
    let town = lehr(&folder).unwrap();
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

/// A folder with one map file for all ways and a scenario, made by `change` from a good table of 800 rows and
/// a good scenario.
fn copy(name: &str, change: impl Fn(&mut String, &mut Vec<f64>, &mut Value)) -> PathBuf {
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
    let idm = json!({"time_headway": 1.5, "gap_min": 2.0, "a": 1.5, "b": 3.0, "delta": 4.0});
    let car = |map: &str| {
        json!({"map_uuid": map, "x": 571_600.0, "y": 5_364_812.0, "v": 7.0, "target_v": 9.0,
            "length": 4.0, "width": 2.0, "params_idm": idm})
    };
    let mut scenario = json!({"ego": {"x": 571_500.0, "y": 5_364_811.0, "v": 6.5},
        "cars": [car("elsewhere"), car("east_to_west")]});
    change(&mut header, &mut cells, &mut scenario);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(cells.iter().flat_map(|cell| cell.to_le_bytes()));
    for way in ways {
        std::fs::write(set.join(format!("extern/{way}.control_points.npy")), &bytes).unwrap();
    }
    let file = folder.join(SCENARIO);
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(file, scenario.to_string()).unwrap();
    folder
}

const SCENARIO: &str = "scenarios/test/intersection_lehr/state.json";

#[test]
fn a_map_is_read_or_its_broken_field_is_named() {
    let good = copy("good", |_, _, _| {});
    let town = lehr(&good).unwrap();
    let route = &town.routes[0];
    assert!((route.path.length() - 389.5).abs() < 1.0, "{}", route.path.length());
    assert_eq!(route.half_widths_at(100.0), (2.0, 2.5));
    assert!(
        (route.path.pose_at(0.0).at.x + 195.0).abs() < 1.0
            && route.limits[9].to_bits() == 10.0_f64.to_bits()
    );
    let [start] = &town.given.starts[..] else { panic!("{:?}", town.given) };
    assert!((start.ego_s - 45.0).abs() < 0.6, "{start:?}");
    assert_eq!((start.ego_speed.to_bits(), start.ego_route), (6.5_f64.to_bits(), 1));
    let [car] = &start.actors[..] else { panic!("{start:?}") };
    assert!(car.route == 2 && (car.s - 145.0).abs() < 0.6, "{car:?}");
    assert_eq!(town.given.drivers, [Idm { v0: 9.0, ..Idm::default() }]);
    let field = |name: &str, change: &dyn Fn(&mut String, &mut Vec<f64>, &mut Value)| {
        let folder = copy(name, change);
        let error = lehr(&folder).unwrap_err();
        std::fs::remove_dir_all(&folder).unwrap();
        error.field
    };
    assert_eq!(field("a", &|h, _, _| *h = h.replace("<f8", "<f4")), "descr");
    assert_eq!(field("b", &|h, _, _| *h = h.replace("False", "True")), "fortran_order");
    assert_eq!(field("c", &|h, _, _| *h = h.replace("800", "801")), "shape");
    assert_eq!(field("d", &|h, _, _| *h = h.replace(", 6", ", 5")), "shape");
    assert_eq!(field("e", &|_, c, _| c[6 * 7 + 4] = f64::NAN), "speed_limit[7]");
    assert_eq!(field("f", &|_, c, _| c.iter_mut().step_by(6).for_each(|x| *x = 0.0)), "x");
    assert_eq!(field("g", &|_, c, _| c[6 * 9 + 4] = 0.0), "speed_limit[9]");
    assert_eq!(field("h", &|_, c, _| c[6 * 9 + 3] = -1.0), "d_right[9]");
    assert_eq!(
        field("i", &|_, c, _| c.iter_mut().skip(1).step_by(6).for_each(|y| *y += 190.0)),
        "x"
    );
    assert_eq!(field("j", &|_, _, s| s["ego"]["y"] = json!(5_364_814.0)), "ego");
    assert_eq!(field("k", &|_, _, s| s["ego"]["v"] = json!(-0.1)), "ego.v");
    let car = |name: &str, column: &str, value: f64| {
        field(name, &|_, _, s| *s["cars"][1].pointer_mut(column).unwrap() = json!(value))
    };
    assert_eq!(car("l", "/params_idm/delta", 3.0), "cars[1].params_idm.delta");
    assert_eq!(car("m", "/params_idm/a", 0.0), "cars[1].params_idm.a");
    assert_eq!(car("n", "/width", 0.0), "cars[1].width");
    assert_eq!(car("o", "/v", -1.0), "cars[1].v");
    assert_eq!(car("p", "/params_idm/gap_min", -1.0), "cars[1].params_idm.gap_min");
    assert_eq!(field("q", &|_, _, s| s["cars"] = json!(3)), "");
    std::fs::remove_file(good.join(SCENARIO)).unwrap();
    assert!(lehr(&good).unwrap_err().file.ends_with(SCENARIO));
    std::fs::remove_file(good.join("maps/ulm/extern/north_to_west.control_points.npy")).unwrap();
    assert!(lehr(&good).unwrap_err().file.ends_with("north_to_west.control_points.npy"));
    std::fs::write(good.join("maps/ulm/state.json"), "{}").unwrap();
    assert_eq!(lehr(&good).unwrap_err().field, "name");
    std::fs::remove_dir_all(&good).unwrap();
    assert_eq!(lehr(&good).unwrap_err().file, good);
}

/// A map is another one when a byte of its files is another one.
#[test]
fn a_map_is_known_by_what_is_in_its_files() {
    let id = |name: &str, change: &dyn Fn(&mut String, &mut Vec<f64>, &mut Value)| {
        let folder = copy(name, change);
        let id = lehr(&folder).unwrap().id;
        std::fs::remove_dir_all(&folder).unwrap();
        id
    };
    let good = id("one", &|_, _, _| {});
    assert_eq!(good, id("same", &|_, _, _| {}));
    assert_ne!(good, id("wider", &|_, c, _| c[2] = 2.1));
    assert_ne!(good, id("slower", &|_, _, s| s["ego"]["v"] = json!(6.0)));
    let text = good.to_string();
    assert!(text.starts_with("ulm-lehr-") && text.parse() == Ok(good), "{text}");
    assert_eq!("town".parse(), Ok(MapId::Town));
    for wrong in ["", "Town", "ulm-lehr-", "ulm-lehr-12", "ulm-lehr-+123456789abcdef"] {
        assert!(wrong.parse::<MapId>().is_err(), "{wrong}");
    }
}

#[test]
fn the_scenario_of_the_institute_runs() {
    let Some(folder) = maps() else { return };
    let town = lehr(&folder).unwrap();
    let [given] = &town.given.starts[..] else { panic!("{:?}", town.given) };
    assert_eq!((given.ego_route, given.actors.len(), town.given.drivers.len()), (1, 4, 4));
    assert!((given.ego_speed - 6.953_881_458_831_216).abs() < 1e-12);
    let drawn: Vec<Scenario> =
        (0..40).map(|seed| Scenario::draw(&town, given.ego_route, 4, seed)).collect();
    let begins = |it: &&Scenario| it.ego_s.to_bits() == given.ego_s.to_bits();
    let as_given: Vec<&Scenario> = drawn.iter().filter(begins).collect();
    assert!((10..=30).contains(&as_given.len()), "about half of {}", as_given.len());
    for scenario in &drawn {
        assert!(scenario.actors.iter().all(|it| town.given.drivers.contains(&it.idm)));
    }
    for scenario in as_given {
        assert_eq!(scenario.ego_speed.to_bits(), given.ego_speed.to_bits());
        assert_eq!(scenario.actors, given.actors);
    }
    assert!(Scenario::draw(&town, 4, 4, 0).ego_s < 21.0, "nothing is given from the north");
}

#[test]
fn nobody_collides_at_lehr() {
    let Some(folder) = maps() else { return };
    let town = lehr(&folder).unwrap();
    let routes: Vec<usize> = town.ego_routes().collect();
    assert_eq!(routes, [1, 4]);
    let mut arrived = 0;
    for seed in 0..40 {
        let scenario = Scenario::draw(&town, routes[usize::from(seed % 2 == 1)], 15, seed);
        let mut world = World::new(&town, &scenario, seed);
        let mut there = false;
        for step in 0..12000 {
            let command = crate::common::drive(&world);
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
