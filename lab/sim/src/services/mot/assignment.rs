//! Which detection is of which track: the global nearest neighbour.

use std::collections::BTreeSet;

use pathfinding::matrix::Matrix;
use pathfinding::prelude::kuhn_munkres_min;

use crate::pose::Point;
use crate::services::mot::kalman::Expected;

/// For each track the index of its detection: as many pairs within the gate as there can be, and of those
/// assignments the one with the greatest likelihood. `free` are the detections that may be used; those that
/// are used are taken out.
///
/// `gate`: the greatest square of the Mahalanobis distance of a pair.
pub fn assigned(
    tracks: &[Expected],
    detections: &[Point],
    free: &mut BTreeSet<usize>,
    gate: f64,
) -> Vec<Option<usize>> {
    let mut found = vec![None; tracks.len()];
    let pairs: Vec<Pair> = (0..)
        .zip(tracks)
        .flat_map(|(track, expected)| {
            free.iter().filter_map(move |&detection| {
                let [square, cost] = expected.distances(detections[detection]);
                (square <= gate).then(|| Pair { track, detection, cost: in_units(cost) })
            })
        })
        .collect();
    for group in groups(&pairs, tracks.len(), detections.len()) {
        for (track, detection) in best(&group) {
            found[track] = Some(detection);
            free.remove(&detection);
        }
    }
    found
}

/// A track and a detection within its gate.
#[derive(Clone, Copy)]
struct Pair {
    track: usize,
    detection: usize,
    cost: i64,
}

/// Costs as integers, which the assignment compares exactly. A likelihood of the filter is far from 10^6.
#[allow(clippy::cast_possible_truncation)]
fn in_units(cost: f64) -> i64 {
    (cost.clamp(-1e6, 1e6) * 1e6) as i64
}

/// What no pair within a gate costs.
const OUTSIDE: i64 = 1_000_000_000_000_000;

/// Pairs in groups that share neither track nor detection: mostly one pair each, so that the assignment is
/// of small matrices.
fn groups(pairs: &[Pair], tracks: usize, detections: usize) -> Vec<Vec<Pair>> {
    // Nodes: tracks, then detections; each points to another of its group, the first to itself.
    let mut parent: Vec<usize> = (0..tracks + detections).collect();
    let root = |parent: &[usize], mut node: usize| {
        while parent[node] != node {
            node = parent[node];
        }
        node
    };
    for pair in pairs {
        let (a, b) = (root(&parent, pair.track), root(&parent, tracks + pair.detection));
        parent[a.max(b)] = a.min(b);
    }
    let mut groups: Vec<Vec<Pair>> = vec![Vec::new(); tracks];
    for &pair in pairs {
        groups[root(&parent, pair.track)].push(pair);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// The best assignment of one group.
fn best(group: &[Pair]) -> Vec<(usize, usize)> {
    if let [pair] = group {
        return vec![(pair.track, pair.detection)];
    }
    let distinct = |of: fn(&Pair) -> usize| -> Vec<usize> {
        let all: BTreeSet<usize> = group.iter().map(of).collect();
        all.into_iter().collect()
    };
    let (tracks, detections) = (distinct(|pair| pair.track), distinct(|pair| pair.detection));
    let mut costs = Matrix::new(tracks.len(), detections.len(), OUTSIDE);
    for pair in group {
        let row = tracks.binary_search(&pair.track);
        let column = detections.binary_search(&pair.detection);
        if let (Ok(row), Ok(column)) = (row, column) {
            costs[(row, column)] = pair.cost;
        }
    }
    // The algorithm asks for no more rows than columns.
    let turned = costs.rows > costs.columns;
    let wide = if turned { costs.transposed() } else { costs.clone() };
    let (_, columns) = kuhn_munkres_min(&wide);
    let pairs =
        (0..).zip(columns).map(|(row, column)| if turned { (column, row) } else { (row, column) });
    let pairs = pairs.filter(|&pair| costs[pair] < OUTSIDE);
    pairs.map(|(row, column)| (tracks[row], detections[column])).collect()
}
