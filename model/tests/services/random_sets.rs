//! `spec/1-services.md#composition`: the orchestrator against brute force on random small sets.

use mufasa_model::services::composition::is_composition;
use mufasa_model::services::orchestrator::{NoComposition, Rule, Task, closed_choices, compose};
use mufasa_model::services::service::{Service, ServiceSet};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{brute_force, task};

/// Reproducible numbers.
struct Numbers(ChaCha8Rng);

impl Numbers {
    /// A number below `bound`.
    fn below(&mut self, bound: u64) -> u64 {
        self.0.random_range(0..bound)
    }

    fn one_in(&mut self, n: u64) -> bool {
        self.below(n) == 0
    }

    fn subset(&mut self, names: &[&str], one_in: u64) -> Vec<String> {
        names.iter().filter(|_| self.one_in(one_in)).map(|name| (*name).to_owned()).collect()
    }
}

/// Up to five services over three interfaces and two stations, with random placement rules. Every
/// third set has no cycles: a service requires only what later ones guarantee.
fn random_task(numbers: &mut Numbers) -> Task {
    let ids = ["d", "a", "c", "e", "b"];
    let count = usize::try_from(2 + numbers.below(4)).expect("small");
    let layered = numbers.one_in(3);
    let services = (0..count)
        .map(|place| {
            let low = if layered { place.min(3) } else { 0 };
            Service {
                id: ids[place].to_owned(),
                requires: numbers.subset(&["x", "y", "z"][low..], 2),
                guarantees: numbers.subset(&["x", "y", "z"][..if layered { low } else { 3 }], 2),
                station: i64::from(numbers.one_in(3)),
            }
        })
        .collect();
    let mut task = task(services, ids[0]);
    for _ in 0..numbers.below(3) {
        task.same_station.push(numbers.subset(&ids, 2));
    }
    task.local_only = numbers.subset(&ids, 4);
    task
}

/// COMP-09, COMP-11: every subset of links
/// with every subset of members, for 3,000 sets with at most 12 links.
#[test]
fn the_orchestrator_agrees_with_brute_force_on_random_sets() {
    let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(1));
    let mut seen = [0_usize; 7];
    let mut examined = 0;
    while examined < 3_000 {
        let task = random_task(&mut numbers);
        if brute_force::arcs(&task).len() > 12 {
            continue;
        }
        examined += 1;
        let found = brute_force::all(&task);
        let answer = compose(&task).expect("a valid task");
        assert_eq!(answer, brute_force::answer(&task, &found), "{task:?}");

        let services = ServiceSet::new(task.services.clone()).expect("valid");
        let choices = closed_choices(&services, &task.goal).expect("few");
        assert_eq!(choices.len(), brute_force::closed_choices(&found), "{task:?}");
        assert!(answer.compositions.iter().all(|c| is_composition(&services, &task, c)));

        seen[match answer.none {
            None if answer.compositions.len() > 1 => 0,
            None if answer.compositions[0].distributed => 1,
            None => 2,
            Some(NoComposition::Requirement { .. }) => 3,
            Some(NoComposition::Rule(Rule::SameStation)) => 4,
            Some(NoComposition::Rule(Rule::LocalOnly)) => 5,
            Some(NoComposition::Rule(Rule::Acyclic)) => 6,
        }] += 1;
    }
    assert!(
        seen.iter().all(|count| *count >= 10),
        "some kind of answer was hardly tried: {seen:?}"
    );
}
