//! Counts of changed verdicts.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use mufasa_drives::check::judge::is_safe;
use mufasa_drives::check::words::{self, failed_witness};
use mufasa_link::message::EncodeError;
use mufasa_props::conformance::{Answer, name};
use serde_json::json;

/// A cycle before and after it was sent.
pub struct Change {
    pub drive: String,
    pub cycle: String,
    pub before: Answer,
    pub after: Result<Answer, EncodeError>,
}

/// What became of the cycles of one profile on one way.
pub struct Tally {
    profile: &'static str,
    way: &'static str,
    pub drives: usize,
    cycles: usize,
    refused: BTreeMap<String, usize>,
    to_unsafe: usize,
    to_safe: usize,
    other: usize,
    /// How often which verdict became which, by stage and rule.
    kinds: BTreeMap<[String; 2], usize>,
    changed: Vec<serde_json::Value>,
}

impl Tally {
    pub fn new(profile: &'static str, way: &'static str) -> Self {
        let (refused, kinds, changed) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        let [drives, cycles, to_unsafe, to_safe, other] = [0; 5];
        Self { profile, way, drives, cycles, refused, to_unsafe, to_safe, other, kinds, changed }
    }

    pub fn add(&mut self, change: Change) {
        self.cycles += 1;
        let Change { drive, cycle, before, after } = change;
        let after = match after {
            Ok(after) => after,
            Err(error) => {
                let place = format!("{}.{}", error.place.part, error.place.field);
                *self.refused.entry(place).or_default() += 1;
                return;
            }
        };
        let kinds = [kind(&before), kind(&after)];
        if kinds[0] == kinds[1] {
            return;
        }
        match [is_safe(&before), is_safe(&after)] {
            [true, false] => self.to_unsafe += 1,
            [false, true] => self.to_safe += 1,
            [true, true] | [false, false] => self.other += 1,
        }
        *self.kinds.entry(kinds).or_default() += 1;
        let [before, after] = [before, after].map(|answer| words::answer(&answer));
        self.changed.push(json!({
            "profile": self.profile, "way": self.way, "drive": drive, "cycle": cycle, "before": before,
            "after": after,
        }));
    }
}

/// `safe`, or the stage that fails and its rule.
fn kind(answer: &Answer) -> String {
    let Ok(report) = answer else { return "error".to_owned() };
    let stage = name(report.failed_stage);
    match failed_witness(report) {
        Some(witness) => format!("{stage} {:?}", witness.rule),
        None => stage.to_owned(),
    }
}

/// Both tables in Markdown.
pub fn tables(tallies: &[Tally]) -> String {
    let mut text =
        "| sent | profile | drives | cycles | cannot be sent | safe to unsafe | unsafe to safe | \
                    another stage or rule |\n|---|---|--:|--:|--:|--:|--:|--:|\n"
            .to_owned();
    for tally in tallies {
        let Tally { profile, way, drives, cycles, refused, to_unsafe, to_safe, other, .. } = tally;
        let refused: usize = refused.values().sum();
        // Writing to a text cannot fail.
        let _ = writeln!(
            text,
            "| {way} | {profile} | {drives} | {cycles} | {refused} | {to_unsafe} | {to_safe} | {other} |"
        );
    }
    text.push_str("\n| sent | profile | before | after | cycles |\n|---|---|---|---|--:|\n");
    for Tally { profile, way, kinds, refused, .. } in tallies {
        for ([before, after], count) in kinds {
            let _ = writeln!(text, "| {way} | {profile} | {before} | {after} | {count} |");
        }
        for (place, count) in refused {
            let _ =
                writeln!(text, "| {way} | {profile} | any | `{place}` does not fit | {count} |");
        }
    }
    text
}

/// Every changed cycle, in words.
pub fn json(tallies: &[Tally]) -> String {
    let changed: Vec<_> = tallies.iter().flat_map(|tally| &tally.changed).collect();
    format!("{:#}\n", json!({ "changed": changed }))
}
