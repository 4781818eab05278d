//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::collision::{Collision, Course, examined};
use crate::configuration::Configuration;
use crate::cycle::{Cycle, Profile, TrackList, Trajectory};
use crate::distance::Horizon;
use crate::sweep::Moving;
use crate::verdict::{Rule, Witness};

/// Why stage iii fails, if it does. `held` is the list whose ids H-09 counts as held: the previous
/// tracks that stage i used in this cycle, if any.
pub(crate) fn tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
    held: Option<&TrackList<'_>>,
) -> Option<Witness> {
    let count = examined(cycle, trajectory.points, Horizon::Cav);
    let points = trajectory.points.get(..count).unwrap_or(trajectory.points);
    let course = Course::new(cycle, points, tracks.stamp_ns);
    let witness = |rule, Collision { point, object, compared }| {
        let track = tracks.items.get(object).map(|track| track.id);
        Witness { track, ..Witness::of(rule, compared) }.at_point(point)
    };
    let predicted = tracks.items.iter().map(Moving::track);
    let found = course.first(predicted, |_| true).map(|it| witness(Rule::Collision, it));
    if cycle.profile == Profile::Paper || cycle.configuration != Configuration::AllRemote {
        return found;
    }
    let is_held = |id: i64| held.is_some_and(|list| list.items.iter().any(|old| old.id == id));
    let standing =
        tracks.items.iter().map(|track| Moving { velocity: [0.0; 2], ..Moving::track(track) });
    let counts = |index: usize| tracks.items.get(index).is_some_and(|track| !is_held(track.id));
    found.or_else(|| course.first(standing, counts).map(|it| witness(Rule::CollisionStanding, it)))
}
