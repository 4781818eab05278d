//! What it costs, and what it is good for, to examine the CAV's own plans (F-48): drives with everything local and
//! nobody who attacks, without and with it. `cargo run --release -p mufasa-sim --example own_plans -- [SCENARIOS]
//! [SEED] [VEHICLES]`: scenarios on each of two routes, seed of the first, other vehicles; 10, 0 and 15.

use std::error::Error;

use mufasa::services::configuration::Groups;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::decided::Decided;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::map::{Town, streets};
use mufasa_sim::run::{Cycle, End, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;
use rayon::prelude::*;

#[derive(Default)]
struct Examined([u64; 2]);

impl Watcher for Examined {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, _: &Cycle) {
        self.0 = cav.examined();
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<u64> =
        std::env::args().skip(1).map(|it| it.parse()).collect::<Result<_, _>>()?;
    let argument = |at: usize, default| arguments.get(at).copied().unwrap_or(default);
    let (scenarios, first, vehicles) = (argument(0, 10), argument(1, 0), argument(2, 15));
    let town = streets::town();
    println!("own plans     | runs | arrived | collided | late | mean end, s | plans that fail");
    for is_supervised in [false, true] {
        let runs: Vec<(usize, u64)> = town
            .ego_routes()
            .flat_map(|route| (first..first + scenarios).map(move |seed| (route, seed)))
            .collect();
        let outcomes = runs
            .par_iter()
            .map(|(route, seed)| {
                drive(&town, *route, usize::try_from(vehicles)?, *seed, is_supervised)
            })
            .collect::<Result<Vec<_>, Box<dyn Error + Send + Sync>>>();
        let outcomes = outcomes.map_err(|error| error.to_string())?;
        let ended = |end: End| outcomes.iter().filter(|(it, ..)| *it == end).count();
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let mean = outcomes.iter().map(|(_, t, _)| t).sum::<f64>() / outcomes.len() as f64;
        let [examined, failed] =
            outcomes.iter().fold([0, 0], |[all, bad], (_, _, it)| [all + it[0], bad + it[1]]);
        let name = if is_supervised { "examined" } else { "not examined" };
        println!(
            "{name:13} | {:4} | {:7} | {:8} | {:4} | {mean:11.2} | {failed} of {examined}",
            outcomes.len(),
            ended(End::Arrived),
            ended(End::Collided),
            ended(End::Late),
        );
    }
    Ok(())
}

fn drive(
    town: &Town,
    route: usize,
    vehicles: usize,
    seed: u64,
    is_supervised: bool,
) -> Result<(End, f64, [u64; 2]), Box<dyn Error + Send + Sync>> {
    let scenario = Scenario::draw(town, route, vehicles, seed);
    let mut settings = Settings::new(Variant::Hardened, Groups::NONE, seed);
    settings.supervise_local = is_supervised.then_some(0.0);
    let mut examined = Examined::default();
    let outcome =
        simulate(town, &scenario, &settings, &mut examined).map_err(|error| error.to_string())?;
    Ok((outcome.end, outcome.t, examined.0))
}
