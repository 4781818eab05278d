//! A picture from above that grows: roads, cars, paths and words, at their places in metres.

use super::canvas::Canvas;
use super::frame::{Frame, Rectangle};

/// What the looks are: classes of elements.
pub const STYLE: &str = "\
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

/// What is drawn, and where on the page the map is. `look`: a class of [`STYLE`], or of what stands beside it in the
/// document. What is no number, or too far to be drawn, is left out.
pub struct Scene {
    /// Where on the page what is drawn next is.
    pub frame: Frame,
    /// What is drawn; for what has its place on the page and not on the map.
    pub canvas: Canvas,
}

impl Scene {
    /// A scene in which nothing is drawn.
    pub fn new(frame: Frame) -> Self {
        Self { frame, canvas: Canvas::default() }
    }

    /// An area between places.
    pub fn polygon(&mut self, places: &[[f64; 2]], look: &str) {
        let corners = self.places(places);
        self.canvas.polygon(&corners, look);
    }

    /// A line through places.
    pub fn line(&mut self, places: &[[f64; 2]], look: &str) {
        let points = self.places(places);
        self.canvas.polyline(&points, look);
    }

    /// A line through places that is so wide, m, such as a road.
    pub fn band(&mut self, places: &[[f64; 2]], width_m: f64, look: &str) {
        let points = self.places(places);
        self.canvas.band(&points, width_m * self.frame.scale, look);
    }

    /// A line and its head, so long, of the looks `look-line` and `look-tip`; no head where the line is shorter.
    pub fn arrow(&mut self, ends: [[f64; 2]; 2], tip_px: f64, look: &str) {
        self.line(&ends, &format!("{look}-line"));
        if let [Some(from), Some(to)] = ends.map(|end| self.frame.at(end)) {
            self.canvas.tip(from, to, tip_px, &format!("{look}-tip"));
        }
    }

    /// A rectangle, such as a car.
    pub fn rectangle(&mut self, rectangle: &Rectangle, look: &str) {
        self.polygon(&rectangle.corners(), look);
    }

    /// The CAV: a rectangle with a nose.
    pub fn cav(&mut self, rectangle: &Rectangle) {
        self.rectangle(rectangle, "ego");
        let [length, width] = rectangle.size;
        let nose = [(0.5, 0.0), (0.25, 0.35), (0.25, -0.35)];
        self.polygon(&nose.map(|(a, b)| rectangle.point([a * length, b * width])), "nose");
    }

    /// A circle of so many metres.
    pub fn circle(&mut self, middle: [f64; 2], radius_m: f64, look: &str) {
        self.canvas.circle(self.frame.at(middle), radius_m * self.frame.scale, look);
    }

    /// A circle of so many px, whatever the scale is.
    pub fn dot(&mut self, middle: [f64; 2], radius_px: f64, look: &str) {
        self.canvas.circle(self.frame.at(middle), radius_px, look);
    }

    /// Words at a place, moved by so many px to the right and down.
    pub fn text(&mut self, place: [f64; 2], [right, down]: [f64; 2], look: &str, text: &str) {
        let at = self.frame.at(place).map(|[x, y]| [x + right, y + down]);
        self.canvas.text(at, look, text);
    }

    fn places(&self, places: &[[f64; 2]]) -> Vec<Option<[f64; 2]>> {
        places.iter().map(|place| self.frame.at(*place)).collect()
    }
}
