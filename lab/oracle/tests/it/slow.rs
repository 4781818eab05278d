//! `mufasa slow`.

use std::fs;
use std::process::Command;

use mufasa_props::bridge::check_impl;
use mufasa_records::{Record, parse};

use crate::kit::folder;

/// The tracks it finds take more instructions than those of W1, and are valid input.
#[test]
fn slower_cycles_are_found() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("NOT RUN: mufasa slow: there is no valgrind");
        return;
    }
    let out = folder("slow");
    let run = Command::new(env!("CARGO_BIN_EXE_mufasa"))
        .args(["slow", "-q", "--of", "iii", "--rounds", "2", "--out"])
        .arg(&out)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let table = fs::read_to_string(out.join("slow.md")).unwrap();
    for profile in ["paper", "hardened"] {
        let row = table.lines().find(|line| line.starts_with(&format!("| {profile} iii"))).unwrap();
        let cells: Vec<u64> = row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
        assert!(cells[1] > 2 * cells[0], "{row}");
    }
    let records = fs::read_to_string(out.join("slow.jsonl")).unwrap();
    for (line, number) in records.lines().zip(1..) {
        let Ok(Record::Cycle { cycle, .. }) = parse(line.as_bytes(), number) else {
            panic!("{line} is no cycle")
        };
        assert!(check_impl(&cycle).is_ok());
    }
    assert_eq!(records.lines().count(), 2);
}
