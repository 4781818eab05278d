//! The list of actions (`spec/2-offloading.md#fallback`).

use mufasa::offloading::requester::{Action, Group};
use mufasa::parts::actions_of;

use super::any::option;
#[cfg(not(kani))]
use crate::kani;

/// The list holds exactly the actions there are: drops, releases, activations and deactivations,
/// requests, MOT before PLAN within each.
///
/// Domain: an action or none of each of the four kinds for each group, of one station and session. Not
/// covered: which actions an event leads to, for which see `group`.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(9))]
pub fn verify_actions_come_in_their_order() {
    let (station, session) = (1, 2);
    let of = |group: Group| {
        let services =
            if kani::any() { Action::Activate(group) } else { Action::Deactivate(group) };
        [
            option(|| Action::Drop(group)),
            option(|| Action::Release { station, group, session }),
            option(|| services),
            option(|| Action::Request { station, group, session }),
        ]
    };
    let (mot, plan) = (of(Group::Mot), of(Group::Plan));
    let by_kind = [[mot[0], plan[0]], [mot[1], plan[1]], [mot[2], plan[2]], [mot[3], plan[3]]];
    let actions = actions_of(by_kind);
    let mut taken = 0;
    let mut place = 0;
    while place < 8 {
        if let Some(action) = by_kind[place / 2][place % 2] {
            assert!(taken < actions.len() && actions[taken] == action);
            taken += 1;
        }
        place += 1;
    }
    assert!(actions.len() == taken);
    kani::cover!(taken == 8, "all");
    kani::cover!(taken == 0, "none");
}
