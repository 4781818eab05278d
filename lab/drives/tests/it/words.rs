//! What a witness says in words, for every cycle of `vectors/` that fails, and what is said of invalid input.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use mufasa_drives::check::words;
use mufasa_model::input::cycle::Profile;
use mufasa_model::input::domain::{Problem, first_problem};
use mufasa_model::numbers::reading::Reading;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::Rule;
use mufasa_props::strategy::{draw::Draw, input};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// The cycles of the vectors, each on a line of its own.
fn cycles() -> String {
    let mut lines = String::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vectors");
    let folders = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    for folder in folders.filter(|path| path.is_dir()) {
        for file in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if file.extension().is_none_or(|it| it != "jsonl") {
                continue;
            }
            for line in fs::read_to_string(file).unwrap().lines() {
                let vector: Value = serde_json::from_str(line).unwrap();
                if vector["input"]["kind"] == "cycle" {
                    lines.push_str(&vector["input"].to_string());
                    lines.push('\n');
                }
            }
        }
    }
    lines
}

/// The two numbers in brackets at the end and how they compare; `None` where there is one, and the other
/// is the same double.
fn compared(words: &str) -> Option<(f64, &str, f64)> {
    let inner = words.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap();
    if let Some(one) = inner.strip_suffix(" by less than doubles tell apart") {
        assert!(one.starts_with("above ") || one.starts_with("below "), "{words}");
        return None;
    }
    let parts: Vec<_> = inner.split(' ').filter(|it| !["m", "s"].contains(it)).collect();
    let [left, relation, right] = parts[..] else { panic!("{words}") };
    Some((left.parse().unwrap(), relation, right.parse().unwrap()))
}

#[test]
fn the_relation_holds_between_the_numbers_as_they_are_printed() {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let (mut by_less, mut starts, mut turns) = (0, [0; 2], [0; 2]);
    for (id, cycle) in mufasa_records::cycles_from_lines(&cycles()).into_iter().flatten() {
        let Ok(report) = mufasa_model::cycle::check(&cycle, Reading::Exact) else { continue };
        let Some(witness) = report.witness() else { continue };
        let words = words::witness(witness);
        let numbers = compared(&words);
        let holds = numbers.is_none_or(|(left, relation, right)| match relation {
            "<" => left < right,
            "<=" => left <= right,
            ">" => left > right,
            ">=" => left >= right,
            "~" => true,
            _ => panic!("{id}: {words}"),
        });
        assert!(holds, "{id}: {words}");
        by_less += usize::from(numbers.is_none());
        *seen.entry(format!("{:?}", witness.rule)).or_default() += 1;
        let product = usize::from(words.contains("cross product"));
        match witness.rule {
            Rule::StartHeading => starts[product] += 1,
            Rule::StepTurn => turns[product] += 1,
            _ => {}
        }
    }
    // Of 25 rules: the exact model never says `ambiguous` or `work_limit`.
    assert!(seen.len() > 20, "{seen:?}");
    assert!(
        by_less > 0 && starts.iter().chain(&turns).all(|count| *count > 0),
        "{starts:?} {turns:?}"
    );
}

/// A sentence with numbers in it, and whether they are as it says.
type Sentence = (&'static str, fn(&[&str]) -> bool);

/// What is said of invalid input.
const SENTENCES: [Sentence; 10] = [
    ("{} is not a number from {} to {}", |it| {
        !(number(it[1])..=number(it[2])).contains(&number(it[0]))
    }),
    ("{} is not an integer from {} to {}", |it| {
        !(integer(it[1])..=integer(it[2])).contains(&integer(it[0]))
    }),
    ("cos^2 + sin^2 of ({}, {}) differs from 1 by {}, more than 1e-6", |it| {
        let excess = excess(it[0], it[1]);
        excess.to_f64().to_bits() == number(it[2]).to_bits() && number(it[2]) > 1e-6
    }),
    ("cos^2 + sin^2 of ({}, {}) differs from 1 by more than 1e-6", |it| {
        excess(it[0], it[1]) > Real::from_double(1e-6)
    }),
    ("{} is not within 60 s of now ({})", |it| {
        (integer(it[0]) - integer(it[1])).abs() > 60_000_000_000
    }),
    ("{} items, where {} to {} are allowed", |it| {
        !(integer(it[1])..=integer(it[2])).contains(&integer(it[0]))
    }),
    ("{} cells, where {} are allowed", |it| integer(it[0]) > integer(it[1])),
    ("{} bytes, where {} are needed", |it| integer(it[0]) != integer(it[1])),
    ("{} is not earlier than the {} before it", |it| integer(it[0]) >= integer(it[1])),
    ("{} is not later than the {} before it", |it| integer(it[0]) <= integer(it[1])),
];

/// Those that compare nothing with a bound.
const OTHERS: [&str; 2] =
    ["the reference point equals the one before", "{} is the id of an earlier track"];

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

fn integer(text: &str) -> i128 {
    text.parse().unwrap()
}

/// abs(cos^2 + sin^2 - 1) of the numbers as they are printed.
fn excess(cos: &str, sin: &str) -> Real {
    let square = |text| Real::from_double(number(text)).square();
    (square(cos) + square(sin) - Real::from_integer(1)).abs()
}

/// What stands in the places `{}` of a sentence, if a message is this sentence.
fn read<'a>(message: &'a str, sentence: &str) -> Option<Vec<&'a str>> {
    let mut parts = sentence.split("{}");
    let mut rest = message.strip_prefix(parts.next()?)?;
    let mut found = Vec::new();
    for part in parts {
        let (value, behind) = if part.is_empty() { (rest, "") } else { rest.split_once(part)? };
        found.push(value);
        rest = behind;
    }
    let is_number = |it: &&str| it.parse::<f64>().is_ok();
    (rest.is_empty() && found.iter().all(is_number)).then_some(found)
}

/// Random cycles with values at and beyond the bounds, and those of `vectors/`: each sentence is true of the
/// numbers in it.
#[test]
fn what_is_said_of_invalid_input_holds_of_the_numbers_as_they_are_printed() {
    let mut seen = [0; SENTENCES.len()];
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let random = (0..20_000).map(|at| {
        let tape: Vec<u32> = (0..160).map(|_| random.next_u32()).collect();
        let profile = if at % 2 == 0 { Profile::PAPER } else { Profile::HARDENED };
        input::cycle(&mut Draw::new(&tape), profile)
    });
    let of_vectors = mufasa_records::cycles_from_lines(&cycles()).into_iter().flatten();
    for cycle in random.chain(of_vectors.map(|(_, cycle)| cycle)) {
        let Some(Problem::Local(problem) | Problem::Remote(problem)) = first_problem(&cycle) else {
            continue;
        };
        let message = &problem.message;
        let mut known = SENTENCES.iter().zip(&mut seen);
        let found =
            known.find_map(|((text, holds), count)| Some((read(message, text)?, holds, count)));
        let holds = match found {
            Some((values, holds, count)) => {
                *count += 1;
                holds(&values)
            }
            None => OTHERS.iter().any(|text| read(message, text).is_some()),
        };
        assert!(holds, "{}", words::invalid(&problem));
    }
    assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
}
