//! Counts of changed verdicts.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use mufasa_drives::check::judge::is_safe;
use mufasa_drives::check::words;
use mufasa_link::message::EncodeError;
use mufasa_props::conformance::{Answer, name};
use serde_json::json;

/// A cycle before and after it was sent.
pub struct Change {
    pub drive: String,
    pub cycle: String,
    pub before: Answer,
    pub after: Result<Answer, EncodeError>,
    /// How little would have turned the verdict before, m.
    pub slack_m: Option<f64>,
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
    /// How often which verdict became which, by stage and rule, and the greatest slack of them.
    kinds: BTreeMap<[String; 2], (usize, Option<f64>)>,
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
        let Change { drive, cycle, before, after, slack_m } = change;
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
        let (count, slack) = self.kinds.entry(kinds).or_insert((0, Some(0.0)));
        *count += 1;
        *slack = slack.zip(slack_m).map(|(most, slack_m)| slack_m.max(most));
        let [before, after] = [before, after].map(|answer| words::answer(&answer));
        self.changed.push(json!({
            "profile": self.profile, "way": self.way, "drive": drive, "cycle": cycle, "before": before,
            "after": after, "slack_m": slack_m,
        }));
    }
}

/// `safe`, or the stage that fails and its rule.
fn kind(answer: &Answer) -> String {
    let Ok(report) = answer else { return "error".to_owned() };
    let stage = name(report.failed_stage);
    match report.witness() {
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
    text.push_str(
        "\n| sent | profile | before | after | cycles | slack |\n|---|---|---|---|--:|--:|\n",
    );
    for Tally { profile, way, kinds, refused, .. } in tallies {
        for ([before, after], (count, slack_m)) in kinds {
            let slack =
                slack_m.map_or("-".to_owned(), |slack_m| format!("{:.1} mm", slack_m * 1e3));
            let _ =
                writeln!(text, "| {way} | {profile} | {before} | {after} | {count} | {slack} |");
        }
        for (place, count) in refused {
            let _ = writeln!(
                text,
                "| {way} | {profile} | any | `{place}` does not fit | {count} | - |"
            );
        }
    }
    text
}

/// Every changed cycle, in words.
pub fn json(tallies: &[Tally]) -> String {
    let changed: Vec<_> = tallies.iter().flat_map(|tally| &tally.changed).collect();
    format!("{:#}\n", json!({ "changed": changed }))
}
