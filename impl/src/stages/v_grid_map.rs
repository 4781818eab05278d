//! Stage v: trajectory with grid map (`spec/3-stages.md#stage-v-trajectory-with-grid-map`), with
//! H-06.

mod band;
pub(crate) mod bitmap;
mod disk;

use crate::input::cycle::{Cycle, Grid, Profile, Trajectory, TrajectoryPoint};
use crate::report::{Rule, Witness};
use crate::stages::distances::Horizon;
use crate::stages::examined::Examined;
use crate::stages::v_grid_map::band::{Band, Frame};
use crate::stages::v_grid_map::bitmap::Bitmap;
use crate::stages::v_grid_map::disk::{Disk, Hit, Map};

/// Why stage v fails, if it does. `unknown_is_free`: stage iv ran in this cycle (H-06).
pub(crate) fn grid(
    cycle: &Cycle<'_>,
    trajectory: &Trajectory<'_>,
    grid: &Grid<'_>,
    unknown_is_free: bool,
) -> Option<Witness> {
    let examined = Examined::new(cycle, trajectory.points, Horizon::Braking);
    let occupied = Bitmap { bits: grid.occupied, width: grid.width, height: grid.height };
    if cycle.profile == Profile::Paper {
        let search = Search::new(cycle, grid, examined.points);
        return search.cells(Rule::Occupied, &occupied, |map, disk| {
            map.marked(disk, &occupied, map.dilation())
        });
    }
    let everywhere = |find: &dyn Fn(&Search<'_, '_>) -> Option<Witness>| {
        let found = find(&Search::new(cycle, grid, examined.points));
        let beyond =
            || examined.first_beyond(|cycle, points| find(&Search::new(cycle, grid, points)));
        found.or_else(beyond)
    };
    let touched = |rule, cells: &Bitmap<'_>| {
        everywhere(&|search| search.cells(rule, cells, |map, disk| map.touched(disk, cells)))
    };
    let found = touched(Rule::Occupied, &occupied);
    if unknown_is_free {
        return found;
    }
    let unknown = grid.unknown.map(|bits| Bitmap { bits, ..occupied });
    let unknown = || unknown.and_then(|unknown| touched(Rule::Unknown, &unknown));
    let is_inside = |band: &Band| band.is_within(grid.width, grid.height);
    let outside = || everywhere(&|search| search.first(Rule::Outside, is_inside, Map::outside));
    found.or_else(unknown).or_else(outside)
}

/// The points that are examined, on a grid.
struct Search<'c, 'a> {
    cycle: &'c Cycle<'a>,
    grid: &'c Grid<'a>,
    points: &'c [TrajectoryPoint],
    frame: Frame,
}

impl<'c, 'a> Search<'c, 'a> {
    fn new(cycle: &'c Cycle<'a>, grid: &'c Grid<'a>, points: &'c [TrajectoryPoint]) -> Self {
        Self { cycle, grid, points, frame: Frame::new(cycle, grid) }
    }

    /// The first disk that `hit` says collides with a cell of the bitmap.
    fn cells(
        &self,
        rule: Rule,
        cells: &Bitmap<'_>,
        hit: impl Fn(&Map, &Disk) -> Option<Hit>,
    ) -> Option<Witness> {
        self.first(rule, |band| band.is_free(cells), hit)
    }

    /// The first hit in the order of points, then disks. As many points as possible are passed at
    /// once; `is_free`: no disk in the band can hit.
    fn first(
        &self,
        rule: Rule,
        is_free: impl Fn(&Band) -> bool,
        hit: impl Fn(&Map, &Disk) -> Option<Hit>,
    ) -> Option<Witness> {
        let (mut at, mut size) = (0_usize, self.points.len());
        while at < self.points.len() {
            let end = at.saturating_add(size).min(self.points.len());
            let points = self.points.get(at..end)?;
            if is_free(&Band::new(&self.frame, points)) {
                at = end;
                size = size.saturating_mul(2);
            } else if let [point] = points {
                let found = self.at_point(rule, at, point, &hit);
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
    fn at_point(
        &self,
        rule: Rule,
        index: usize,
        point: &TrajectoryPoint,
        hit: impl Fn(&Map, &Disk) -> Option<Hit>,
    ) -> Option<Witness> {
        let map = Map::new(self.cycle, self.grid);
        (0..self.cycle.parameters.n).zip(0_usize..).find_map(|(i, number)| {
            let Hit { cell, distance } = hit(&map, &map.disk(self.cycle, point, i))?;
            let witness = Witness::of(rule, [distance, map.radius.value()]).at_point(index);
            Some(Witness { disk: Some(number), cell, ..witness })
        })
    }
}
