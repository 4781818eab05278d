//! Stage ii: containment in the corridor by `geo`'s interval tree, distance to the reference path
//! by `rstar`. The trees are built once: the map changes rarely.

use geo::indexed::IntervalTreeMultiPolygon;
use geo::{Contains, Coord, LineString, MultiPolygon, Polygon};
use mufasa::input::cycle::Cycle;
use mufasa::report::Stage;
use rstar::RTree;
use rstar::primitives::Line;

use super::Peer;

/// What is built once for a route.
pub struct Trees {
    corridor: IntervalTreeMultiPolygon<f64>,
    path: RTree<Line<[f64; 2]>>,
}

impl Trees {
    /// From the cross sections of the cycle's route, which is open and does not cross itself.
    pub fn new(cycle: &Cycle<'_>) -> Self {
        let cross_sections = cycle.route.cross_sections;
        let ring = cross_sections
            .iter()
            .map(|s| s.left)
            .chain(cross_sections.iter().rev().map(|s| s.right));
        let ring: Vec<Coord<f64>> = ring.map(|[x, y]| Coord { x, y }).collect();
        let polygon = Polygon::new(LineString(ring), Vec::new());
        let lines = cross_sections.windows(2);
        let lines = lines.map(|pair| Line::new([pair[0].x, pair[0].y], [pair[1].x, pair[1].y]));
        Self {
            corridor: IntervalTreeMultiPolygon::new(&MultiPolygon(vec![polygon])),
            path: RTree::bulk_load(lines.collect()),
        }
    }

    /// Whether there is something in it.
    pub fn is_built(&self) -> bool {
        self.path.size() > 0
    }

    fn inside(&self, [x, y]: [f64; 2]) -> bool {
        self.corridor.contains(&Coord { x, y })
    }

    fn near(&self, point: [f64; 2], theta_map: f64) -> bool {
        self.path.locate_within_distance(point, theta_map * theta_map).next().is_some()
    }
}

/// The corridor first, which decides most points.
pub fn peer<'a>(cycle: &'a Cycle<'a>) -> Peer<'a> {
    let trees = Trees::new(cycle);
    let decide = move || {
        let points = cycle.trajectory.map_or(&[][..], |trajectory| trajectory.points);
        let theta_map = std::hint::black_box(cycle).parameters.theta_map;
        let passes = |point: [f64; 2]| trees.inside(point) || trees.near(point, theta_map);
        points.iter().all(|point| passes([point.x, point.y]))
    };
    Peer { name: "geo, then rstar", stage: Stage::Ii, decide: Box::new(decide) }
}
