//! Witnesses of findings, found by the solver: numbers for the holes of a cycle that the paper
//! profile accepts although something is wrong with it. `theorem::closure` proves that the hardened
//! profile accepts none of them, whatever the numbers.

mod scenes;
mod searches;

use std::io;

pub use searches::SEARCHES;

use crate::cycle::decide;
use crate::input::cycle::{Cycle, Profile};
use crate::input::scene::Scene;
use crate::numbers::real::formula::{Formula, given, not};
use crate::numbers::real::hole::name_of;
use crate::prove::{Decision, prove_claim};
use crate::theorem::base;

/// A finding whose witness is searched.
#[derive(Debug)]
pub struct Search {
    /// The finding.
    pub finding: &'static str,
    /// The cycle with holes.
    pub cycle: fn(Profile) -> Cycle,
    /// What the holes are within, and what is wrong.
    pub conditions: fn(&Scene) -> [Formula; 2],
}

impl Search {
    /// A cycle that the paper profile accepts in spite of what is wrong; none where there is none
    /// or the solver knows none. Errors are those of talking to the solver.
    ///
    /// # Panics
    /// Never: theorems count no work.
    pub fn find(&self) -> io::Result<Option<Cycle>> {
        let proof = prove_claim(&|| {
            let scene = base::scene(&(self.cycle)(Profile::PAPER));
            let [bounds, wrong] = (self.conditions)(&scene);
            given(bounds);
            given(wrong);
            not(Formula::from(decide(&scene).expect("no work is counted").failed_stage.is_none()))
        })?;
        let Decision::Refuted(values) = proof.decision else { return Ok(None) };
        let mut cycle = (self.cycle)(Profile::PAPER);
        for number in numbers(&mut cycle) {
            let Some(name) = name_of(*number) else { continue };
            let found = values.iter().find(|(other, _)| *other == name);
            *number = found.map_or(0.0, |(_, value)| *value);
        }
        Ok(Some(cycle))
    }
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
