//! Pictures of cycles from above, as SVG: for people, not for verdicts (plain `f64`).

pub mod canvas;
pub mod frame;
mod layers;
mod legend;
pub mod scene;
mod witness;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Report;

pub use canvas::escape;

use frame::{Frame, PAGE_WIDTH, Rectangle};
use legend::LEGEND_HEIGHT;
use scene::{STYLE, Scene};

/// A cycle that failed, with the words of its picture.
pub struct Content<'a> {
    /// First line: drive, time, configuration, profile.
    pub title: String,
    /// Second line: stage, rule and the numbers compared.
    pub subtitle: String,
    /// The cycle.
    pub cycle: &'a Cycle,
    /// Its report.
    pub report: &'a Report,
}

/// The picture of a cycle as an SVG document: route, objects, trajectory, and the witness in a
/// strong colour. Values that are not finite are left out.
pub fn picture(content: &Content<'_>) -> String {
    let Content { cycle, report, .. } = content;
    let (musts, wishes) = seen(cycle, report);
    let mut scene = Scene::new(Frame::new(cycle, &musts, &wishes));
    let (place, size) = (scene.frame.place, scene.frame.size);
    scene.canvas.clip("map", place, size);
    let drawn = layers::draw(&mut scene, cycle);
    witness::draw(&mut scene, cycle, report);
    layers::ids(&mut scene, cycle);
    scene.canvas.close();
    scene.canvas.rect(place, size, "frame");
    legend::title(&mut scene.canvas, &content.title, &content.subtitle);
    legend::draw(&mut scene, &drawn);
    let height = place[1] + size[1] + LEGEND_HEIGHT;
    scene.canvas.document([PAGE_WIDTH, height], &content.title, STYLE)
}

/// Places that the window must hold, and places that it should hold when they are near.
fn seen(cycle: &Cycle, report: &Report) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let mut musts = witness::places(cycle, report);
    let ego = &cycle.ego;
    musts.extend(Rectangle::of_ego(ego, [ego.x, ego.y], [ego.cos, ego.sin]).corners());
    for point in cycle.trajectory.iter().flat_map(|it| &it.points) {
        musts.extend(layers::footprint(cycle, point).corners());
    }
    let tracks = cycle.tracks.iter().flat_map(|list| &list.items);
    let detections = cycle.detections.iter().flat_map(|list| &list.items);
    let wishes = tracks
        .map(|track| layers::track(track, 0.0))
        .chain(detections.map(layers::detection))
        .flat_map(|shape| shape.corners())
        .collect();
    (musts, wishes)
}
