//! Charts of runs that failed.

use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::row::Row;

use super::bars::{self, Bar, Bars, Group};
use super::chart::{Figure, figure, ratio, series};
use super::page::Series;
use crate::evaluate::published;

/// What the bars mean.
pub(super) const BARS: &str =
    "In full: collisions; paler: target not reached in time. Above: failures of runs.";

/// Runs that failed, in groups of rows that are neighbours.
pub(super) struct Failed {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// What is said of it.
    pub(super) about: &'static [&'static str],
    /// Whether the paper has numbers of them.
    pub(super) is_published: bool,
    pub(super) same: fn(&Row, &Row) -> bool,
    pub(super) group: fn(&Row) -> String,
}

impl Failed {
    pub(super) fn draw<'r>(&self, rows: impl Iterator<Item = &'r Row>) -> Vec<Figure> {
        let rows: Vec<Row> = rows.cloned().collect();
        let published = |row: &Row| published::failures(row.attack, row.variant).number;
        let bar = |row: &Row| Bar {
            series: series(row.variant),
            value: 100.0 * ratio(row.collided, row.runs),
            paler: 100.0 * ratio(row.late, row.runs),
            label: format!("{}/{}", row.failures, row.runs),
            published: published(row).into_iter().filter(|_| self.is_published).collect(),
        };
        let group = |rows: &[Row]| Group {
            name: (self.group)(&rows[0]),
            bars: rows.iter().map(bar).collect(),
            note: if self.is_published { words(rows) } else { String::new() },
        };
        let all = [Series::SOFOF, Series::PAPER, Series::HARDENED, Series::PUBLISHED];
        let svg = bars::draw(&Bars {
            title: self.title,
            about: self.about,
            key: if self.is_published { &all } else { &all[..3] },
            unit: "runs that failed, %",
            most: 100.0,
            step: 25.0,
            groups: rows.chunk_by(self.same).map(group).collect(),
        });
        vec![figure(self.name, svg)]
    }
}

/// What the paper says of this attack without its stages.
fn words(rows: &[Row]) -> String {
    let sofof = rows.iter().find(|row| row.variant == Variant::Sofof);
    let words = sofof.map_or("", |row| published::failures(row.attack, row.variant).words);
    if words.is_empty() { String::new() } else { format!("paper, sofof: {words}") }
}
