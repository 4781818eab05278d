//! Stage i: track validation (`spec/3-stages.md#stage-i-track-validation`, H-01, H-09).

use crate::input::profile::Profile;
use crate::input::scene::{Object, Scene, Track, Tracks};
use crate::numbers::assignment::{Costs, costs_less};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Reading, Rule, Witness};

/// More tracks than this on the edge of the field of view: not every choice of them is tried.
const MOST_ON_THE_EDGE: usize = 6;

/// Compares the received tracks with the detections; `None` passes.
pub fn track_validation(scene: &Scene, tracks: &Tracks, detections: &[Object]) -> Option<Witness> {
    let mean = match choices_of_gated_tracks(scene, tracks, detections) {
        Some(choices) => {
            let mut failures =
                choices.iter().map(|gated| assignment_failure(scene, gated, detections));
            match scene.reading {
                // Strict passes when every choice does, lax when some does; exact has one.
                Reading::Exact | Reading::Strict => failures.find_map(|failure| failure),
                Reading::Lax => {
                    let failures: Vec<_> = failures.collect();
                    if failures.iter().any(Option::is_none) { None } else { failures[0].clone() }
                }
            }
        }
        None => match scene.reading {
            Reading::Lax => None,
            Reading::Exact | Reading::Strict => Some(too_many_on_the_edge(scene)),
        },
    };
    mean.or_else(|| velocity_failure(scene, tracks))
}

/// The field-of-view radius r: the distance from p to the farthest detection, 0 without any.
fn field_of_view(scene: &Scene, detections: &[Object]) -> Real {
    let distances = detections.iter().map(|d| distance(&scene.ego.position, &d.frame.origin));
    distances.max().unwrap_or_else(Real::zero)
}

/// The lists of tracks to be assigned: those with distance to p <= r. In the strict and the lax
/// reading a track whose distance differs from r by at most delta is both in and out; `None` when
/// there are too many of these.
fn choices_of_gated_tracks<'a>(
    scene: &Scene,
    tracks: &'a Tracks,
    detections: &[Object],
) -> Option<Vec<Vec<&'a Track>>> {
    let r = field_of_view(scene, detections);
    let beyond = |track: &Track| distance(&scene.ego.position, &track.object.frame.origin) - &r;
    let on_the_edge = |track: &&Track| {
        scene.reading != Reading::Exact && beyond(track).abs() <= scene.parameters.delta
    };
    let edge: Vec<&Track> = tracks.items.iter().filter(on_the_edge).collect();
    if edge.len() > MOST_ON_THE_EDGE {
        return None;
    }
    let inside = |track: &Track| beyond(track) <= Real::zero();
    let choices = (0..1usize << edge.len()).map(|choice| {
        let chosen = |track: &&Track| match edge.iter().position(|e| std::ptr::eq(*e, *track)) {
            Some(bit) => choice >> bit & 1 == 1,
            None => inside(track),
        };
        tracks.items.iter().filter(chosen).collect()
    });
    Some(choices.collect())
}

fn assignment_failure(scene: &Scene, gated: &[&Track], detections: &[Object]) -> Option<Witness> {
    over_limit(scene, gated.len(), detections.len())
        .or_else(|| assigned_failure(scene, gated, detections))
}

/// Strict: the work of the assignment is above work_limit, so that an implementation may fail.
fn over_limit(scene: &Scene, gated: usize, detections: usize) -> Option<Witness> {
    let budget = usize::try_from(scene.parameters.miss_budget).unwrap_or(0).min(gated);
    let (pairs, columns) = match scene.profile {
        Profile::Paper => (gated.min(detections), detections),
        Profile::Hardened => (gated - budget, detections + budget),
    };
    let (least, most) = (gated.min(columns) as i128, gated.max(columns) as i128);
    let work = least * least * most;
    let limit = i128::from(scene.parameters.work_limit);
    (scene.reading == Reading::Strict && pairs > 0 && work > limit).then(|| {
        Witness::new(Rule::WorkLimit, &Real::from_integer(work), &Real::from_integer(limit))
    })
}

fn assigned_failure(scene: &Scene, gated: &[&Track], detections: &[Object]) -> Option<Witness> {
    match scene.profile {
        Profile::Paper => {
            let pairs = gated.len().min(detections.len());
            mean_failure(scene, &costs(gated, detections, None), detections.len(), pairs)
        }
        Profile::Hardened => {
            let limit = &scene.parameters.theta_track_max - &scene.m;
            let costs = costs(gated, detections, Some(&limit));
            let budget = usize::try_from(scene.parameters.miss_budget).unwrap_or(0);
            let pairs = gated.len().saturating_sub(budget);
            mean_failure(scene, &costs, detections.len(), pairs).map(|mut witness| {
                if witness.rule == Rule::NoAssignment {
                    let unmatched = costs.iter().position(|row| row.iter().all(Option::is_none));
                    witness.track = unmatched.map(|row| gated[row].id);
                }
                witness
            })
        }
    }
}

/// Distances of every track to every detection; none where it is not below `limit`.
fn costs(gated: &[&Track], detections: &[Object], limit: Option<&Real>) -> Costs {
    let cost = |track: &Track, detection: &Object| {
        let cost = distance(&track.object.frame.origin, &detection.frame.origin);
        limit.is_none_or(|limit| cost < *limit).then_some(cost)
    };
    gated.iter().map(|track| detections.iter().map(|d| cost(track, d)).collect()).collect()
}

/// The mean over the cheapest assignment of `pairs` pairs is not below theta_tr; none of 0 pairs.
fn mean_failure(scene: &Scene, costs: &Costs, columns: usize, pairs: usize) -> Option<Witness> {
    if pairs == 0 {
        return None;
    }
    let count = |n: usize| Real::from_integer(i128::try_from(n).unwrap_or(i128::MAX));
    let theta_tr = &scene.parameters.theta_tr;
    match costs_less(costs, columns, pairs, &(count(pairs) * (theta_tr - &scene.m))) {
        Ok(comparison) => (!comparison.less)
            .then(|| Witness::new(Rule::MeanCost, &(comparison.cost / count(pairs)), theta_tr)),
        Err(most) => Some(Witness::new(Rule::NoAssignment, &count(most), &count(pairs))),
    }
}

fn too_many_on_the_edge(scene: &Scene) -> Witness {
    Witness::new(Rule::MeanCost, &scene.parameters.delta, &scene.parameters.delta)
}

/// H-09: dt between the stamps of the received list and the previous one, when that is usable.
fn time_since_previous<'a>(scene: &'a Scene, tracks: &Tracks) -> Option<(&'a Tracks, Real)> {
    let previous = scene.previous_tracks.as_ref()?;
    let dt_ns = i128::from(tracks.stamp_ns) - i128::from(previous.stamp_ns);
    (0 < dt_ns && dt_ns <= 1_000_000_000).then(|| (previous, Real::seconds(dt_ns)))
}

/// H-09: the previous list holds this id.
pub fn is_held(scene: &Scene, tracks: &Tracks, id: i64) -> bool {
    time_since_previous(scene, tracks)
        .is_some_and(|(previous, _)| previous.items.iter().any(|track| track.id == id))
}

/// H-09: abs(p - p_prev - v dt) <= theta_velocity dt for every track whose id is held.
fn velocity_failure(scene: &Scene, tracks: &Tracks) -> Option<Witness> {
    if scene.profile == Profile::Paper {
        return None;
    }
    let (previous, dt) = time_since_previous(scene, tracks)?;
    tracks.items.iter().find_map(|track| {
        let before = previous.items.iter().find(|before| before.id == track.id)?;
        let moved = &track.object.frame.origin - &before.object.frame.origin;
        let error = (&moved - &track.velocity.scaled(&dt)).length();
        let limit = &scene.parameters.theta_velocity * &dt;
        (error > &limit - &scene.m).then(|| Witness {
            track: Some(track.id),
            ..Witness::new(Rule::Velocity, &error, &limit)
        })
    })
}

fn distance(a: &Vector, b: &Vector) -> Real {
    (a - b).length()
}
