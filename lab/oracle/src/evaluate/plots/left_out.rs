//! Charts of what is left out: true lists, and inputs of stages.

use mufasa_sim::attack::means::{Comes, Lists};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::axes::{Detectors, LeftOut};
use mufasa_sim::experiment::left_out::LEFT_OUT;
use mufasa_sim::experiment::made::Made;
use mufasa_sim::experiment::readings::READINGS;
use mufasa_sim::experiment::row::Row;

use super::bars::{self, Bar, Bars, Group};
use super::chart::{Figure, figure, ratio, series};
use super::failed::Failed;
use super::page::Series;

/// Collisions by the reading of the paper's text.
pub fn readings(of: &Made) -> Vec<Figure> {
    let failed = Failed {
        name: READINGS.name,
        title: "Empty track lists, by whose they are and how they come",
        about: &[
            "In full: collisions; paler: target not reached in time. An empty list is a list (I-11).",
        ],
        is_published: false,
        same: |a, b| (a.lists, a.comes) == (b.lists, b.comes),
        group: |row| {
            let lists = row.lists.map_or("", Lists::name);
            format!("{lists}, {}", row.comes.map_or("", Comes::name))
        },
    };
    failed.draw(of.rows.iter().filter(|row| row.empty_is_a_list == Some(true)))
}

/// Collisions under attacks by what is left out.
pub fn parts(of: &Made) -> Vec<Figure> {
    let bar = |row: &Row| Bar {
        series: series(row.variant),
        value: 100.0 * ratio(row.attacked_collided_remote, row.attacked_runs),
        paler: 0.0,
        label: row.attacked_collided_remote.to_string(),
        published: Vec::new(),
    };
    let figure_of = |detectors: Detectors| {
        let rows = || of.rows.iter().filter(move |row| row.detectors == Some(detectors));
        let hardened = rows().filter(|row| row.variant == Variant::Hardened);
        let group = |named: &Row| Group {
            name: named.left_out.map_or("", LeftOut::name).trim_start_matches("stage-").to_owned(),
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
        figure(&format!("{}-{}", LEFT_OUT.name, detectors.name()), svg)
    };
    Detectors::ALL.map(figure_of).into()
}
