//! Stage iii: trajectory with tracks (`spec/3-stages.md#stage-iii-trajectory-with-tracks`).

use crate::collision::{collision, examined, footprint};
use crate::configuration::Configuration;
use crate::cycle::{Cycle, Profile, Track, TrackList, Trajectory, TrajectoryPoint};
use crate::distance::s_cav;
use crate::input::elapsed_ns;
use crate::plane::Vector;
use crate::rectangle::Rectangle;
use crate::rounding::Real;
use crate::verdict::{Rule, Witness};

/// Why stage iii fails, if it does. `held` is the list whose ids H-09 counts as held: the previous
/// tracks that stage i used in this cycle, if any.
pub(crate) fn tracks(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    tracks: &TrackList<'_>,
    held: Option<&TrackList<'_>>,
) -> Option<Witness> {
    let s = s_cav(&cycle.parameters, cycle.ego.speed);
    let count = examined(cycle, trajectory.points, s);
    let points = trajectory.points.get(..count).unwrap_or(trajectory.points);
    let predicted =
        |point: &TrajectoryPoint| Real::seconds(elapsed_ns(tracks.stamp_ns, point.t_ns));
    let is_held =
        |track: &Track| held.is_some_and(|list| list.items.iter().any(|old| old.id == track.id));
    let found = first(cycle, points, tracks, Rule::Collision, predicted, |_| true);
    if cycle.profile == Profile::Paper || cycle.configuration != Configuration::AllRemote {
        return found;
    }
    let standing = |_: &TrajectoryPoint| Real::ZERO;
    let rule = Rule::CollisionStanding;
    found.or_else(|| first(cycle, points, tracks, rule, standing, |track| !is_held(track)))
}

/// The first collision in the order of points, then tracks; every track is moved on by the time
/// of the point, and only those that `counts` holds for are examined.
fn first(
    cycle: &Cycle<'_>,
    points: &[TrajectoryPoint],
    tracks: &TrackList<'_>,
    rule: Rule,
    seconds: impl Fn(&TrajectoryPoint) -> Real,
    counts: impl Fn(&Track) -> bool,
) -> Option<Witness> {
    points.iter().enumerate().find_map(|(index, point)| {
        let cav = footprint(&cycle.ego, point);
        let dt = seconds(point);
        tracks.items.iter().find_map(|track| {
            let compared = collision(cycle, &cav, &moved(track, dt))?;
            let witness = Witness { track: Some(track.id), ..Witness::of(rule, compared) };
            counts(track).then(|| witness.at_point(index))
        })
    })
}

/// The rectangle of a track after `dt` seconds with unchanged velocity and direction.
fn moved(track: &Track, dt: Real) -> Rectangle {
    let velocity = Vector::new(track.vx, track.vy);
    Rectangle {
        centre: Vector::new(track.x, track.y) + velocity.times(dt),
        direction: Vector::new(track.cos, track.sin),
        length: track.length,
        width: track.width,
    }
}
