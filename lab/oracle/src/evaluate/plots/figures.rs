//! Which charts each experiment has.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::ATTACKS;
use mufasa_sim::experiment::availability::AVAILABILITY;
use mufasa_sim::experiment::axes::{Factor, Offered};
use mufasa_sim::experiment::combinations::COMBINATIONS;
use mufasa_sim::experiment::failures::FAILURES;
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::made::Made;
use mufasa_sim::experiment::row::Row;
use mufasa_sim::experiment::stages::{PAPER, STAGES};
use mufasa_sim::experiment::watch::By;

use super::bars::{self, Bar, Bars, Group};
pub use super::chart::Figure;
pub(super) use super::chart::figure;
use super::chart::{float, series};
use super::dots::{self, Dot, Dots, Panel};
use super::failed::{BARS, Failed};
pub use super::left_out::{parts as left_out, readings};
use super::lines::{self, COLLIDED, Small};
use super::page::{Mark, Series};

/// Failures by attack and variant.
pub fn failures(of: &Made) -> Vec<Figure> {
    let failed = Failed {
        name: FAILURES.name,
        title: "Failures by attack and by what is checked",
        about: &[
            BARS,
            "The paper gives numbers in words alone: no failure with its stages, \"several\" without (Sec. V-B).",
        ],
        is_published: true,
        same: |a, b| a.attack == b.attack,
        group: |row| kind_name(row.attack).to_owned(),
    };
    failed.draw(of.rows.iter())
}

/// What the paper published, as a bar.
const PUBLISHED: Series = Series { class: "sofof", mark: Mark::Square, ..Series::PUBLISHED };

/// Detections of each stage.
pub fn stages(of: &Made) -> Vec<Figure> {
    let per_1000 =
        |part: u64, of: u64| if of == 0 { 0.0 } else { 1000.0 * float(part) / float(of) };
    let bar = |series: Series, detections: u64, executions: u64| Bar {
        series,
        value: per_1000(detections, executions),
        paler: 0.0,
        label: format!("{detections}\nof {executions}"),
        published: Vec::new(),
    };
    let groups = PAPER.into_iter().enumerate().map(|(index, (executions, detections))| {
        let rows = of.rows.iter().filter(|row| row.stage == By::ALL.get(index).copied());
        let mut bars: Vec<Bar> = rows
            .clone()
            .map(|row| bar(series(row.variant), row.detections, row.executions))
            .collect();
        bars.push(bar(PUBLISHED, detections, executions));
        let name = rows.map(|row| format!("stage {}", row.stage.map_or("", By::name))).next();
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
    vec![figure(STAGES.name, svg)]
}

/// Cycles until each attack is detected.
pub fn attacks(of: &Made) -> Vec<Figure> {
    let kinds: Vec<Kind> = Kind::IN_THE_LOOP.into_iter().collect();
    let variants = [(Variant::Paper, -4.0), (Variant::Hardened, 4.0)];
    let panel = |offered: Offered| {
        let rows = || of.rows.iter().filter(|row| row.offered == Some(offered));
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
    vec![figure(ATTACKS.name, svg)]
}

fn latency(row: &Row, at: usize, shift: f64) -> Dot {
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
pub fn combinations(of: &Made) -> Vec<Figure> {
    let failed = Failed {
        name: COMBINATIONS.name,
        title: "Failures under attacks of all kinds, drawn at random over time",
        about: &[BARS],
        is_published: false,
        same: |a, b| a.offered == b.offered,
        group: |row| format!("{} offered", row.offered.map_or("", Offered::name)),
    };
    failed.draw(of.rows.iter())
}

/// Availability by each factor.
pub fn availability(of: &Made) -> Vec<Figure> {
    let chart = |factor: Factor, value: fn(&Row) -> f64| {
        let rows = || of.rows.iter().filter(|row| row.factor == Some(factor));
        let line = |variant| {
            let of = rows().filter(|row| row.variant == variant).map(value).collect();
            (series(variant), of)
        };
        let names = rows().filter(|row| row.variant == Variant::Paper);
        Small {
            name: words_of(factor).to_owned(),
            names: names.filter_map(|row| Some(said(factor, row.value?))).collect(),
            lines: [Variant::Paper, Variant::Hardened].map(line).into(),
        }
    };
    let charts = |value: fn(&Row) -> f64| Factor::ALL.map(|factor| chart(factor, value)).into();
    let most = of.rows.iter().map(|row| row.fallbacks_per_hour).fold(100.0, f64::max);
    let rows = [
        lines::Row {
            unit: "share of the time with remote tracks, %",
            most: 100.0,
            step: 25.0,
            charts: charts(|row| 100.0 * row.share_mot),
        },
        lines::Row {
            unit: "share of the time with a remote trajectory, %",
            most: 100.0,
            step: 25.0,
            charts: charts(|row| 100.0 * row.share_plan),
        },
        lines::Row {
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
    vec![figure(AVAILABILITY.name, svg)]
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
