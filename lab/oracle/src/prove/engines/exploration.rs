//! The exploration of the offloading protocol in the small worlds that take seconds.

use std::collections::BTreeMap;

use indicatif::ProgressBar;
use mufasa_exploration::bounds::{Bounds, World};
use mufasa_exploration::properties::Property;
use mufasa_exploration::run;
use mufasa_model::input::cycle::Profile;

use crate::prove::claim::{Claim, EngineAnswer, Status};

const ENGINE: &str = "exploration";
/// `mufasa explore` does the other small worlds, too, and the large ones.
const WORLDS: [&str; 6] = ["anything", "qos-hold", "choice", "shared", "honest", "roam"];

pub(super) fn claims() -> Vec<Claim> {
    let claim = |property: Property| {
        let worlds: Vec<String> =
            worlds().filter(|world| run::is_asked(property, world)).map(bounds_of).collect();
        let domain = format!("hardened profile, every state of: {}", worlds.join("; "));
        let parts = [property.name(), property.statement(), domain.as_str()];
        Claim::new(parts, EngineAnswer::not_run(ENGINE, ""))
    };
    Property::ALL
        .into_iter()
        .filter(|property| property.is_claimed(Profile::HARDENED))
        .map(claim)
        .collect()
}

fn worlds() -> impl Iterator<Item = &'static World> {
    Bounds::Small.worlds().iter().filter(|world| WORLDS.contains(&world.name))
}

fn bounds_of(world: &World) -> String {
    let count =
        |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let messages = match world.in_flight {
        0 => String::from("any message at any time"),
        number => format!("{number} messages in flight"),
    };
    let (cavs, stations) = (count(world.requesters, "CAV"), count(world.stations.len(), "station"));
    format!("{} ({cavs}, {stations}, {messages})", world.name)
}

pub(super) fn judge(claims: Vec<Claim>, bar: &ProgressBar) -> Vec<Claim> {
    let mut found: BTreeMap<&str, Found> = BTreeMap::new();
    bar.set_length(u64::try_from(worlds().count()).unwrap_or(u64::MAX));
    for world in worlds() {
        let is_wanted = |property: Property| claims.iter().any(|line| line.id == property.name());
        if !Property::ALL
            .into_iter()
            .any(|property| is_wanted(property) && run::is_asked(property, world))
        {
            continue;
        }
        bar.set_message(world.name);
        bar.inc(1);
        match run::explore(world, Profile::HARDENED, |_| bar.tick()) {
            Ok(outcome) => outcome.results.iter().for_each(|finding| {
                let found = found.entry(finding.property.name()).or_default();
                found.add(world, &outcome, finding);
            }),
            // Model and implementation differ, so nothing is known of what they do together.
            Err(difference) => Property::ALL.into_iter().for_each(|property| {
                let found = found.entry(property.name()).or_default();
                found.difference = Some(format!("{}: {difference}", world.name));
            }),
        }
    }
    let judged = |line: Claim| {
        let answer = found.remove(line.id.as_str()).map(|found| found.answer(&line.id));
        line.answered(answer.into_iter().collect())
    };
    claims.into_iter().map(judged).collect()
}

/// What all worlds say of one property.
#[derive(Default)]
struct Found {
    states: usize,
    seconds: f64,
    broken: Option<String>,
    difference: Option<String>,
}

impl Found {
    fn add(&mut self, world: &World, outcome: &run::WorldOutcome, finding: &run::PropertyOutcome) {
        let share = u32::try_from(outcome.results.len().max(1)).unwrap_or(u32::MAX);
        self.states += outcome.states;
        self.seconds += (outcome.time / share).as_secs_f64();
        if let Some(moves) = &finding.counterexample {
            let moves = moves.trace.len() + moves.circle.len();
            self.broken = Some(format!("in world {} after {moves} moves", world.name));
        }
    }

    fn answer(self, id: &str) -> EngineAnswer {
        let (status, reason) = match (self.broken, self.difference) {
            (None, None) => (Status::Proved, None),
            (None, Some(difference)) if id != Property::PartsValid.name() => {
                (Status::Unknown, Some(difference))
            }
            (Some(reason), _) | (None, Some(reason)) => (Status::Refuted, Some(reason)),
        };
        let ran = Some(format!("{} states", self.states));
        EngineAnswer { ran, reason, ..EngineAnswer::given(ENGINE, status, self.seconds) }
    }
}
