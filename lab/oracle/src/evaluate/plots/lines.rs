//! Small charts of lines beside and below each other; and one of every run of a search.

use super::page::{MARGIN, Mark, Page, Scale, Series, WIDTH, nth};

/// Height of a small chart, and its distance from the next below and beside it, px.
const HIGH: f64 = 130.0;
const BELOW: f64 = 46.0;
const BESIDE: f64 = 22.0;
/// Height of the chart of a search, px.
const SEARCH: f64 = 280.0;

/// A small chart.
pub(super) struct Small {
    pub(super) name: String,
    /// The values along it, evenly apart.
    pub(super) names: Vec<String>,
    /// One value for each.
    pub(super) lines: Vec<(Series, Vec<f64>)>,
}

/// A row of small charts with one scale.
pub(super) struct Row {
    pub(super) unit: &'static str,
    pub(super) most: f64,
    pub(super) step: f64,
    pub(super) charts: Vec<Small>,
}

/// What is drawn: as an SVG document.
pub(super) fn draw(title: &str, about: &[&str], key: &[Series], rows: &[Row]) -> String {
    let (mut page, top) = Page::new(title, about, key);
    let (left, mut top) = (MARGIN + 44.0, top + 40.0);
    for row in rows {
        page.text([MARGIN, top - 26.0], "", row.unit);
        let y = Scale { values: [0.0, row.most], places: [top + HIGH, top], is_log: false };
        let count = nth(row.charts.len().max(1));
        let wide = (WIDTH - MARGIN - left - BESIDE * (count - 1.0)) / count;
        for (index, chart) in row.charts.iter().enumerate() {
            let from = left + (wide + BESIDE) * nth(index);
            small(&mut page, chart, (row.step, &y), [from, from + wide]);
        }
        let mut value = 0.0;
        while value <= row.most * 1.0001 {
            page.text([left - 8.0, y.at(value) + 4.5], "end", &format!("{value:.0}"));
            value += row.step;
        }
        top += HIGH + BELOW + 30.0;
    }
    page.ends(top - 36.0);
    page.svg()
}

fn small(page: &mut Page, chart: &Small, (step, y): (f64, &Scale), [left, right]: [f64; 2]) {
    page.text([f64::midpoint(left, right), y.places[1] - 8.0], "middle", &chart.name);
    let mut value = 0.0;
    while value <= y.values[1] * 1.0001 {
        page.line([left, y.at(value)], [right, y.at(value)], "grid");
        value += step;
    }
    let bottom = y.places[0];
    page.line([left, bottom], [right, bottom], "axis");
    let each = (right - left) / nth(chart.names.len().max(1));
    let x = |index: usize| left + each * (nth(index) + 0.5);
    for (index, name) in chart.names.iter().enumerate() {
        page.text([x(index), bottom + 17.0], "small", name);
    }
    for (series, values) in &chart.lines {
        let points = values.iter().enumerate().map(|(index, it)| Some([x(index), y.at(*it)]));
        page.canvas.polyline(&points.collect::<Vec<_>>(), &format!("{}-line", series.class));
        for (index, value) in values.iter().enumerate() {
            page.mark([x(index), y.at(*value)], *series, "");
        }
    }
}

/// A run of a search.
pub(super) struct Tried {
    pub(super) series: Series,
    /// None: a collision.
    pub(super) value: Option<f64>,
}

/// A run that collided.
pub(super) const COLLIDED: Series = Series { name: "collided", class: "bad", mark: Mark::Cross };

/// Every run of a search in its order, and the least value up to each; `rounds`: runs before each round.
pub(super) fn search(
    title: &str,
    about: &[&str],
    key: &[Series],
    (unit, most): (&str, f64),
    (tried, rounds): (&[Tried], &[usize]),
) -> String {
    let (mut page, top) = Page::new(title, about, key);
    let (left, top) = (MARGIN + 66.0, top + 30.0);
    let bottom = top + SEARCH;
    // Collisions have a row of their own below zero.
    let y = Scale { values: [0.0, most], places: [bottom - 30.0, top], is_log: false };
    let places = [left, WIDTH - MARGIN];
    let x = Scale { values: [0.0, nth(tried.len().max(1))], places, is_log: false };
    page.text([MARGIN, top - 12.0], "", unit);
    let mut value = 0.0;
    while value <= most {
        page.line([left, y.at(value)], [places[1], y.at(value)], "grid");
        page.text([left - 8.0, y.at(value) + 4.5], "end", &format!("{value:.0}"));
        value += 1.0;
    }
    page.text([left - 8.0, bottom - 7.5], "end", "collided");
    for before in rounds {
        let at = x.at(nth(*before));
        page.line([at, top], [at, bottom], "axis");
    }
    let step = [10, 20, 50, 100, 200, 500, 1000, 5000, 20_000];
    let step = step.into_iter().find(|step| tried.len() / step <= 10).unwrap_or(100_000);
    for run in (0..=tried.len()).step_by(step) {
        page.text([x.at(nth(run)), bottom + 18.0], "small", &run.to_string());
    }
    page.text([f64::midpoint(left, places[1]), bottom + 38.0], "middle", "runs with attacks");
    let mut least = most;
    let mut best = vec![Some([left, y.at(least)])];
    for (run, it) in tried.iter().enumerate() {
        let at = x.at(nth(run) + 0.5);
        match it.value {
            Some(value) => {
                page.canvas.circle(
                    Some([at, y.at(value)]),
                    2.6,
                    &format!("{} dot", it.series.class),
                );
                if value < least {
                    best.push(Some([at, y.at(least)]));
                    least = value;
                    best.push(Some([at, y.at(least)]));
                }
            }
            None => page.mark([at, bottom - 12.0], COLLIDED, ""),
        }
    }
    best.push(Some([places[1], y.at(least)]));
    page.canvas.polyline(&best, "best");
    page.line([left, bottom], [places[1], bottom], "axis");
    page.ends(bottom + 54.0);
    page.svg()
}
