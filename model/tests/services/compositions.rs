//! `spec/1-services.md#composition`: each rule with a composition that keeps it and one that does
//! not, and what the orchestrator answers on small sets.

use std::collections::BTreeSet;

use mufasa_model::services::composition::{
    Composition, Link, is_acyclic, is_choice, is_closed, is_minimal, keeps_local_only,
    keeps_same_station, names_its_switches,
};
use mufasa_model::services::orchestrator::{Answer, NoComposition, Rule, Task, TaskError, compose};
use mufasa_model::services::service::{Service, ServiceSet};

use crate::{names, service, task};

fn link(text: &str) -> Link {
    let [provider, interface, consumer] = names(text).try_into().expect("three words");
    Link { provider, interface, consumer }
}

fn links(texts: &[&str]) -> BTreeSet<Link> {
    texts.iter().map(|text| link(text)).collect()
}

/// Two detections, a tracker and a goal; the second detection is on station 1.
fn chain() -> Vec<Service> {
    vec![
        service("goal", "tracks", "", 0),
        service("mot", "detections", "tracks", 0),
        service("near", "", "detections", 0),
        service("far", "", "detections", 1),
    ]
}

fn chain_set() -> ServiceSet {
    ServiceSet::new(chain()).expect("valid")
}

fn of(texts: &[&str]) -> Composition {
    Composition::of_links(&chain_set(), "goal", &links(texts))
}

fn answer(task: &Task) -> Answer {
    compose(task).expect("a valid task")
}

fn none(task: &Task) -> NoComposition {
    answer(task).none.expect("no composition")
}

/// `spec/1-services.md#composition`
#[test]
fn a_composition_picks_exactly_one_provider_for_every_requirement() {
    let set = chain_set();
    assert!(is_choice(&set, &of(&["mot tracks goal", "near detections mot"])));
    let two = of(&["mot tracks goal", "near detections mot", "far detections mot"]);
    assert!(!is_choice(&set, &two));
    assert!(!is_choice(&set, &of(&["near tracks goal"])), "near does not guarantee tracks");
    assert!(!is_choice(&set, &of(&["near detections goal"])), "goal does not require detections");
    assert!(!is_choice(&set, &of(&["nobody tracks goal"])));
    assert!(!is_choice(&set, &of(&["near detections mot"])), "mot is no member");
}

/// COMP-01
#[test]
fn a_composition_is_closed() {
    let set = chain_set();
    let whole = of(&["mot tracks goal", "far detections mot"]);
    assert!(is_closed(&set, &whole));
    assert!(!is_closed(&set, &of(&["mot tracks goal"])), "nobody provides detections to mot");
    let mut without_provider = whole;
    without_provider.members.retain(|member| member != "far");
    assert!(!is_closed(&set, &without_provider));
}

/// COMP-02
#[test]
fn a_composition_is_minimal() {
    let mut composition = of(&["mot tracks goal", "far detections mot"]);
    assert!(is_minimal("goal", &composition));
    composition.members.push("near".to_owned());
    assert!(!is_minimal("goal", &composition));
    for composition in answer(&task(chain(), "goal")).compositions {
        assert_eq!(composition.members.len(), 3, "one detection is enough");
    }
}

/// COMP-03
#[test]
fn a_composition_is_acyclic_over_its_chosen_links() {
    assert!(is_acyclic(&of(&["mot tracks goal", "far detections mot"])));
    assert!(is_acyclic(&of(&[])));
    assert!(!is_acyclic(&of(&["mot tracks goal", "goal loop mot"])));
    assert!(!is_acyclic(&of(&["mot tracks goal", "mot loop mot"])));
    assert!(is_acyclic(&of(&["a x b", "a y c", "b x d", "c x d"])), "a diamond is no cycle");
}

/// COMP-04
#[test]
fn the_device_switches_of_a_composition_are_the_chosen_links_whose_stations_differ() {
    let set = chain_set();
    let far = of(&["mot tracks goal", "far detections mot"]);
    assert_eq!(far.switches, [("far".to_owned(), "mot".to_owned())]);
    assert!(names_its_switches(&set, &far));
    let hidden = Composition { switches: vec![], ..far };
    assert!(!names_its_switches(&set, &hidden));
}

/// COMP-05
#[test]
fn a_composition_is_called_distributed_exactly_when_it_has_a_device_switch() {
    let set = chain_set();
    let near = of(&["mot tracks goal", "near detections mot"]);
    assert!(!near.distributed && names_its_switches(&set, &near));
    assert!(of(&["mot tracks goal", "far detections mot"]).distributed);
    assert!(!names_its_switches(&set, &Composition { distributed: true, ..near }));
}

/// `spec/5-interfaces.md#composition`: two interfaces between the same two services.
#[test]
fn each_switch_is_named_once() {
    let list = vec![service("goal", "x y", "", 0), service("far", "", "x y", 1)];
    let compositions = answer(&task(list, "goal")).compositions;
    assert_eq!(compositions[0].links, [link("far x goal"), link("far y goal")]);
    assert_eq!(compositions[0].switches, [("far".to_owned(), "goal".to_owned())]);
}

/// COMP-06
#[test]
fn members_named_in_one_same_station_list_run_on_one_station() {
    let set = chain_set();
    let far = of(&["mot tracks goal", "far detections mot"]);
    let keeps = |lists: &[&str]| {
        let lists: Vec<_> = lists.iter().map(|list| names(list)).collect();
        keeps_same_station(&set, &lists, &far)
    };
    assert!(keeps(&[]) && keeps(&["mot goal"]));
    assert!(!keeps(&["mot far"]) && !keeps(&["mot goal", "goal far"]));
    assert!(keeps(&["mot goal", "far"]), "two lists may be on two stations");
    assert!(keeps(&["near far nobody"]), "near is no member");
}

/// COMP-07
#[test]
fn members_named_in_local_only_run_on_station_0() {
    let set = chain_set();
    let far = of(&["mot tracks goal", "far detections mot"]);
    assert!(keeps_local_only(&set, &names("goal mot near nobody"), &far));
    assert!(!keeps_local_only(&set, &names("goal far"), &far));
    let near = of(&["mot tracks goal", "near detections mot"]);
    assert!(keeps_local_only(&set, &names("far"), &near), "far is no member");
}

/// COMP-09; against brute force in `figure_2` and `random_sets`.
#[test]
fn the_orchestrator_enumerates_every_composition_once_and_no_other() {
    let answer = answer(&task(chain(), "goal"));
    assert_eq!(answer.none, None);
    let chosen: Vec<_> = answer.compositions.iter().map(|c| c.links.clone()).collect();
    let far = vec![link("far detections mot"), link("mot tracks goal")];
    let near = vec![link("mot tracks goal"), link("near detections mot")];
    assert_eq!(chosen, [far, near]);
}

/// A goal whose requirement i has `providers[i]` providers.
fn fan(providers: &[usize]) -> Vec<Service> {
    let interfaces: Vec<String> = (0..providers.len()).map(|i| format!("i{i}")).collect();
    let mut services = vec![service("goal", &interfaces.join(" "), "", 0)];
    for (interface, count) in interfaces.iter().zip(providers) {
        services
            .extend((0..*count).map(|n| service(&format!("{interface}p{n}"), "", interface, 0)));
    }
    services
}

/// COMP-10: 10,000 are answered, 10,001 = 73 * 137 are not, and 2^64 are
/// refused without being counted to the end.
#[test]
fn more_than_ten_thousand_closed_choices_are_an_error() {
    let full = answer(&task(fan(&[10, 10, 10, 10]), "goal"));
    assert_eq!(full.compositions.len(), 10_000);
    assert_eq!(compose(&task(fan(&[73, 137]), "goal")), Err(TaskError::TooManyChoices));
    assert_eq!(compose(&task(fan(&[2; 64]), "goal")), Err(TaskError::TooManyChoices));
}

/// COMP-10: placement rules that leave one composition do not help.
#[test]
fn closed_choices_are_counted_before_the_placement_rules_and_acyclicity() {
    let mut placed = task(fan(&[73, 137]), "goal");
    for provider in &mut placed.services[2..] {
        provider.station = 1;
    }
    placed.local_only = placed.services.iter().map(|service| service.id.clone()).collect();
    assert_eq!(compose(&placed), Err(TaskError::TooManyChoices));

    let mut cyclic = task(fan(&[73, 137]), "goal");
    cyclic.services[0].guarantees = names("self");
    for provider in &mut cyclic.services[1..] {
        provider.requires = names("self");
    }
    assert_eq!(compose(&cyclic), Err(TaskError::TooManyChoices));
}

/// COMP-10: a provider that nobody can complete is no closed choice,
/// although its other requirements could be met in 2^64 ways.
#[test]
fn choices_that_cannot_be_closed_are_not_counted() {
    let mut list = fan(&[2; 64]);
    list[0].id = "dead".to_owned();
    list[0].requires.insert(0, "nothing".to_owned());
    list[0].guarantees = names("x");
    list.push(service("alive", "", "x", 0));
    list.push(service("goal", "x", "", 0));
    let compositions = answer(&task(list, "goal")).compositions;
    assert_eq!(compositions.len(), 1);
    assert_eq!(compositions[0].members, ["alive", "goal"]);
}

/// COMP-11
#[test]
fn no_composition_names_a_requirement_that_nobody_guarantees_bytewise_first() {
    let missing = |requirement: &str, service: &str| NoComposition::Requirement {
        requirement: requirement.to_owned(),
        service: service.to_owned(),
    };
    let list = vec![
        service("goal", "z a", "", 0),
        service("b", "x B", "a", 0),
        service("a", "x", "a", 0),
        service("unreachable", "A", "w", 0),
    ];
    assert_eq!(none(&task(list.clone(), "goal")), missing("B", "b"));
    assert_eq!(none(&task(list[..1].to_vec(), "goal")), missing("a", "goal"));
    let only_x: Vec<_> =
        vec![service("goal", "a", "", 0), service("b", "x", "a", 0), service("a", "x", "a", 0)];
    assert_eq!(none(&task(only_x, "goal")), missing("x", "a"));
}

/// COMP-11: a reachable requirement that nobody guarantees is named
/// although what stands in the way of the only closed choice is a rule.
#[test]
fn a_requirement_is_named_before_a_rule() {
    let mut blocked = task(
        vec![service("goal", "a", "", 0), service("dead", "x", "a", 0), service("far", "", "a", 1)],
        "goal",
    );
    blocked.local_only = names("far");
    let requirement =
        NoComposition::Requirement { requirement: "x".to_owned(), service: "dead".to_owned() };
    assert_eq!(none(&blocked), requirement);
    blocked.services.remove(1);
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::LocalOnly));
}

/// COMP-11: two closed choices, one that breaks a rule alone and one
/// that breaks the other two; the rule that is enough alone is named, whatever its place in the
/// order.
#[test]
fn no_composition_names_the_first_rule_without_which_alone_there_would_be_one() {
    // `loop` makes a cycle with the goal, `far` is on station 1.
    let list = vec![
        service("goal", "a", "g", 0),
        service("loop", "g", "a", 0),
        service("far", "", "a", 1),
    ];
    let mut blocked = task(list, "goal");
    blocked.same_station = vec![names("goal far")];
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::SameStation), "first of two that do");
    blocked.local_only = names("far");
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::Acyclic), "far breaks two rules");
    blocked.same_station.clear();
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::LocalOnly), "before acyclic");
}

/// COMP-11
#[test]
fn no_composition_names_else_the_first_rule_that_some_closed_choice_breaks() {
    let list = vec![service("goal", "a", "g", 0), service("far", "g", "a", 1)];
    let mut blocked = task(list, "goal");
    blocked.local_only = names("far");
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::LocalOnly), "and acyclic");
    blocked.same_station = vec![names("far goal")];
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::SameStation), "all three");
    blocked.local_only.clear();
    assert_eq!(none(&blocked), NoComposition::Rule(Rule::SameStation), "and acyclic");
}

/// `spec/5-interfaces.md#composition`
#[test]
fn an_absent_goal_is_an_error() {
    let unknown = compose(&task(chain(), "nobody"));
    assert_eq!(unknown, Err(TaskError::UnknownGoal("nobody".to_owned())));
    assert!(unknown.expect_err("unknown").to_string().contains("`nobody`"));
}

/// A chain of 1,000 services is one choice and needs no stack.
#[test]
fn a_long_chain_is_one_composition() {
    let mut list = vec![service("s0", "i1", "", 0)];
    list.extend(
        (1..1000).map(|n| service(&format!("s{n}"), &format!("i{}", n + 1), &format!("i{n}"), 0)),
    );
    list.push(service("s1000", "", "i1000", 0));
    let compositions = answer(&task(list, "s0")).compositions;
    assert_eq!(compositions.len(), 1);
    assert_eq!(compositions[0].links.len(), 1000);
}
