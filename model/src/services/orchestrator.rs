//! The orchestrator: every composition of a service set for a goal, or why there is none
//! (`spec/1-services.md#composition`, `spec/5-interfaces.md#composition`).
//!
//! A closed choice takes exactly one provider for every requirement of the goal, of the providers
//! so chosen, of their providers, and so on until nothing is left to provide. It is closed and
//! minimal by construction; a composition is a closed choice that also keeps the other rules.

use std::collections::BTreeSet;
use std::fmt;

pub use crate::services::composition::Task;

use crate::services::composition::{
    Composition, Link, is_acyclic, keeps_local_only, keeps_same_station,
};
use crate::services::service::{Service, ServiceError, ServiceSet};

/// More closed choices than this are an error.
pub const MAX_CLOSED_CHOICES: usize = 10_000;

/// Every composition, sorted by members, then links; `none` says why there is none.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Answer {
    /// The compositions, each once.
    pub compositions: Vec<Composition>,
    /// `Some` exactly when there is no composition.
    pub none: Option<NoComposition>,
}

/// Why no composition exists.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum NoComposition {
    /// Nobody guarantees a requirement of a service reachable from the goal.
    Requirement {
        /// Name of the interface.
        requirement: String,
        /// Id of the service that requires it.
        service: String,
    },
    /// A rule stands in the way.
    Rule(Rule),
}

/// The rules that a closed choice may break, in the order in which they are named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rule {
    /// All members named in one list run on one station.
    SameStation,
    /// Members named run on station 0.
    LocalOnly,
    /// No cycle of chosen links.
    Acyclic,
}

impl Rule {
    /// All rules in order.
    pub const ALL: [Self; 3] = [Self::SameStation, Self::LocalOnly, Self::Acyclic];
}

/// What makes a task unanswerable.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum TaskError {
    /// The services are no service set.
    Services(ServiceError),
    /// The set does not hold the goal.
    UnknownGoal(String),
    /// More than [`MAX_CLOSED_CHOICES`] closed choices.
    TooManyChoices,
}

impl fmt::Display for TaskError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Services(error) => error.fmt(f),
            Self::UnknownGoal(goal) => {
                write!(f, "goal `{goal}` is no service of the set: name one that is")
            }
            Self::TooManyChoices => write!(
                f,
                "more than {MAX_CLOSED_CHOICES} closed choices: offer fewer providers per interface"
            ),
        }
    }
}

impl std::error::Error for TaskError {}

/// Enumerates every composition for the task, or names why there is none. Errors: no service set,
/// unknown goal, too many closed choices. `spec/1-services.md#composition`.
pub fn compose(task: &Task) -> Result<Answer, TaskError> {
    let services = ServiceSet::new(task.services.clone()).map_err(TaskError::Services)?;
    if services.get(&task.goal).is_none() {
        return Err(TaskError::UnknownGoal(task.goal.clone()));
    }
    let choices: Vec<Judged> = closed_choices(&services, &task.goal)?
        .iter()
        .map(|links| judge(&services, task, links))
        .collect();
    let compositions: BTreeSet<Composition> = choices
        .iter()
        .filter(|choice| choice.broken.is_empty())
        .map(|choice| choice.composition.clone())
        .collect();
    let none = if compositions.is_empty() { reason(&services, &task.goal, &choices) } else { None };
    Ok(Answer { compositions: compositions.into_iter().collect(), none })
}

/// The link sets of all closed choices, each once. `spec/1-services.md#composition`.
pub fn closed_choices(services: &ServiceSet, goal: &str) -> Result<Vec<BTreeSet<Link>>, TaskError> {
    let closable = closable(services);
    let mut closed = Vec::new();
    let mut unfinished = Vec::new();
    if let Some(goal) = services.get(goal).filter(|_| closable.contains(goal)) {
        unfinished.push(Choice::of_goal(goal));
    }
    while let Some(mut choice) = unfinished.pop() {
        let Some((consumer, requirement)) = choice.open.pop() else {
            closed.push(choice.links);
            continue;
        };
        let providers = services
            .iter()
            .filter(|s| closable.contains(s.id.as_str()) && s.guarantees.contains(requirement));
        for provider in providers {
            let mut next = choice.clone();
            next.link(provider, requirement, consumer);
            unfinished.push(next);
        }
        // Every unfinished choice can be finished, and no two finish as the same.
        if closed.len() + unfinished.len() > MAX_CLOSED_CHOICES {
            return Err(TaskError::TooManyChoices);
        }
    }
    Ok(closed)
}

/// A choice on its way from the goal back to the services without requirements.
#[derive(Clone)]
struct Choice<'a> {
    members: BTreeSet<&'a str>,
    links: BTreeSet<Link>,
    /// Requirements that have no provider yet, with their consumers.
    open: Vec<(&'a Service, &'a String)>,
}

impl<'a> Choice<'a> {
    fn of_goal(goal: &'a Service) -> Self {
        let mut choice =
            Self { members: BTreeSet::new(), links: BTreeSet::new(), open: Vec::new() };
        choice.join(goal);
        choice
    }

    fn link(&mut self, provider: &'a Service, requirement: &str, consumer: &Service) {
        self.links.insert(Link {
            provider: provider.id.clone(),
            interface: requirement.to_owned(),
            consumer: consumer.id.clone(),
        });
        self.join(provider);
    }

    /// A new member brings its requirements along.
    fn join(&mut self, service: &'a Service) {
        if self.members.insert(&service.id) {
            self.open.extend(service.requires.iter().map(|requirement| (service, requirement)));
        }
    }
}

/// The services that some closed choice can hold: what remains when services with a requirement
/// that no remaining service guarantees are taken away until there are none.
fn closable(services: &ServiceSet) -> BTreeSet<&str> {
    let mut remaining: BTreeSet<&str> = services.ids().collect();
    loop {
        let guaranteed: BTreeSet<&String> = services
            .iter()
            .filter(|service| remaining.contains(service.id.as_str()))
            .flat_map(|service| &service.guarantees)
            .collect();
        let kept: BTreeSet<&str> = services
            .iter()
            .filter(|service| remaining.contains(service.id.as_str()))
            .filter(|service| service.requires.iter().all(|name| guaranteed.contains(name)))
            .map(|service| service.id.as_str())
            .collect();
        if kept == remaining {
            return remaining;
        }
        remaining = kept;
    }
}

/// A closed choice and the rules that it breaks.
struct Judged {
    composition: Composition,
    broken: BTreeSet<Rule>,
}

fn judge(services: &ServiceSet, task: &Task, links: &BTreeSet<Link>) -> Judged {
    let composition = Composition::of_links(services, &task.goal, links);
    let keeps = |rule: &Rule| match rule {
        Rule::SameStation => keeps_same_station(services, &task.same_station, &composition),
        Rule::LocalOnly => keeps_local_only(services, &task.local_only, &composition),
        Rule::Acyclic => is_acyclic(&composition),
    };
    let broken = Rule::ALL.into_iter().filter(|rule| !keeps(rule)).collect();
    Judged { composition, broken }
}

/// Why none of the closed choices is a composition. `spec/1-services.md#composition`.
fn reason(services: &ServiceSet, goal: &str, choices: &[Judged]) -> Option<NoComposition> {
    if let Some((requirement, service)) = unguaranteed(services, goal) {
        return Some(NoComposition::Requirement { requirement, service });
    }
    let alone = Rule::ALL
        .into_iter()
        .find(|rule| choices.iter().any(|choice| choice.broken == BTreeSet::from([*rule])));
    let some = Rule::ALL
        .into_iter()
        .find(|rule| choices.iter().any(|choice| choice.broken.contains(rule)));
    alone.or(some).map(NoComposition::Rule)
}

/// The first (requirement, service) reachable from the goal that nobody guarantees.
fn unguaranteed(services: &ServiceSet, goal: &str) -> Option<(String, String)> {
    let mut reachable: BTreeSet<&str> = BTreeSet::new();
    let mut next: Vec<&Service> = services.get(goal).into_iter().collect();
    let mut missing = BTreeSet::new();
    while let Some(consumer) = next.pop() {
        if !reachable.insert(&consumer.id) {
            continue;
        }
        next.extend(services.iter().filter(|provider| provider.feeds(consumer)));
        for requirement in &consumer.requires {
            if !services.iter().any(|service| service.guarantees.contains(requirement)) {
                missing.insert((requirement.clone(), consumer.id.clone()));
            }
        }
    }
    missing.into_iter().next()
}
