//! An exploration as a file that a program can read, and as Markdown for documents.

use mufasa_exploration::bounds::Bounds;
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::WorldOutcome;
use mufasa_model::input::cycle::Profile;
use schemars::JsonSchema;
use serde::Serialize;

use super::evidence::{self, grouped, wide};
use super::monitor::{self, LawRow};
use crate::rows::{Column, Rows, number, text};
use mufasa_records::names;

/// What was explored in one profile, and what it showed.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ExplorationReport {
    /// The profile.
    pub profile: &'static str,
    /// The bounds.
    pub bounds: &'static str,
    /// The worlds.
    pub worlds: Vec<WorldRow>,
    /// The properties over all these worlds.
    pub properties: Vec<PropertyRow>,
    /// The laws of the monitor; empty where one world alone was asked for.
    pub monitor: Vec<LawRow>,
}

/// A world with its sizes.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WorldRow {
    /// Its name.
    pub name: &'static str,
    /// What it is for.
    pub why: &'static str,
    /// States of a requester.
    pub requester_states: usize,
    /// Steps in which model and implementation were compared.
    pub steps_compared: usize,
    /// Reachable states of the system.
    pub states: usize,
    /// Moves tried.
    pub moves: u64,
    /// Largest distance from the start, moves.
    pub depth: usize,
    /// Seconds of the search and of all properties.
    pub seconds: f64,
    /// Bytes that the states take.
    pub bytes: usize,
}

/// A property with its verdict.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PropertyRow {
    /// Its sentence.
    pub name: String,
    /// The heading of its requirement.
    pub requirement: &'static str,
    /// `always` or `eventually`.
    pub kind: &'static str,
    /// Whether the profile claims it.
    pub claimed: bool,
    /// Worlds in which it holds.
    pub holds_in: usize,
    /// Worlds in which it fails.
    pub fails_in: usize,
    /// Moves of the shortest counterexample.
    pub shortest_counterexample: Option<usize>,
    /// What shows that it is not empty.
    pub shown_by: String,
}

impl ExplorationReport {
    /// Of what was explored in a profile.
    pub fn new(
        profile: Profile,
        bounds: Bounds,
        outcomes: &[WorldOutcome],
        monitor: Vec<LawRow>,
    ) -> Self {
        Self {
            monitor,
            profile: names::profile(profile),
            bounds: bounds.name(),
            worlds: outcomes.iter().map(WorldRow::new).collect(),
            properties: Property::ALL
                .into_iter()
                .map(|it| PropertyRow::new(it, profile, outcomes))
                .collect(),
        }
    }

    /// The tables as Markdown.
    pub fn markdown(&self) -> String {
        let Self { profile, bounds, .. } = self;
        let tables = [self.worlds(), self.properties(), monitor::table(&self.monitor)];
        let [worlds, properties, monitor] = tables.map(|it| it.markdown());
        format!("### {profile} profile, {bounds} bounds\n\n{worlds}\n{properties}\n{monitor}\n")
    }

    /// The worlds with their sizes.
    pub fn worlds(&self) -> Rows {
        let columns: [Column<WorldRow>; 8] = [
            text("world", |it| it.name.to_owned()),
            number("requester: states", |it| grouped(wide(it.requester_states))),
            number("steps compared", |it| grouped(wide(it.steps_compared))),
            number("states", |it| grouped(wide(it.states))),
            number("moves", |it| grouped(it.moves)),
            number("depth", |it| it.depth.to_string()),
            number("seconds", |it| format!("{:.1}", it.seconds)),
            number("MB", |it| it.bytes.div_ceil(1 << 20).to_string()),
        ];
        Rows::new(&self.worlds, &columns)
    }

    /// The properties with their verdicts over all worlds, and what shows that they are not empty.
    pub fn properties(&self) -> Rows {
        let columns: [Column<PropertyRow>; 4] = [
            text("property", |it| it.name.clone()),
            text("", |it| it.kind.to_owned()),
            text("verdict", PropertyRow::verdict),
            text("shown by (moves)", |it| it.shown_by.clone()),
        ];
        Rows::new(&self.properties, &columns)
    }
}

impl WorldRow {
    fn new(outcome: &WorldOutcome) -> Self {
        let world = outcome.system.world();
        let requesters = outcome.system.requesters();
        Self {
            name: world.name,
            why: world.why,
            requester_states: requesters.len(),
            steps_compared: requesters.reactions(),
            states: outcome.states,
            moves: outcome.transitions,
            depth: outcome.depth,
            seconds: outcome.time.as_secs_f64(),
            bytes: outcome.bytes,
        }
    }
}

impl PropertyRow {
    /// A property over all worlds of a profile.
    pub fn new(property: Property, profile: Profile, outcomes: &[WorldOutcome]) -> Self {
        let results = outcomes.iter().flat_map(|outcome| &outcome.results);
        let asked: Vec<_> = results.filter(|finding| finding.property == property).collect();
        let failures = asked.iter().filter_map(|finding| finding.counterexample.as_ref());
        let moves: Vec<_> = failures.map(|it| it.trace.len() + it.circle.len()).collect();
        Self {
            name: property.name().replace('_', " "),
            requirement: property.requirement(),
            kind: if property.is_safety() { "always" } else { "eventually" },
            claimed: property.is_claimed(profile),
            holds_in: asked.len() - moves.len(),
            fails_in: moves.len(),
            shortest_counterexample: moves.into_iter().min(),
            shown_by: evidence::of_property(property, profile, outcomes),
        }
    }

    /// In words.
    pub fn verdict(&self) -> String {
        match (self.shortest_counterexample, self.holds_in) {
            (Some(moves), _) if self.claimed => format!("FAILS after {moves} moves"),
            (Some(moves), _) => format!("fails after {moves} moves (F-12)"),
            (None, 0) => String::from("not asked"),
            (None, 1) => String::from("holds in 1 world"),
            (None, worlds) => format!("holds in {worlds} worlds"),
        }
    }
}
