//! `spec/1-services.md`: compositions against all choices, and what no vector shows.

mod brute_force;
mod configurations;
mod figure_2;
mod random_sets;
mod service_sets;

use mufasa_model::services::orchestrator::Task;
use mufasa_model::services::service::Service;

/// A service from words: `service("env", "tracks map", "environment", 0)`.
fn service(id: &str, requires: &str, guarantees: &str, station: i64) -> Service {
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect();
    Service { id: id.to_owned(), requires: words(requires), guarantees: words(guarantees), station }
}

/// A task without placement rules.
fn task(services: Vec<Service>, goal: &str) -> Task {
    Task { services, goal: goal.to_owned(), same_station: vec![], local_only: vec![] }
}

/// A list of names from words.
fn names(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}
