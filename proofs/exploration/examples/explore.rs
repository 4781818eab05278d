//! Explores the small worlds named on the command line, or all, and says
//! which properties fail: `profile world property moves`. `scripts/mutants` reads it.

use std::process::ExitCode;

use mufasa_exploration::bounds::Bounds;
use mufasa_exploration::run;
use mufasa_model::input::cycle::Profile;

fn main() -> ExitCode {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let mut fails = false;
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for world in Bounds::Small.worlds() {
            if !names.is_empty() && !names.iter().any(|name| name == world.name) {
                continue;
            }
            let outcome = match run::explore(world, profile, |_| {}) {
                Ok(outcome) => outcome,
                Err(difference) => {
                    println!("{profile:?} {} refinement: {difference}", world.name);
                    fails = true;
                    continue;
                }
            };
            for finding in outcome.results.iter().filter(|it| it.property.is_claimed(profile)) {
                if let Some(found) = &finding.counterexample {
                    let moves = found.trace.len() + found.circle.len();
                    println!("{profile:?} {} {} {moves}", world.name, finding.property.name());
                    fails = true;
                }
            }
        }
    }
    ExitCode::from(u8::from(fails))
}
