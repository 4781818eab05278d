//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::input::cycle::{Cycle, Profile, Track, TrackList, Trajectory};
use crate::report::{Rule, Witness};
use crate::services::configuration::Configuration;
use crate::stages::distances::Horizon;
use crate::stages::examined::Examined;
use crate::stages::llcc::sweep::Moving;
use crate::stages::llcc::{Collision, Course};

/// Why stage iii fails, if it does. `held` is the list whose ids H-09 counts as held: the previous
/// tracks that stage i used in this cycle, if any.
pub(crate) fn tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
    held: Option<&TrackList<'_>>,
) -> Option<Witness> {
    let examined = Examined::new(cycle, trajectory.points, Horizon::Cav);
    let course = Course::new(cycle, examined.points, tracks.stamp_ns);
    let witness = |rule, Collision { point, object, compared }| {
        let track = tracks.items.get(object).map(|track| track.id);
        Witness { track, ..Witness::of(rule, compared) }.at_point(point)
    };
    let predicted = |course: &Course<'_, '_>| {
        let objects = tracks.items.iter().map(Moving::track);
        course.first(objects, |_| true).map(|it| witness(Rule::Collision, it))
    };
    let beyond = |find: &dyn Fn(&Course<'_, '_>) -> Option<Witness>| {
        examined.first_beyond(|cycle, points| find(&Course::new(cycle, points, tracks.stamp_ns)))
    };
    let found = predicted(&course).or_else(|| beyond(&predicted));
    if cycle.profile == Profile::Paper || cycle.configuration != Configuration::AllRemote {
        return found;
    }
    let is_held = |id: i64| held.is_some_and(|list| list.items.iter().any(|old| old.id == id));
    let counts = |index: usize| tracks.items.get(index).is_some_and(|track| !is_held(track.id));
    let still = |track: &Track| Moving { velocity: [0.0; 2], ..Moving::track(track) };
    let standing = |course: &Course<'_, '_>| {
        let objects = tracks.items.iter().map(still);
        course.first(objects, counts).map(|it| witness(Rule::CollisionStanding, it))
    };
    found.or_else(|| standing(&course)).or_else(|| beyond(&standing))
}
