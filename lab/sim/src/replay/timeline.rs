//! The whole run over time: speed, distance, who computed, and what was found.

use std::error::Error;

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::run::Cycle;

/// Names of what can fail, by the code of a cycle less one.
pub(super) const FAILED: [&str; 7] =
    ["stage i", "stage ii", "stage iii", "stage iv", "stage v", "no obstacle check", "input"];
/// The configuration, the attack, and what can fail.
const ROWS: u32 = 9;
/// Colours of the configurations, by the bits of a cycle.
const CONFIGURATIONS: [(RGBColor, &str); 4] = [
    (RGBColor(0xd9, 0xdd, 0xe0), "all local"),
    (RGBColor(0x8e, 0xca, 0xe6), "MOT remote"),
    (RGBColor(0xff, 0xb7, 0x03), "PLAN remote"),
    (RGBColor(0x9d, 0x7b, 0xd8), "all remote"),
];
const BAD: RGBColor = RGBColor(0xd6, 0x28, 0x28);
const SPEED: RGBColor = RGBColor(0x1f, 0x6f, 0xd1);
const NEAREST: RGBColor = RGBColor(0xb5, 0x54, 0x1c);
const GRID: RGBColor = RGBColor(0xe2, 0xe2, 0xe2);
/// Width of the page, and heights of a curve, of a row, and of what stands below the rows, px.
const WIDTH: u32 = 1060;
const CURVE: u32 = 120;
const ROW: u32 = 18;
const BELOW: u32 = 36;
const KEY: u32 = 30;
/// For names on the left, and what is free on the right, px.
const LEFT: i32 = 130;
const RIGHT: i32 = 20;
/// Farther than this nobody is near, m.
const FAR: f64 = 40.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn Error>>;

/// The timeline, as a whole file. `event`, `end`: s.
pub(super) fn svg(cycles: &[Cycle], event: f64, end: f64) -> String {
    let mut text = String::new();
    let drawn = draw(&mut text, cycles, event, end.max(1.0));
    drawn.unwrap_or_else(|error| unreachable!("a string takes everything: {error}"));
    text
}

fn draw(text: &mut String, cycles: &[Cycle], event: f64, end: f64) -> Drawn {
    let page = (WIDTH, 2 * CURVE + ROWS * ROW + BELOW + KEY);
    let page = SVGBackend::with_string(text, page).into_drawing_area();
    page.fill(&WHITE)?;
    let (speed, rest) = page.split_vertically(CURVE);
    let (nearest, rest) = rest.split_vertically(CURVE);
    let (bands, below) = rest.split_vertically(ROWS * ROW + BELOW);
    let fastest = cycles.iter().map(|it| it.speed).fold(5.0, f64::max);
    let values = cycles.iter().map(|it| (it.t, it.speed)).collect();
    let most = 5.0 * libm::ceil(fastest / 5.0);
    curve(&speed, values, ("speed, m/s", SPEED), most, (event, end))?;
    let near = |it: &Cycle| (it.t, it.nearest.unwrap_or(FAR).clamp(0.0, FAR));
    let values = cycles.iter().map(near).collect();
    curve(&nearest, values, ("nearest, m", NEAREST), FAR, (event, end))?;
    found(&bands, cycles, f64::from(ROWS), (event, end))?;
    key(&below)?;
    page.present()?;
    Ok(())
}

fn font(side: HPos) -> TextStyle<'static> {
    TextStyle::from(("sans-serif", 15).into_font()).pos(Pos::new(side, VPos::Center))
}

fn curve(
    area: &Area<'_>,
    values: Vec<(f64, f64)>,
    (name, color): (&'static str, RGBColor),
    most: f64,
    (event, end): (f64, f64),
) -> Drawn {
    let mut chart = ChartBuilder::on(area)
        .margin_top(16)
        .margin_right(RIGHT)
        .set_label_area_size(LabelAreaPosition::Left, LEFT)
        .build_cartesian_2d(0.0..end, 0.0..most)?;
    let mut mesh = chart.configure_mesh();
    mesh.x_labels(20).y_labels(5).light_line_style(TRANSPARENT).bold_line_style(GRID);
    mesh.axis_style(GRID).label_style(font(HPos::Right)).disable_x_axis().draw()?;
    chart.draw_series([PathElement::new(values, color.stroke_width(2))])?;
    chart.draw_series([event_line(event, most)])?;
    let at = EmptyElement::at((0.0, most / 2.0));
    chart.draw_series([at + Text::new(name, (4 - LEFT, 0), font(HPos::Left))])?;
    Ok(())
}

fn event_line(event: f64, height: f64) -> DashedPathElement<std::vec::IntoIter<(f64, f64)>, u32> {
    let ends = vec![(event, 0.0), (event, height)];
    DashedPathElement::new(ends.into_iter(), 4, 3, BLACK.stroke_width(1))
}

/// A row for the configurations, one for attacks, and one for each that can fail.
fn found(area: &Area<'_>, cycles: &[Cycle], rows: f64, (event, end): (f64, f64)) -> Drawn {
    let mut chart = ChartBuilder::on(area)
        .margin_top(8)
        .margin_right(RIGHT)
        .set_label_area_size(LabelAreaPosition::Left, LEFT)
        .set_label_area_size(LabelAreaPosition::Bottom, BELOW - 8)
        .build_cartesian_2d(0.0..end, 0.0..rows)?;
    let seconds = |t: &f64| format!("{t} s");
    let mut mesh = chart.configure_mesh();
    mesh.x_labels(20).x_label_formatter(&seconds).disable_y_mesh().disable_y_axis();
    mesh.light_line_style(TRANSPARENT).bold_line_style(GRID).axis_style(GRID);
    mesh.label_style(("sans-serif", 15)).draw()?;
    for (row, name) in (1_u32..).zip(["configuration", "attack"].into_iter().chain(FAILED)) {
        let at = EmptyElement::at((0.0, rows - f64::from(row) + 0.5));
        chart.draw_series([at + Text::new(name, (4 - LEFT, 0), font(HPos::Left))])?;
    }
    let remote = |it: &Cycle| Some(CONFIGURATIONS[usize::from(it.remote & 3)].0);
    chart.draw_series(band(cycles, rows - 1.0, end, remote))?;
    chart.draw_series(band(cycles, rows - 2.0, end, |it| it.attacked.then_some(BAD)))?;
    let failed = cycles.iter().filter(|it| it.failed > 0).map(|it| {
        let bottom = rows - 2.0 - f64::from(it.failed);
        PathElement::new([(it.t, bottom + 0.15), (it.t, bottom + 0.85)], BAD.stroke_width(2))
    });
    chart.draw_series(failed)?;
    chart.draw_series([event_line(event, rows)])?;
    Ok(())
}

/// A rectangle for each stretch of cycles with one colour.
fn band(
    cycles: &[Cycle],
    bottom: f64,
    end: f64,
    color: impl Fn(&Cycle) -> Option<RGBColor>,
) -> Vec<Rectangle<(f64, f64)>> {
    let mut from = 0;
    let stretches = cycles.chunk_by(|a, b| color(a) == color(b)).filter_map(|stretch| {
        from += stretch.len();
        let until = cycles.get(from).map_or(end, |it| it.t);
        let corners = [(stretch[0].t, bottom + 0.05), (until, bottom + 0.95)];
        Some(Rectangle::new(corners, color(&stretch[0])?.filled()))
    });
    stretches.collect()
}

fn key(area: &Area<'_>) -> Drawn {
    let mut left = LEFT;
    for (color, name) in CONFIGURATIONS.into_iter().chain([(BAD, "attack on, or failed")]) {
        area.draw(&Rectangle::new([(left, 6), (left + 12, 18)], color.filled()))?;
        area.draw(&Text::new(name, (left + 17, 12), font(HPos::Left)))?;
        left += 120;
    }
    left += 40;
    area.draw(&DashedPathElement::new([(left, 12), (left + 24, 12)].into_iter(), 4, 3, BLACK))?;
    area.draw(&Text::new("what the frames are around", (left + 30, 12), font(HPos::Left)))?;
    Ok(())
}
