//! Stage v where the CAV is until it stops, behind the points that the paper names (H-04 of
//! `spec/hardened/H-04.md`).

use crate::hardened::h14_fail_safe::nodes::Nodes;
use crate::hardened::h14_fail_safe::path::{Path, Place};
use crate::input::cycle::{Cycle, Ego, Grid, Trajectory, TrajectoryPoint};
use crate::report::{Rule, Witness};
use crate::stages::v_grid_map::DilatedCells;
use crate::stages::v_grid_map::band::Band;
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit};
use crate::stages::v_grid_map::search::DiskSearch;

/// More than what the rounding of a sum and a product loses.
const UP: f64 = 1.0 + 4.0 * f64::EPSILON;

/// The path whose places are examined behind the points.
pub(crate) struct Places<'c, 'a> {
    nodes: Nodes<'c, 'a>,
    /// How many points the trajectory has.
    points: usize,
    /// With a CAV that is as wide as at places.
    pub(crate) wide: Cycle<'a>,
}

/// Those of a trajectory, of a CAV that is wider by so much on each side, m.
pub(crate) fn places_of<'c, 'a>(
    cycle: &'c Cycle<'a>,
    trajectory: &Trajectory<'a>,
    aside: f64,
) -> Places<'c, 'a> {
    let more = 2.0 * aside;
    //
    // H-14.27; rounded up, and by nothing where it is 0
    let width = if more > 0.0 { (cycle.ego.width + more) * UP } else { cycle.ego.width };
    Places {
        nodes: Nodes::new(cycle, trajectory.points),
        points: trajectory.points.len(),
        wide: Cycle { ego: Ego { width, ..cycle.ego }, ..*cycle },
    }
}

/// As the paper examines the points.
pub(crate) fn dilated_at_places(grid: &Grid<'_>, places: &Places<'_, '_>) -> Option<Witness> {
    let (search, dilated) = (DiskSearch::new(&places.wide, grid), DilatedCells::new(grid));
    search.first_place(
        places,
        Rule::Occupied,
        |band| dilated.is_free(band),
        |grid, disk| dilated.hit(grid, disk),
    )
}

impl DiskSearch<'_, '_> {
    /// As `first`, at the places of a path, which a witness counts as points behind the others. The
    /// places of a piece lie on a line with one heading, and are in the band of the first and the last.
    pub(crate) fn first_place(
        &self,
        &Places { nodes, points, .. }: &Places<'_, '_>,
        rule: Rule,
        is_free: impl Fn(&Band) -> bool,
        hit: impl Fn(&GridGeometry, &Disk<'_>) -> Option<Hit>,
    ) -> Option<Witness> {
        if self.lines_are_free(nodes, &is_free) {
            return None;
        }
        // H-04.1
        Path::new(nodes).pieces().find_map(|piece| {
            let [cos, sin] = piece.heading();
            let is_free = |run: [i64; 2]| {
                let ends = piece.between(run, [0.0; 2]);
                let ends = ends.map(|[x, y, _]| TrajectoryPoint { t_ns: 0, x, y, cos, sin });
                is_free(&Band::new(&self.frame, ends.into_iter()))
            };
            let find = |place: &Place| self.at_pose(rule, place.point(points), &place.pose, &hit);
            piece.first_place(is_free, find)
        })
    }

    /// Whether nothing along the path can hit, by one band. Without it stage v of W1 takes three times as many
    /// instructions, of W2 four times.
    fn lines_are_free(&self, nodes: Nodes<'_, '_>, is_free: impl Fn(&Band) -> bool) -> bool {
        let &Ego { x: p_x, y: p_y, .. } = &self.cycle.ego;
        let ends = nodes.lines().flat_map(|line| {
            let [cos, sin] = line.heading;
            let end =
                |[x, y]: [f64; 2]| TrajectoryPoint { t_ns: 0, x: p_x + x, y: p_y + y, cos, sin };
            [line.from, line.to].map(end)
        });
        is_free(&Band::new(&self.frame, ends))
    }
}
