//! Look-ups of configurations and compositions (`spec/1-services.md`).

use mufasa::composition::{Composition, Link, Switch, Task, check, switched_links};
use mufasa::configuration::{Configuration, Group, Groups, Source};
use mufasa::service::{Service, ServiceSet};

use super::any::{groups, index, near_integer, option};
#[cfg(not(kani))]
use crate::kani;

/// The four configurations and the four sets of remote groups are one to one, and a group has the
/// remote source exactly when its local services do not compute.
///
/// Domain: all sets, all stations. Not covered: nothing of these functions.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(4))]
pub fn verify_configurations_are_the_sets_of_groups() {
    let remote = groups();
    let configuration = Configuration::of(remote);
    assert!(configuration.remote_groups() == remote);
    assert!(configuration.is_remote(Group::Mot) == remote.mot);
    assert!(configuration.is_remote(Group::Plan) == remote.plan);
    assert!((configuration == Configuration::Local) == remote.is_empty());
    assert!(remote.with(Group::Mot).without(Group::Plan) == Groups::from(Group::Mot));
    let (computes, station): (bool, Option<i64>) = (kani::any(), option(|| near_integer(1, 3)));
    let source = Source::of(computes, station);
    assert!(source.station() == if computes { 0 } else { station.unwrap_or(0) });
    kani::cover!(configuration == Configuration::MotRemote, "MOT alone");
    kani::cover!(configuration == Configuration::PlanRemote, "PLAN alone");
    kani::cover!(matches!(source, Source::Remote { .. }), "a remote source");
    kani::cover!(source == Source::Local && station.is_some(), "local services that compute win");
}

const NAMES: [&str; 3] = ["a", "b", "c"];
const INTERFACES: [&str; 2] = ["x", "y"];
const LINK: Link<'static> = Link { provider: "b", interface: "x", consumer: "a" };
const SWITCH: Switch<'static> = Switch { provider: "b", consumer: "a" };

/// Two services that may require and guarantee an interface each, and whose links, members and
/// switches may be named rightly or not: what is accepted is closed, minimal, acyclic, keeps the
/// placement, and names exactly its switches.
///
/// Domain: a goal and one more service, one interface between them, stations 0 and 1, up to two
/// links and one switch. Not covered: longer chains and cycles.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(8))]
pub fn verify_accepted_compositions_keep_the_rules() {
    let (needs, feeds): (bool, bool) = (kani::any(), kani::any());
    let stations: [i64; 2] = [(); 2].map(|()| i64::from(kani::any::<bool>()));
    let services = services(needs, feeds, stations);
    let Ok(set) = ServiceSet::new(&services) else { unreachable!("the set keeps the rules") };
    let local_only = &NAMES[..index(2)];
    let together = [NAMES.as_slice()];
    let same_station = &together[..index(2)];
    let task = Task { services: set, goal: NAMES[0], same_station, local_only };
    let (members, links) = (up_to::<_, 2>("a", || NAMES[index(3)]), up_to::<_, 2>(LINK, link));
    let switches =
        up_to::<_, 1>(SWITCH, || Switch { provider: NAMES[index(2)], consumer: NAMES[index(2)] });
    let (members, links) = (shown(&members), shown(&links));
    let switches = shown(&switches);
    let composition = Composition { members, links, switches, distributed: kani::any() };
    let mut scratch = [0; 2];
    let accepted = check(&task, &composition, &mut scratch).is_ok();
    let [here, there] = stations;
    // All that there is: b feeds a or a feeds itself with nothing, so a is alone or has b.
    let wanted: &[Link<'_>] = if needs { &[LINK] } else { &[] };
    let right_members = if needs {
        members.len() == 2 && members.contains(&"a") && members.contains(&"b")
    } else {
        members == ["a"].as_slice()
    };
    let right_links = links == wanted && (!needs || feeds);
    let placed = (local_only.is_empty() || here == 0)
        && (same_station.is_empty() || !needs || here == there);
    let switched = needs && here != there;
    let right_switches =
        if switched { switches == [SWITCH].as_slice() } else { switches.is_empty() };
    let right = right_members
        && right_links
        && placed
        && right_switches
        && composition.distributed == switched;
    assert!(accepted == right);
    if accepted {
        assert!(switched_links(set, &composition).count() == usize::from(switched));
    }
    kani::cover!(accepted && needs && switched, "distributed");
    kani::cover!(accepted && needs && !switched, "on one station");
    kani::cover!(accepted && !needs, "the goal alone");
    kani::cover!(!accepted && right_members && right_links && !placed, "misplaced");
    kani::cover!(!accepted && right_members && !right_links, "links that do not fit");
}

/// Up to N items and their number; `filler` stands behind them.
fn up_to<T: Copy, const N: usize>(filler: T, item: impl Fn() -> T) -> ([T; N], usize) {
    let count = index(N + 1);
    (core::array::from_fn(|at| if at < count { item() } else { filler }), count)
}

fn shown<T, const N: usize>((items, count): &([T; N], usize)) -> &[T] {
    &items[..*count]
}

fn link() -> Link<'static> {
    Link { provider: NAMES[index(2)], interface: INTERFACES[index(2)], consumer: NAMES[index(2)] }
}

/// a, which may need x, and b, which may guarantee it.
fn services(needs: bool, feeds: bool, [here, there]: [i64; 2]) -> [Service<'static>; 2] {
    const X: &[&str] = &["x"];
    let requires = if needs { X } else { &[] };
    let guarantees = if feeds { X } else { &[] };
    [
        Service { id: "a", requires, guarantees: &[], station: here },
        Service { id: "b", requires: &[], guarantees, station: there },
    ]
}
