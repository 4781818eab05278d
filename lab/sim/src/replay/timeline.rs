//! The whole run over time: speed, distance, who computed, and what was found.

use core::fmt::Write;

use crate::run::Cycle;

/// Names of what can fail, by the code of a cycle less one.
pub(super) const FAILED: [&str; 7] =
    ["stage i", "stage ii", "stage iii", "stage iv", "stage v", "no obstacle check", "input"];
/// Colours of the configurations, by the bits of a cycle.
const CONFIGURATIONS: [(&str, &str); 4] = [
    ("#d9dde0", "all local"),
    ("#8ecae6", "MOT remote"),
    ("#ffb703", "PLAN remote"),
    ("#9d7bd8", "all remote"),
];
const WIDTH: f64 = 1060.0;
/// Where time begins and ends, px.
const ACROSS: (f64, f64) = (130.0, 1040.0);
/// Height of a curve, of a band, and of a row of ticks, px.
const CURVE: f64 = 90.0;
const BAND: f64 = 16.0;
const ROW: f64 = 16.0;
/// Farther than this nobody is near, m.
const FAR: f64 = 40.0;

/// The timeline, as a whole file. `event`, `end`: s.
pub(super) fn svg(cycles: &[Cycle], event: f64, end: f64) -> String {
    let end = end.max(1.0);
    let tops = [20.0, 20.0 + CURVE + 20.0];
    let bands = tops[1] + CURVE + 14.0;
    let rows = bands + 2.0 * (BAND + 6.0) + 8.0;
    let axis = FAILED.iter().fold(rows, |y, _| y + ROW) + 4.0;
    let height = axis + 62.0;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} \
         {height}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let fastest = cycles.iter().map(|it| it.speed).fold(5.0, f64::max);
    let speed: Vec<_> = cycles.iter().map(|it| (it.t, Some(it.speed))).collect();
    let top = 5.0 * libm::ceil(fastest / 5.0);
    curve(&mut text, &speed, ("speed, m/s", "#1f6fd1"), (tops[0], top), end);
    let near: Vec<_> = cycles.iter().map(|it| (it.t, it.nearest)).collect();
    curve(&mut text, &near, ("nearest, m", "#b5541c"), (tops[1], FAR), end);
    label(&mut text, bands + 12.5, "configuration");
    label(&mut text, bands + BAND + 6.0 + 12.5, "attack");
    let remote = |it: &Cycle| Some(CONFIGURATIONS[usize::from(it.remote & 3)].0);
    band(&mut text, cycles, bands, end, remote);
    let attacked = |it: &Cycle| it.attacked.then_some("#d62828");
    band(&mut text, cycles, bands + BAND + 6.0, end, attacked);
    ticks(&mut text, cycles, rows, end);
    times(&mut text, (tops[0], axis), end);
    let at = x(event, end);
    put(
        &mut text,
        format_args!(
            "<line x1=\"{at:.1}\" y1=\"{:.1}\" x2=\"{at:.1}\" y2=\"{axis:.1}\" stroke=\"#000\" \
             stroke-dasharray=\"4 3\"/>\n",
            tops[0]
        ),
    );
    key(&mut text, axis + 44.0);
    text.push_str("</svg>\n");
    text
}

fn x(t: f64, end: f64) -> f64 {
    ACROSS.0 + (ACROSS.1 - ACROSS.0) * t / end
}

fn curve(
    text: &mut String,
    values: &[(f64, Option<f64>)],
    (name, color): (&str, &str),
    (top, most): (f64, f64),
    end: f64,
) {
    label(text, top + CURVE / 2.0 + 4.0, name);
    for share in [0.0, 0.5, 1.0] {
        let y = top + CURVE * (1.0 - share);
        put(
            text,
            format_args!(
                "<line x1=\"{}\" y1=\"{y:.1}\" x2=\"{}\" y2=\"{y:.1}\" stroke=\"#e2e2e2\"/>\n\
                 <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#555\">{}</text>\n",
                ACROSS.0,
                ACROSS.1,
                ACROSS.0 - 6.0,
                y + 4.0,
                share * most
            ),
        );
    }
    text.push_str("<polyline fill=\"none\" stroke-width=\"1.6\" stroke=\"");
    text.push_str(color);
    text.push_str("\" points=\"");
    for (t, value) in values {
        let share = value.unwrap_or(most).clamp(0.0, most) / most;
        put(text, format_args!("{:.1},{:.1} ", x(*t, end), top + CURVE * (1.0 - share)));
    }
    text.push_str("\"/>\n");
}

/// A rectangle for each stretch of cycles with one colour.
fn band(
    text: &mut String,
    cycles: &[Cycle],
    top: f64,
    end: f64,
    color: impl Fn(&Cycle) -> Option<&'static str>,
) {
    let mut from = 0;
    for stretch in cycles.chunk_by(|a, b| color(a) == color(b)) {
        let next = from + stretch.len();
        let until = cycles.get(next).map_or(end, |it| it.t);
        if let Some(color) = color(&stretch[0]) {
            let (left, right) = (x(stretch[0].t, end), x(until, end));
            put(
                text,
                format_args!(
                    "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{BAND}\" fill=\"{color}\"/>\n",
                    right - left
                ),
            );
        }
        from = next;
    }
}

fn ticks(text: &mut String, cycles: &[Cycle], top: f64, end: f64) {
    let mut y = top;
    for (code, name) in (1_u8..).zip(FAILED) {
        label(text, y + 12.0, name);
        for cycle in cycles.iter().filter(|it| it.failed == code) {
            let at = x(cycle.t, end);
            put(
                text,
                format_args!(
                    "<line x1=\"{at:.1}\" y1=\"{:.1}\" x2=\"{at:.1}\" y2=\"{:.1}\" stroke=\"#d62828\" \
                     stroke-width=\"2\"/>\n",
                    y + 2.0,
                    y + ROW - 2.0
                ),
            );
        }
        y += ROW;
    }
}

/// The axis: a line every 5 s, or every 10 s of a longer run.
fn times(text: &mut String, (top, axis): (f64, f64), end: f64) {
    let step = if end > 60.0 { 10.0 } else { 5.0 };
    let mut t = 0.0;
    while t <= end {
        let at = x(t, end);
        put(
            text,
            format_args!(
                "<line x1=\"{at:.1}\" y1=\"{top:.1}\" x2=\"{at:.1}\" y2=\"{:.1}\" stroke=\"#000\" opacity=\"0.12\"/>\n\
                 <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#555\">{t} s</text>\n",
                axis + 4.0,
                axis + 18.0
            ),
        );
        t += step;
    }
}

fn key(text: &mut String, y: f64) {
    let mut left = ACROSS.0;
    let entries = CONFIGURATIONS.into_iter().chain([("#d62828", "attack on, or failed")]);
    for (color, name) in entries {
        put(
            text,
            format_args!(
                "<rect x=\"{left}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"{color}\"/>\n\
                 <text x=\"{}\" y=\"{y:.1}\">{name}</text>\n",
                y - 10.5,
                left + 17.0
            ),
        );
        left += 120.0;
    }
    left += 40.0;
    put(
        text,
        format_args!(
            "<line x1=\"{left}\" y1=\"{0:.1}\" x2=\"{1}\" y2=\"{0:.1}\" stroke=\"#000\" stroke-dasharray=\"4 3\"/>\n\
             <text x=\"{2}\" y=\"{y:.1}\">what the frames are around</text>\n",
            y - 4.0,
            left + 24.0,
            left + 30.0
        ),
    );
}

fn label(text: &mut String, y: f64, name: &str) {
    put(text, format_args!("<text x=\"4\" y=\"{y:.1}\" fill=\"#222\">{name}</text>\n"));
}

fn put(text: &mut String, arguments: core::fmt::Arguments<'_>) {
    text.write_fmt(arguments).unwrap_or_else(|_| unreachable!("a string takes everything"));
}
