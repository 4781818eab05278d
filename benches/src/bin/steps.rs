//! `steps INPUT SIZE`: one call of one stage on an input that is as slow as one of its size can be, in a
//! function of its own, whose instructions `scripts/steps` counts; prints how many steps it may take
//! (`spec/4-arithmetic.md#steps`). `steps times`: how long a step of each takes on this processor, and what
//! `Monitor::calibrate` says. Without arguments: the inputs.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use mufasa::input::cycle::Cycle;
use mufasa::monitor::{Calibration, Monitor};
use mufasa::report::{Outcome, Stage};
use mufasa_benches::contestant::Contestant;
use mufasa_benches::steps::{INPUTS, SIZES, allowed, input};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => all().for_each(|(name, size)| println!("{name} {size}")),
        ["times"] => times(),
        ["calibrate", kind] => {
            let work = Calibration::ALL
                .into_iter()
                .find(|work| format!("{work:?}") == kind)
                .ok_or(kind)?;
            measured(&mut || work.run() == Outcome::Passed);
            println!("{}", Calibration::STEPS);
        }
        [name, size] => input(name, size.parse()?, &mut |stage, cycle| {
            let passed = run(stage, cycle)();
            println!("{} {}", allowed(stage, cycle), if passed { "passes" } else { "fails" });
        }),
        _ => return Err("steps [times | INPUT SIZE]".into()),
    }
    Ok(())
}

/// The inputs in each size, and the kinds of work of `calibrate`.
fn all() -> impl Iterator<Item = (&'static str, String)> {
    let sizes = |name| SIZES.map(|size| (name, size.to_string()));
    let inputs = INPUTS.into_iter().flat_map(move |(name, _)| sizes(name));
    inputs.chain(Calibration::ALL.map(|work| ("calibrate", format!("{work:?}"))))
}

/// A call of the stage, or of the checks of the input.
fn run<'a>(stage: Option<Stage>, cycle: &'a Cycle<'a>) -> impl FnMut() -> bool {
    let mut it = Contestant::new(cycle);
    move || measured(&mut || it.part(stage))
}

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}

fn times() {
    let mut slowest = ("", 0, 0);
    for (name, _) in INPUTS {
        for size in SIZES {
            input(name, size, &mut |stage, cycle| {
                let ps = shortest(allowed(stage, cycle), run(stage, cycle));
                println!("{name} {size}: {ps} ps a step");
                if ps > slowest.2 {
                    slowest = (name, size, ps);
                }
            });
        }
    }
    let began = Instant::now();
    let now_ns = || u64::try_from(began.elapsed().as_nanos()).unwrap_or(u64::MAX);
    let calibrate = (0..50).map(|_| Monitor::calibrate(now_ns)).min().map_or(1, u128::from);
    let ((name, size, ps), arch) = (slowest, std::env::consts::ARCH);
    let hundredths = 100 * ps / calibrate;
    println!(
        "{arch}: `Monitor::calibrate` says {calibrate} ps; a step of the slowest input (`{name}`, {size}) takes {ps} ps, \
         {}.{:02} of that.",
        hundredths / 100,
        hundredths % 100
    );
}

/// The time of a step, ps: of the shortest of many calls, which nothing interrupted.
fn shortest<T>(steps: u64, mut call: impl FnMut() -> T) -> u128 {
    let times = (0..50).map(|_| {
        let began = Instant::now();
        black_box(call());
        began.elapsed().as_nanos()
    });
    1000 * times.min().unwrap_or_default() / u128::from(steps)
}
