//! The list of actions (`spec/2-offloading.md#fallback`).

use mufasa::offloading::requester::{Action, Group};
use mufasa::parts::action_at;

use super::any::{below, option};
#[cfg(not(kani))]
use crate::kani;

/// The list holds exactly the actions there are: drops, releases, activations and deactivations,
/// requests, MOT before PLAN within each [FALL-13].
///
/// Domain: an action or none of each of the four kinds for each group, of one station and session,
/// any one of them looked at. Not covered: which actions an event leads to, for which see `group`.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_actions_come_in_their_order() {
    let (mot, plan) = (of(Group::Mot), of(Group::Plan));
    let by_kind = [[mot[0], plan[0]], [mot[1], plan[1]], [mot[2], plan[2]], [mot[3], plan[3]]];
    let looked_at = below(8);
    let (mut before, mut all) = (0, 0);
    let mut expected = None;
    let mut place = 0;
    while place < 8 {
        let action = by_kind[place / 2][place % 2];
        if place == usize::from(looked_at) {
            (before, expected) = (all, action);
        }
        all += usize::from(action.is_some());
        place += 1;
    }
    let (len, found) = action_at(by_kind, before);
    assert!(len == all);
    if let Some(expected) = expected {
        assert!(found == Some(expected));
    }
    kani::cover!(all == 8, "all");
    kani::cover!(all == 0, "none");
}

fn of(group: Group) -> [Option<Action>; 4] {
    let (station, session) = (1, 2);
    let services = if kani::any() { Action::Activate(group) } else { Action::Deactivate(group) };
    [
        option(|| Action::Drop(group)),
        option(|| Action::Release { station, group, session }),
        option(|| services),
        option(|| Action::Request { station, group, session }),
    ]
}
