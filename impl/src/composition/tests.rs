//! One test for each sentence of `spec/1-services.md#composition` about a given composition.

use super::*;

const fn service<'a>(
    id: &'a str,
    requires: &'a [&'a str],
    guarantees: &'a [&'a str],
    station: i64,
) -> Service<'a> {
    Service { id, requires, guarantees, station }
}

const fn link<'a>(provider: &'a str, interface: &'a str, consumer: &'a str) -> Link<'a> {
    Link { provider, interface, consumer }
}

/// Table I, with a second MOT, ENV and TPL on station 1.
const SERVICES: [Service<'static>; 9] = [
    service("detector", &[], &["detections"], 0),
    service("maps", &[], &["map", "ego motion", "metadata"], 0),
    service("mot", &["detections"], &["tracks"], 0),
    service("env", &["tracks", "map", "ego motion"], &["environment"], 0),
    service("tpl", &["environment", "metadata"], &["trajectory"], 0),
    service("mec-mot", &["detections"], &["tracks"], 1),
    service("mec-env", &["tracks", "map", "ego motion"], &["environment"], 1),
    service("mec-tpl", &["environment", "metadata"], &["trajectory"], 1),
    service("control", &["trajectory"], &[], 0),
];
const SAME_STATION: &[&[&str]] = &[&["env", "tpl", "mec-env", "mec-tpl"]];
const LOCAL_ONLY: &[&str] = &["control", "actuation"];

const MEMBERS: [&str; 6] = ["control", "tpl", "env", "mec-mot", "maps", "detector"];
const LINKS: [Link<'static>; 7] = [
    link("tpl", "trajectory", "control"),
    link("env", "environment", "tpl"),
    link("maps", "metadata", "tpl"),
    link("mec-mot", "tracks", "env"),
    link("maps", "map", "env"),
    link("maps", "ego motion", "env"),
    link("detector", "detections", "mec-mot"),
];
const SWITCHES: [Switch<'static>; 2] = [
    Switch { provider: "detector", consumer: "mec-mot" },
    Switch { provider: "mec-mot", consumer: "env" },
];
/// MOT on station 1, ENV and TPL on station 0.
const MOT_REMOTE: Composition<'static> =
    Composition { members: &MEMBERS, links: &LINKS, switches: &SWITCHES, distributed: true };

type Answer = Result<(), CompositionError<'static>>;

/// The answer for the goal `control`.
fn answer(composition: &Composition<'static>) -> Answer {
    answer_for(&SERVICES, "control", composition)
}

fn answer_for(
    services: &'static [Service<'static>],
    goal: &'static str,
    composition: &Composition<'static>,
) -> Answer {
    let set = ServiceSet::new(services);
    assert!(set.is_ok(), "{set:?}");
    let Ok(services) = set else { return Ok(()) };
    let task = Task { services, goal, same_station: SAME_STATION, local_only: LOCAL_ONLY };
    // Whatever the scratch holds makes no difference.
    check(&task, composition, &mut [7; 16])
}

/// A composition of services on one station.
fn local(
    members: &'static [&'static str],
    links: &'static [Link<'static>],
) -> Composition<'static> {
    Composition { members, links, switches: &[], distributed: false }
}

/// `spec/1-services.md#composition`: a composition that keeps all rules is accepted, whatever the
/// order of its lists.
#[test]
fn a_composition_that_keeps_the_rules_is_accepted() {
    assert_eq!(answer(&MOT_REMOTE), Ok(()));
    let reversed = Composition {
        members: &["detector", "env", "mec-mot", "maps", "tpl", "control"],
        links: &const {
            let [a, b, c, d, e, f, g] = LINKS;
            [g, c, e, a, d, b, f]
        },
        switches: &const {
            let [a, b] = SWITCHES;
            [b, a]
        },
        distributed: true,
    };
    assert_eq!(answer(&reversed), Ok(()));
    let services = &const { [service("goal", &[], &["x"], 3)] };
    assert_eq!(answer_for(services, "goal", &local(&["goal"], &[])), Ok(()));
}

/// "A composition for a goal service picks, for every requirement of every service in it, exactly
/// one service that guarantees it: the link (provider, interface, consumer)."
#[test]
fn exactly_one_service_that_guarantees_it_is_picked_for_every_requirement() {
    let twice = Composition {
        members: &["control", "tpl", "env", "mec-mot", "maps", "detector", "mot"],
        links: &const {
            let [a, b, c, d, e, f, g] = LINKS;
            [
                a,
                b,
                c,
                d,
                e,
                f,
                g,
                link("mot", "tracks", "env"),
                link("detector", "detections", "mot"),
            ]
        },
        ..MOT_REMOTE
    };
    let expected = CompositionError::ProvidedTwice { service: "env", requirement: "tracks" };
    assert_eq!(answer(&twice), Err(expected));

    let wrong = link("detector", "trajectory", "control");
    let composition =
        local(&["control", "detector"], &const { [link("detector", "trajectory", "control")] });
    assert_eq!(answer(&composition), Err(CompositionError::NotGuaranteed { link: wrong }));

    let wrong = link("detector", "detections", "control");
    let composition =
        local(&["control", "detector"], &const { [link("detector", "detections", "control")] });
    assert_eq!(answer(&composition), Err(CompositionError::NotRequired { link: wrong }));
}

/// The services of a composition are those of the set, each once, and the goal is one of them.
#[test]
fn members_are_services_of_the_set_and_the_goal_is_one() {
    let unknown = Composition { members: &["control", "ghost"], ..MOT_REMOTE };
    assert_eq!(answer(&unknown), Err(CompositionError::UnknownMember { member: "ghost" }));
    let repeated = Composition { members: &["control", "maps", "control"], ..MOT_REMOTE };
    assert_eq!(answer(&repeated), Err(CompositionError::RepeatedMember { member: "control" }));
    let without_goal = answer_for(&SERVICES, "mot", &MOT_REMOTE);
    assert_eq!(without_goal, Err(CompositionError::GoalIsNoMember { goal: "mot" }));
    let absent = answer_for(&SERVICES, "actuation", &MOT_REMOTE);
    assert_eq!(absent, Err(CompositionError::UnknownGoal { goal: "actuation" }));
}

/// `spec/1-services.md#composition.1`: "A composition MUST be closed: every requirement of every
/// member is provided by a member."
#[test]
fn a_composition_is_closed() {
    let open = Composition {
        links: &const {
            let [a, b, c, d, _, f, g] = LINKS;
            [a, b, c, d, f, g]
        },
        ..MOT_REMOTE
    };
    let expected = CompositionError::NotClosed { service: "env", requirement: "map" };
    assert_eq!(answer(&open), Err(expected));
    let outside =
        Composition { members: &["control", "tpl", "env", "mec-mot", "maps"], ..MOT_REMOTE };
    let last = link("detector", "detections", "mec-mot");
    assert_eq!(answer(&outside), Err(CompositionError::LinkOfNoMember { link: last }));
}

/// `spec/1-services.md#composition.2`: "A composition MUST be minimal: every member other than the
/// goal provides some chosen link."
#[test]
fn a_composition_is_minimal() {
    let idle = Composition {
        members: &["control", "tpl", "env", "mec-mot", "maps", "detector", "mot"],
        links: &const {
            let [a, b, c, d, e, f, g] = LINKS;
            [a, b, c, d, e, f, g, link("detector", "detections", "mot")]
        },
        ..MOT_REMOTE
    };
    assert_eq!(answer(&idle), Err(CompositionError::NotMinimal { member: "mot" }));
}

/// `spec/1-services.md#composition.3`: "A composition MUST be acyclic over its chosen links."
#[test]
fn a_composition_is_acyclic_over_its_chosen_links() {
    let services = &const {
        [
            service("goal", &["a"], &[], 0),
            service("one", &["b"], &["a"], 0),
            service("two", &["a"], &["b"], 0),
            service("three", &[], &["a"], 0),
            service("self", &["a"], &["a"], 0),
        ]
    };
    let round = local(
        &["goal", "one", "two"],
        &const { [link("one", "a", "goal"), link("two", "b", "one"), link("one", "a", "two")] },
    );
    let cyclic = |member| Err(CompositionError::Cyclic { member });
    assert_eq!(answer_for(services, "goal", &round), cyclic("goal"), "it depends on the cycle");
    let own =
        local(&["self", "goal"], &const { [link("self", "a", "self"), link("self", "a", "goal")] });
    assert_eq!(answer_for(services, "goal", &own), cyclic("self"));
    // The same services feed each other in a cycle, but the chosen links do not.
    let straight = local(
        &["goal", "one", "two", "three"],
        &const { [link("one", "a", "goal"), link("two", "b", "one"), link("three", "a", "two")] },
    );
    assert_eq!(answer_for(services, "goal", &straight), Ok(()));
}

/// `spec/1-services.md#composition.4`: "The device switches of a composition MUST be the chosen
/// links whose two stations differ; it MUST be called distributed exactly when there is at least
/// one."
#[test]
fn switches_are_the_chosen_links_whose_stations_differ() {
    let [first, second] = SWITCHES;
    let missing = Composition {
        switches: &const {
            let [a, _] = SWITCHES;
            [a]
        },
        ..MOT_REMOTE
    };
    let expected = CompositionError::MissingSwitch { link: link("mec-mot", "tracks", "env") };
    assert_eq!(answer(&missing), Err(expected));
    let repeated = Composition {
        switches: &const {
            let [a, b] = SWITCHES;
            [a, b, a]
        },
        ..MOT_REMOTE
    };
    assert_eq!(answer(&repeated), Err(CompositionError::RepeatedSwitch { switch: first }));
    // The services feed each other across stations, but no link between them is chosen.
    let unlinked = Switch { provider: "mec-mot", consumer: "mec-env" };
    let extra = Composition {
        switches: &const {
            let [a, b] = SWITCHES;
            [a, b, Switch { provider: "mec-mot", consumer: "mec-env" }]
        },
        ..MOT_REMOTE
    };
    assert_eq!(answer(&extra), Err(CompositionError::NoSwitch { switch: unlinked }));
    let denied = Composition { distributed: false, ..MOT_REMOTE };
    assert_eq!(answer(&denied), Err(CompositionError::Distributed { named: false }));

    let set = ServiceSet::new(&SERVICES);
    let links = set.iter().flat_map(|services| switched_links(*services, &MOT_REMOTE));
    let pairs = links.map(|link| Switch { provider: link.provider, consumer: link.consumer });
    assert!(pairs.eq([second, first]), "in the order of the links");
}

/// `spec/1-services.md#composition.4`: a composition on one station is not distributed.
#[test]
fn without_a_switch_a_composition_is_not_distributed() {
    let services = &const { [service("goal", &["a"], &[], 0), service("one", &[], &["a"], 0)] };
    let here = local(&["goal", "one"], &const { [link("one", "a", "goal")] });
    assert_eq!(answer_for(services, "goal", &here), Ok(()));
    let claimed = Composition { distributed: true, ..here };
    let expected = Err(CompositionError::Distributed { named: true });
    assert_eq!(answer_for(services, "goal", &claimed), expected);
}

/// `spec/5-interfaces.md#composition`: each switch once, although two interfaces cross together.
#[test]
fn two_links_between_the_same_members_are_one_switch() {
    let services =
        &const { [service("goal", &["a", "b"], &[], 0), service("far", &[], &["a", "b"], 2)] };
    let composition = Composition {
        members: &["goal", "far"],
        links: &const { [link("far", "a", "goal"), link("far", "b", "goal")] },
        switches: &const { [Switch { provider: "far", consumer: "goal" }] },
        distributed: true,
    };
    assert_eq!(answer_for(services, "goal", &composition), Ok(()));
}

/// `spec/1-services.md#composition.5`: "All members named in one `same_station` list (ENV and TPL,
/// which share memory) MUST run on one station."
#[test]
fn members_of_one_same_station_list_run_on_one_station() {
    let split = Composition {
        members: &["control", "mec-tpl", "env", "mot", "maps", "detector"],
        links: &const {
            [
                link("mec-tpl", "trajectory", "control"),
                link("env", "environment", "mec-tpl"),
                link("maps", "metadata", "mec-tpl"),
                link("mot", "tracks", "env"),
                link("maps", "map", "env"),
                link("maps", "ego motion", "env"),
                link("detector", "detections", "mot"),
            ]
        },
        ..MOT_REMOTE
    };
    let expected = CompositionError::SameStation { member: "mec-tpl", other: "env" };
    assert_eq!(answer(&split), Err(expected));
}

/// `spec/1-services.md#composition.6`: "Members named in `local_only` (control, actuation) MUST run
/// on station 0."
#[test]
fn members_of_local_only_run_on_station_0() {
    let services = &const { [service("control", &[], &[], 1)] };
    let expected = CompositionError::LocalOnly { member: "control" };
    assert_eq!(answer_for(services, "control", &local(&["control"], &[])), Err(expected));
}

/// `spec/4-arithmetic.md#conformance-of-an-implementation.6`: input that does not fit the scratch
/// is an error, not a truncated check.
#[test]
fn too_little_scratch_is_an_error() {
    let set = ServiceSet::new(&SERVICES);
    assert!(set.is_ok());
    if let Ok(services) = set {
        let task = Task { services, goal: "control", same_station: &[], local_only: &[] };
        let refused = check(&task, &MOT_REMOTE, &mut [0; 5]);
        assert_eq!(refused, Err(CompositionError::ScratchTooSmall { needed: 6 }));
        assert_eq!(check(&task, &MOT_REMOTE, &mut [0; 6]), Ok(()));
    }
}
