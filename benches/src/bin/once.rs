//! `once TASK`: one call of one task on W1, in a function of its own, whose instructions
//! `scripts/instruction-counts` counts. Tasks: `validation`, a stage (`i` to `v`) or
//! `all`, each with `-hardened` for that profile.

use std::error::Error;
use std::hint::black_box;

use mufasa::configuration::Configuration;
use mufasa::cycle::Profile;
use mufasa::verdict::Stage;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::table::STAGES;
use mufasa_benches::workload::{SIZES, Variant, Workload};

fn main() -> Result<(), Box<dyn Error>> {
    let argument = std::env::args().nth(1).ok_or("which task?")?;
    let (task, profile) = match argument.strip_suffix("-hardened") {
        Some(task) => (task, Profile::Hardened),
        None => (argument.as_str(), Profile::Paper),
    };
    let workload = Workload::new(&SIZES[0], Variant::Pass);
    let cycle = workload.cycle(profile, Configuration::AllRemote);
    let mut it = Contestant::new(&cycle);
    let stage = STAGES.into_iter().zip(Stage::ALL).find(|&(name, _)| name == task);
    let mut run: Box<dyn FnMut() -> bool> = match (task, stage) {
        (_, Some((_, stage))) => Box::new(move || it.stage(stage)),
        ("validation", _) => Box::new(move || it.validate()),
        ("all", _) => Box::new(move || it.all_stages()),
        _ => return Err(format!("unknown task {task}").into()),
    };
    assert!(measured(&mut run), "the workload passes");
    Ok(())
}

/// What is counted.
#[inline(never)]
fn measured(run: &mut dyn FnMut() -> bool) -> bool {
    black_box(run())
}
