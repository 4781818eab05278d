//! Stage i: minimal assignment by `lapjv` (square matrices only: the rest is padded with zeros) and
//! `lsap`, and nearest neighbours by `rstar`, which decide alone when they are distinct.

use mufasa::input::cycle::{Cycle, Detection, Track};
use mufasa::report::Stage;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::Peer;

/// The three ways.
pub fn peers<'a>(cycle: &'a Cycle<'a>) -> Vec<Peer<'a>> {
    let peer = |name, decide: fn(&Cycle<'_>) -> bool| Peer {
        name,
        stage: Stage::I,
        decide: Box::new(move || decide(std::hint::black_box(cycle))),
    };
    vec![
        peer("lapjv", by_lapjv),
        peer("lsap", by_lsap),
        peer("rstar, lsap when needed", by_neighbours),
    ]
}

fn lists<'a>(cycle: &Cycle<'a>) -> (Vec<&'a Track>, &'a [Detection]) {
    let items = cycle.detections.map_or(&[][..], |list| list.items);
    let tracks = cycle.tracks.map_or(&[][..], |list| list.items);
    let far = |x: f64, y: f64| square(x - cycle.ego.x) + square(y - cycle.ego.y);
    let radius = items.iter().map(|d| far(d.x, d.y)).fold(0.0, f64::max);
    (tracks.iter().filter(|t| far(t.x, t.y) <= radius).collect(), items)
}

fn apart(track: &Track, detection: &Detection) -> f64 {
    (square(track.x - detection.x) + square(track.y - detection.y)).sqrt()
}

fn passes(cycle: &Cycle<'_>, sum: f64, pairs: usize) -> bool {
    pairs == 0 || sum < count(pairs) * cycle.parameters.theta_tr
}

fn by_lapjv(cycle: &Cycle<'_>) -> bool {
    let (tracks, detections) = lists(cycle);
    let (pairs, side) = (tracks.len().min(detections.len()), tracks.len().max(detections.len()));
    let costs = ndarray::Array2::from_shape_fn((side, side), |(row, column)| {
        match (tracks.get(row), detections.get(column)) {
            (Some(track), Some(detection)) => apart(track, detection),
            _ => 0.0,
        }
    });
    lapjv::lapjv(&costs).is_ok_and(|(rows, _)| passes(cycle, lapjv::cost(&costs, &rows), pairs))
}

fn by_lsap(cycle: &Cycle<'_>) -> bool {
    let (tracks, detections) = lists(cycle);
    assigned(cycle, &tracks, detections)
}

fn assigned(cycle: &Cycle<'_>, tracks: &[&Track], detections: &[Detection]) -> bool {
    let row = |track: &&Track| {
        let track = **track;
        detections.iter().map(move |detection| apart(&track, detection))
    };
    let costs: Vec<f64> = tracks.iter().flat_map(row).collect();
    let pairs = tracks.len().min(detections.len());
    lsap::get_assigned_cost(tracks.len(), detections.len(), &costs, false)
        .is_ok_and(|sum| passes(cycle, sum, pairs))
}

/// Distinct nearest neighbours are a minimal assignment; whatever they are, no assignment of all
/// tracks is cheaper.
fn by_neighbours(cycle: &Cycle<'_>) -> bool {
    let (tracks, detections) = lists(cycle);
    let places = detections.iter().enumerate();
    let tree = RTree::bulk_load(
        places.map(|(index, d)| GeomWithData::new([d.x, d.y], index)).collect::<Vec<_>>(),
    );
    let mut taken = vec![false; detections.len()];
    let (mut sum, mut distinct) = (0.0, true);
    for track in &tracks {
        let Some(nearest) = tree.nearest_neighbor(&[track.x, track.y]) else { break };
        distinct &= !std::mem::replace(&mut taken[nearest.data], true);
        sum += apart(track, &detections[nearest.data]);
    }
    if tracks.len() > detections.len() || (!distinct && passes(cycle, sum, tracks.len())) {
        return assigned(cycle, &tracks, detections);
    }
    passes(cycle, sum, tracks.len())
}

fn square(value: f64) -> f64 {
    value * value
}

#[expect(clippy::cast_precision_loss, reason = "lists are short")]
fn count(items: usize) -> f64 {
    items as f64
}
