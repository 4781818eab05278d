//! Witnesses of findings, found by the solver: numbers for the holes of a cycle that the paper
//! profile accepts although something is wrong with it.

mod scenes;
pub mod searches;

use std::io;

use searches::Search;

use crate::claim::Decision;
use crate::input::cycle::{Cycle, Profile};
use crate::numbers::real::formula::Formula;
use crate::numbers::real::hole::name_of;
use crate::prove::prove_claim;

/// A cycle that the paper profile accepts in spite of what is wrong; none where there is none
/// or the solver knows none. Errors are those of talking to the solver.
pub fn find(search: &Search) -> io::Result<Option<Cycle>> {
    let proof = prove_claim(&|| Formula::from(search.is_rejected(Profile::PAPER, None)))?;
    let Decision::Refuted(values) = proof.decision else { return Ok(None) };
    let mut cycle = search.cycle(Profile::PAPER);
    for number in numbers(&mut cycle) {
        let Some(name) = name_of(*number) else { continue };
        let found = values.iter().find(|(other, _)| *other == name);
        *number = found.map_or(0.0, |(_, value)| *value);
    }
    Ok(Some(cycle))
}

/// The numbers that a search may leave open.
fn numbers(cycle: &mut Cycle) -> impl Iterator<Item = &mut f64> {
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    let tracks = cycle.tracks.iter_mut().flat_map(|list| &mut list.items);
    let detections = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    let earlier = cycle.detection_history.iter_mut().flat_map(|list| &mut list.items);
    let ego = &mut cycle.ego;
    [&mut ego.speed, &mut ego.x, &mut ego.y, &mut ego.sin]
        .into_iter()
        .chain(points.flat_map(|point| [&mut point.x, &mut point.y]))
        .chain(tracks.flat_map(|track| [&mut track.x, &mut track.vx, &mut track.length]))
        .chain(detections.map(|detection| &mut detection.x))
        .chain(earlier.map(|detection| &mut detection.y))
        .chain(cycle.lead.iter_mut().map(|lead| &mut lead.speed))
}
