//! Title, legend, scale bar and the direction of the map.

use super::canvas::Canvas;
use super::frame::{Frame, MARGIN, PAGE_WIDTH};
use super::layers::Layer;
use super::scene::Scene;

/// Height of the strip below the map, px.
pub const LEGEND_HEIGHT: f64 = 76.0;
/// Width of a character of the legend, px.
const CHARACTER: f64 = 6.5;
/// Room for the scale bar and the arrow on the right, px.
const RIGHT: f64 = 230.0;

/// Two lines above the map.
pub fn title(canvas: &mut Canvas, first: &str, second: &str) {
    canvas.text(Some([MARGIN, 32.0]), "title", &shortened(first, 105));
    canvas.text(Some([MARGIN, 60.0]), "subtitle", &shortened(second, 140));
}

/// Legend of the layers drawn, scale bar, and the direction of the map's y axis.
pub fn draw(Scene { canvas, frame }: &mut Scene, layers: &[Layer]) {
    let top = frame.place[1] + frame.size[1];
    entries(canvas, layers, top);
    scale_bar(canvas, frame, top);
    north(canvas, frame, top);
}

fn entries(canvas: &mut Canvas, layers: &[Layer], top: f64) {
    let named = layers.iter().map(|layer| entry(*layer)).chain([(&["witness"][..], "witness")]);
    let (mut x, mut y) = (MARGIN, top + 16.0);
    for (classes, text) in named {
        #[expect(clippy::cast_precision_loss)] // of a picture
        let width = text.chars().count() as f64 * CHARACTER + 50.0;
        if x + width > PAGE_WIDTH - MARGIN - RIGHT {
            (x, y) = (MARGIN, y + 26.0);
        }
        for class in classes {
            match *class {
                "reference" | "trajectory" => {
                    canvas.polyline(&[Some([x, y + 8.0]), Some([x + 26.0, y + 8.0])], class);
                }
                class => canvas.rect([x, y], [26.0, 15.0], class),
            }
        }
        canvas.text(Some([x + 32.0, y + 12.0]), "legend", text);
        x += width;
    }
}

fn entry(layer: Layer) -> (&'static [&'static str], &'static str) {
    match layer {
        Layer::Route => (&["corridor", "reference"], "corridor, reference path"),
        Layer::Occupied => (&["occupied"], "occupied"),
        Layer::Unknown => (&["unknown"], "unknown"),
        Layer::History => (&["history"], "detection, earlier"),
        Layer::Detections => (&["detection"], "detection"),
        Layer::Tracks => (&["track"], "track"),
        Layer::Predictions => (&["prediction"], "track, predicted"),
        Layer::Trajectory => (&["footprint", "trajectory"], "trajectory"),
        Layer::Ego => (&["ego"], "CAV"),
    }
}

fn scale_bar(canvas: &mut Canvas, frame: &Frame, top: f64) {
    let metres = [50.0, 20.0, 10.0, 5.0, 2.0]
        .into_iter()
        .find(|metres| metres * frame.scale <= 170.0)
        .unwrap_or(1.0);
    let width = metres * frame.scale;
    let (right, y) = (PAGE_WIDTH - MARGIN - 60.0, top + 26.0);
    let left = right - width;
    canvas.polyline(&[Some([left, y]), Some([right, y])], "scale");
    for x in [left, right] {
        canvas.polyline(&[Some([x, y - 5.0]), Some([x, y + 5.0])], "scale");
    }
    canvas.text(Some([left + width / 2.0, y + 20.0]), "middle", &format!("{metres} m"));
}

fn north(canvas: &mut Canvas, frame: &Frame, top: f64) {
    let centre = [PAGE_WIDTH - MARGIN - 22.0, top + 30.0];
    let [right, down] = frame.north();
    let at = |along: f64, across: f64| {
        Some([centre[0] + along * right - across * down, centre[1] + along * down + across * right])
    };
    canvas.polyline(&[at(-14.0, 0.0), at(14.0, 0.0)], "scale");
    canvas.polygon(&[at(17.0, 0.0), at(8.0, 4.5), at(8.0, -4.5)], "arrow");
    canvas.text(Some([centre[0], top + 66.0]), "middle", "map y");
}

fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most - 1).chain(['…']).collect()
}
