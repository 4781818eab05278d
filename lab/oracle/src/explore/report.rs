//! An exploration as a file that a program can read, and as Markdown for documents.

use std::fmt::Write as _;

use mufasa_exploration::bounds::Bounds;
use mufasa_exploration::properties::Property;
use mufasa_exploration::run::WorldOutcome;
use mufasa_model::input::cycle::Profile;
use schemars::JsonSchema;
use serde::Serialize;

use super::evidence;
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
    /// Reachable states as stateright counts them; `None`: it was not asked.
    pub stateright_states: Option<usize>,
    /// Seconds of stateright.
    pub stateright_seconds: Option<f64>,
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
    pub fn new(profile: Profile, bounds: Bounds, outcomes: &[WorldOutcome]) -> Self {
        Self {
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
        let mut out = format!("### {} profile, {} bounds\n\n", self.profile, self.bounds);
        out.push_str(
            "| world | requester: states | steps compared | states | moves | depth | seconds | MB \
             | stateright: states | seconds |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        );
        for world in &self.worlds {
            let number = |number: usize| evidence::grouped(evidence::wide(number));
            let _ = writeln!(
                out,
                "| {} | {} | {} | {} | {} | {} | {:.1} | {} | {} | {} |",
                world.name,
                number(world.requester_states),
                number(world.steps_compared),
                number(world.states),
                evidence::grouped(world.moves),
                world.depth,
                world.seconds,
                world.bytes.div_ceil(1 << 20),
                world.stateright_states.map_or_else(|| String::from("not asked"), number),
                world.stateright_seconds.map_or_else(String::new, |it| format!("{it:.1}")),
            );
        }
        out.push_str("\n| property | | verdict | shown by (moves) |\n|---|---|---|---|\n");
        for property in &self.properties {
            let PropertyRow { name, kind, shown_by, .. } = property;
            let shown_by = shown_by.replace('\n', "; ");
            let _ = writeln!(out, "| {name} | {kind} | {} | {shown_by} |", property.verdict());
        }
        out.push('\n');
        out
    }
}

impl WorldRow {
    fn new(outcome: &WorldOutcome) -> Self {
        let world = outcome.system.world();
        let requesters = outcome.system.requesters();
        let second = outcome.second.as_ref();
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
            stateright_states: second.map(|(it, _)| it.states),
            stateright_seconds: second.map(|(_, time)| time.as_secs_f64()),
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
