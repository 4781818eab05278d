//! The stages of the paper profile by libraries, each used as an expert would: what does not
//! change from cycle to cycle (route index, structuring element, image format) is prepared
//! outside the measured time, and cheap tests go before expensive ones. They decide in plain
//! doubles, without error bounds, and check nothing about their input: `validation` does.

pub mod assignment;
pub mod boxes;
pub mod corridor;
pub mod grid;
pub mod validation;

use mufasa::input::cycle::{Cycle, TrajectoryPoint};
use mufasa::report::Stage;

/// A way to decide one stage; `true` passes.
pub struct Peer<'a> {
    /// The library and how it is used.
    pub name: &'static str,
    /// The stage that it decides.
    pub stage: Stage,
    /// Decides the cycle that the peer was made for.
    pub decide: Box<dyn FnMut() -> bool + 'a>,
}

/// Every peer, prepared for a cycle.
pub fn all<'a>(cycle: &'a Cycle<'a>) -> Vec<Peer<'a>> {
    let mut peers = assignment::peers(cycle);
    peers.push(corridor::peer(cycle));
    peers.extend(boxes::peers(cycle));
    peers.extend(grid::peers(cycle));
    peers
}

/// The peers of these names, one for each stage, one after the other in one call: what one would
/// put together from libraries. `validates`: the input is checked first.
///
/// # Panics
/// When a stage has no peer of that name.
pub fn team<'a>(
    cycle: &'a Cycle<'a>,
    names: [&str; 5],
    validates: bool,
) -> impl FnMut() -> bool + use<'a> {
    let mut all = all(cycle);
    let mut member = |(stage, name): (Stage, &str)| {
        let at = all.iter().position(|peer| peer.stage == stage && peer.name == name);
        all.swap_remove(at.expect("a peer of this name"))
    };
    let mut members: Vec<Peer<'a>> = Stage::ALL.into_iter().zip(names).map(&mut member).collect();
    move || {
        (!validates || validation::plain_loop(std::hint::black_box(cycle)))
            && members.iter_mut().all(|peer| (peer.decide)())
    }
}

/// The points with arc length at most `horizon`, in plain doubles.
fn within(points: &[TrajectoryPoint], horizon: f64) -> &[TrajectoryPoint] {
    let mut arc = 0.0;
    let steps = points.windows(2);
    let beyond = steps.take_while(|pair| {
        let (dx, dy) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
        arc += (dx * dx + dy * dy).sqrt();
        arc <= horizon
    });
    &points[..=beyond.count()]
}

/// `s_b`, m.
fn braking(cycle: &Cycle<'_>) -> f64 {
    cycle.ego.speed * cycle.ego.speed / (2.0 * cycle.parameters.a_b)
}
