//! Rows of marks along a logarithmic scale, in panels beside each other.

use super::page::{MARGIN, Page, Scale, Series, WIDTH, nth};

/// Height of a row, px.
const ROW: f64 = 22.0;
/// Distance of two panels, px.
const APART: f64 = 26.0;
/// The column for what is off the scale, px.
const OFF: f64 = 44.0;

/// A value in a row of a panel.
pub(super) struct Dot {
    pub(super) row: usize,
    /// None: in the column beside the scale.
    pub(super) value: Option<f64>,
    pub(super) series: Series,
    /// Whether it is drawn open.
    pub(super) is_open: bool,
    /// Above or below the middle of its row, px.
    pub(super) shift: f64,
}

/// Rows of dots.
pub(super) struct Panel {
    pub(super) name: String,
    pub(super) dots: Vec<Dot>,
    /// Values that all rows are to be compared with.
    pub(super) lines: Vec<(f64, &'static str)>,
}

/// What is drawn.
pub(super) struct Dots<'t> {
    pub(super) title: &'t str,
    pub(super) about: &'t [&'t str],
    pub(super) key: &'t [Series],
    pub(super) rows: Vec<String>,
    /// For the names of the rows, px.
    pub(super) left: f64,
    /// Powers of ten of the scale: from, to.
    pub(super) powers: [i32; 2],
    pub(super) unit: &'t str,
    /// The name of the column beside the scale; none: there is no such column.
    pub(super) off: Option<&'t str>,
    pub(super) panels: Vec<Panel>,
}

/// As an SVG document.
pub(super) fn draw(dots: &Dots<'_>) -> String {
    let (mut page, top) = Page::new(dots.title, dots.about, dots.key);
    let top = top + 30.0;
    let bottom = top + ROW * nth(dots.rows.len());
    for (index, row) in dots.rows.iter().enumerate() {
        let at = top + ROW * (nth(index) + 0.5);
        page.text([MARGIN + dots.left - 10.0, at + 4.5], "end", row);
    }
    let count = nth(dots.panels.len().max(1));
    let all = WIDTH - 2.0 * MARGIN - dots.left;
    let wide = (all - APART * (count - 1.0)) / count;
    for (index, panel) in dots.panels.iter().enumerate() {
        let left = MARGIN + dots.left + (wide + APART) * nth(index);
        one(&mut page, dots, panel, ([left, left + wide], [top, bottom]));
    }
    // Below the name of the column beside the scale.
    let below = bottom + if dots.off.is_some() { 56.0 } else { 40.0 };
    page.text([MARGIN + dots.left + all / 2.0, below], "middle", dots.unit);
    page.ends(below + 16.0);
    page.svg()
}

fn one(
    page: &mut Page,
    dots: &Dots<'_>,
    panel: &Panel,
    ([left, right], [top, bottom]): ([f64; 2], [f64; 2]),
) {
    let end = if dots.off.is_some() { right - OFF } else { right };
    let [from, to] = dots.powers;
    let values = [10_f64.powi(from), 10_f64.powi(to)];
    let x = Scale { values, places: [left + 8.0, end - 8.0], is_log: true };
    page.text([f64::midpoint(left, end), top - 10.0], "middle", &panel.name);
    for power in from..=to {
        let (value, at) = (10_f64.powi(power), x.at(10_f64.powi(power)));
        page.line([at, top], [at, bottom], "grid");
        page.text([at, bottom + 18.0], "small", &format!("{value}"));
    }
    for row in 0..=dots.rows.len() {
        let at = top + ROW * nth(row);
        page.line([left, at], [right, at], "grid");
    }
    if let Some(off) = dots.off {
        page.line([end, top], [end, bottom], "axis");
        page.text([end + OFF / 2.0, bottom + 34.0], "small", off);
    }
    for (value, class) in &panel.lines {
        let at = x.at(*value);
        page.line([at, top], [at, bottom], &format!("{class} control"));
    }
    for dot in &panel.dots {
        let y = top + ROW * (nth(dot.row) + 0.5) + dot.shift;
        let at = dot.value.map_or(end + OFF / 2.0, |value| x.at(value));
        page.mark([at, y], dot.series, if dot.is_open { "open" } else { "" });
    }
    page.line([left, bottom], [right, bottom], "axis");
}
