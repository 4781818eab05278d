//! `spec/1-services.md#configuration`; how sources change over time is in the tests of offloading.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Sessions,
};
use mufasa_model::services::configuration::{Configuration, Offloadable, Source};
use mufasa_model::services::orchestrator::compose;
use mufasa_model::services::service::Service;

use crate::{names, service, task};

/// Table I with MOT on one station, ENV and TPL on another, and what they need from station 0.
fn table_one(mot: i64, plan: i64) -> Vec<Service> {
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let mut services: Vec<Service> = Offloadable::ALL
        .into_iter()
        .map(|offloadable| Service {
            id: format!("{offloadable:?}"),
            requires: owned(offloadable.requires()),
            guarantees: owned(offloadable.guarantees()),
            station: match offloadable.group() {
                Group::Mot => mot,
                Group::Plan => plan,
            },
        })
        .collect();
    for name in ["detections", "map", "ego motion", "vehicle metadata"] {
        services.push(Service {
            id: name.to_owned(),
            requires: vec![],
            guarantees: vec![name.to_owned()],
            station: 0,
        });
    }
    services.push(service("control", "trajectory", "", 0));
    services
}

/// `spec/1-services.md#configuration`: the table, each row once, and nothing else.
#[test]
fn the_four_configurations_are_the_subsets_of_the_groups() {
    let rows = [
        (Configuration::Local, false, false),
        (Configuration::MotRemote, true, false),
        (Configuration::AllRemote, true, true),
        (Configuration::PlanRemote, false, true),
    ];
    for (configuration, mot, plan) in rows {
        assert_eq!(configuration.remote(), Groups { mot, plan });
        assert_eq!(Configuration::of_remote(Groups { mot, plan }), configuration);
    }
}

/// `spec/1-services.md#configuration`: Table I composes to exactly one chain in each row, with
/// ENV and TPL on one station, also when MOT and PLAN are on different remote stations.
#[test]
fn table_one_composes_in_every_configuration() {
    for (mot, plan, switches) in [
        (0, 0, vec![]),
        (1, 0, vec![("Mot", "Env"), ("detections", "Mot")]),
        (
            1,
            1,
            vec![
                ("Tpl", "control"),
                ("detections", "Mot"),
                ("ego motion", "Env"),
                ("map", "Env"),
                ("vehicle metadata", "Tpl"),
            ],
        ),
        (
            0,
            1,
            vec![
                ("Mot", "Env"),
                ("Tpl", "control"),
                ("ego motion", "Env"),
                ("map", "Env"),
                ("vehicle metadata", "Tpl"),
            ],
        ),
        (
            2,
            1,
            vec![
                ("Mot", "Env"),
                ("Tpl", "control"),
                ("detections", "Mot"),
                ("ego motion", "Env"),
                ("map", "Env"),
                ("vehicle metadata", "Tpl"),
            ],
        ),
    ] {
        let mut task = task(table_one(mot, plan), "control");
        task.same_station = vec![names("Env Tpl")];
        task.local_only = names("control");
        let answer = compose(&task).expect("a valid task");
        assert_eq!(answer.compositions.len(), 1);
        let switches: Vec<(String, String)> =
            switches.into_iter().map(|(from, to)| (from.to_owned(), to.to_owned())).collect();
        assert_eq!(answer.compositions[0].switches, switches);
        assert_eq!(answer.compositions[0].distributed, (mot, plan) != (0, 0));
    }
}

/// A requester whose MOT was requested from station 1 at 0 ns.
fn requested(profile: Profile) -> Requester {
    let mut requester = Requester::new(profile, Parameters::default());
    let groups = Groups { mot: true, plan: false };
    requester.step(&Event { t_ns: 0, kind: EventKind::Offer { station: 1, groups } });
    requester.step(&Event { t_ns: 0, kind: EventKind::Tick });
    requester
}

const CONFIRM: EventKind = EventKind::Confirm { station: 1, group: Group::Mot, session: 1 };
const DATA: EventKind =
    EventKind::Data { station: 1, group: Group::Mot, session: 1, generated_ns: 2 };
const SAFE: EventKind =
    EventKind::Verdict { safe: true, sessions: Sessions { mot: Some(1), plan: None } };

/// CONF-01
#[test]
fn the_source_is_the_local_services_while_they_compute_else_the_remote_station() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let mut requester = requested(profile);
        assert_eq!(requester.source(Group::Mot), Source::Local);
        let mut local_computes = true;
        for (t_ns, kind) in [(1, CONFIRM), (2, DATA), (3, SAFE)] {
            let actions = requester.step(&Event { t_ns, kind });
            local_computes = local_computes && !actions.contains(&Action::Deactivate(Group::Mot));
            let remote = Source::Remote { station: 1 };
            let expected = if local_computes { Source::Local } else { remote };
            assert_eq!(requester.source(Group::Mot), expected);
            assert_eq!(requester.source(Group::Plan), Source::Local);
            assert_eq!(requester.state(Group::Mot), GroupState::Remote { station: 1, session: 1 });
            assert_eq!(requester.configuration(), Configuration::MotRemote);
        }
        assert!(!local_computes);
    }
}
