//! The path does not come back to the CAV, behind p nor from beyond the end of its list of places
//! (`spec/hardened/H-14.md#requirements-reach`).

use crate::hardened::h14_fail_safe::path::{ahead, farthest, least_ahead, nodes};
use crate::hardened::h14_fail_safe::times::Driving;
use crate::input::scene::{Point, Scene};
use crate::numbers::polyline::{Segment, nearest_point};
use crate::numbers::real::Real;
use crate::numbers::vector::Vector;
use crate::report::{Rule, Witness};

/// The first way from a node to the next one on which the path comes back, by the second of its nodes.
pub fn failure(scene: &Scene, trajectory: &[Point]) -> Option<Witness> {
    let nodes: Vec<Vector> = nodes(scene, trajectory).into_iter().map(|it| it.origin).collect();
    let first = trajectory.len() + 1 - nodes.len();
    let ways = (first..).zip(nodes.windows(2)).zip(all_earlier(scene, &nodes));
    let mut failures = ways.map(|((i, ends), earlier)| {
        let way = [ends[0].clone(), ends[1].clone()];
        let failure = back_failure(scene, &way, &earlier)
            .or_else(|| from_afar_failure(scene, &way, &earlier))?;
        Some(failure.at_point(i))
    });
    failures.find_map(|failure| failure)
}

/// What the earlier nodes of a way are: the first of its two, and all before that.
#[derive(Clone)]
struct Earlier {
    /// Their greatest progress, m.
    progress: Real,
    /// One of them is farther from p than s_stop + max(1 m, lateral_tolerance).
    is_far: bool,
}

/// The earlier nodes of the way that begins at each node.
fn all_earlier(scene: &Scene, nodes: &[Vector]) -> impl Iterator<Item = Earlier> {
    let least = scene.reads.lowered(&farthest(scene));
    nodes.iter().scan(None, move |before: &mut Option<Earlier>, node| {
        let is_far = node.distance(&scene.ego.position) > least;
        let here = Earlier { progress: ahead(scene, node), is_far };
        let all = before.take().map_or(here.clone(), |before| Earlier {
            progress: before.progress.max(here.progress),
            is_far: before.is_far || here.is_far,
        });
        Some(before.insert(all).clone())
    })
}

/// Case 1: a point nearer to p than s_stop + max(1 m, lateral_tolerance) is more than 1/8 m less ahead than an earlier
/// node.
fn back_failure(scene: &Scene, way: &Segment, earlier: &Earlier) -> Option<Witness> {
    let limit = scene.reads.raised(&(&earlier.progress - least_ahead()));
    let part = less_ahead(scene, way, &limit)?;
    let is_near = scene.reads.may_be_less(&distance(scene, &part), &farthest(scene));
    let [f_a, f_b] = way.each_ref().map(|node| ahead(scene, node));
    let back = &earlier.progress - f_a.min(f_b);
    Witness::unless(!is_near, Rule::Reach, &back, &least_ahead())
}

/// Case 2: a point is nearer to p than s_stop, and an earlier node farther than s_stop + max(1 m, lateral_tolerance).
fn from_afar_failure(scene: &Scene, way: &Segment, earlier: &Earlier) -> Option<Witness> {
    let (distance, s_stop) = (distance(scene, way), Driving::of(scene).s_stop());
    let is_near = scene.reads.may_be_less(&distance, &s_stop);
    Witness::unless(!(earlier.is_far && is_near), Rule::Reach, &distance, &s_stop)
}

/// The part of a way that is less ahead than a limit, with its end at the limit; none where no point is less ahead.
/// Points that are less ahead come as near to that end as one likes: one of them is nearer to p than a bound exactly when
/// a point of the part is.
fn less_ahead(scene: &Scene, way: &Segment, limit: &Real) -> Option<Segment> {
    let [f_a, f_b] = way.each_ref().map(|node| ahead(scene, node));
    let [a, b] = way;
    let border = || a + &(b - a).scaled(&((limit - &f_a) / (&f_b - &f_a)));
    match [f_a < *limit, f_b < *limit] {
        [true, true] => Some(way.clone()),
        [true, false] => Some([a.clone(), border()]),
        [false, true] => Some([border(), b.clone()]),
        [false, false] => None,
    }
}

/// The least distance of a way from p, m.
fn distance(scene: &Scene, way: &Segment) -> Real {
    let p = &scene.ego.position;
    nearest_point(p, way).distance(p)
}
