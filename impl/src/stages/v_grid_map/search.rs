//! Which disk of which trajectory point is the first to collide, with as many points as possible
//! passed at once (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

use crate::hardened::h14_fail_safe::path::{Nodes, Path, Place};
use crate::input::cycle::{Cycle, Ego, Grid, TrajectoryPoint};
use crate::report::{Rule, Witness};
use crate::stages::llcc::Pose;
use crate::stages::v_grid_map::band::{Band, CellFrame};
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit};

/// The path whose places are examined behind the points (H-04), and how many points the trajectory has.
pub(crate) type Places<'c, 'a> = (Nodes<'c, 'a>, usize);

/// Points that are examined, on a grid.
pub(crate) struct DiskSearch<'c, 'a> {
    pub(crate) cycle: &'c Cycle<'a>,
    grid: &'c Grid<'a>,
    points: &'c [TrajectoryPoint],
    frame: CellFrame,
}

impl<'c, 'a> DiskSearch<'c, 'a> {
    pub(crate) fn new(
        cycle: &'c Cycle<'a>,
        grid: &'c Grid<'a>,
        points: &'c [TrajectoryPoint],
    ) -> Self {
        Self { cycle, grid, points, frame: CellFrame::new(cycle, grid) }
    }

    /// For cells that the CAV's rectangle has to touch, too.
    pub(crate) fn with_rectangle(self) -> Self {
        Self { frame: CellFrame::with_rectangle(self.cycle, self.grid), ..self }
    }

    /// The first hit in the order of points, then disks. As many points as possible are passed at
    /// once; `is_free`: nothing in the band can hit.
    pub(crate) fn first(
        &self,
        rule: Rule,
        is_free: impl Fn(&Band) -> bool,
        hit: impl Fn(&GridGeometry, &Disk<'_>) -> Option<Hit>,
    ) -> Option<Witness> {
        let (mut at, mut size) = (0_usize, self.points.len());
        while at < self.points.len() {
            let end = at.saturating_add(size).min(self.points.len());
            let points = self.points.get(at..end)?;
            if is_free(&Band::new(&self.frame, points.iter().copied())) {
                at = end;
                size = size.saturating_mul(2);
            } else if let [point] = points {
                let found = self.at_pose(rule, at, &Pose::of(point), &hit);
                if found.is_some() {
                    return found;
                }
                at = end;
            } else {
                size = points.len() >> 1;
            }
        }
        None
    }

    /// As `first`, at the places of a path, which a witness counts as points behind that many. The
    /// places of a piece lie on a line with one heading, and are in the band of the first and the last.
    pub(crate) fn first_place(
        &self,
        (nodes, points): Places<'_, '_>,
        rule: Rule,
        is_free: impl Fn(&Band) -> bool,
        hit: impl Fn(&GridGeometry, &Disk<'_>) -> Option<Hit>,
    ) -> Option<Witness> {
        if self.lines_are_free(nodes, &is_free) {
            return None;
        }
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

    /// Whether nothing along the path can hit, by one band.
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

    /// The first disk that hits.
    fn at_pose(
        &self,
        rule: Rule,
        index: usize,
        pose: &Pose,
        hit: impl Fn(&GridGeometry, &Disk<'_>) -> Option<Hit>,
    ) -> Option<Witness> {
        let grid = GridGeometry::new(self.cycle, self.grid);
        (0..self.cycle.parameters.n).zip(0_usize..).find_map(|(i, number)| {
            let Hit { cell, distance } = hit(&grid, &grid.disk(self.cycle, pose, i))?;
            let witness = Witness::of(rule, [distance, grid.radius.value()]).at_point(index);
            Some(Witness { disk: Some(number), cell, ..witness })
        })
    }
}
