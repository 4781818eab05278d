//! A sheet of panels, as SVG: metres (or metres and seconds) on small maps, with a title above and
//! words below.

use mufasa_drives::pictures::canvas::Canvas;
use mufasa_model::numbers::rectangle::Rectangle;
use mufasa_model::numbers::vector::Vector;

const STYLE: &str = "\
text{font-family:'DejaVu Sans',Verdana,Helvetica,sans-serif;font-size:12px;fill:#1d2733}\
.h{font-size:13px;font-weight:bold}.m{text-anchor:middle}.e{text-anchor:end}\
.frame{fill:none;stroke:#c3ccd5}.axis{stroke:#6a7683;fill:none}\
.cav{fill:#1b8a5a;fill-opacity:.25;stroke:#0f5e3c;stroke-width:1.3}\
.cavs{fill:none;stroke:#0f5e3c;stroke-opacity:.35}\
.inner{fill:#1b8a5a;fill-opacity:.35;stroke:#0f5e3c;stroke-dasharray:4 3}\
.path{fill:none;stroke:#0f5e3c;stroke-width:1.5}.place{fill:#0f5e3c}\
.node{fill:#fff;stroke:#0f5e3c;stroke-width:1.6}\
.track{fill:#3b6fb6;fill-opacity:.25;stroke:#2a4f85;stroke-width:1.3}\
.det{fill:none;stroke:#c97200;stroke-width:2}\
.item{fill:none;stroke:#c97200;stroke-width:1.2;stroke-dasharray:3 3}\
.object{fill:#7a5aa8;fill-opacity:.3;stroke:#56397f;stroke-width:1.3}\
.swept{fill:#7a5aa8;fill-opacity:.12;stroke:#56397f;stroke-dasharray:4 3}\
.wrong{fill:#e4002b;fill-opacity:.3;stroke:#e4002b;stroke-width:1.3}\
.limit{fill:none;stroke:#6a7683;stroke-dasharray:5 3}\
.yes{fill:#1b8a5a;fill-opacity:.5}.no{fill:#e4002b;fill-opacity:.5}\
.line{fill:none;stroke:#1d2733}.tip{fill:#1d2733}\
.road{fill:none;stroke:#9aa8b6;stroke-dasharray:8 5}\
.hit{fill:#e4002b;fill-opacity:.45;stroke:#fff;stroke-width:.6}";

const MARGIN: f64 = 14.0;
const TITLE: f64 = 22.0;
const LINE: f64 = 16.0;
/// Width of a letter, px, at most on the average of a line.
const LETTER: f64 = 6.6;

/// Panels of one size in rows.
pub struct Sheet {
    columns: usize,
    size: [f64; 2],
    lines: usize,
    count: usize,
    /// That of the first panel.
    title: String,
    canvas: Canvas,
}

/// What a panel shows, and its words.
pub struct Look<'a> {
    /// Above it.
    pub title: &'a str,
    /// Below it, in as many lines as there is room for.
    pub words: &'a str,
    /// Lower left corner, m.
    pub low: [f64; 2],
    /// px per m along x and y.
    pub scale: [f64; 2],
}

impl Sheet {
    /// Panels of `size` px in `columns`, each with room for `lines` lines of words.
    pub fn new(columns: usize, size: [f64; 2], lines: usize) -> Self {
        Self { columns, size, lines, count: 0, title: String::new(), canvas: Canvas::default() }
    }

    fn step(&self) -> [f64; 2] {
        let [width, height] = self.size;
        [width + MARGIN, TITLE + height + LINE * count(self.lines) + MARGIN]
    }

    /// Draws the next panel.
    pub fn panel(&mut self, look: &Look<'_>, draw: impl FnOnce(&mut Pen<'_>)) {
        let [column, row] = [self.count % self.columns, self.count / self.columns].map(count);
        let [width, height] = self.size;
        let corner = [MARGIN + column * self.step()[0], TITLE + row * self.step()[1]];
        if self.count == 0 {
            look.title.clone_into(&mut self.title);
        }
        self.count += 1;
        self.canvas.open(&format!("transform=\"translate({},{})\"", corner[0], corner[1]));
        self.canvas.text(Some([0.0, -7.0]), "h", look.title);
        let lines = wrapped(look.words, width / LETTER);
        assert!(lines.len() <= self.lines, "{}: {} lines", look.title, lines.len());
        for (i, line) in lines.iter().enumerate() {
            self.canvas.text(Some([0.0, height + LINE * (count(i) + 0.9)]), "", line);
        }
        self.canvas.clip(&format!("p{}", self.count), [0.0; 2], self.size);
        draw(&mut Pen { canvas: &mut self.canvas, low: look.low, scale: look.scale, height });
        self.canvas.close();
        self.canvas.rect([0.0, 0.0], [width, height], "frame");
        self.canvas.close();
    }

    /// The document.
    pub fn finish(self) -> String {
        let rows = self.count.div_ceil(self.columns);
        let [across, down] = self.step();
        let (width, height) = (MARGIN + count(self.columns) * across, count(rows) * down);
        self.canvas.document([width, height], &self.title, STYLE)
    }
}

/// Draws in a panel.
pub struct Pen<'a> {
    canvas: &'a mut Canvas,
    low: [f64; 2],
    scale: [f64; 2],
    height: f64,
}

impl Pen<'_> {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [right, up] = [(x - self.low[0]) * self.scale[0], (y - self.low[1]) * self.scale[1]];
        [right, self.height - up]
    }

    /// A closed polygon.
    pub fn area(&mut self, corners: &[[f64; 2]], class: &str) {
        let corners: Vec<_> = corners.iter().map(|corner| Some(self.at(*corner))).collect();
        self.canvas.polygon(&corners, class);
    }

    /// A rectangle of the model.
    pub fn rectangle(&mut self, of: &Rectangle, class: &str) {
        self.area(&corners(of), class);
    }

    /// A line through points.
    pub fn line(&mut self, points: &[[f64; 2]], class: &str) {
        let points: Vec<_> = points.iter().map(|point| Some(self.at(*point))).collect();
        self.canvas.polyline(&points, class);
    }

    /// An arrow.
    pub fn arrow(&mut self, from: [f64; 2], to: [f64; 2]) {
        let (a, b) = (self.at(from), self.at(to));
        self.canvas.polyline(&[Some(a), Some(b)], "line");
        self.canvas.tip(a, b, 7.0, "tip");
    }

    /// A bar along x with its ends, and words above it.
    pub fn bar(&mut self, from: f64, to: f64, y: f64, words: &str) {
        self.line(&[[from, y], [to, y]], "line");
        [from, to].iter().for_each(|x| self.line(&[[*x, y - 0.1], [*x, y + 0.1]], "line"));
        self.words([from.midpoint(to), y], [0.0, -4.0], "m", words);
    }

    /// A dot of a radius in px.
    pub fn dot(&mut self, at: [f64; 2], radius: f64, class: &str) {
        self.canvas.circle(Some(self.at(at)), radius, class);
    }

    /// A circle of a radius in m.
    pub fn circle(&mut self, at: [f64; 2], radius: f64, class: &str) {
        self.canvas.circle(Some(self.at(at)), radius * self.scale[0], class);
    }

    /// Words at a place, moved by px to the right and down.
    pub fn words(&mut self, at: [f64; 2], by: [f64; 2], class: &str, words: &str) {
        let [x, y] = self.at(at);
        self.canvas.text(Some([x + by[0], y + by[1]]), class, words);
    }
}

/// Lines of at most so many letters.
fn wrapped(words: &str, letters: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut().filter(|line| count(line.len() + 1 + word.len()) <= letters) {
            Some(line) => *line = format!("{line} {word}"),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A vector of the model.
pub fn xy(of: &Vector) -> [f64; 2] {
    [of.x.near(), of.y.near()]
}

/// Corners of a rectangle of the model in turn.
pub fn corners(of: &Rectangle) -> [[f64; 2]; 4] {
    let (a, b) = (&of.half_length, &of.half_width);
    [(a.clone(), b.clone()), (a.clone(), -b), (-a, -b), (-a, b.clone())]
        .map(|(along, left)| xy(&of.frame.point(&along, &left)))
}

fn count(n: usize) -> f64 {
    u32::try_from(n).map_or(0.0, f64::from)
}
