//! Pictures of cycles from above, as SVG: for people, not for verdicts (plain `f64`).

pub mod canvas;
mod frame;
mod layers;
mod legend;
pub mod sequence;
mod witness;

use std::fmt::Write as _;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::Report;

pub use canvas::escape;

use canvas::Canvas;
use frame::{Frame, MARGIN, PAGE_WIDTH, Rectangle, TITLE_HEIGHT};
use legend::LEGEND_HEIGHT;

const STYLE: &str = "\
text{font-family:'DejaVu Sans',Verdana,Helvetica,sans-serif;fill:#1d2733}\
.title{font-size:19px;font-weight:bold}.subtitle{font-size:15px;fill:#b3001f}\
.legend{font-size:12.5px}.middle{font-size:12.5px;text-anchor:middle}\
.id{font-size:11px;text-anchor:middle;fill:#14305c;stroke:#fff;stroke-width:3;\
stroke-opacity:.75;paint-order:stroke}\
.corridor{fill:#e9eef3;stroke:#e9eef3;stroke-width:.6}\
.boundary{fill:none;stroke:#9aa8b6;stroke-width:1.5}\
.reference{fill:none;stroke:#8694a3;stroke-width:1.2;stroke-dasharray:8 5}\
.occupied{fill:#5b4a3c;fill-opacity:.4}.unknown{fill:#c9bfae;fill-opacity:.45}\
.detection{fill:none;stroke:#e08600;stroke-width:2;stroke-dasharray:5 3}\
.history{fill:none;stroke:#e08600;stroke-opacity:.45;stroke-width:1;stroke-dasharray:2 3}\
.track{fill:#3b6fb6;fill-opacity:.32;stroke:#2a4f85;stroke-width:1.5}\
.prediction{fill:#3b6fb6;fill-opacity:.05;stroke:#2a4f85;stroke-opacity:.28;stroke-width:1}\
.footprint{fill:#1b8a5a;fill-opacity:.05;stroke:#1b8a5a;stroke-opacity:.4;stroke-width:1}\
.trajectory{fill:none;stroke:#1b8a5a;stroke-width:2}.point{fill:#0f5e3c}\
.ego{fill:#1b8a5a;fill-opacity:.55;stroke:#0f5e3c;stroke-width:1.5}.nose{fill:#0f5e3c}\
.witness{fill:#e4002b;fill-opacity:.22;stroke:#e4002b;stroke-width:2.5}\
.witness-line{fill:none;stroke:#e4002b;stroke-width:2}\
.witness-tip{fill:#e4002b}\
.disk{fill:none;stroke:#e4002b;stroke-width:1.2;stroke-dasharray:4 3}\
.leader{fill:none;stroke:#b3001f;stroke-width:1.2}\
.label{fill:#fff;fill-opacity:.93;stroke:#b3001f;stroke-width:1.4}\
.label-text{font-size:12.5px;text-anchor:middle;fill:#b3001f}\
.frame{fill:none;stroke:#6a7683;stroke-width:1}\
.scale{fill:none;stroke:#1d2733;stroke-width:2}.arrow{fill:#1d2733}";

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
    let frame = Frame::new(cycle, &musts, &wishes);
    let mut map = Canvas::default();
    map.open("clip-path=\"url(#map)\"");
    let drawn = layers::draw(&mut map, &frame, cycle);
    witness::draw(&mut map, &frame, cycle, report);
    layers::ids(&mut map, &frame, cycle);
    map.close();
    let size = [PAGE_WIDTH - 2.0 * MARGIN, frame.height];
    map.rect([MARGIN, TITLE_HEIGHT], size, "frame");
    legend::title(&mut map, &content.title, &content.subtitle);
    legend::draw(&mut map, &frame, &drawn);
    document(&frame, &content.title, map)
}

fn document(frame: &Frame, title: &str, body: Canvas) -> String {
    let height = TITLE_HEIGHT + frame.height + LEGEND_HEIGHT;
    let title = escape(title);
    let (width, map_height) = (PAGE_WIDTH - 2.0 * MARGIN, frame.height);
    let mut out = String::new();
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{PAGE_WIDTH}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {PAGE_WIDTH} {height:.0}\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n\
         <clipPath id=\"map\"><rect x=\"{MARGIN}\" y=\"{TITLE_HEIGHT}\" width=\"{width}\" \
         height=\"{map_height:.1}\"/></clipPath>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    out.push_str(&body.into_body());
    out.push_str("</svg>\n");
    out
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
