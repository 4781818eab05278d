//! The paper's Fig. 2: one CAV (station 0) and one MEC server (station 1).

use mufasa_model::composition::{
    holds_goal, is_acyclic, is_choice, is_closed, is_composition, is_minimal, keeps_local_only,
    keeps_same_station, names_its_switches,
};
use mufasa_model::orchestrator::{Task, closed_choices, compose};
use mufasa_model::service::ServiceSet;

use crate::{brute_force, names, service};

fn figure_2() -> Task {
    let mut services = vec![
        service("cav ego", "", "ego", 0),
        service("control", "trajectory", "commands", 0),
        service("actuation", "commands", "", 0),
    ];
    for (computer, station) in [("cav", 0), ("mec", 1)] {
        for (name, requires, guarantees) in [
            ("detection", "", "detections"),
            ("tracking", "detections", "tracks"),
            ("map", "", "map"),
            ("env", "tracks map ego", "environment"),
            ("tpl", "environment", "trajectory"),
        ] {
            services.push(service(&format!("{computer} {name}"), requires, guarantees, station));
        }
    }
    let shared_memory = ["cav env", "mec env", "cav tpl", "mec tpl"];
    Task {
        services,
        goal: "actuation".to_owned(),
        same_station: vec![shared_memory.map(str::to_owned).to_vec()],
        local_only: names("control actuation"),
    }
}

/// Station of ENV and TPL, of tracking, of detection and of the map provider: two each.
#[test]
fn figure_2_has_sixteen_compositions_and_thirty_two_closed_choices() {
    let task = figure_2();
    let answer = compose(&task).expect("a valid task");
    assert_eq!(answer.compositions.len(), 16);
    assert_eq!(answer.compositions.iter().filter(|c| !c.distributed).count(), 1);
    let services = ServiceSet::new(task.services.clone()).expect("valid");
    assert_eq!(closed_choices(&services, &task.goal).expect("few").len(), 32);
}

/// All 2^21 subsets of its links.
#[test]
fn figure_2_agrees_with_brute_force() {
    let task = figure_2();
    assert_eq!(brute_force::arcs(&task).len(), 21);
    let found = brute_force::all_by_links(&task);
    assert_eq!(brute_force::closed_choices(&found), 32);
    assert_eq!(compose(&task).expect("a valid task"), brute_force::answer(&task, &found));
}

#[test]
fn every_composition_of_figure_2_satisfies_every_rule() {
    let task = figure_2();
    let services = ServiceSet::new(task.services.clone()).expect("valid");
    for composition in compose(&task).expect("a valid task").compositions {
        assert!(holds_goal(&task.goal, &composition));
        assert!(is_choice(&services, &composition));
        assert!(is_closed(&services, &composition));
        assert!(is_minimal(&task.goal, &composition));
        assert!(is_acyclic(&composition));
        assert!(names_its_switches(&services, &composition));
        assert!(keeps_same_station(&services, &task.same_station, &composition));
        assert!(keeps_local_only(&services, &task.local_only, &composition));
        assert!(is_composition(&services, &task, &composition));
        assert!(composition.members.contains(&"cav ego".to_owned()), "only the CAV has it");
    }
}
