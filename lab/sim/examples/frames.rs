//! Draws a moment of the town to a file, and a strip of three: `cargo run --example frames -- FOLDER`.

use mufasa_sim::map::streets;
use mufasa_sim::pictures::{Overlay, View, frame, sheet};
use mufasa_sim::pose::Point;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::vehicle::Command;
use mufasa_sim::world::World;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| String::from("."));
    let town = streets::town();
    let scenario = Scenario::draw(&town, 0, 30, 3);
    let mut world = World::new(&town, &scenario, 3);
    let mut snapshots = vec![world.snapshot()];
    for _ in 0..2 {
        for _ in 0..400 {
            world.step(Command { acceleration: 0.2, steering: 0.0 });
        }
        snapshots.push(world.snapshot());
    }
    let whole = View { middle: Point::new(120.0, 110.0), width: 410.0, height: 390.0 };
    std::fs::write(
        format!("{folder}/town.svg"),
        frame(&town, 1, &snapshots[2], &Overlay::default(), whole),
    )?;
    let overlays: Vec<Overlay> = snapshots
        .iter()
        .map(|snapshot| Overlay {
            trajectory: (0..20)
                .map(|i| snapshot.ego.rectangle.pose.ahead(f64::from(i), 0.0))
                .collect(),
            tracks: snapshot.objects.iter().map(|object| object.rectangle).collect(),
            is_remote: true,
            detections: snapshot.objects.iter().map(|object| object.rectangle.pose.at).collect(),
            cells: vec![snapshot.ego.rectangle.pose.ahead(15.0, 3.0)],
            cell_size: 0.5,
            caption: String::from("truth < & > belief"),
            ..Overlay::default()
        })
        .collect();
    let frames: Vec<_> =
        snapshots.iter().zip(&overlays).map(|(s, o)| (s, o, View::of_ego(s))).collect();
    std::fs::write(format!("{folder}/strip.svg"), sheet(&town, 0, &[&frames]))
}
