//! `steps INPUT SIZE`: one call of one stage on an input that is as slow as one of its size can be, in a
//! function of its own, whose instructions `scripts/steps` counts; prints how many steps it may take
//! (`spec/4-arithmetic.md#steps`). Without arguments: the inputs.

use std::error::Error;
use std::hint::black_box;

use mufasa::monitor::Monitor;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::steps::{INPUTS, allowed, input};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, size] = &arguments[..] else {
        INPUTS.iter().for_each(|(name, _)| println!("{name}"));
        println!("calibrate");
        return Ok(());
    };
    if name == "calibrate" {
        calibrate();
        return Ok(());
    }
    input(name, size.parse()?, &mut |stage, cycle| {
        let mut it = Contestant::new(cycle);
        let passed = measured(&mut || match stage {
            None => it.validate(),
            Some(stage) => it.stage(stage),
        });
        println!("{} {}", allowed(stage, cycle), if passed { "passes" } else { "fails" });
    });
    Ok(())
}

fn calibrate() {
    let mut taken = 0;
    measured(&mut || {
        taken = Monitor::calibrate();
        true
    });
    println!("{taken} passes");
}

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}
