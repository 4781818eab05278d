//! `once TASK [1|2|3] [fail] [bare] [RULE] [CALLS]`: one call of one task on W1 (W2, W3), in a
//! function of its own, whose instructions `scripts/instruction-counts` counts; more calls for a
//! profile by samples. Tasks: `validation`, a stage (`i` to `v`), `all`, or a cycle as a vehicle
//! asks for it (`mot`: `MotRemote`, `remote`: `AllRemote`), or that with the verdict to the requester by
//! the plain calls (`plain`) and by the monitor (`monitor`), each with `-hardened` for that profile.
//! `fail`: the variant of the stage that it fails; `bare`: without a detection history; a rule (`H-14`): without it.

use std::error::Error;
use std::hint::black_box;

use mufasa::input::profile::{HardenedRule, Profile};
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::monitored::{Monitored, Plain};
use mufasa_benches::workload::{SIZES, Variant, Workload};

fn main() -> Result<(), Box<dyn Error>> {
    let argument = std::env::args().nth(1).ok_or("which task?")?;
    let (task, mut profile) = match argument.strip_suffix("-hardened") {
        Some(task) => (task, Profile::HARDENED),
        None => (argument.as_str(), Profile::PAPER),
    };
    let mut stages = ["i", "ii", "iii", "iv", "v"].into_iter().zip(Stage::ALL);
    let stage = stages.find(|&(name, _)| name == task);
    let (mut size, mut variant, mut calls) = (&SIZES[0], Variant::Pass, 1_u64);
    let mut bare = false;
    for option in std::env::args().skip(2) {
        match (option.as_str(), stage) {
            ("1", _) => {}
            ("2", _) => size = &SIZES[1],
            ("3", _) => size = &SIZES[2],
            ("fail", Some((_, stage))) => variant = Variant::Fail(stage),
            ("bare", _) => bare = true,
            (other, _) => match HardenedRule::ALL.into_iter().find(|rule| rule.id() == other) {
                Some(rule) => profile = profile.without(rule),
                None => calls = other.parse()?,
            },
        }
    }
    let workload = Workload::new(size, variant);
    let configuration =
        if task == "mot" { Configuration::MotRemote } else { Configuration::AllRemote };
    let mut cycle = workload.cycle(profile, configuration);
    if bare {
        cycle.detection_history = &[];
    }
    let mut it = Contestant::new(&cycle);
    let mut run: Box<dyn FnMut() -> bool> = match (task, stage) {
        (_, Some((_, stage))) => Box::new(move || it.stage(stage)),
        ("plain", _) => {
            let mut it = Plain::new(&cycle);
            Box::new(move || it.cycle())
        }
        ("monitor", _) => {
            let mut it = Monitored::new(&cycle);
            Box::new(move || it.cycle())
        }
        ("validation", _) => Box::new(move || it.validate()),
        ("mot" | "remote", _) => Box::new(move || it.check().failed_stage.is_none()),
        ("all", _) => Box::new(move || it.all_stages()),
        _ => return Err(format!("unknown task {task}").into()),
    };
    for _ in 0..calls {
        let passes = measured(&mut run);
        assert_eq!(passes, variant == Variant::Pass, "{argument} {variant:?}");
    }
    Ok(())
}

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}
