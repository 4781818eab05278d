//! The kinds of charts: bars, dots in rows, lines, and the runs of a search.
//!
//! Colours are those of Okabe and Ito, which colour-blind readers tell apart, and every series has a shape of
//! its own.

use std::error::Error;
use std::ops::Add;

use mufasa_drives::pictures::escape;
use mufasa_sim::cav::guard::Variant;
use plotters::coord::Shift;
use plotters::element::{ComposedElement, DashedPathElement};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width of every chart, px.
const WIDTH: u32 = 900;
/// Left of the scale, px.
const LEFT: i32 = 56;
/// Heights of bars, of a row of dots, of a small chart, and of that of a search, px.
const BARS: u32 = 340;
const ROW: usize = 22;
const SMALL: u32 = 200;
const SEARCH: u32 = 350;

const INK: RGBColor = RGBColor(0x1d, 0x27, 0x33);
const FAINT: RGBColor = RGBColor(0x4b, 0x58, 0x66);
const GRID: RGBColor = RGBColor(0xd5, 0xdb, 0xe1);
const AXIS: RGBColor = RGBColor(0x6a, 0x76, 0x83);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn Error>>;
type Place = (f64, f64);
/// px from a place.
type Moved = (i32, i32);
type Words<'a> = <EmptyElement<Place, SVGBackend<'a>> as Add<Text<'static, Moved, String>>>::Output;
type Marked<'a> = ComposedElement<Place, SVGBackend<'a>, Polygon<Moved>, PathElement<Moved>>;

/// A chart and the name of its file.
pub struct Figure {
    pub file: String,
    pub svg: String,
}

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
    pub(super) color: RGBColor,
    pub(super) mark: Mark,
}

impl Series {
    /// What the paper says.
    pub(super) const PUBLISHED: Self =
        Self { name: "published in the paper", color: INK, mark: Mark::Diamond };
    /// Runs that collided.
    pub(super) const COLLIDED: Self =
        Self { name: "collided", color: RGBColor(0xd5, 0x5e, 0x00), mark: Mark::Cross };

    /// What is checked of remote data.
    pub(super) const fn of(variant: Variant) -> Self {
        let (name, color, mark) = match variant {
            Variant::Sofof => ("sofof", RGBColor(0xe6, 0x9f, 0x00), Mark::Triangle),
            Variant::Paper => ("paper (profile)", RGBColor(0x00, 0x72, 0xb2), Mark::Circle),
            Variant::Hardened => ("hardened", RGBColor(0x00, 0x9e, 0x73), Mark::Square),
        };
        Self { name, color, mark }
    }

    /// A value, moved by so many px down.
    fn at<'a>(self, place: Place, down: i32, is_open: bool) -> Marked<'a> {
        let outline: &[Moved] = match self.mark {
            Mark::Circle => &[
                (5, 0),
                (4, 3),
                (3, 4),
                (0, 5),
                (-3, 4),
                (-4, 3),
                (-5, 0),
                (-4, -3),
                (-3, -4),
                (0, -5),
                (3, -4),
                (4, -3),
                (5, 0),
            ],
            Mark::Square => &[(-4, -4), (4, -4), (4, 4), (-4, 4), (-4, -4)],
            Mark::Triangle => &[(0, -6), (5, 4), (-5, 4), (0, -6)],
            Mark::Diamond => &[(0, -6), (6, 0), (0, 6), (-6, 0), (0, -6)],
            Mark::Cross => &[(-5, -5), (5, 5), (0, 0), (-5, 5), (5, -5)],
        };
        let outline: Vec<Moved> = outline.iter().map(|(x, y)| (*x, *y + down)).collect();
        let is_filled = !is_open && !matches!(self.mark, Mark::Cross);
        let fill = if is_filled { self.color.mix(1.0) } else { TRANSPARENT };
        EmptyElement::at(place)
            + Polygon::new(outline.clone(), fill)
            + PathElement::new(outline, self.color.stroke_width(if is_filled { 1 } else { 2 }))
    }
}

fn font(size: i32, side: HPos, line: VPos) -> TextStyle<'static> {
    TextStyle::from(("sans-serif", size).into_font().color(&INK)).pos(Pos::new(side, line))
}

/// A page with a title, lines about it, and a key; the rest is drawn by `draw`.
fn page(
    [title, about]: [&str; 2],
    key: &[Series],
    height: u32,
    draw: impl FnOnce(&Area<'_>) -> Drawn,
) -> String {
    let mut svg = String::new();
    let all = || -> Drawn {
        let lines = about.lines().count();
        let head = i32::try_from(66 + 18 * lines)?;
        let size = (WIDTH, head.unsigned_abs() + height);
        let page = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        page.fill(&WHITE)?;
        let (top, rest) = page.split_vertically(head);
        let bold = ("sans-serif", 22).into_font().style(FontStyle::Bold).color(&INK);
        top.draw(&Text::new(title, (20, 12), TextStyle::from(bold)))?;
        for (line, y) in about.lines().zip((40..).step_by(18)) {
            top.draw(&Text::new(line, (20, y), ("sans-serif", 15).into_font().color(&FAINT)))?;
        }
        // Places of the key are those of the page, as of a chart whose scale is px.
        let (wide, high) = (f64::from(WIDTH), f64::from(head));
        let mut key_chart = ChartBuilder::on(&top).build_cartesian_2d(0.0..wide, high..0.0)?;
        let mut left = 27.0;
        for series in key {
            let place = (left, high - 12.0);
            key_chart.draw_series([series.at(place, 0, false)])?;
            let name = Text::new(series.name, (12, 0), font(16, HPos::Left, VPos::Center));
            key_chart.draw_series([EmptyElement::at(place) + name])?;
            left += 42.0 + 7.6 * nth(series.name.chars().count());
        }
        draw(&rest)?;
        page.present()?;
        Ok(())
    };
    all().unwrap_or_else(|error| unreachable!("a string takes everything: {error}"));
    let named = format!(" role=\"img\">\n<title>{}</title>\n", escape(title));
    svg.replacen(">\n", &named, 1)
}

/// Chart and mesh in the same clothes: numbers on the left, lines across, nothing below.
macro_rules! meshed {
    ($builder:expr, $x:expr, $y:expr, $labels:expr, $format:expr) => {{
        let mut chart = $builder.build_cartesian_2d($x, $y)?;
        let mut mesh = chart.configure_mesh();
        mesh.disable_x_mesh().disable_x_axis().y_labels($labels).y_label_formatter($format);
        mesh.light_line_style(TRANSPARENT).bold_line_style(GRID).axis_style(AXIS);
        mesh.label_style(font(16, HPos::Right, VPos::Center)).draw()?;
        chart
    }};
}

/// Whole numbers; of what is below the scale nothing.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "as plotters calls it")]
fn whole(value: &f64) -> String {
    if *value < 0.0 { String::new() } else { format!("{value:.0}") }
}

/// Words at a place.
fn words<'a>(place: Place, moved: Moved, text: String, style: TextStyle<'static>) -> Words<'a> {
    EmptyElement::at(place) + Text::new(text, moved, style)
}

/// A bar.
pub(super) struct Bar {
    pub(super) series: Series,
    /// What is drawn in full, and what is drawn paler on top of it.
    pub(super) value: f64,
    pub(super) paler: f64,
    /// Over it.
    pub(super) label: String,
    /// What the paper published, as far as it gives numbers.
    pub(super) published: Option<f64>,
}

/// Bars beside each other.
pub(super) struct Group {
    pub(super) name: String,
    pub(super) bars: Vec<Bar>,
    /// Below its name.
    pub(super) note: String,
}

/// Groups of bars; `scale`: what is counted, the greatest value, and how many lines it takes.
pub(super) fn bars(
    head: [&str; 2],
    key: &[Series],
    (unit, most, lines): (&str, f64, usize),
    groups: &[Group],
) -> String {
    page(head, key, BARS, |area| {
        area.draw(&Text::new(unit, (20, 6), font(16, HPos::Left, VPos::Top)))?;
        let mut builder = ChartBuilder::on(area);
        builder.margin_top(52).margin_right(20).margin_bottom(50);
        builder.set_label_area_size(LabelAreaPosition::Left, LEFT);
        let mut chart = meshed!(builder, 0.0..nth(groups.len()), 0.0..most, lines + 1, &whole);
        for (index, group) in groups.iter().enumerate() {
            let each = (0.86 / nth(group.bars.len().max(1))).min(0.3);
            let middle = nth(index) + 0.5;
            let first = middle - each * nth(group.bars.len()) / 2.0;
            for (index, bar) in group.bars.iter().enumerate() {
                let middle = first + each * (nth(index) + 0.5);
                let [left, right] = [-0.36, 0.36].map(|share| middle + share * each);
                let (full, all) = (bar.value, bar.value + bar.paler);
                let colors = [bar.series.color.mix(1.0), bar.series.color.mix(0.4)];
                for ((from, to), color) in [(0.0, full), (full, all)].into_iter().zip(colors) {
                    let bar = Rectangle::new([(left, from), (right, to)], color.filled());
                    chart.draw_series((to > from).then_some(bar))?;
                }
                let highest = bar.published.map_or(all, |it| it.max(all));
                let above = if bar.published.is_some_and(|it| it >= all) { -10 } else { -4 };
                let small = || font(14, HPos::Center, VPos::Bottom);
                for (line, up) in bar.label.split('\n').rev().zip((0..).step_by(14)) {
                    let text = words((middle, highest), (0, above - up), line.to_owned(), small());
                    chart.draw_series([text])?;
                }
                let published = bar.published.map(|it| Series::PUBLISHED.at((middle, it), 0, true));
                chart.draw_series(published)?;
            }
            let below = |y, size| ((0, y), font(size, HPos::Center, VPos::Top));
            for (text, (moved, style)) in
                [(&group.name, below(10, 16)), (&group.note, below(29, 14))]
            {
                chart.draw_series([words((middle, 0.0), moved, text.clone(), style)])?;
            }
        }
        Ok(())
    })
}

/// A value in a row of a panel.
pub(super) struct Dot {
    pub(super) row: usize,
    /// None: in the column beside the scale.
    pub(super) value: Option<f64>,
    pub(super) series: Series,
    /// Whether it is drawn open.
    pub(super) is_open: bool,
    /// Below the middle of its row, px.
    pub(super) shift: i32,
}

/// Rows of dots.
pub(super) struct Panel {
    pub(super) name: String,
    pub(super) dots: Vec<Dot>,
    /// Values that all rows are to be compared with.
    pub(super) lines: Vec<(f64, RGBColor)>,
}

/// Rows of marks along a logarithmic scale from 1 to `most`, in panels beside each other; `off`: the name of the
/// column beside the scale.
pub(super) fn dots(
    head: [&str; 2],
    key: &[Series],
    rows: &[&str],
    (unit, most, off): (&str, f64, &str),
    panels: &[Panel],
) -> String {
    let names = 150;
    let height = u32::try_from(rows.len() * ROW).unwrap_or(u32::MAX);
    page(head, key, height + 100, |area| {
        let (left, panels_area) = area.split_horizontally(names);
        for (row, name) in rows.iter().enumerate() {
            let y = i32::try_from(30 + ROW * row + ROW / 2)?;
            left.draw(&Text::new(*name, (names - 10, y), font(16, HPos::Right, VPos::Center)))?;
        }
        let parts = panels_area.split_evenly((1, panels.len().max(1)));
        for (panel, part) in panels.iter().zip(&parts) {
            let mut builder = ChartBuilder::on(part);
            builder.margin_top(30).margin_right(22).margin_bottom(70);
            let off_at = most * 2.6;
            let x = (0.8..most * 5.0).log_scale();
            let rows_of = 0.0..nth(rows.len());
            let mut chart = meshed!(builder, x, rows_of, rows.len() + 1, &whole);
            let (top, middle) = (nth(rows.len()), most.sqrt());
            let above = font(16, HPos::Center, VPos::Bottom);
            chart.draw_series([words((middle, top), (0, -6), panel.name.clone(), above)])?;
            let below = || font(14, HPos::Center, VPos::Top);
            let powers = std::iter::successors(Some(1.0), |it| Some(it * 10.0));
            for power in powers.take_while(|it| *it <= most) {
                let line = PathElement::new([(power, 0.0), (power, top)], GRID);
                chart.draw_series([line])?;
                chart.draw_series([words((power, 0.0), (0, 6), format!("{power}"), below())])?;
            }
            let edge = PathElement::new([(most * 1.4, 0.0), (most * 1.4, top)], AXIS);
            chart.draw_series([edge])?;
            chart.draw_series([words((off_at, 0.0), (0, 22), off.to_owned(), below())])?;
            for (value, color) in &panel.lines {
                let ends = [(*value, 0.0), (*value, top)].into_iter();
                let line = DashedPathElement::new(ends, 5, 4, color.stroke_width(2));
                chart.draw_series([line])?;
            }
            let mark = |dot: &Dot| {
                let place = (dot.value.unwrap_or(off_at), top - nth(dot.row) - 0.5);
                dot.series.at(place, dot.shift, dot.is_open)
            };
            chart.draw_series(panel.dots.iter().map(mark))?;
        }
        let (wide, high) = panels_area.dim_in_pixel();
        let place = (i32::try_from(wide / 2)?, i32::try_from(high)? - 22);
        panels_area.draw(&Text::new(unit, place, font(16, HPos::Center, VPos::Center)))?;
        Ok(())
    })
}

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
    pub(super) charts: Vec<Small>,
}

/// Small charts of lines beside and below each other.
pub(super) fn lines(head: [&str; 2], key: &[Series], rows: &[Row]) -> String {
    let height = u32::try_from(rows.len()).unwrap_or(0) * SMALL;
    page(head, key, height, |area| {
        for (row, part) in rows.iter().zip(area.split_evenly((rows.len().max(1), 1))) {
            part.draw(&Text::new(row.unit, (20, 8), font(16, HPos::Left, VPos::Top)))?;
            let part = part.margin(28, 0, 40, 0);
            let places = part.split_evenly((1, row.charts.len().max(1)));
            for (index, (small, place)) in row.charts.iter().zip(&places).enumerate() {
                one_small(small, place, row.most, index == 0)?;
            }
        }
        Ok(())
    })
}

fn one_small(small: &Small, place: &Area<'_>, most: f64, is_first: bool) -> Drawn {
    let mut builder = ChartBuilder::on(place);
    builder.margin_top(26).margin_right(6).margin_bottom(28);
    builder.set_label_area_size(LabelAreaPosition::Left, 12);
    let across = 0.0..nth(small.names.len());
    let mut chart = meshed!(builder, across, 0.0..most, 5, &|_: &f64| String::new());
    // The numbers of a row stand left of its first chart.
    for value in [0.0, 0.5, 1.0].map(|share| share * most).into_iter().filter(|_| is_first) {
        let side = font(16, HPos::Right, VPos::Center);
        chart.draw_series([words((0.0, value), (-9, 0), whole(&value), side)])?;
    }
    let middle = nth(small.names.len()) / 2.0;
    let above = font(16, HPos::Center, VPos::Bottom);
    chart.draw_series([words((middle, most), (0, -4), small.name.clone(), above)])?;
    for (index, name) in small.names.iter().enumerate() {
        let below = font(13, HPos::Center, VPos::Top);
        chart.draw_series([words((nth(index) + 0.5, 0.0), (0, 6), name.clone(), below)])?;
    }
    for (series, values) in &small.lines {
        let places = values.iter().enumerate().map(|(at, it)| (nth(at) + 0.5, *it));
        let places: Vec<_> = places.collect();
        chart.draw_series([PathElement::new(places.clone(), series.color.stroke_width(2))])?;
        chart.draw_series(places.iter().map(|place| series.at(*place, 0, false)))?;
    }
    Ok(())
}

/// Every run of a search in its order, where a collision has no value, and the least value up to each; `rounds`: runs
/// before each round.
pub(super) fn search(
    head: [&str; 2],
    key: &[Series],
    (unit, most): (&str, f64),
    (tried, rounds): (&[(Series, Option<f64>)], &[usize]),
) -> String {
    page(head, key, SEARCH, |area| {
        area.draw(&Text::new(unit, (20, 6), font(16, HPos::Left, VPos::Top)))?;
        let mut builder = ChartBuilder::on(area);
        builder.margin_top(30).margin_right(20).margin_bottom(10);
        builder.set_label_area_size(LabelAreaPosition::Left, LEFT + 14);
        builder.set_label_area_size(LabelAreaPosition::Bottom, 44);
        // Collisions have a row of their own below zero.
        let low = -0.14 * most;
        let mut chart = builder.build_cartesian_2d(0.0..nth(tried.len().max(1)), low..most)?;
        let mut mesh = chart.configure_mesh();
        mesh.disable_x_mesh()
            .x_labels(10)
            .y_labels(6)
            .x_label_formatter(&whole)
            .y_label_formatter(&whole);
        mesh.light_line_style(TRANSPARENT).bold_line_style(GRID).axis_style(AXIS);
        mesh.label_style(("sans-serif", 15)).x_desc("runs with attacks").draw()?;
        let side = font(16, HPos::Right, VPos::Center);
        chart.draw_series([words((0.0, low / 2.0), (-8, 0), "collided".to_owned(), side)])?;
        for before in rounds {
            let at = nth(*before);
            chart.draw_series([PathElement::new([(at, low), (at, most)], AXIS)])?;
        }
        let mut best = vec![(0.0, most)];
        let mut least = most;
        for (run, (series, value)) in tried.iter().enumerate() {
            let at = nth(run) + 0.5;
            let Some(value) = *value else {
                chart.draw_series([Series::COLLIDED.at((at, low / 2.0), 0, false)])?;
                continue;
            };
            chart.draw_series([Circle::new((at, value), 3, series.color.mix(0.55).filled())])?;
            if value < least {
                best.extend([(at, least), (at, value)]);
                least = value;
            }
        }
        best.push((nth(tried.len()), least));
        chart.draw_series([PathElement::new(best, INK.stroke_width(2))])?;
        Ok(())
    })
}

/// The place in a row of something counted from 0.
pub(super) fn nth(index: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "some thousands")]
    let nth = index as f64;
    nth
}
