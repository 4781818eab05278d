//! All compositions of a service set, as a table and as a graph
//! (`spec/1-services.md#composition`, `spec/5-interfaces.md#composition`; paper Fig. 2).

pub mod graph;

mod dot;

use std::collections::{BTreeMap, BTreeSet};

use comfy_table::{ContentArrangement, Table, presets};
use mufasa_model::report::InvalidInput;
use mufasa_model::services::composition::{Composition, Link};
use mufasa_model::services::orchestrator::{Answer, NoComposition, Task};
use mufasa_model::services::service::ServiceSet;
use serde::de::IgnoredAny;

use graph::Graph;
use mufasa_records::composition_answer::CompositionAnswer;
use mufasa_records::{self as json, LineError, Record, names};

/// Width of a table, characters.
const TABLE_WIDTH: u16 = 110;

/// The services of the paper's Fig. 2.
pub const EXAMPLE: &str = include_str!("../../../examples/fig2.json");

/// A service set with its compositions.
pub struct Composed {
    id: String,
    task: Task,
    services: ServiceSet,
    answer: Answer,
}

/// Composes the service set of a composition record, which may go over several lines. Errors: the
/// text is no composition record, or the orchestrator refuses it; each with the line.
pub fn composed(text: &str) -> Result<Composed, LineError> {
    let (id, task) = match json::parse(text.as_bytes(), 1)
        .map_err(|error| one_of_many(text).unwrap_or(error))?
    {
        Record::Composition { id, task } => (id, task),
        Record::Cycle { id, .. } | Record::Offloading { id, .. } | Record::Monitor { id, .. } => {
            return Err(LineError::new(
                1,
                Some(id),
                InvalidInput {
                    field: String::from("kind"),
                    index: None,
                    message: String::from("kind must be composition"),
                },
            ));
        }
    };
    let (services, answer) =
        json::compose(&task).map_err(|problem| LineError::new(1, Some(id.clone()), problem))?;
    Ok(Composed { id, task, services, answer })
}

/// The error of a text of several records, a line each.
fn one_of_many(text: &str) -> Option<LineError> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let is_json = serde_json::from_str::<IgnoredAny>(lines.next()?).is_ok();
    let others = lines.count();
    (is_json && others > 0).then(|| {
        let message = format!("one record is composed, and behind the first line are {others} more; give a file with one");
        LineError::whole(2, message)
    })
}

impl Composed {
    /// The answer of the line protocol.
    pub fn answer(&self) -> CompositionAnswer {
        CompositionAnswer::new(self.id.clone(), self.answer.clone())
    }

    /// The services and links that some composition uses; without a composition the goal alone.
    pub fn graph(&self) -> Graph {
        Graph::of_compositions(&self.services, &self.task.goal, &self.answer.compositions)
    }

    /// One row per composition, below a line that says how many there are, or why there is none.
    /// What all compositions have in common stands above the table.
    pub fn table(&self) -> String {
        let mut text = self.summary() + "\n";
        let compositions = &self.answer.compositions;
        if compositions.is_empty() {
            return text;
        }
        let common = self.common();
        text.extend(["in every one: ", &names(common.iter().copied()), "\n"]);
        let unused = self.unused();
        if !unused.is_empty() {
            text.extend(["in none: ", &names(unused), "\n"]);
        }
        let stations = self.stations();
        // Links need a column of their own only where members leave a question open.
        let members: BTreeSet<_> = compositions.iter().map(|it| &it.members).collect();
        let links_differ = members.len() < compositions.len();
        let mut table = Table::new();
        table.load_style(presets::UTF8_FULL);
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(TABLE_WIDTH);
        let mut header = vec![String::from("#")];
        header.extend(stations.iter().map(|station| graph::station_name(*station)));
        header.extend(links_differ.then(|| String::from("choices")));
        header.push(String::from("device switches"));
        table.set_header(header);
        for (index, composition) in compositions.iter().enumerate() {
            let mut row = vec![(index + 1).to_string()];
            row.extend(stations.iter().map(|station| {
                names(self.members_on(*station, composition).filter(|id| !common.contains(id)))
            }));
            row.extend(links_differ.then(|| choices(&self.varied(), composition)));
            row.push(switches(composition));
            table.add_row(row);
        }
        text.extend([&table.to_string(), "\n"]);
        text
    }

    /// The graph in the language of Graphviz, the goal at the top.
    pub fn dot(&self) -> String {
        dot::draw(&self.graph())
    }

    fn summary(&self) -> String {
        let Answer { compositions, none } = &self.answer;
        match none {
            None => {
                let distributed = compositions.iter().filter(|it| it.distributed).count();
                let plural = if compositions.len() == 1 { "" } else { "s" };
                format!(
                    "{} composition{plural} for {}, {distributed} distributed",
                    compositions.len(),
                    json::shown(&self.task.goal)
                )
            }
            Some(NoComposition::Requirement { requirement, service }) => format!(
                "no composition for {}: nobody guarantees {}, which {} requires",
                json::shown(&self.task.goal),
                json::shown(requirement),
                json::shown(service)
            ),
            Some(NoComposition::Rule(broken)) => format!(
                "no composition for {}: the rule {} stands in the way",
                json::shown(&self.task.goal),
                names::placement_rule(*broken)
            ),
        }
    }

    fn stations(&self) -> BTreeSet<i64> {
        let members = self.answer.compositions.iter().flat_map(|it| &it.members);
        members.filter_map(|id| self.services.get(id)).map(|service| service.station).collect()
    }

    fn members_on<'a>(
        &'a self,
        station: i64,
        composition: &'a Composition,
    ) -> impl Iterator<Item = &'a str> {
        let here = move |id: &&str| self.services.get(id).is_some_and(|it| it.station == station);
        composition.members.iter().map(String::as_str).filter(here)
    }

    /// Members of every composition.
    fn common(&self) -> BTreeSet<&str> {
        let members = self
            .answer
            .compositions
            .iter()
            .map(|it| it.members.iter().map(String::as_str).collect::<BTreeSet<_>>());
        members.reduce(|common, more| &common & &more).unwrap_or_default()
    }

    /// Consumers and interfaces for which there is more than one provider.
    fn varied(&self) -> BTreeSet<(&str, &str)> {
        let mut providers: BTreeMap<(&str, &str), BTreeSet<&str>> = BTreeMap::new();
        for Link { provider, interface, consumer } in
            self.answer.compositions.iter().flat_map(|it| &it.links)
        {
            providers.entry((consumer, interface)).or_default().insert(provider);
        }
        providers.into_iter().filter(|(_, some)| some.len() > 1).map(|(key, _)| key).collect()
    }

    fn unused(&self) -> Vec<&str> {
        let used: BTreeSet<&String> =
            self.answer.compositions.iter().flat_map(|it| &it.members).collect();
        self.services
            .iter()
            .map(|it| &it.id)
            .filter(|id| !used.contains(id))
            .map(String::as_str)
            .collect()
    }
}

fn choices(varied: &BTreeSet<(&str, &str)>, composition: &Composition) -> String {
    let chosen = composition
        .links
        .iter()
        .filter(|link| varied.contains(&(link.consumer.as_str(), link.interface.as_str())))
        .map(|link| {
            let [provider, interface, consumer] =
                [&link.provider, &link.interface, &link.consumer].map(|name| json::shown(name));
            format!("{interface} of {consumer}: {provider}")
        });
    join(chosen, "\n")
}

fn switches(composition: &Composition) -> String {
    let pairs = composition.switches.iter().map(|(provider, consumer)| {
        format!("{} \u{2192} {}", json::shown(provider), json::shown(consumer))
    });
    join(pairs, "\n")
}

fn names<'a>(ids: impl IntoIterator<Item = &'a str>) -> String {
    join(ids.into_iter().map(json::shown), ", ")
}

fn join(parts: impl Iterator<Item = String>, separator: &str) -> String {
    parts.collect::<Vec<_>>().join(separator)
}
