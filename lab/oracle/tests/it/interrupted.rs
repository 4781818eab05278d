//! A search that is ended before its end leaves what it found, and does not look complete.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::kit::{folder, said};
use serde_json::Value;

/// A search in which nothing is checked, so that it finds much; sent a signal once it has. What it said.
fn interrupted(folder: &Path, signal: &str, more: &[&str]) -> String {
    let search = ["--verbose", "evaluate", "falsify", "--profile", "sofof", "--vehicles", "8"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.args(search).args(["--attack", "empty-tracks"]).args(more).current_dir(folder);
    let mut running =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
    let mut said = BufReader::new(running.stderr.take().expect("it is piped")).lines();
    let finds = |line: &std::io::Result<String>| {
        let line = line.as_ref().expect("UTF-8");
        line.contains(" collisions") && !line.contains(" 0 collisions")
    };
    assert!(said.any(|line| finds(&line)), "it ended");
    let id = running.id().to_string();
    assert!(Command::new("kill").args([signal, &id]).status().expect("kill runs").success());
    said.for_each(drop);
    let mut told = String::new();
    running.stdout.take().expect("it is piped").read_to_string(&mut told).expect("UTF-8");
    assert_eq!(running.wait().expect("it ends").code(), Some(130), "{told}");
    assert!(told.contains("INTERRUPTED: "), "{told}");
    told
}

#[test]
fn an_interrupted_search_leaves_what_it_found() {
    let folder = folder("whole");
    let told = interrupted(&folder, "-INT", &["--minutes", "60", "--out", "left"]);
    assert!(told.contains(" empty-tracks "), "{told}");
    let text = |name: &str| fs::read_to_string(folder.join("left").join(name)).expect("written");
    let made: Value = serde_json::from_str(&text("falsify.json")).expect("JSON");
    assert_eq!(made["interrupted"], true);
    assert!(made["collided"].as_u64().expect("a count") > 0, "{told}");
    assert!(text("report.html").contains("interrupted: yes"), "{}", text("report.html"));
    assert!(text("falsify.csv").contains("empty-tracks"));
    let found = fs::read_dir(folder.join("left/found")).expect("a folder");
    let found = found.map(|it| it.expect("an entry").path());
    let kept = found.filter(|it| it.extension().is_some_and(|it| it == "json"));
    let kept: Vec<_> = kept.collect();
    assert_eq!(kept.len(), made["found"].as_array().expect("a list").len());
    let replay = ["evaluate", "replay", kept[0].to_str().expect("a name"), "--out", "page.html"];
    said(&folder, &replay).has(0, "Collided", "");
}

#[test]
fn an_interrupted_part_holds_what_was_found_and_is_no_part() {
    let folder = folder("part");
    interrupted(&folder, "-TERM", &["--rounds", "100000", "--shard", "1/1", "--out", "left"]);
    let file = "left/falsify.1-of-1.part.json";
    let text = fs::read_to_string(folder.join(file)).expect("written");
    let part: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(part["interrupted"], true);
    let rounds = part["runs"].as_object().expect("rounds").values();
    let found = rounds.map(|it| it["found"].as_array().expect("a list").len()).sum::<usize>();
    assert!(found > 0, "{text}");
    let why = format!("{file}: it was interrupted, and is no part");
    said(&folder, &["merge", file]).has(2, "", &why);
}
