//! What all charts have in common: the page with title, notes and key, scales, and marks.
//!
//! Colours are those of Okabe and Ito, which colour-blind readers tell apart, and every series has a shape of
//! its own. Where a reader's screen is dark, so is the page.

use std::fmt::Write as _;

use mufasa_drives::pictures::canvas::{Canvas, escape};

/// Width of every chart, px.
pub(super) const WIDTH: f64 = 900.0;
/// Distance of what is drawn from the left and right edge, px.
pub(super) const MARGIN: f64 = 20.0;

const STYLE: &str = "\
.chart text{font-family:'DejaVu Sans',Verdana,Helvetica,sans-serif;fill:#1d2733;font-size:13px}\
.chart .title{font-size:18px;font-weight:bold}.chart .about{font-size:12.5px;fill:#4b5866}\
.chart .middle{text-anchor:middle}.chart .end{text-anchor:end}\
.chart .small{font-size:11.5px;text-anchor:middle}.chart .faint{font-size:11.5px;text-anchor:middle;fill:#4b5866}\
.chart .page{fill:#fff}.chart .grid{stroke:#d5dbe1;stroke-width:1;fill:none}\
.chart .axis{stroke:#6a7683;stroke-width:1.2;fill:none}\
.chart .sofof{fill:#e69f00}.chart .paper{fill:#0072b2}.chart .hardened{fill:#009e73}\
.chart .published{fill:#fff;fill-opacity:.9;stroke:#1d2733;stroke-width:1.8}\
.chart .pale{fill-opacity:.4}.chart .open{fill-opacity:0}\
.chart .sofof-line,.chart .sofof{stroke:#e69f00}.chart .paper-line,.chart .paper{stroke:#0072b2}\
.chart .hardened-line,.chart .hardened{stroke:#009e73}\
.chart .sofof,.chart .paper,.chart .hardened{stroke-width:1.6}\
.chart .sofof-line,.chart .paper-line,.chart .hardened-line{stroke-width:2;fill:none}\
.chart .control{stroke-dasharray:5 4;stroke-width:1.6}\
.chart .bad{stroke:#d55e00;stroke-width:2.2;fill:none}\
.chart .dot{stroke:none;fill-opacity:.55}.chart .best{stroke:#1d2733;stroke-width:1.8;fill:none}\
@media (prefers-color-scheme:dark){.chart .page{fill:#15191e}.chart text{fill:#e8edf2}\
.chart .about,.chart .faint{fill:#a9b4bf}.chart .grid{stroke:#343c45}.chart .axis{stroke:#8694a3}\
.chart .paper{fill:#56b4e9;stroke:#56b4e9}.chart .paper-line{stroke:#56b4e9}\
.chart .published{fill:#15191e}.chart .published,.chart .best{stroke:#e8edf2}}";

/// A shape that a value is drawn as.
#[derive(Clone, Copy)]
pub(super) enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
}

/// What belongs together, and how it looks.
#[derive(Clone, Copy)]
pub(super) struct Series {
    pub(super) name: &'static str,
    pub(super) class: &'static str,
    pub(super) mark: Mark,
}

impl Series {
    /// Checked by quality of service alone.
    pub(super) const SOFOF: Self = Self { name: "sofof", class: "sofof", mark: Mark::Triangle };
    /// By the paper's stages.
    pub(super) const PAPER: Self =
        Self { name: "paper (profile)", class: "paper", mark: Mark::Circle };
    /// By the hardened ones.
    pub(super) const HARDENED: Self =
        Self { name: "hardened", class: "hardened", mark: Mark::Square };
    /// What the paper says.
    pub(super) const PUBLISHED: Self =
        Self { name: "published in the paper", class: "published", mark: Mark::Diamond };
}

/// From values to places, px.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) values: [f64; 2],
    pub(super) places: [f64; 2],
    pub(super) is_log: bool,
}

impl Scale {
    /// The place of a value; what is off the scale is at its end.
    pub(super) fn at(&self, value: f64) -> f64 {
        let of = |value: f64| if self.is_log { value.log10() } else { value };
        let [from, to] = self.values;
        let share = (of(value.clamp(from, to)) - of(from)) / (of(to) - of(from));
        self.places[0] + share * (self.places[1] - self.places[0])
    }
}

/// A chart that grows.
pub(super) struct Page {
    pub(super) canvas: Canvas,
    height: f64,
    title: String,
}

impl Page {
    /// With a title, lines about it, and a key; also gives where they end, px.
    pub(super) fn new(title: &str, about: &[&str], key: &[Series]) -> (Self, f64) {
        let mut page = Self { canvas: Canvas::default(), height: 0.0, title: title.to_owned() };
        page.text([MARGIN, 28.0], "title", title);
        let mut y = 28.0;
        for line in about {
            y += 19.0;
            page.text([MARGIN, y], "about", line);
        }
        y += 24.0;
        let mut x = MARGIN;
        for series in key {
            page.mark([x + 7.0, y - 4.5], *series, "");
            page.text([x + 19.0, y], "key", series.name);
            x += 42.0 + 7.6 * letters(series.name);
        }
        (page, y + 12.0)
    }

    /// So high it is, px.
    pub(super) fn ends(&mut self, height: f64) {
        self.height = height;
    }

    pub(super) fn text(&mut self, at: [f64; 2], class: &str, text: &str) {
        self.canvas.text(Some(at), class, text);
    }

    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], class: &str) {
        self.canvas.polyline(&[Some(from), Some(to)], class);
    }

    /// A value. `more`: classes beside that of the series.
    pub(super) fn mark(&mut self, [x, y]: [f64; 2], series: Series, more: &str) {
        let class = format!("{} {more}", series.class);
        let corners = |places: &[[f64; 2]]| -> Vec<Option<[f64; 2]>> {
            places.iter().map(|[dx, dy]| Some([x + dx, y + dy])).collect()
        };
        let canvas = &mut self.canvas;
        match series.mark {
            Mark::Circle => canvas.circle(Some([x, y]), 4.6, &class),
            Mark::Square => {
                let places = [[-4.2, -4.2], [4.2, -4.2], [4.2, 4.2], [-4.2, 4.2]];
                canvas.polygon(&corners(&places), &class);
            }
            Mark::Triangle => {
                canvas.polygon(&corners(&[[0.0, -5.6], [5.2, 4.0], [-5.2, 4.0]]), &class);
            }
            Mark::Diamond => {
                let places = [[0.0, -6.4], [6.0, 0.0], [0.0, 6.4], [-6.0, 0.0]];
                canvas.polygon(&corners(&places), &class);
            }
            Mark::Cross => {
                canvas.polyline(&corners(&[[-4.6, -4.6], [4.6, 4.6]]), &class);
                canvas.polyline(&corners(&[[-4.6, 4.6], [4.6, -4.6]]), &class);
            }
        }
    }

    /// The whole file.
    pub(super) fn svg(self) -> String {
        let Self { canvas, height, title } = self;
        let title = escape(&title);
        let mut out = String::new();
        // A string takes everything.
        let _ = write!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" role=\"img\" width=\"{WIDTH}\" \
             height=\"{height:.0}\" viewBox=\"0 0 {WIDTH} {height:.0}\">\n<title>{title}</title>\n\
             <style>{STYLE}</style>\n<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n"
        );
        out.push_str(&canvas.into_body());
        out.push_str("</svg>\n");
        out
    }
}

/// Letters of a text.
pub(super) fn letters(text: &str) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "some dozens")]
    let count = text.chars().count() as f64;
    count
}

/// The place in a row of something counted from 0.
pub(super) fn nth(index: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "some dozens")]
    let nth = index as f64;
    nth
}
