//! Which disk of which trajectory point is the first to collide, with as many points as possible
//! passed at once (`spec/3-stages.md#stage-v-trajectory-with-grid-map`).

use crate::input::cycle::{Cycle, Grid, TrajectoryPoint};
use crate::report::{Rule, Witness};
use crate::stages::llcc::Pose;
use crate::stages::v_grid_map::band::{Band, CellFrame};
use crate::stages::v_grid_map::disk::{Disk, GridGeometry, Hit};

/// The CAV on a grid.
pub(crate) struct DiskSearch<'c, 'a> {
    pub(crate) cycle: &'c Cycle<'a>,
    grid: &'c Grid<'a>,
    /// With its disks, or with another shape.
    pub(crate) frame: CellFrame,
}

impl<'c, 'a> DiskSearch<'c, 'a> {
    pub(crate) fn new(cycle: &'c Cycle<'a>, grid: &'c Grid<'a>) -> Self {
        Self { cycle, grid, frame: CellFrame::new(cycle, grid) }
    }

    /// The first hit in the order of points, then disks. As many points as possible are passed at
    /// once; `is_free`: nothing in the band can hit.
    pub(crate) fn first(
        &self,
        points: &[TrajectoryPoint],
        rule: Rule,
        is_free: impl Fn(&Band) -> bool,
        hit: impl Fn(&GridGeometry, &Disk<'_>) -> Option<Hit>,
    ) -> Option<Witness> {
        let (mut at, mut size) = (0_usize, points.len());
        while at < points.len() {
            let end = at.saturating_add(size).min(points.len());
            let points = points.get(at..end)?;
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

    /// The first disk that hits.
    pub(crate) fn at_pose(
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
