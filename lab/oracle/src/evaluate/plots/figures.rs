//! Which charts each experiment has.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::attacks::{self, Attacks, Offered};
use mufasa_sim::experiment::availability::{self, Availability, Factor};
use mufasa_sim::experiment::combinations::{self, Combinations};
use mufasa_sim::experiment::failures::{self, Failures};
use mufasa_sim::experiment::falsify::danger::FREE_S;
use mufasa_sim::experiment::falsify::{self, Falsified};
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::experiment::left_out::{self, Detectors, LeftOuts};
use mufasa_sim::experiment::readings::{self, Readings};
use mufasa_sim::experiment::stages::{self, Stages};

pub use super::chart::Figure;
use super::chart::{self, Bar, Dot, Group, Mark, Panel, Row, Series, Small};
use crate::evaluate::published;

const SOFOF: Series = Series::of(Variant::Sofof);
const PAPER: Series = Series::of(Variant::Paper);
const HARDENED: Series = Series::of(Variant::Hardened);
/// What is counted, up to how much, and in how many steps.
const PERCENT: (&str, f64, usize) = ("runs that failed, %", 100.0, 4);
const IN_FULL: &str =
    "In full: collisions; paler: target not reached in time. Above: failures of runs.";

fn figure(name: &str, svg: String) -> Vec<Figure> {
    vec![Figure { file: format!("{name}.svg"), svg }]
}

fn percent(part: usize, of: usize) -> f64 {
    if of == 0 { 0.0 } else { 100.0 * chart::nth(part) / chart::nth(of) }
}

/// Of so many runs those that collided, and those that were late.
fn failed(variant: Variant, [collided, late, runs]: [usize; 3]) -> Bar {
    Bar {
        series: Series::of(variant),
        value: percent(collided, runs),
        paler: percent(late, runs),
        label: format!("{}/{runs}", collided + late),
        published: None,
    }
}

/// Failures by attack and variant.
pub fn failures(of: &Failures) -> Vec<Figure> {
    let bar = |row: &failures::Row| Bar {
        published: published::failures(row.attack, row.variant).number,
        ..failed(row.variant, [row.collided, row.late, row.runs])
    };
    let group = |rows: &[failures::Row]| Group {
        name: kind_name(rows[0].attack).to_owned(),
        bars: rows.iter().map(bar).collect(),
        note: words(rows),
    };
    let groups: Vec<_> = of.rows.chunk_by(|a, b| a.attack == b.attack).map(group).collect();
    let about = format!(
        "{IN_FULL}\nThe paper gives numbers in words alone: no failure with its stages, \"several\" without (Sec. V-B)."
    );
    let head = ["Failures by attack and by what is checked", &about];
    let key = [SOFOF, PAPER, HARDENED, Series::PUBLISHED];
    figure(failures::NAME, chart::bars(head, &key, PERCENT, &groups))
}

/// What the paper says of this attack without its stages.
fn words(rows: &[failures::Row]) -> String {
    let sofof = rows.iter().find(|row| row.variant == Variant::Sofof);
    let words = sofof.map_or("", |row| published::failures(row.attack, row.variant).words);
    if words.is_empty() { String::new() } else { format!("paper, sofof: {words}") }
}

/// Failures under empty lists, by the reading of the paper's text.
pub fn readings(of: &Readings) -> Vec<Figure> {
    let same = |a: &readings::Row, b: &readings::Row| (a.lists, a.comes) == (b.lists, b.comes);
    let group = |rows: &[readings::Row]| {
        let [lists, comes] =
            [readings::name_of_lists(rows[0].lists), readings::name_of_comes(rows[0].comes)];
        let rows = rows.iter().filter(|row| row.empty_is_a_list);
        let bars = rows.map(|row| failed(row.variant, [row.collided, row.late, row.runs]));
        Group { name: format!("{lists}, {comes}"), bars: bars.collect(), note: String::new() }
    };
    let groups: Vec<_> = of.rows.chunk_by(same).map(group).collect();
    let about =
        "In full: collisions; paler: target not reached in time. An empty list is a list (I-11).";
    let head = ["Empty track lists, by whose they are and how they come", about];
    figure(readings::NAME, chart::bars(head, &[SOFOF, PAPER, HARDENED], PERCENT, &groups))
}

/// Failures under combinations of attacks.
pub fn combinations(of: &Combinations) -> Vec<Figure> {
    let group = |rows: &[combinations::Row]| {
        let bars = rows.iter();
        let bars = bars.map(|row| failed(row.variant, [row.collided, row.late, row.runs]));
        let name = format!("{} offered", rows[0].offered.name());
        Group { name, bars: bars.collect(), note: String::new() }
    };
    let groups: Vec<_> = of.rows.chunk_by(|a, b| a.offered == b.offered).map(group).collect();
    let head = ["Failures under attacks of all kinds, drawn at random over time", IN_FULL];
    figure(combinations::NAME, chart::bars(head, &[SOFOF, PAPER, HARDENED], PERCENT, &groups))
}

/// Collisions under attacks by what is left out.
pub fn left_out(of: &LeftOuts) -> Vec<Figure> {
    let figure_of = |detectors: Detectors| {
        let rows = || of.rows.iter().filter(move |row| row.detectors == detectors);
        let bar = |row: &left_out::Row| Bar {
            label: row.attacked_collided.to_string(),
            ..failed(row.variant, [row.attacked_collided, 0, row.attacked_runs])
        };
        let group = |named: &left_out::Row| Group {
            name: named.left_out.name().trim_start_matches("stage-").to_owned(),
            bars: rows().filter(|row| row.left_out == named.left_out).map(bar).collect(),
            note: String::new(),
        };
        let groups: Vec<_> =
            rows().filter(|row| row.variant == Variant::Hardened).map(group).collect();
        let title =
            format!("Collisions while offloading, by what is left out: {}", detectors.name());
        let about =
            "Under attacks, by stages and rules that are left out. Above: runs that collided.";
        let scale = ("runs that collided, %", 100.0, 4);
        let svg = chart::bars([&title, about], &[PAPER, HARDENED], scale, &groups);
        Figure { file: format!("{}-{}.svg", left_out::NAME, detectors.name()), svg }
    };
    Detectors::ALL.map(figure_of).into()
}

/// Detections of each stage.
pub fn stages(of: &Stages) -> Vec<Figure> {
    const PUBLISHED: Series =
        Series { mark: Mark::Square, color: SOFOF.color, ..Series::PUBLISHED };
    let count = |it: u64| usize::try_from(it).unwrap_or(usize::MAX);
    let bar = |series: Series, detections: u64, executions: u64| Bar {
        series,
        value: 10.0 * percent(count(detections), count(executions)),
        paler: 0.0,
        label: format!("{detections}\nof {executions}"),
        published: None,
    };
    let groups = stages::PAPER.into_iter().enumerate().map(|(index, (executions, detections))| {
        let rows = of.rows.iter().filter(|row| row.stage as usize == index);
        let ours =
            rows.clone().map(|row| bar(Series::of(row.variant), row.detections, row.executions));
        let bars = ours.chain([bar(PUBLISHED, detections, executions)]).collect();
        let name = rows.map(|row| format!("stage {}", row.stage.name())).next();
        Group { name: name.unwrap_or_default(), bars, note: String::new() }
    });
    let groups: Vec<Group> = groups.collect();
    let most = groups.iter().flat_map(|it| &it.bars).map(|it| it.value).fold(10.0, f64::max);
    let most = 20.0 * (most / 20.0).ceil();
    let about = "Above each bar: detections of executions. Town, services and areas are ours.";
    let head = ["Detections of each stage under random attacks", about];
    let scale = ("detections in 1000 executions", most, 5);
    figure(stages::NAME, chart::bars(head, &[PAPER, HARDENED, PUBLISHED], scale, &groups))
}

/// Cycles until each attack is detected.
pub fn attacks(of: &Attacks) -> Vec<Figure> {
    let kinds: Vec<Kind> = Kind::ALL.into_iter().collect();
    let panel = |offered: Offered| {
        let rows = || of.rows.iter().filter(|row| row.offered == offered);
        let (mut dots, mut lines) = (vec![], vec![]);
        for (variant, shift) in [(Variant::Paper, -4), (Variant::Hardened, 4)] {
            let series = Series::of(variant);
            let control = rows().find(|row| (row.attack, row.variant) == (None, variant));
            let control = control.and_then(|row| row.median_cycles);
            lines.extend(control.map(|cycles| (float(cycles), series.color)));
            for row in rows().filter(|row| row.variant == variant) {
                let Some(at) = kinds.iter().position(|kind| Some(*kind) == row.attack) else {
                    continue;
                };
                let value = row.median_cycles.map(float);
                let is_open = row.detected < row.runs;
                dots.push(Dot { row: at, value, series, is_open, shift });
                let series = Series::COLLIDED;
                let collided = Dot { row: at, value: None, series, is_open, shift };
                dots.extend((row.collided > 0).then_some(collided));
            }
        }
        Panel { name: format!("{} offered", offered.name()), dots, lines }
    };
    let about = "Median of the cycles (of 0.1 s) with something remote from the attack's start to the first detection.\n\
        Open: not in every run; \"missed\": in none. Dashed: the first false alarm of as many runs without an attack;\n\
        a mark at or behind the line of its colour shows nothing.";
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    let svg = chart::dots(
        ["How soon attacks are detected", about],
        &[PAPER, HARDENED, Series::COLLIDED],
        &names,
        ("cycles until it is detected", 1000.0, "missed"),
        &Offered::ALL.map(panel),
    );
    figure(attacks::NAME, svg)
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn float(count: u64) -> f64 {
    count as f64
}

/// Availability by each factor.
pub fn availability(of: &Availability) -> Vec<Figure> {
    let small = |factor: Factor, value: fn(&availability::Row) -> f64| {
        let rows = || of.rows.iter().filter(|row| row.factor == factor);
        let line = |variant| {
            let of = rows().filter(|row| row.variant == variant).map(value).collect();
            (Series::of(variant), of)
        };
        let names = rows().filter(|row| row.variant == Variant::Paper);
        Small {
            name: words_of(factor).to_owned(),
            names: names.map(|row| said(row.factor, row.value)).collect(),
            lines: [Variant::Paper, Variant::Hardened].map(line).into(),
        }
    };
    let row = |unit, most, value: fn(&availability::Row) -> f64| {
        let charts = Factor::ALL.map(|factor| small(factor, value)).into();
        Row { unit, most, charts }
    };
    let most = of.rows.iter().map(|row| row.fallbacks_per_hour).fold(100.0, f64::max);
    let most = 200.0 * (most / 200.0).ceil();
    let rows = [
        row("share of the time with remote tracks, %", 100.0, |row| 100.0 * row.share_mot),
        row("share of the time with a remote trajectory, %", 100.0, |row| 100.0 * row.share_plan),
        row("fallbacks in an hour, each a false alarm", most, |row| row.fallbacks_per_hour),
    ];
    let one =
        |factor: Factor| format!("{}: {}", words_of(factor), said(factor, factor.of_default()));
    let about = format!(
        "No attack. One setting at a time differs from its default:\n{}.\nThe paper gives no such figures.",
        Factor::ALL.map(one).join("; ")
    );
    let head = ["What the checks cost without an attack", about.as_str()];
    figure(availability::NAME, chart::lines(head, &[PAPER, HARDENED], &rows))
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

/// The time left to react in every run of a search.
pub fn falsified(of: &Falsified) -> Vec<Figure> {
    let random = Series { name: "at random", mark: Mark::Circle, ..SOFOF };
    let guided = Series { name: "by CMA-ES, from the best of them", mark: Mark::Circle, ..PAPER };
    let tried =
        of.tries.iter().map(|it| (if it.is_random { random } else { guided }, it.time_left_s));
    let tried: Vec<_> = tried.collect();
    let rounds = of.tries.windows(2).enumerate();
    let rounds = rounds.filter(|(_, it)| it[0].round != it[1].round).map(|(at, _)| at + 1);
    let about = "Least time left to react of each run; at 0 nothing helps any more. The line is the least up to then;\n\
        upright lines part the rounds, which have new scenarios.";
    let svg = chart::search(
        ["The search for collisions", about],
        &[random, guided, Series::COLLIDED],
        ("time left to react, s", FREE_S),
        (&tried, &rounds.collect::<Vec<_>>()),
    );
    figure(falsify::NAME, svg)
}
