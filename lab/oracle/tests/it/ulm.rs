//! Experiments on the map of Ulm-Lehr, where it lies; says so when it does not (`mufasa evaluate --map`).

use std::fs;
use std::path::{Path, PathBuf};

use crate::kit::{self, folder};
use crate::maps::maps;
use serde_json::Value;

const SIZE: [&str; 5] = ["failures", "--scenarios", "1", "--vehicles", "4"];

/// What a command says that ends with this code.
fn said(folder: &Path, arguments: &[&str], code: i32) -> String {
    let told = kit::said(folder, arguments);
    told.has(code, "", "");
    told.out + &told.err
}

fn on_map() -> Option<String> {
    let folder = fs::canonicalize(maps()?).expect("it is there");
    Some(folder.display().to_string())
}

#[test]
fn parts_are_of_one_map_and_make_the_whole() {
    let Some(map) = on_map() else { return };
    let folder = folder("parts");
    let evaluate = |more: &[&str]| {
        said(&folder, &[&["evaluate"], &SIZE[..], more].concat(), 0);
    };
    evaluate(&["--map", &map, "--out", "whole"]);
    evaluate(&["--map", &map, "--out", "parts", "--shard", "1/2"]);
    evaluate(&["--map", &map, "--out", "parts", "--shard", "2/2"]);
    evaluate(&["--out", "town", "--shard", "2/2"]);
    let part = |place: &str, index| format!("{place}/failures.{index}-of-2.part.json");
    let (one, two, town) = (part("parts", 1), part("parts", 2), part("town", 2));
    said(&folder, &["merge", &one, &two, "--map", &map, "--out", "merged"], 0);
    for name in ["failures.json", "failures-runs.csv", "report.html"] {
        let file = |place: &str| fs::read(folder.join(place).join(name)).expect("a file");
        assert!(file("whole") == file("merged"), "{name}");
    }
    let text = fs::read_to_string(folder.join("whole/failures.json")).expect("it is there");
    let made: Value = serde_json::from_str(&text).expect("JSON");
    let id = made["options"]["map"].as_str().expect("a map");
    assert!(id.starts_with("ulm-lehr-"), "{id}");
    let without = said(&folder, &["merge", &one, &two], 2);
    assert!(without.contains(id) && without.contains("by --map"), "{without}");
    let mixed = said(&folder, &["merge", &one, &town, "--map", &map], 2);
    assert!(mixed.contains("map: Lehr(") && mixed.contains("map: Town"), "{mixed}");
}

#[test]
fn a_run_is_drawn_by_its_id_and_its_map() {
    let Some(map) = on_map() else { return };
    let folder = folder("replay");
    let only = ["--only", "failures/sofof/empty-tracks", "--out", "out", "--map", &map];
    said(&folder, &[&["evaluate"], &SIZE[..], &only].concat(), 0);
    let text = fs::read_to_string(folder.join("out/failures.json")).expect("it is there");
    let made: Value = serde_json::from_str(&text).expect("JSON");
    let id = "failures/sofof/empty-tracks/lehr-1/0";
    let runs = made["runs"].as_array().expect("runs");
    let run = runs.iter().find(|it| it["id"] == id).expect("it is one of them");
    let replay = ["evaluate", "replay", "--scenarios", "1", "--vehicles", "4", "--run", id];
    let again = said(&folder, &[&replay[..], &["--map", &map]].concat(), 0);
    let time = format!("{:.2} s", run["t_s"].as_f64().expect("a time"));
    let end = run["end"].as_str().expect("an end");
    assert!(again.to_lowercase().contains(end) && again.contains(&time), "{again} {run}");
    assert!(folder.join("failures-sofof-empty-tracks-lehr-1-0.html").exists());
    let town = said(&folder, &replay, 2);
    assert!(town.contains("on town has such an id"), "{town}");
}

#[test]
fn a_collision_names_its_map() {
    let Some(map) = on_map() else { return };
    let folder = folder("found");
    let search = ["evaluate", "falsify", "--profile", "sofof", "--attack", "empty-tracks"];
    let size = ["--runs", "30", "--map", &map, "--out", "out"];
    said(&folder, &[&search[..], &size].concat(), 0);
    let found = fs::read_dir(folder.join("out/found")).expect("a folder");
    let files: Vec<PathBuf> = found.map(|it| it.expect("an entry").path()).collect();
    let is_json = |it: &&PathBuf| it.extension().is_some_and(|it| it == "json");
    let file = files.iter().find(is_json).expect("a collision is found in so many runs");
    let name = file.display().to_string();
    assert!(name.contains("-lehr-"), "{name}");
    let text = fs::read_to_string(file).expect("it is there");
    let found: Value = serde_json::from_str(&text).expect("JSON");
    let id = found["case"]["map"].as_str().expect("a map");
    let again = said(&folder, &["evaluate", "replay", &name, "--map", &map], 0);
    let time = format!("Collided at {:.2} s", found["t_s"].as_f64().expect("a time"));
    assert!(again.contains(&time), "{again}");
    let town = said(&folder, &["evaluate", "replay", &name], 2);
    assert!(town.contains(id) && town.contains("by --map"), "{town}");
}

#[test]
fn a_folder_without_the_map_is_refused() {
    let folder = folder("none");
    fs::create_dir(folder.join("empty")).expect("it can be made");
    for command in [&["stages"][..], &["falsify", "--runs", "1"], &["replay"]] {
        let of = |name| [&["evaluate"], command, &["--map", name]].concat();
        let nothing = said(&folder, &of("nothing"), 2);
        assert!(nothing.contains("nothing: no such folder"), "{nothing}");
        let empty = said(&folder, &of("empty"), 2);
        assert!(empty.contains("empty/maps/ulm/state.json: "), "{empty}");
    }
}
