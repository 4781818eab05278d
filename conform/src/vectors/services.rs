//! Vectors of `spec/1-services.md`.

use mufasa_model::services::orchestrator::Task;
use mufasa_model::services::service::Service;

use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::{compositions, refused};
use mufasa_records::{self as json, Record};

const FIGURE_2: &str = include_str!("../../data/fig2.json");

const fn composition(requirement: &'static str) -> Topic {
    Topic::new("services/composition", requirement)
}

const CLOSED: Topic = composition("spec/1-services.md#composition.1");
const MINIMAL: Topic = composition("spec/1-services.md#composition.2");
const ACYCLIC: Topic = composition("spec/1-services.md#composition.3");
const SWITCHES: Topic = composition("spec/1-services.md#composition.4");
const SAME_STATION: Topic = composition("spec/1-services.md#composition.5");
const LOCAL_ONLY: Topic = composition("spec/1-services.md#composition.6");
const ALL: Topic = composition("spec/1-services.md#composition.7");
const NONE: Topic = composition("spec/1-services.md#composition.8");
const NAMES: Topic = Topic::new("services/service", "spec/1-services.md#service.1");
const SET: Topic = Topic::new("services/service", "spec/1-services.md#service.2");
const REFUSED: Topic = Topic::new("services/service", "spec/1-services.md#service.4");

/// A service from words.
fn service(id: &str, requires: &str, guarantees: &str, station: i64) -> Service {
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect();
    Service { id: id.to_owned(), requires: words(requires), guarantees: words(guarantees), station }
}

fn task(services: Vec<Service>) -> Task {
    let goal = String::from("goal");
    Task { services, goal, same_station: vec![], local_only: vec![] }
}

/// A goal, a tracker on `station`, and detections.
pub fn chain(station: i64) -> Task {
    task(vec![
        service("goal", "tracks", "", 0),
        service("mot", "detections", "tracks", station),
        service("near", "", "detections", 0),
    ])
}

/// Adds them.
pub fn add(book: &mut Book) {
    rules(book);
    figure_2(book);
    none(book);
    sets(book);
}

fn rules(book: &mut Book) {
    let note = "Every requirement of every member is provided: the members are all three.";
    let expected = compositions(1).that("/compositions/0/members", vec!["goal", "mot", "near"]);
    book.composition(CLOSED, "closed", note, &chain(0), &expected);
    let note = "What nobody provides leaves no composition.";
    let mut open = chain(0);
    open.services.pop();
    book.composition(CLOSED, "not-closed", note, &open, &compositions(0));
    let note = "A second tracker provides nothing that is chosen: it is in another composition.";
    let mut two = chain(0);
    two.services.push(service("other", "", "tracks", 0));
    let expected = compositions(2).that("/compositions/1/members", vec!["goal", "other"]);
    book.composition(MINIMAL, "minimal", note, &two, &expected);
    let note = "A member beside the one choice would provide nothing.";
    let mut idle = chain(0);
    idle.services.push(service("idle", "", "map", 0));
    let expected = compositions(1).that("/compositions/0/members", vec!["goal", "mot", "near"]);
    book.composition(MINIMAL, "idle", note, &idle, &expected);
    let note = "A service that provides for itself makes a cycle; the other choice is none.";
    let looped = task(vec![service("goal", "x", "x", 0), service("other", "", "x", 0)]);
    book.composition(ACYCLIC, "self", note, &looped, &compositions(1));
    let note = "A diamond is no cycle: one provider for two members.";
    let diamond = task(vec![
        service("goal", "x y", "", 0),
        service("left", "z", "x", 0),
        service("right", "z", "y", 0),
        service("top", "", "z", 0),
    ]);
    book.composition(ACYCLIC, "diamond", note, &diamond, &compositions(1));
    let note = "No switch, not distributed.";
    let expected = compositions(1).that("/compositions/0/distributed", false);
    book.composition(SWITCHES, "local", note, &chain(0), &expected);
    let note = "Two switches: to the tracker's station and back; each is named once.";
    let expected = compositions(1)
        .that("/compositions/0/distributed", true)
        .that("/compositions/0/switches", vec![vec!["mot", "goal"], vec!["near", "mot"]]);
    book.composition(SWITCHES, "distributed", note, &chain(1), &expected);
    for (name, station, count) in [("together", 0, 1), ("apart", 1, 0)] {
        let note = "mot and near are named in one same_station list.";
        let mut task = chain(station);
        task.same_station = vec![vec![String::from("mot"), String::from("near")]];
        book.composition(SAME_STATION, name, note, &task, &compositions(count));
        let note = "mot is named in local_only.";
        let mut task = chain(station);
        task.local_only = vec![String::from("mot")];
        let name = format!("local-only-{name}");
        book.composition(LOCAL_ONLY, &name, note, &task, &compositions(count));
    }
    for (name, providers, expected) in
        [("10000", 10, compositions(10_000)), ("more", 11, refused("services", None))]
    {
        if name == "10000" {
            // Ten thousand compositions would be megabytes; a hundred show the same.
            let task = fan(&[10, 10]);
            book.composition(ALL, "100", "Every choice, once each.", &task, &compositions(100));
            continue;
        }
        let note = "More than 10,000 closed choices: 11^4.";
        book.composition(ALL, name, note, &fan(&[providers; 4]), &expected);
    }
    let note = "A goal without requirements is a composition of its own.";
    let task = task(vec![service("goal", "", "", 0), service("other", "", "x", 0)]);
    let expected = compositions(1).that("/compositions/0/members", vec!["goal"]);
    book.composition(ALL, "alone", note, &task, &expected);
}

/// A goal whose requirement i has so many providers.
fn fan(providers: &[usize]) -> Task {
    let interfaces: Vec<String> = (0..providers.len()).map(|i| format!("i{i}")).collect();
    let mut services = vec![service("goal", &interfaces.join(" "), "", 0)];
    for (interface, count) in interfaces.iter().zip(providers) {
        let provider = |n| service(&format!("{interface}p{n}"), "", interface, 0);
        services.extend((0..*count).map(provider));
    }
    task(services)
}

fn figure_2(book: &mut Book) {
    let Ok(Record::Composition { task, .. }) = json::parse(FIGURE_2.as_bytes(), 1) else { return };
    let note = "The paper's Fig. 2: detection, tracking and ENV with TPL on either computer.";
    book.composition(ALL, "figure-2", note, &task, &compositions(8));
    let note = "Fig. 2 without the rule of shared memory.";
    let apart = Task { same_station: vec![], ..task.clone() };
    book.composition(SAME_STATION, "figure-2-apart", note, &apart, &compositions(16));
    let note = "Fig. 2 with nothing remote.";
    let services = task.services.iter().filter(|it| it.station == 0).cloned().collect();
    let local = Task { services, ..task };
    let expected = compositions(1).that("/compositions/0/distributed", false);
    book.composition(ALL, "figure-2-local", note, &local, &expected);
}

fn none(book: &mut Book) {
    let none = || compositions(0);
    let note = "Nobody guarantees the detections that mot requires.";
    let mut task = chain(0);
    task.services.pop();
    let expected = none().that("/none/requirement", "detections").that("/none/service", "mot");
    book.composition(NONE, "requirement", note, &task, &expected);
    let note = "Without acyclic there would be one.";
    let task = self::task(vec![service("goal", "x", "x", 0)]);
    book.composition(NONE, "acyclic", note, &task, &none().that("/none/rule", "acyclic"));
    for (name, same, local, rule) in [
        ("same-station", true, false, "same_station"),
        ("local-only", false, true, "local_only"),
        ("both", true, true, "same_station"),
    ] {
        let note = "The first rule without which alone there would be one; when both stand in the \
                    way, the first that some choice breaks.";
        let mut task = chain(1);
        if same {
            task.same_station = vec![vec![String::from("mot"), String::from("near")]];
        }
        if local {
            task.local_only = vec![String::from("mot")];
        }
        book.composition(NONE, name, note, &task, &none().that("/none/rule", rule));
    }
}

fn sets(book: &mut Book) {
    let second = |change: fn(&mut Service)| {
        let mut task = chain(0);
        change(&mut task.services[1]);
        task
    };
    let note = "A name listed twice.";
    let task = second(|service| service.requires.push(String::from("detections")));
    let expected = refused("services.requires", Some(1));
    book.composition(NAMES, "requires-twice", note, &task, &expected);
    let task = second(|service| service.guarantees.push(String::from("tracks")));
    let expected = refused("services.guarantees", Some(1));
    book.composition(NAMES, "guarantees-twice", note, &task, &expected);
    let note = "An empty list is a list.";
    book.composition(NAMES, "empty-lists", note, &chain(0), &compositions(1));
    let note = "Two services with the same id.";
    let task = second(|service| service.id = String::from("goal"));
    book.composition(SET, "id-twice", note, &task, &refused("services.id", Some(1)));
    let note = "No service at all.";
    let task = Task { services: vec![], ..chain(0) };
    book.composition(SET, "empty", note, &task, &refused("services", None));
    let note = "A goal that names no service.";
    let task = Task { goal: String::from("MOT"), ..chain(0) };
    book.composition(REFUSED, "goal", note, &task, &refused("goal", None));
    let note = "A station below 0.";
    let task = second(|service| service.station = -1);
    book.composition(REFUSED, "station", note, &task, &refused("services.station", Some(1)));
}
