//! Where corridors overlap: computed from the paths alone.
//!
//! Two routes run together where they are nearly the same line in the same direction: there one follows
//! the other. Where they part, the one behind still sees the one ahead. What is left, crossing and
//! merging, is a conflict: an interval of either route that two vehicles are not to be in at once.

use crate::map::route::{Conflict, Passage, Route, RouteKind};
use crate::map::{Light, Town};

/// Half width that a vehicle needs for a conflict, m: that of the widest, and what it swings out.
const HALF_VEHICLE: f64 = 1.45;
/// The same of a person or a bicycle, m.
const HALF_PERSON: f64 = 0.7;
/// Routes run together up to this distance, m, and where the cosine of their angle is above this.
const TOGETHER: (f64, f64) = (1.5, 0.95);
/// Overlaps of a route that are nearer than this belong to one passage, m: no vehicle waits between them.
const APART: f64 = 14.0;
/// From the stop line to the first overlap, m.
const BEFORE: f64 = 1.0;

/// How one point of a route lies to another route.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Relation {
    Apart,
    Together,
    Across,
}

/// An overlap of two routes before it has passages.
struct Overlap {
    routes: (usize, usize),
    here: (f64, f64),
    there: (f64, f64),
}

/// Finds all passages and conflicts of a town, and who gives way.
pub fn compute(town: &mut Town) {
    let mut overlaps = Vec::new();
    for a in 0..town.routes.len() {
        for b in a + 1..town.routes.len() {
            overlaps_of(&town.routes, (a, b), &mut overlaps);
        }
    }
    for index in 0..town.routes.len() {
        town.routes[index].passages = passages(&town.routes[index], index, &overlaps);
    }
    let mut conflicts: Vec<(usize, Conflict)> = Vec::new();
    for overlap in &overlaps {
        let (a, b) = overlap.routes;
        let of = |route: usize, s: f64| {
            town.routes[route].passages.iter().position(|p| p.from <= s && s <= p.to)
        };
        let (Some(passage), Some(their_passage)) = (of(a, overlap.here.0), of(b, overlap.there.0))
        else {
            unreachable!("passages are made of all overlaps");
        };
        let first = goes_first(&town.routes, overlap, (passage, their_passage));
        let (here, there) = (overlap.here, overlap.there);
        conflicts.push((
            a,
            Conflict { passage, here, with: b, there, their_passage, gives_way: !first },
        ));
        conflicts.push((
            b,
            Conflict {
                passage: their_passage,
                here: there,
                with: a,
                there: here,
                their_passage: passage,
                gives_way: first,
            },
        ));
    }
    conflicts.sort_by_key(|(route, c)| (*route, c.passage, c.with, c.their_passage));
    for (route, conflict) in conflicts {
        town.routes[route].conflicts.push(conflict);
    }
}

/// What the signal over a passage shows, s; green where there is none.
pub fn light(town: &Town, passage: &Passage, time: f64) -> Light {
    passage.group.map_or(Light::Green, |group| town.signals[group].light(time))
}

const fn half(route: &Route) -> f64 {
    match route.kind {
        RouteKind::Road => HALF_VEHICLE,
        RouteKind::Foot | RouteKind::Cycle => HALF_PERSON,
    }
}

fn overlaps_of(routes: &[Route], (a, b): (usize, usize), into: &mut Vec<Overlap>) {
    let (first, second) = (&routes[a], &routes[b]);
    if first.kind != RouteKind::Road && second.kind != RouteKind::Road {
        return;
    }
    let reach = half(first) + half(second);
    let relations = relations(first, second, reach);
    let mut at = 0;
    while at < relations.len() {
        if relations[at].0 != Relation::Across {
            at += 1;
            continue;
        }
        let start = at;
        while at < relations.len() && relations[at].0 == Relation::Across {
            at += 1;
        }
        // They ran together and part: who is behind follows.
        if start > 0 && relations[start - 1].0 == Relation::Together {
            continue;
        }
        let run = &relations[start..at];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &(_, _, s) in run {
            (low, high) = (low.min(s), high.max(s));
        }
        let (from, to) = (run[0].1, run[run.len() - 1].1);
        // Where paths cross squarely the nearest points of the other are all one.
        into.push(Overlap { routes: (a, b), here: (from, to), there: (low - reach, high + reach) });
    }
}

/// How every point of a route lies to another: the relation, its arc length, and that on the other.
fn relations(first: &Route, second: &Route, reach: f64) -> Vec<(Relation, f64, f64)> {
    let points = first.path.points();
    let length = second.path.length();
    let mut result = Vec::with_capacity(points.len());
    for (index, &point) in points.iter().enumerate() {
        let s = first.path.arc_lengths()[index];
        let Some(seen) = second.path.project_near(point, 0.0, length, reach) else {
            result.push((Relation::Apart, s, 0.0));
            continue;
        };
        let near = second.path.pose_at(seen.s);
        let distance = near.at.distance(point);
        let pose = first.path.pose_at(s);
        let along = pose.cos * near.cos + pose.sin * near.sin;
        let relation = if distance >= reach || !(seen.s > 0.0 && seen.s < length) {
            Relation::Apart
        } else if distance < TOGETHER.0 && along > TOGETHER.1 {
            Relation::Together
        } else {
            Relation::Across
        };
        result.push((relation, s, seen.s));
    }
    result
}

fn passages(route: &Route, index: usize, overlaps: &[Overlap]) -> Vec<Passage> {
    let mut spans: Vec<(f64, f64, Option<usize>)> =
        route.signals.iter().map(|signal| (signal.s, signal.s + 1.0, Some(signal.group))).collect();
    for overlap in overlaps {
        let (a, b) = overlap.routes;
        if a == index {
            spans.push((overlap.here.0 - BEFORE, overlap.here.1, None));
        }
        if b == index {
            spans.push((overlap.there.0 - BEFORE, overlap.there.1, None));
        }
    }
    spans.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut passages: Vec<Passage> = Vec::new();
    for (from, to, group) in spans {
        match passages.last_mut() {
            Some(last) if from < last.to + APART => {
                last.to = last.to.max(to);
                last.group = last.group.or(group);
            }
            _ => passages.push(Passage { from, to, group }),
        }
    }
    passages
}

/// Whether the first route of an overlap goes before the second: people; the road of the better rank;
/// who does not turn left across; who comes from the right.
fn goes_first(routes: &[Route], overlap: &Overlap, passages: (usize, usize)) -> bool {
    let (first, second) = (&routes[overlap.routes.0], &routes[overlap.routes.1]);
    if first.kind != second.kind {
        return first.kind != RouteKind::Road;
    }
    let (p, q) = (first.passages[passages.0], second.passages[passages.1]);
    let (ours, theirs) = (first.path.pose_at(p.from), second.path.pose_at(q.from));
    let (rank, their_rank) = (first.rank_at(p.from), second.rank_at(q.from));
    if rank != their_rank {
        return rank < their_rank;
    }
    let along = ours.cos * theirs.cos + ours.sin * theirs.sin;
    if along < -0.5 {
        // Towards each other: who turns left waits.
        let turn = |route: &Route, passage: Passage| {
            let (from, to) = (route.path.pose_at(passage.from), route.path.pose_at(passage.to));
            from.cos * to.sin - from.sin * to.cos
        };
        return turn(first, p) < turn(second, q);
    }
    // The other comes from the left when its direction is to the right of ours.
    ours.cos * theirs.sin - ours.sin * theirs.cos < 0.0
}
