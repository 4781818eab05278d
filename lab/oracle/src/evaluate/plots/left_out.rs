//! Charts of what is left out: true lists, and inputs of stages.

use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::left_out::{self, Detectors, LeftOuts};
use mufasa_sim::experiment::readings::{self, Readings};

use super::bars::{self, Bar, Bars, Group};
use super::chart::{Figure, figure, ratio, series};
use super::page::Series;

/// Collisions by the reading of the paper's text.
pub fn readings(of: &Readings) -> Vec<Figure> {
    let bar = |row: &readings::Row| Bar {
        series: series(row.variant),
        value: 100.0 * ratio(row.collided, row.runs),
        paler: 100.0 * ratio(row.late, row.runs),
        label: format!("{}/{}", row.collided + row.late, row.runs),
        published: Vec::new(),
    };
    let group = |rows: &[readings::Row]| Group {
        name: format!(
            "{}, {}",
            readings::name_of_lists(rows[0].lists),
            readings::name_of_comes(rows[0].comes)
        ),
        bars: rows.iter().filter(|row| row.empty_is_a_list).map(bar).collect(),
        note: String::new(),
    };
    let same = |a: &readings::Row, b: &readings::Row| (a.lists, a.comes) == (b.lists, b.comes);
    let svg = bars::draw(&Bars {
        title: "Empty track lists, by whose they are and how they come",
        about: &[
            "In full: collisions; paler: target not reached in time. An empty list is a list (I-11).",
        ],
        key: &[Series::SOFOF, Series::PAPER, Series::HARDENED],
        unit: "runs that failed, %",
        most: 100.0,
        step: 25.0,
        groups: of.rows.chunk_by(same).map(group).collect(),
    });
    vec![figure(readings::NAME, svg)]
}

/// Collisions under attacks by what is left out.
pub fn parts(of: &LeftOuts) -> Vec<Figure> {
    let bar = |row: &left_out::Row| Bar {
        series: series(row.variant),
        value: 100.0 * ratio(row.attacked_collided, row.attacked_runs),
        paler: 0.0,
        label: row.attacked_collided.to_string(),
        published: Vec::new(),
    };
    let figure_of = |detectors: Detectors| {
        let rows = || of.rows.iter().filter(move |row| row.detectors == detectors);
        let hardened = rows().filter(|row| row.variant == Variant::Hardened);
        let group = |named: &left_out::Row| Group {
            name: named.left_out.name().trim_start_matches("stage-").to_owned(),
            bars: rows().filter(|row| row.left_out == named.left_out).map(bar).collect(),
            note: String::new(),
        };
        let svg = bars::draw(&Bars {
            title: &format!(
                "Collisions while offloading, by what is left out: {}",
                detectors.name()
            ),
            about: &[
                "Under attacks, by stages and rules that are left out. Above: runs that collided.",
            ],
            key: &[Series::PAPER, Series::HARDENED],
            unit: "runs that collided, %",
            most: 100.0,
            step: 25.0,
            groups: hardened.map(group).collect(),
        });
        figure(&format!("{}-{}", left_out::NAME, detectors.name()), svg)
    };
    Detectors::ALL.map(figure_of).into()
}
