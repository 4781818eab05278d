//! What a step of the world costs, with 30 vehicles and the ego: `cargo run --release --example step_cost`.
#![allow(clippy::disallowed_methods, reason = "measures the machine, not the world")]

use std::time::Instant;

use mufasa_sim::map::streets;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::vehicle::Command;
use mufasa_sim::world::World;

fn main() {
    let start = Instant::now();
    let town = streets::town();
    println!("town: {:.1} ms, {} routes", start.elapsed().as_secs_f64() * 1e3, town.routes.len());
    let (mut steps, mut agents) = (0_u32, 0_usize);
    let start = Instant::now();
    for seed in 0..20 {
        let scenario = Scenario::draw(&town, 0, 30, seed);
        let mut world = World::new(&town, &scenario, seed);
        for _ in 0..6000 {
            world.step(Command { acceleration: -0.1, steering: 0.0 });
            steps += 1;
        }
        agents += world.agents().len();
    }
    let step = start.elapsed().as_secs_f64() * 1e6 / f64::from(steps);
    println!("step: {step:.2} us, {} agents at the end on average", agents / 20);
}
