//! Which charts each experiment has.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::{self, Attacks, Offered};
use mufasa_sim::experiment::availability::{self, Availability, Factor};
use mufasa_sim::experiment::combinations::{self, Combinations};
use mufasa_sim::experiment::failures::{self, Failures};
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::stages::{self, Stages};

use super::bars::{self, Bar, Bars, Group};
pub use super::chart::Figure;
pub(super) use super::chart::figure;
use super::chart::{float, ratio, series};
use super::dots::{self, Dot, Dots, Panel};
pub use super::left_out::{parts as left_out, readings};
use super::lines::{self, COLLIDED, Row, Small};
use super::page::{Mark, Series};
use crate::evaluate::published;

const VARIANTS: [Series; 4] = [Series::SOFOF, Series::PAPER, Series::HARDENED, Series::PUBLISHED];

/// Failures by attack and variant.
pub fn failures(of: &Failures) -> Vec<Figure> {
    let group = |rows: &[failures::Row]| Group {
        name: kind_name(rows[0].attack).to_owned(),
        bars: rows.iter().map(failure).collect(),
        note: words(rows),
    };
    let same = |a: &failures::Row, b: &failures::Row| a.attack == b.attack;
    let svg = bars::draw(&Bars {
        title: "Failures by attack and by what is checked",
        about: &[
            "In full: collisions; paler: target not reached in time. Above: failures of runs.",
            "The paper gives numbers in words alone: no failure with its stages, \"several\" without (Sec. V-B).",
        ],
        key: &VARIANTS,
        unit: "runs that failed, %",
        most: 100.0,
        step: 25.0,
        groups: of.rows.chunk_by(same).map(group).collect(),
    });
    vec![figure(failures::NAME, svg)]
}

fn failure(row: &failures::Row) -> Bar {
    let share = |part: usize| 100.0 * ratio(part, row.runs);
    let published = published::failures(row.attack, row.variant).number;
    Bar {
        series: series(row.variant),
        value: share(row.collided),
        paler: share(row.late),
        label: format!("{}/{}", row.failures, row.runs),
        published: published.into_iter().collect(),
    }
}

/// What the paper says of this attack without its stages.
fn words(rows: &[failures::Row]) -> String {
    let sofof = rows.iter().find(|row| row.variant == Variant::Sofof);
    let words = sofof.map_or("", |row| published::failures(row.attack, row.variant).words);
    if words.is_empty() { String::new() } else { format!("paper, sofof: {words}") }
}

/// What the paper published, as a bar.
const PUBLISHED: Series = Series { class: "sofof", mark: Mark::Square, ..Series::PUBLISHED };

/// Detections of each stage.
pub fn stages(of: &Stages) -> Vec<Figure> {
    let per_1000 =
        |part: u64, of: u64| if of == 0 { 0.0 } else { 1000.0 * float(part) / float(of) };
    let bar = |series: Series, detections: u64, executions: u64| Bar {
        series,
        value: per_1000(detections, executions),
        paler: 0.0,
        label: format!("{detections}\nof {executions}"),
        published: Vec::new(),
    };
    let groups = stages::PAPER.into_iter().enumerate().map(|(index, (executions, detections))| {
        let rows = of.rows.iter().filter(|row| row.stage as usize == index);
        let mut bars: Vec<Bar> = rows
            .clone()
            .map(|row| bar(series(row.variant), row.detections, row.executions))
            .collect();
        bars.push(bar(PUBLISHED, detections, executions));
        let name = rows.map(|row| format!("stage {}", row.stage.name())).next();
        Group { name: name.unwrap_or_default(), bars, note: String::new() }
    });
    let groups: Vec<Group> = groups.collect();
    let most = groups.iter().flat_map(|it| &it.bars).map(|it| it.value).fold(10.0, f64::max);
    let svg = bars::draw(&Bars {
        title: "Detections of each stage under random attacks",
        about: &["Above each bar: detections of executions. Town, services and areas are ours."],
        key: &[Series::PAPER, Series::HARDENED, PUBLISHED],
        unit: "detections in 1000 executions",
        most: 20.0 * (most / 20.0).ceil(),
        step: 20.0,
        groups,
    });
    vec![figure(stages::NAME, svg)]
}

/// Cycles until each attack is detected.
pub fn attacks(of: &Attacks) -> Vec<Figure> {
    let kinds: Vec<Kind> = Kind::ALL.into_iter().collect();
    let variants = [(Variant::Paper, -4.0), (Variant::Hardened, 4.0)];
    let panel = |offered: Offered| {
        let rows = || of.rows.iter().filter(|row| row.offered == offered);
        let mut panel =
            Panel { name: format!("{} offered", offered.name()), dots: vec![], lines: vec![] };
        for (variant, shift) in variants {
            let line = format_class(variant);
            let control = rows().find(|row| (row.attack, row.variant) == (None, variant));
            let control = control.and_then(|row| row.median_cycles);
            panel.lines.extend(control.map(|cycles| (float(cycles), line)));
            for row in rows().filter(|row| row.variant == variant) {
                let Some(at) = kinds.iter().position(|kind| Some(*kind) == row.attack) else {
                    continue;
                };
                panel.dots.push(latency(row, at, shift));
                let collided = Dot { value: None, series: COLLIDED, ..latency(row, at, shift) };
                panel.dots.extend((row.collided > 0).then_some(collided));
            }
        }
        panel
    };
    let svg = dots::draw(&Dots {
        title: "How soon attacks are detected",
        about: &[
            "Median of the cycles (of 0.1 s) with something remote from the attack's start to the first detection.",
            "Open: not in every run; \"missed\": in none. Dashed: the first false alarm of as many runs without an attack;",
            "a mark at or behind the line of its colour shows nothing.",
        ],
        key: &[Series::PAPER, Series::HARDENED, COLLIDED],
        rows: kinds.iter().map(|kind| kind.name().to_owned()).collect(),
        left: 132.0,
        powers: [0, 3],
        unit: "cycles until it is detected",
        off: Some("missed"),
        panels: Offered::ALL.map(panel).into(),
    });
    vec![figure(attacks::NAME, svg)]
}

fn latency(row: &attacks::Row, at: usize, shift: f64) -> Dot {
    Dot {
        row: at,
        value: row.median_cycles.map(float),
        series: series(row.variant),
        is_open: row.detected < row.runs,
        shift,
    }
}

const fn format_class(variant: Variant) -> &'static str {
    match variant {
        Variant::Sofof => "sofof-line",
        Variant::Paper => "paper-line",
        Variant::Hardened => "hardened-line",
    }
}

/// Failures under combinations of attacks.
pub fn combinations(of: &Combinations) -> Vec<Figure> {
    let bar = |row: &combinations::Row| Bar {
        series: series(row.variant),
        value: 100.0 * ratio(row.collided, row.runs),
        paler: 100.0 * ratio(row.late, row.runs),
        label: format!("{}/{}", row.failures, row.runs),
        published: Vec::new(),
    };
    let group = |rows: &[combinations::Row]| Group {
        name: format!("{} offered", rows[0].offered.name()),
        bars: rows.iter().map(bar).collect(),
        note: String::new(),
    };
    let same = |a: &combinations::Row, b: &combinations::Row| a.offered == b.offered;
    let svg = bars::draw(&Bars {
        title: "Failures under attacks of all kinds, drawn at random over time",
        about: &[
            "In full: collisions; paler: target not reached in time. Above: failures of runs.",
        ],
        key: &[Series::SOFOF, Series::PAPER, Series::HARDENED],
        unit: "runs that failed, %",
        most: 100.0,
        step: 25.0,
        groups: of.rows.chunk_by(same).map(group).collect(),
    });
    vec![figure(combinations::NAME, svg)]
}

/// Availability by each factor.
pub fn availability(of: &Availability) -> Vec<Figure> {
    let chart = |factor: Factor, value: fn(&availability::Row) -> f64| {
        let rows = || of.rows.iter().filter(|row| row.factor == factor);
        let line = |variant| {
            let of = rows().filter(|row| row.variant == variant).map(value).collect();
            (series(variant), of)
        };
        let names = rows().filter(|row| row.variant == Variant::Paper);
        Small {
            name: words_of(factor).to_owned(),
            names: names.map(|row| said(row.factor, row.value)).collect(),
            lines: [Variant::Paper, Variant::Hardened].map(line).into(),
        }
    };
    let charts = |value: fn(&availability::Row) -> f64| {
        Factor::ALL.map(|factor| chart(factor, value)).into()
    };
    let most = of.rows.iter().map(|row| row.fallbacks_per_hour).fold(100.0, f64::max);
    let rows = [
        Row {
            unit: "share of the time with remote tracks, %",
            most: 100.0,
            step: 25.0,
            charts: charts(|row| 100.0 * row.share_mot),
        },
        Row {
            unit: "share of the time with a remote trajectory, %",
            most: 100.0,
            step: 25.0,
            charts: charts(|row| 100.0 * row.share_plan),
        },
        Row {
            unit: "fallbacks in an hour, each a false alarm",
            most: 200.0 * (most / 200.0).ceil(),
            step: 200.0,
            charts: charts(|row| row.fallbacks_per_hour),
        },
    ];
    let one =
        |factor: Factor| format!("{}: {}", words_of(factor), said(factor, factor.of_default()));
    let defaults = Factor::ALL.map(one).join("; ");
    let defaults =
        format!("No attack. One setting at a time differs from its default: {defaults}.");
    let about = [defaults.as_str(), "The paper gives no such figures."];
    let key = [Series::PAPER, Series::HARDENED];
    let svg = lines::draw("What the checks cost without an attack", &about, &key, &rows);
    vec![figure(availability::NAME, svg)]
}

/// The value that is set, short enough to stand beside others.
fn said(factor: Factor, value: f64) -> String {
    let percent = if factor == Factor::Loss { 100.0 } else { 1.0 };
    (percent * value).to_string()
}

const fn words_of(factor: Factor) -> &'static str {
    match factor {
        Factor::Missed => "share missed",
        Factor::Clutter => "clutter, a cycle",
        Factor::PositionM => "noise, m",
        Factor::JitterMs => "jitter, ms",
        Factor::Loss => "loss, %",
        Factor::TWaitS => "t_wait, s",
    }
}
