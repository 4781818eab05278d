//! Groups of bars, with what the paper published beside ours.

use super::page::{MARGIN, Page, Scale, Series, WIDTH, nth};

/// Height of the bars, px.
const HIGH: f64 = 230.0;

/// A bar.
pub(super) struct Bar {
    pub(super) series: Series,
    /// What is drawn in full, and what is drawn paler on top of it.
    pub(super) value: f64,
    pub(super) paler: f64,
    /// Over it.
    pub(super) label: String,
    /// What the paper published, as far as it gives numbers.
    pub(super) published: Vec<f64>,
}

/// Bars beside each other.
pub(super) struct Group {
    pub(super) name: String,
    pub(super) bars: Vec<Bar>,
    /// Below its name.
    pub(super) note: String,
}

/// What is drawn.
pub(super) struct Bars<'t> {
    pub(super) title: &'t str,
    pub(super) about: &'t [&'t str],
    pub(super) key: &'t [Series],
    /// What is counted.
    pub(super) unit: &'t str,
    /// The greatest value, and how far the lines are apart.
    pub(super) most: f64,
    pub(super) step: f64,
    pub(super) groups: Vec<Group>,
}

/// As an SVG document.
pub(super) fn draw(bars: &Bars<'_>) -> String {
    let (mut page, top) = Page::new(bars.title, bars.about, bars.key);
    let top = top + 36.0;
    let left = MARGIN + 44.0;
    let y = Scale { values: [0.0, bars.most], places: [top + HIGH, top], is_log: false };
    page.text([MARGIN, top - 26.0], "", bars.unit);
    let mut value = 0.0;
    while value <= bars.most * 1.0001 {
        let at = y.at(value);
        page.line([left, at], [WIDTH - MARGIN, at], "grid");
        page.text([left - 8.0, at + 4.5], "end", &format!("{value:.0}"));
        value += bars.step;
    }
    let wide = (WIDTH - MARGIN - left) / nth(bars.groups.len().max(1));
    for (index, group) in bars.groups.iter().enumerate() {
        let middle = left + wide * (nth(index) + 0.5);
        page.text([middle, top + HIGH + 20.0], "middle", &group.name);
        page.text([middle, top + HIGH + 38.0], "faint", &group.note);
        let each = (wide * 0.86 / nth(group.bars.len().max(1))).min(64.0);
        let first = middle - each * nth(group.bars.len()) / 2.0;
        for (index, bar) in group.bars.iter().enumerate() {
            one(&mut page, bar, &y, [first + each * nth(index), each]);
        }
    }
    page.line([left, top + HIGH], [WIDTH - MARGIN, top + HIGH], "axis");
    let has_notes = bars.groups.iter().any(|it| !it.note.is_empty());
    page.ends(top + HIGH + if has_notes { 54.0 } else { 36.0 });
    page.svg()
}

fn one(page: &mut Page, bar: &Bar, y: &Scale, [left, each]: [f64; 2]) {
    let (wide, middle) = (each * 0.72, left + each / 2.0);
    let mut place = |from: f64, to: f64, class: &str| {
        if to > from {
            let size = [wide, y.at(from) - y.at(to)];
            page.canvas.rect([middle - wide / 2.0, y.at(to)], size, class);
        }
    };
    let all = bar.value + bar.paler;
    place(0.0, bar.value, bar.series.class);
    place(bar.value, all, &format!("{} pale", bar.series.class));
    let highest = bar.published.iter().fold(all, |most, it| most.max(*it));
    let is_marked = bar.published.iter().any(|it| *it >= all);
    let above = if is_marked { 14.0 } else { 8.0 };
    let words = bar.label.split('\n').rev();
    for (line, words) in words.enumerate() {
        page.text([middle, y.at(highest) - above - 14.0 * nth(line)], "small", words);
    }
    for value in &bar.published {
        page.mark([middle, y.at(*value)], Series::PUBLISHED, "");
    }
}
