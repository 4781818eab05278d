//! The paper's Fig. 2: one CAV (station 0) and one MEC server (station 1).

use mufasa_model::services::orchestrator::{Task, closed_choices, compose};
use mufasa_model::services::service::ServiceSet;

use crate::{brute_force, names, service};

/// The services of `examples/fig2.json`. Detections and tracks go from each computer to each,
/// ego motion from the CAV to both, but each map provider feeds the environment of its own.
fn figure_2() -> Task {
    let mut services = vec![
        service("cav-ego-motion", "", "ego-motion", 0),
        service("control", "trajectories", "commands", 0),
        service("actuation", "commands", "", 0),
    ];
    for (computer, station) in [("cav", 0), ("mec", 1)] {
        for (name, requires, guarantees) in [
            ("detection", "", "detections"),
            ("tracking", "detections", "tracks"),
            ("map", "", &format!("map-of-{computer}")),
            ("env", &format!("tracks map-of-{computer} ego-motion"), "environment"),
            ("tpl", "environment", "trajectories"),
        ] {
            services.push(service(&format!("{computer}-{name}"), requires, guarantees, station));
        }
    }
    Task {
        services,
        goal: "actuation".to_owned(),
        same_station: vec![names("cav-env cav-tpl mec-env mec-tpl")],
        local_only: names("control actuation"),
    }
}

/// Station of ENV and TPL, of tracking and of detection: two each. Without the rule of shared
/// memory those of ENV and of TPL are two choices.
#[test]
fn figure_2_has_eight_compositions_and_sixteen_closed_choices() {
    let task = figure_2();
    let answer = compose(&task).expect("a valid task");
    assert_eq!(answer.compositions.len(), 8);
    assert_eq!(answer.compositions.iter().filter(|c| !c.distributed).count(), 1);
    let services = ServiceSet::new(task.services.clone()).expect("valid");
    assert_eq!(closed_choices(&services, &task.goal).expect("few").len(), 16);
}

/// The arrows of the figure from bottom to top, with ENV and TPL of the other computer, which the
/// figure leaves out because they share memory.
#[test]
fn figure_2_has_the_arrows_of_the_figure() {
    let task = figure_2();
    let mut arrows: Vec<(&str, &str)> = brute_force::arcs(&task)
        .into_iter()
        .map(|(j, _, k)| (task.services[j].id.as_str(), task.services[k].id.as_str()))
        .collect();
    arrows.sort_unstable();
    let mut figure = [
        ("control", "actuation"),
        ("cav-tpl", "control"),
        ("mec-tpl", "control"),
        ("cav-env", "cav-tpl"),
        ("mec-env", "mec-tpl"),
        ("cav-env", "mec-tpl"),
        ("mec-env", "cav-tpl"),
        ("cav-ego-motion", "cav-env"),
        ("cav-ego-motion", "mec-env"),
        ("cav-map", "cav-env"),
        ("mec-map", "mec-env"),
        ("cav-tracking", "cav-env"),
        ("mec-tracking", "cav-env"),
        ("mec-tracking", "mec-env"),
        ("cav-tracking", "mec-env"),
        ("cav-detection", "cav-tracking"),
        ("mec-detection", "cav-tracking"),
        ("mec-detection", "mec-tracking"),
        ("cav-detection", "mec-tracking"),
    ];
    figure.sort_unstable();
    assert_eq!(arrows, figure);
}

/// COMP-08, COMP-09: all 2^19 subsets of its links.
#[test]
fn figure_2_agrees_with_brute_force() {
    let task = figure_2();
    assert_eq!(brute_force::arcs(&task).len(), 19);
    let found = brute_force::all_by_links(&task);
    assert_eq!(brute_force::closed_choices(&found), 16);
    assert_eq!(compose(&task).expect("a valid task"), brute_force::answer(&task, &found));
}
