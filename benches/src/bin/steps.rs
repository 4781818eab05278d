//! `steps INPUT SIZE`: one call of one stage on an input that is as slow as one of its size can be, in a
//! function of its own, whose instructions `scripts/steps` counts; prints how many steps it may take
//! (`spec/4-arithmetic.md#steps`). `steps times`: how long a step of each takes on this processor, and by how much
//! `Monitor::calibrate` measures too little. Without arguments: the inputs.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use mufasa::input::cycle::Cycle;
use mufasa::monitor::Monitor;
use mufasa::report::Stage;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::steps::{INPUTS, SIZES, allowed, input};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => all().for_each(|(name, size)| println!("{name} {size}")),
        ["times"] => times(),
        ["calibrate", _] => println!("{} passes", calibrated()),
        [name, size] => input(name, size.parse()?, &mut |stage, cycle| {
            let passed = run(stage, cycle)();
            println!("{} {}", allowed(stage, cycle), if passed { "passes" } else { "fails" });
        }),
        _ => return Err("steps [times | INPUT SIZE]".into()),
    }
    Ok(())
}

/// The inputs in each size, and `calibrate`, which has none.
fn all() -> impl Iterator<Item = (&'static str, u32)> {
    let inputs = INPUTS.into_iter().flat_map(|(name, _)| SIZES.map(|size| (name, size)));
    inputs.chain([("calibrate", 0)])
}

/// A call of the stage, or of the checks of the input.
fn run<'a>(stage: Option<Stage>, cycle: &'a Cycle<'a>) -> impl FnMut() -> bool {
    let mut it = Contestant::new(cycle);
    move || {
        measured(&mut || match stage {
            None => it.validate(),
            Some(stage) => it.stage(stage),
        })
    }
}

fn calibrated() -> u64 {
    let mut taken = 0;
    measured(&mut || {
        taken = Monitor::calibrate();
        true
    });
    taken
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
    let calibrate = shortest(Monitor::calibrate(), calibrated);
    let ((name, size, ps), arch) = (slowest, std::env::consts::ARCH);
    let hundredths = 100 * ps / calibrate;
    println!(
        "{arch}: a step of `Monitor::calibrate` takes {calibrate} ps, one of the slowest input (`{name}`, {size}) {ps} ps: \
         factor {}.{:02}.",
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
