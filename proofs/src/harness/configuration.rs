//! Look-ups of configurations (`spec/1-services.md`).

use mufasa::services::configuration::{Configuration, Group, Groups, Source};

use super::any::{groups, near_integer, option};
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
