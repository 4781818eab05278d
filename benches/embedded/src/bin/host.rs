//! `embedded-host write FOLDER [smoke]` writes the cases; `embedded-host read FOLDER [smoke] TARGET...` compares the
//! answers of each target, in `FOLDER/TARGET`, with those of this machine, and these with the model's, and prints the
//! tables.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use mufasa::input::profile::Profile;
use mufasa::monitor::Calibration;
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
    print(&found, [vectors.len(), expected.len() - vectors.len()]);
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
        for size in steps::SIZES {
            steps::input(name, size, &mut |stage, cycle| {
                let task = stage.map_or(Task::Input, Task::Stage);
                job(name, steps::allowed(stage, cycle), &Case { task, cycle: *cycle });
            });
        }
    }
    steps::input(steps::INPUTS[0].0, steps::SIZES[0], &mut |_, cycle| {
        for work in Calibration::ALL {
            let case = Case { task: Task::Calibrate(work), cycle: *cycle };
            job("`Monitor::calibrate`", Calibration::STEPS, &case);
        }
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
    /// Instructions, bytes of stack and of scratch of each workload.
    workloads: Vec<(String, [u64; 3])>,
    /// Hundredths of an instruction that a step of an input takes, the most of its sizes; last the kinds of work of
    /// `Monitor::calibrate`, the more of them.
    of_a_step: Vec<(String, u64)>,
    /// The largest of all vectors, and of the others.
    stacks: [u64; 2],
}

impl Found {
    /// Errors: another answer than that of this machine; a step that takes more than `Monitor::calibrate` says.
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
        let (mut workloads, mut stacks) = (Vec::new(), [0; 2]);
        let mut of_a_step: Vec<(String, u64)> = Vec::new();
        for (at, (answer, expected)) in answers.iter().zip(expected).enumerate() {
            let Expected { name, steps, answer: right } = expected;
            let mut parts = answer.splitn(4, ' ');
            let mut number = || parts.next().unwrap_or_default().parse::<u64>();
            let numbers = [number()?, number()?, number()?];
            let said = parts.next().unwrap_or_default();
            if said != right {
                return Err(format!("{target}, case {at} {name}: {said}, here: {right}").into());
            }
            let stack = &mut stacks[usize::from(!name.is_empty())];
            *stack = numbers[1].max(*stack);
            if *steps == 0 && !name.is_empty() {
                workloads.push((name.clone(), numbers));
            } else if *steps > 0 {
                let taken = 100 * numbers[0] / steps;
                match of_a_step.last_mut().filter(|it| it.0 == *name) {
                    Some((_, most)) => *most = taken.max(*most),
                    None => of_a_step.push((name.clone(), taken)),
                }
            }
        }
        let calibrated = of_a_step.last().map_or(0, |it| it.1);
        if let Some((name, taken)) = of_a_step.iter().find(|it| it.1 > calibrated) {
            let problem =
                format!("{target}: a step of {name} takes {taken}, of calibrate {calibrated}");
            return Err(problem.into());
        }
        Ok(Self { target: target.to_owned(), code, first, workloads, of_a_step, stacks })
    }
}

/// The tables of docs/embedded.md.
fn print(found: &[Found], [vectors, others]: [usize; 2]) {
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
    row("stack of a call, the largest of all vectors", &|it| it.stacks[0]);
    row("stack of a call, the largest of the others", &|it| it.stacks[1]);
    row("scratch", &|it| it.first[2]);
    row("all that a monitor is lent, scratch included", &|it| it.first[3]);
    row("the monitor itself", &|it| it.first[4]);
    row("instructions of a loop of 2,000,000, as they are counted", &|it| it.first[1]);
    let columns: Vec<_> = names.iter().map(|it| format!("{it}: instructions | stack")).collect();
    println!("\n| one call | scratch | {} |", columns.join(" | "));
    println!("|---|--:|{}", "--:|--:|".repeat(found.len()));
    for (at, (name, [_, _, scratch])) in found[0].workloads.iter().enumerate() {
        let numbers = found.iter().flat_map(|it| it.workloads[at].1[..2].iter().copied());
        let cells: Vec<_> = numbers.map(grouped).collect();
        println!("| {name} | {} | {} |", grouped(*scratch), cells.join(" | "));
    }
    if found[0].of_a_step.is_empty() {
        return;
    }
    println!(
        "\n| instructions of a step | {} |\n|---|{}",
        names.join(" | "),
        "--:|".repeat(found.len())
    );
    let row = |name: &str, tenths: &dyn Fn(&Found) -> u64| {
        let cells = found.iter().map(tenths).map(|it| format!("{}.{}", it / 10, it % 10));
        println!("| {name} | {} |", cells.collect::<Vec<_>>().join(" | "));
    };
    for (at, (name, _)) in found[0].of_a_step.iter().enumerate() {
        row(name, &|it| it.of_a_step[at].1 / 10);
    }
}

/// With commas between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let comma = |at: usize| at > 0 && (digits.len() - at).is_multiple_of(3);
    let parts =
        digits.char_indices().map(|(at, c)| if comma(at) { format!(",{c}") } else { c.into() });
    parts.collect()
}
