//! `embedded-host write FOLDER [smoke]` writes the cases; `embedded-host read FOLDER [smoke] TARGET...` compares the
//! answers of each target, in `FOLDER/TARGET`, with those of this machine, and these with the model's, and prints the
//! tables.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use mufasa::input::profile::Profile;
use mufasa::monitor::Monitor;
use mufasa::services::configuration::Configuration;
use mufasa_benches::steps;
use mufasa_benches::workload::{SIZES, Variant, Workload};
use mufasa_embedded::{Bytes, Case, Task};
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Reading;
use mufasa_props::bridge;
use mufasa_records::Record;
use serde_json::value::RawValue;

type Failure = Box<dyn Error>;

/// Of the cases of a smoke test, one of so many vectors.
const SMOKE: usize = 40;
/// The size of the inputs whose steps are counted.
const SIZE: u32 = 128;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1).collect::<Vec<_>>();
    let smoke = arguments.iter().position(|it| it == "smoke").map(|at| arguments.remove(at));
    let [task, folder, targets @ ..] = &arguments[..] else { return Err("write or read?".into()) };
    let (folder, vectors) = (Path::new(folder), vectors(smoke.is_some())?);
    if task == "write" {
        let mut all = Vec::new();
        each(&vectors, smoke.is_some(), &mut |_, _, case| {
            let mut bytes = Vec::new();
            case.write(&mut bytes);
            all.extend(bytes.len().to_le_bytes());
            all.extend(bytes);
        });
        return Ok(fs::write(folder.join("cases"), all)?);
    }
    for (at, cycle) in vectors.iter().enumerate() {
        let [exact, strict] = [Reading::Exact, Reading::Strict].map(|it| check(cycle, it));
        let found = bridge::check_impl(cycle);
        bridge::conforms(&exact, &strict, &found).map_err(|it| format!("vector {at}: {it}"))?;
    }
    let mut expected = Vec::new();
    each(&vectors, smoke.is_some(), &mut |name, steps, case| {
        let answer = case.answer(&mut |call| call()).1;
        expected.push(Expected { name: name.to_owned(), steps, answer });
    });
    let found = targets.iter().map(|target| Found::new(&folder.join(target), target, &expected));
    let found = found.collect::<Result<Vec<_>, _>>()?;
    print(&found, vectors.len());
    Ok(())
}

/// What a case has to answer. The name of a vector is empty; where steps are not counted they are 0.
struct Expected {
    name: String,
    steps: u64,
    answer: String,
}

/// Calls a job with each case, its name and its steps.
fn each(vectors: &[Cycle], smoke: bool, job: &mut dyn FnMut(&str, u64, &Case<'_>)) {
    for cycle in vectors {
        let owned = bridge::to_impl(cycle);
        let history = owned.history();
        job("", 0, &Case { task: Task::Check, cycle: owned.borrow(&history) });
    }
    for size in SIZES.iter().take(if smoke { 1 } else { 3 }) {
        let workload = Workload::new(size, Variant::Pass);
        for configuration in [Configuration::AllRemote, Configuration::MotRemote] {
            for (profile, rules) in [("paper", Profile::PAPER), ("hardened", Profile::HARDENED)] {
                let cycle = workload.cycle(rules, configuration);
                let name = format!("{}, `{configuration:?}`, {profile}", workload.name);
                job(&name, 0, &Case { task: Task::Kept, cycle });
            }
        }
    }
    if smoke {
        return;
    }
    for (name, _) in steps::INPUTS {
        steps::input(name, SIZE, &mut |stage, cycle| {
            let task = stage.map_or(Task::Input, Task::Stage);
            job(name, steps::allowed(stage, cycle), &Case { task, cycle: *cycle });
        });
    }
    steps::input(steps::INPUTS[0].0, SIZE, &mut |_, cycle| {
        let case = Case { task: Task::Calibrate, cycle: *cycle };
        job("`Monitor::calibrate`", Monitor::calibrate(), &case);
    });
}

/// The cycles of the published vectors, in order of their files.
fn vectors(smoke: bool) -> Result<Vec<Cycle>, Failure> {
    let (mut open, mut files) = (vec![PathBuf::from("vectors")], Vec::new());
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() { &mut open } else { &mut files }.push(path);
        }
    }
    files.retain(|it| it.extension().is_some_and(|it| it == "jsonl"));
    files.sort();
    let mut cycles = Vec::new();
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            // The text as it stands: a number that is read and written again might be another.
            let vector: BTreeMap<&str, &RawValue> = serde_json::from_str(line)?;
            let input = vector["input"].get();
            let line = serde_json::from_str(input).unwrap_or_else(|_| input.to_owned());
            if let Ok(Record::Cycle { cycle, .. }) = mufasa_records::parse(line.as_bytes(), 1) {
                cycles.push(*cycle);
            }
        }
    }
    Ok(cycles.into_iter().step_by(if smoke { SMOKE } else { 1 }).collect())
}

/// What a target answered and took.
struct Found {
    target: String,
    /// Bytes that a call of `check_with` links, by what the compiler makes the best of.
    code: Vec<(String, u64)>,
    /// Instructions of a loop and as they were counted; bytes of scratch, of all that a monitor is lent, of itself.
    first: Vec<u64>,
    /// Name, steps, and instructions, bytes of stack and of scratch; of vectors the largest stack alone.
    cases: Vec<(String, u64, [u64; 3])>,
    stack_of_vectors: u64,
}

impl Found {
    /// Errors: another answer than that of this machine.
    fn new(folder: &Path, target: &str, expected: &[Expected]) -> Result<Self, Failure> {
        let code = fs::read_to_string(folder.join("code"))?;
        let code = code.lines().filter_map(|line| line.split_once(' '));
        let code = code.map(|(level, bytes)| Ok((level.to_owned(), bytes.parse()?)));
        let code = code.collect::<Result<_, Failure>>()?;
        let text = fs::read_to_string(folder.join("answers"))?;
        let (first, rest) = text.split_once('\n').ok_or("no answers")?;
        let first = first.split(' ').map(str::parse).collect::<Result<Vec<_>, _>>()?;
        let answers: Vec<&str> = rest.lines().collect();
        if answers.len() != expected.len() {
            return Err(format!("{target}: {} of {} answers", answers.len(), expected.len()).into());
        }
        let (mut cases, mut stack_of_vectors) = (Vec::new(), 0);
        for (at, (answer, expected)) in answers.iter().zip(expected).enumerate() {
            let Expected { name, steps, answer: right } = expected;
            let mut parts = answer.splitn(4, ' ');
            let mut number = || parts.next().unwrap_or_default().parse::<u64>();
            let numbers = [number()?, number()?, number()?];
            let said = parts.next().unwrap_or_default();
            if said != right {
                return Err(format!("{target}, case {at} {name}: {said}, here: {right}").into());
            }
            if name.is_empty() {
                stack_of_vectors = numbers[1].max(stack_of_vectors);
            } else {
                cases.push((name.clone(), *steps, numbers));
            }
        }
        Ok(Self { target: target.to_owned(), code, first, cases, stack_of_vectors })
    }

    /// How many times the instructions of a step of `Monitor::calibrate` one takes, at most; tenths, rounded up.
    fn over_calibrated(&self) -> u64 {
        let counted = self.cases.iter().filter(|it| it.1 > 0);
        let of_a_step: Vec<_> = counted.map(|it| 1000 * it.2[0] / it.1).collect();
        let (Some(calibrated), Some(most)) = (of_a_step.last(), of_a_step.iter().max()) else {
            return 0;
        };
        (10 * most).div_ceil(*calibrated)
    }
}

/// The tables of docs/embedded.md.
fn print(found: &[Found], vectors: usize) {
    let others = found[0].cases.len();
    println!("{vectors} vectors and {others} others: equal answers.\n");
    let names: Vec<_> = found.iter().map(|it| it.target.as_str()).collect();
    println!("| | {} |\n|---|{}", names.join(" | "), "--:|".repeat(found.len()));
    let row = |name: &str, number: &dyn Fn(&Found) -> u64| {
        let cells: Vec<_> = found.iter().map(|it| grouped(number(it))).collect();
        println!("| {name} | {} |", cells.join(" | "));
    };
    for (at, (level, _)) in found[0].code.iter().enumerate() {
        row(&format!("code and constants, `opt-level = {level}`"), &|it| it.code[at].1);
    }
    row("stack of a call, the largest of all vectors", &|it| it.stack_of_vectors);
    row("stack of a call, the largest of the others", &|it| {
        it.cases.iter().map(|it| it.2[1]).max().unwrap_or(0)
    });
    row("scratch", &|it| it.first[2]);
    row("all that a monitor is lent, scratch included", &|it| it.first[3]);
    row("the monitor itself", &|it| it.first[4]);
    row("instructions of a loop of 2,000,000, as they are counted", &|it| it.first[1]);
    let columns: Vec<_> = names.iter().map(|it| format!("{it}: instructions | stack")).collect();
    println!("\n| one call | scratch | {} |", columns.join(" | "));
    println!("|---|--:|{}", "--:|--:|".repeat(found.len()));
    for (at, (name, steps, [_, _, scratch])) in found[0].cases.iter().enumerate() {
        if *steps == 0 {
            let numbers = found.iter().flat_map(|it| it.cases[at].2[..2].iter().copied());
            let cells: Vec<_> = numbers.map(grouped).collect();
            println!("| {name} | {} | {} |", grouped(*scratch), cells.join(" | "));
        }
    }
    println!("\n| instructions of a step | steps | {} |", names.join(" | "));
    println!("|---|--:|{}", "--:|".repeat(found.len()));
    let tenths = |number: u64| format!("{}.{}", number / 10, number % 10);
    for (at, (name, steps, _)) in found[0].cases.iter().enumerate().filter(|(_, it)| it.1 > 0) {
        let cells: Vec<_> = found.iter().map(|it| tenths(10 * it.cases[at].2[0] / steps)).collect();
        println!("| {name} | {} | {} |", grouped(*steps), cells.join(" | "));
    }
    let cells: Vec<_> = found.iter().map(|it| tenths(it.over_calibrated())).collect();
    println!("| **the most of these, times the last** | | {} |", cells.join(" | "));
}

/// With commas between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let comma = |at: usize| at > 0 && (digits.len() - at).is_multiple_of(3);
    let parts =
        digits.char_indices().map(|(at, c)| if comma(at) { format!(",{c}") } else { c.into() });
    parts.collect()
}
