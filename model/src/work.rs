//! How much the model computes (`spec/4-arithmetic.md#conformance-of-an-implementation`): a cycle that
//! needs more than 10^10 comparisons is no input of the model.

use crate::hardened::detection_history;
use crate::hardened::h14_fail_safe::widening::wider_by;
use crate::hardened::h14_fail_safe::{self, path};
use crate::input::profile::HardenedRule;
use crate::input::scene::{Grid, Point, Scene};
use crate::numbers::assignment;
use crate::numbers::real::Real;
use crate::report::{InvalidInput, Stage};
use crate::stages::v_grid_map::radius;

/// The comparisons that the stages of a cycle may need.
const MOST: i128 = 10_000_000_000;

/// Counts what the stages need one after the other.
#[derive(Debug, Default)]
pub struct Work(i128);

impl Work {
    /// Adds the comparisons that a stage or a rule needs that is about to run. `Err` is a problem at the
    /// field `work`: more than 10^10 in all.
    pub fn add(&mut self, comparisons: i128) -> Result<(), InvalidInput> {
        self.0 = self.0.saturating_add(comparisons);
        if self.0 <= MOST {
            return Ok(());
        }
        let message = format!("the cycle needs {} comparisons; the model makes {MOST}", self.0);
        Err(InvalidInput { field: "work".into(), index: None, message })
    }
}

/// The comparisons that a stage needs when nothing fails early, in the reading of the scene:
///
/// * i: the steps of the assignment, of all tracks and detections (its work), and with H-01 or H-14 each
///   track with each detection and each item of a usable list;
/// * ii: each trajectory point, with H-14 each place, too (the road), with each cross section;
/// * iii: each point with each track;
/// * iv: each point with each detection;
/// * v: each disk at each point, with H-04 at each place, too, with each cell that is as near as its
///   radius.
pub fn of_stage(scene: &Scene, stage: Stage) -> i128 {
    let trajectory = scene.trajectory.as_deref().unwrap_or_default();
    let points = trajectory.len() as i128;
    let has = |rule| scene.profile.has(rule);
    let tracks = scene.tracks.as_ref().map_or(0, |list| list.items.len());
    let detections = scene.detections.as_ref().map_or(0, |list| list.items.len());
    let places = |rule| if has(rule) { path::count(scene, trajectory) } else { 0 };
    match stage {
        Stage::I => {
            let lists = detection_history::usable(scene);
            let items: usize = lists.iter().map(|list| list.items.len()).sum();
            let is_seen = has(HardenedRule::H01) || has(HardenedRule::H14);
            let seen = if is_seen { tracks as i128 * (detections + items) as i128 } else { 0 };
            let left_out = usize::try_from(scene.parameters.miss_budget).unwrap_or(0).min(tracks);
            seen + assignment::work(tracks, detections + left_out)
        }
        Stage::Ii => {
            (points + places(HardenedRule::H14)) * scene.route.cross_sections.len() as i128
        }
        Stage::Iii => points * tracks as i128,
        Stage::Iv => points * detections as i128,
        Stage::V => {
            let cells =
                |half: &Real| scene.grid.as_ref().map_or(0, |grid| cells(scene, grid, half));
            let half_width = &scene.ego.width / Real::from_integer(2);
            let at_places = match places(HardenedRule::H04) {
                0 => 0,
                places => places * cells(&(&half_width + wider_by(scene, trajectory))),
            };
            points * cells(&half_width) + at_places
        }
    }
}

/// The comparisons of H-14, and each place and each moving object with each cross section (who
/// follows).
pub fn of_fail_safe(scene: &Scene, trajectory: &[Point]) -> i128 {
    let beside_route = path::count(scene, trajectory) + h14_fail_safe::most_moving(scene);
    h14_fail_safe::comparisons(scene, trajectory)
        + beside_route * scene.route.cross_sections.len() as i128
}

/// The cells near the n disks of a place, of a CAV of this half width.
fn cells(scene: &Scene, grid: &Grid, half_width: &Real) -> i128 {
    let n = scene.parameters.n;
    let r = radius(scene, half_width);
    let across = i128::from((Real::from_integer(2) * r / &grid.resolution).floor()) + 4;
    let near = |side: i64| across.min(i128::from(side));
    i128::from(n) * near(grid.width) * near(grid.height)
}
