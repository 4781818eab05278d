//! Panels of lines on logarithmic axes, as SVG.

use std::fmt::Write as _;

/// A line of a panel.
pub struct Line {
    /// In the legend.
    pub name: &'static str,
    /// A colour of SVG.
    pub colour: &'static str,
    /// Drawn dashed.
    pub dashed: bool,
    /// (x, y), both above 0.
    pub points: Vec<(f64, f64)>,
}

/// A panel with its lines.
pub struct Panel {
    /// Above the panel.
    pub title: String,
    /// Below the panel.
    pub axis: &'static str,
    /// What is drawn.
    pub lines: Vec<Line>,
}

const WIDTH: f64 = 400.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 26.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 44.0;

/// Two panels a row, the legend of the first one below all; the text says what y is.
pub fn svg(panels: &[Panel], y_axis: &str) -> String {
    let rows = panels.len().div_ceil(2);
    let (width, height) = (2.0 * WIDTH, float(rows) * HEIGHT + 34.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    for (index, panel) in panels.iter().enumerate() {
        let (column, row) = (index % 2, index / 2);
        let corner = (float(column) * WIDTH, float(row) * HEIGHT);
        draw(&mut text, panel, corner, y_axis);
    }
    legend(&mut text, panels, height - 14.0);
    text.push_str("</svg>\n");
    text
}

/// Whole decades around the values.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut least, mut most) = (f64::MAX, f64::MIN);
    for value in values {
        least = least.min(value.log10().floor());
        most = most.max(value.log10().ceil());
    }
    (least, most.max(least + 1.0))
}

fn draw(text: &mut String, panel: &Panel, (left, top): (f64, f64), y_axis: &str) {
    let points = || panel.lines.iter().flat_map(|line| line.points.iter().copied());
    let (x_range, y_range) = (decades(points().map(|it| it.0)), decades(points().map(|it| it.1)));
    let part = |value: f64, (least, most): (f64, f64)| (value.log10() - least) / (most - least);
    let x = |value: f64| left + LEFT + part(value, x_range) * (WIDTH - LEFT - RIGHT);
    let y = |value: f64| top + HEIGHT - BOTTOM - part(value, y_range) * (HEIGHT - TOP - BOTTOM);
    let (x0, x1) = (left + LEFT, left + WIDTH - RIGHT);
    let (y0, y1) = (top + HEIGHT - BOTTOM, top + TOP);
    let _ = writeln!(
        text,
        "<text x=\"{x0:.1}\" y=\"{:.1}\" font-weight=\"bold\">{}</text>",
        y1 - 12.0,
        panel.title
    );
    for value in powers(x_range) {
        let at = x(value);
        let _ = writeln!(
            text,
            "<path d=\"M{at:.1} {y0:.1}V{y1:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{value}</text>",
            y0 + 16.0
        );
    }
    for value in powers(y_range) {
        let at = y(value);
        let _ = writeln!(
            text,
            "<path d=\"M{x0:.1} {at:.1}H{x1:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{value}</text>",
            x0 - 5.0,
            at + 4.0
        );
    }
    let (middle_x, middle_y) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
    let _ = writeln!(
        text,
        "<text x=\"{middle_x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\
         <text transform=\"translate({:.1} {middle_y:.1}) rotate(-90)\" \
         text-anchor=\"middle\">{y_axis}</text>",
        y0 + 34.0,
        panel.axis,
        left + 14.0
    );
    for line in &panel.lines {
        let places: Vec<String> =
            line.points.iter().map(|&(a, b)| format!("{:.1},{:.1}", x(a), y(b))).collect();
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>",
            places.join(" "),
            line.colour,
            dashes(line)
        );
        for &(a, b) in &line.points {
            let (cx, cy, colour) = (x(a), y(b), line.colour);
            let _ = writeln!(
                text,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"2.5\" fill=\"{colour}\"/>"
            );
        }
    }
}

fn legend(text: &mut String, panels: &[Panel], y: f64) {
    let mut x = LEFT;
    for line in panels.first().map_or(&[][..], |panel| &panel.lines) {
        let _ = writeln!(
            text,
            "<path d=\"M{x:.1} {:.1}h24\" stroke=\"{}\" stroke-width=\"2\"{}/>\
             <text x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
            y - 4.0,
            line.colour,
            dashes(line),
            x + 30.0,
            line.name
        );
        x += 60.0 + 7.0 * float(line.name.len());
    }
}

fn dashes(line: &Line) -> &'static str {
    if line.dashed { " stroke-dasharray=\"6 4\"" } else { "" }
}

/// The powers of ten of a range of decades.
fn powers((least, most): (f64, f64)) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(least), |power| Some(power + 1.0))
        .take_while(move |power| *power <= most)
        .map(|power| 10_f64.powf(power))
}

#[expect(clippy::cast_precision_loss, reason = "a few panels")]
fn float(count: usize) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_whole_decades() {
        let (least, most) = decades([3.0, 40.0].into_iter());
        assert!((least - 0.0).abs() < 1e-9 && (most - 2.0).abs() < 1e-9);
        assert_eq!(powers((0.0, 2.0)).count(), 3);
    }

    #[test]
    fn every_point_is_drawn() {
        let line = |name, dashed| Line {
            name,
            colour: "black",
            dashed,
            points: vec![(1.0, 1.0), (10.0, 5.0), (100.0, 90.0)],
        };
        let panel =
            Panel { title: "a".into(), axis: "b", lines: vec![line("c", false), line("d", true)] };
        let text = svg(&[panel], "us");
        assert_eq!(text.matches("<circle").count(), 6);
        assert_eq!(text.matches("<polyline").count(), 2);
        assert!(text.starts_with("<svg") && text.ends_with("</svg>\n"));
    }
}
