//! Random bytes and damaged records: one JSON answer per line, in order, and no crash.

use std::collections::BTreeMap;

use mufasa_conform::reference as oracle;
use serde_json::Value;

use crate::oracle::common::{COMPOSITION, CYCLE, Random, TRACE};

const LINES: usize = 100_000;
const SEED: u64 = 5;

/// CYCLE-07, CYCLE-08
#[test]
fn each_of_100_000_damaged_lines_has_one_answer_in_order() {
    let mut random = Random::new(SEED);
    let lines: Vec<Vec<u8>> = (0..LINES).map(|number| line(&mut random, number)).collect();
    let mut output = Vec::new();
    oracle::run(lines.join(&b'\n').as_slice(), &mut output, oracle::by_model).unwrap();
    let output = String::from_utf8(output).expect("answers are UTF-8");
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let mut answers = output.lines();
    for (index, line) in lines.iter().enumerate() {
        let shown = String::from_utf8_lossy(line);
        let answer: Value = answers
            .next()
            .and_then(|answer| serde_json::from_str(answer).ok())
            .unwrap_or_else(|| panic!("no answer to {shown}"));
        let kind = check(index, line, &answer).unwrap_or_else(|| panic!("{shown}\n{answer}"));
        *seen.entry(kind).or_default() += 1;
    }
    assert_eq!(answers.next(), None);
    // The damage is light enough that every kind of answer occurs often.
    for kind in ["safe", "unsafe", "error", "known", "states", "compositions"] {
        assert!(seen.get(kind).is_some_and(|count| *count > 200), "{kind}: {seen:?}");
    }
}

/// The kind of an answer that fits its line; `known` is an error of a record whose id was read.
fn check(index: usize, line: &[u8], answer: &Value) -> Option<String> {
    let id = id(line);
    if answer.get("states").or(answer.get("compositions")).is_some() {
        let kind = if answer["states"].is_array() { "states" } else { "compositions" };
        return (answer["id"] == id? && answer[kind].is_array()).then(|| kind.into());
    }
    match answer["verdict"].as_str()? {
        "error" => {
            let error = &answer["error"];
            let fits = error["line"] == index + 1
                && error["field"].is_string()
                && (error["index"].is_null() || error["index"].is_u64())
                && error["message"].is_string()
                && answer["failed_stage"].is_null();
            let known = answer["id"].is_string();
            let id_fits = if known { Some(&answer["id"]) == id.as_ref() } else { id.is_none() };
            (fits && id_fits).then(|| String::from(if known { "known" } else { "error" }))
        }
        verdict @ ("safe" | "unsafe") => {
            let fits = answer["failed_stage"].is_null() == (verdict == "safe");
            (answer["id"] == id? && fits && answer["stages"]["v"].is_object())
                .then(|| verdict.into())
        }
        _ => None,
    }
}

/// The id of a line as another reader finds it: of a JSON object, given once, a string.
fn id(line: &[u8]) -> Option<Value> {
    struct Ids(Vec<Value>);
    impl<'de> serde::de::Visitor<'de> for Ids {
        type Value = Vec<Value>;
        fn expecting(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            out.write_str("an object")
        }
        fn visit_map<M: serde::de::MapAccess<'de>>(
            mut self,
            mut map: M,
        ) -> Result<Vec<Value>, M::Error> {
            while let Some(key) = map.next_key::<String>()? {
                if key == "id" {
                    self.0.push(map.next_value()?);
                } else {
                    map.next_value::<serde::de::IgnoredAny>()?;
                }
            }
            Ok(self.0)
        }
    }
    let text = std::str::from_utf8(line).ok()?;
    let mut reader = serde_json::Deserializer::from_str(text);
    let mut ids = serde::Deserializer::deserialize_map(&mut reader, Ids(Vec::new())).ok()?;
    reader.end().ok()?;
    let id = ids.pop().filter(Value::is_string)?;
    ids.is_empty().then_some(id)
}

/// Random bytes, random tokens, or a record with some damage; no newline.
fn line(random: &mut Random, number: usize) -> Vec<u8> {
    let mut line = match random.below(10) {
        0 => (0..random.below(60)).map(|_| random.byte()).collect(),
        1 => tokens(random),
        _ => {
            let (record, id) =
                *random.pick(&[(CYCLE, "\"c\""), (TRACE, "\"o\""), (COMPOSITION, "\"s\"")]);
            let mut line = record.replacen(id, &format!("\"{number}\""), 1).into_bytes();
            for _ in 0..=random.below(2) {
                damage(random, &mut line);
            }
            line
        }
    };
    line.retain(|byte| *byte != b'\n');
    line
}

fn tokens(random: &mut Random) -> Vec<u8> {
    let words = [
        "{",
        "}",
        "[",
        "]",
        ":",
        ",",
        "\"kind\"",
        "\"cycle\"",
        "\"id\"",
        "\"a\"",
        "\"ego\"",
        "1",
        "-",
        "0",
        "1e5",
        "null",
        "true",
        "\"",
        "\\",
        "\\u",
        " ",
        "\t",
        "\u{e9}",
        "\"\\ud800\"",
    ];
    (0..random.below(30)).flat_map(|_| random.pick(&words).bytes()).collect()
}

fn damage(random: &mut Random, line: &mut Vec<u8>) {
    if line.is_empty() {
        return;
    }
    let place = random.below(line.len());
    match random.below(9) {
        0 => line[place] ^= 1 << random.below(8),
        1 => line.truncate(place),
        2 => line.insert(place, random.byte()),
        3 => {
            line.remove(place);
        }
        4 => {
            // A part of the line a second time: often a key with its value.
            let from = line[..place].iter().rposition(|byte| *byte == b',').unwrap_or(0);
            let part = line[from..place].to_vec();
            line.splice(place..place, part);
        }
        _ => number(random, line),
    }
}

/// Puts another number in the place of one.
fn number(random: &mut Random, line: &mut Vec<u8>) {
    let values = [
        "0",
        "1",
        "-1",
        "1.5",
        "1e3",
        "-0",
        "4.8",
        "1e400",
        "5e-324",
        "\"nan\"",
        "\"inf\"",
        "null",
        "9223372036854775807",
        "9223372036854775808",
        "-9223372036854775808",
        "900",
        "1000",
        "950",
        "true",
        "[]",
        "{}",
        "\"mot\"",
        "16777216",
        "0.01",
        "100",
    ];
    let is_part = |byte: &u8| matches!(byte, b'0'..=b'9' | b'-' | b'.' | b'e' | b'E' | b'+');
    let starts: Vec<usize> = (1..line.len())
        .filter(|i| is_part(&line[*i]) && matches!(line[i - 1], b' ' | b'['))
        .collect();
    if starts.is_empty() {
        return;
    }
    let start = *random.pick(&starts);
    let length = line[start..].iter().take_while(|byte| is_part(byte)).count();
    line.splice(start..start + length, random.pick(&values).bytes());
}
