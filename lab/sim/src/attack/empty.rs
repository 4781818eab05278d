//! The lists of `empty-tracks`, by how they come.

use mufasa::input::cycle::{Ego, Track};

use super::Attack;
use super::means::{Comes, Lists};
use crate::pose::Point;
use crate::services::detectors::random::Draws;

/// Share of the time in which a true list is the last: they come at 10 Hz, and an empty one at most 10 ms later.
const TRUE_IS_LAST: f64 = 0.05;

/// What the station's planner believes in instead.
pub(super) fn believed(attack: &Attack, stamp_ns: i64, ego: &Ego, list: &mut Vec<Track>) {
    if !attack.means.spoils(Lists::Planner) {
        return;
    }
    match attack.means.comes {
        Comes::Last | Comes::Replaced => list.clear(),
        Comes::Interleaved => {
            let mut draws = Draws::new([attack.seed, 8, stamp_ns.unsigned_abs(), 0]);
            if draws.share() >= TRUE_IS_LAST {
                list.clear();
            }
        }
        Comes::Farthest => farthest(ego, list),
    }
}

/// What the CAV is sent in the place of a true list.
pub(super) fn sent(attack: &Attack, ego: &Ego, list: &mut Vec<Track>) {
    if !attack.means.spoils(Lists::Cav) {
        return;
    }
    match attack.means.comes {
        Comes::Last | Comes::Interleaved => {}
        Comes::Replaced => list.clear(),
        Comes::Farthest => farthest(ego, list),
    }
}

/// Whether the CAV is sent empty lists between the true ones.
pub(super) fn is_forged(attack: &Attack) -> bool {
    let between = matches!(attack.means.comes, Comes::Last | Comes::Interleaved);
    between && attack.means.spoils(Lists::Cav)
}

fn farthest(ego: &Ego, list: &mut Vec<Track>) {
    let from = Point::new(ego.x, ego.y);
    let distance = |it: &Track| from.distance(Point::new(it.x, it.y));
    let farthest = list.iter().copied().max_by(|a, b| distance(a).total_cmp(&distance(b)));
    list.clear();
    list.extend(farthest);
}
