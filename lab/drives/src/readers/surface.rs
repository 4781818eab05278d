//! The surface of the road: the union of lanelets, and what of the plane it covers.

use crate::geometry::{Point, add, cross, distance, dot, foot, inside, mix, norm, scale, sub};
use crate::readers::lanes::{Lanelet, Network};

/// What reaches less than this beyond the road is on it, m: bounds that lanelets share are not
/// always the same to the last digit.
const SKIN: f64 = 1e-3;
/// What is between two lanelets that are not farther apart than this is road, m: bounds that they
/// share are drawn twice, and not always alike.
pub(crate) const GAP: f64 = 0.05;

/// The polygon between the bounds of a lanelet, and the box around it.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    points: Vec<Point>,
    low: Point,
    high: Point,
}

impl Outline {
    pub(crate) fn new(lanelet: &Lanelet) -> Self {
        let points: Vec<Point> = lanelet.outline().collect();
        let (low, high) = around(&points);
        Self { points, low, high }
    }

    fn edges(&self) -> impl Iterator<Item = [Point; 2]> {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    fn meets(&self, low: Point, high: Point) -> bool {
        (0..2).all(|i| self.low[i] <= high[i] && low[i] <= self.high[i])
    }

    fn contains(&self, p: Point) -> bool {
        self.meets(p, p) && inside(p, &self.points)
    }

    /// The way from a point outside to the nearest point of the outline, if it is at most [`GAP`].
    fn way_from(&self, p: Point) -> Option<Point> {
        if !self.meets(p.map(|x| x - GAP), p.map(|x| x + GAP)) {
            return None;
        }
        let ways = self.edges().map(|[a, b]| sub(foot(p, a, b).1, p));
        ways.min_by(|a, b| norm(*a).total_cmp(&norm(*b))).filter(|way| norm(*way) <= GAP)
    }

    /// The intervals of `t` for which `p + t u` is inside, `u` of length 1, up to `far` either way.
    pub(crate) fn along(&self, p: Point, u: Point, far: f64) -> Vec<[f64; 2]> {
        let ends = [add(p, scale(u, -far)), add(p, scale(u, far))];
        let (low, high) = around(&ends);
        if !self.meets(low, high) {
            return Vec::new();
        }
        // A vertex on the line counts for one of its edges only, as in `inside`.
        let mut cuts = Vec::new();
        for [a, b] in self.edges() {
            let [side_a, side_b] = [a, b].map(|q| cross(u, sub(q, p)));
            if (side_a > 0.0) != (side_b > 0.0) {
                cuts.push(dot(sub(mix(a, b, side_a / (side_a - side_b)), p), u));
            }
        }
        cuts.sort_by(f64::total_cmp);
        let pairs = cuts.chunks_exact(2).map(|pair| [pair[0].max(-far), pair[1].min(far)]);
        pairs.filter(|[from, to]| from < to).collect()
    }
}

/// The lanelets of a network that are near a line.
pub(crate) struct Surface {
    outlines: Vec<Outline>,
}

impl Surface {
    /// The lanelets within `reach` of the box around these points.
    pub(crate) fn near(network: &Network, points: &[Point], reach: f64) -> Self {
        let (low, high) = around(points);
        let (low, high) = (low.map(|x| x - reach), high.map(|x| x + reach));
        let outlines = network.lanelets.values().map(|it| Outline::new(it));
        Self { outlines: outlines.filter(|it| it.meets(low, high)).collect() }
    }

    /// Whether all of a triangle is on the road, but for a skin of [`SKIN`].
    pub(crate) fn covers(&self, [a, b, c]: [Point; 3]) -> bool {
        let sides = [distance(b, c), distance(c, a), distance(a, b)];
        let around_it: f64 = sides.iter().sum();
        let inradius = cross(sub(b, a), sub(c, a)).abs() / around_it;
        // NaN, and triangles that are all skin.
        if inradius.is_nan() || inradius <= SKIN {
            return around_it.is_finite();
        }
        let weighted = add(add(scale(a, sides[0]), scale(b, sides[1])), scale(c, sides[2]));
        let incenter = scale(weighted, 1.0 / around_it);
        let triangle = [a, b, c].map(|p| mix(incenter, p, 1.0 - SKIN / inradius));
        let (low, high) = around(&[a, b, c]);
        let wide = [low.map(|x| x - GAP), high.map(|x| x + GAP)];
        let near: Vec<&Outline> =
            self.outlines.iter().filter(|o| o.meets(wide[0], wide[1])).collect();
        let [a, b, c] = triangle;
        [[a, b], [b, c], [c, a]].into_iter().all(|side| covers_segment(&near, side))
            && near
                .iter()
                .flat_map(|o| o.edges())
                .all(|edge| no_edge_of_road(&near, triangle, edge))
    }
}

/// Whether what of an edge of a lanelet is inside a triangle has road on both sides. So nothing is
/// missing inside a triangle whose sides are on the road.
fn no_edge_of_road(near: &[&Outline], triangle: [Point; 3], [p, q]: [Point; 2]) -> bool {
    let Some([from, to]) = clip(triangle, [p, q]) else { return true };
    let length = distance(p, q);
    if (to - from) * length <= SKIN {
        return true;
    }
    let [dx, dy] = scale(sub(q, p), SKIN / length);
    let part = [mix(p, q, from), mix(p, q, to)];
    [[-dy, dx], [dy, -dx]].into_iter().all(|off| covers_segment(near, part.map(|it| add(it, off))))
}

/// The part of a segment in a triangle, as shares of its length.
fn clip([a, b, c]: [Point; 3], [p, q]: [Point; 2]) -> Option<[f64; 2]> {
    let turn = cross(sub(b, a), sub(c, a)).signum();
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for [r, s] in [[a, b], [b, c], [c, a]] {
        let [at_p, at_q] = [p, q].map(|it| turn * cross(sub(s, r), sub(it, r)));
        if at_p < 0.0 && at_q < 0.0 {
            return None;
        }
        if (at_p < 0.0) != (at_q < 0.0) {
            let w = at_p / (at_p - at_q);
            if at_p < 0.0 { from = from.max(w) } else { to = to.min(w) }
        }
    }
    (from < to).then_some([from, to])
}

/// Whether a point is inside an outline, or in a gap between two.
fn covers_point(near: &[&Outline], p: Point) -> bool {
    if near.iter().any(|outline| outline.contains(p)) {
        return true;
    }
    let ways: Vec<Point> = near.iter().filter_map(|outline| outline.way_from(p)).collect();
    let opposite = |a: &Point, b: &Point| dot(*a, *b) <= 0.0 && norm(*a) + norm(*b) <= GAP;
    ways.iter().enumerate().any(|(i, a)| ways[..i].iter().any(|b| opposite(a, b)))
}

/// Whether every part of a segment, cut where it crosses an outline, is inside one of them.
fn covers_segment(near: &[&Outline], [a, b]: [Point; 2]) -> bool {
    let way = sub(b, a);
    let (low, high) = around(&[a, b]);
    let mut cuts = vec![0.0, 1.0];
    for [p, q] in near.iter().filter(|o| o.meets(low, high)).flat_map(|o| o.edges()) {
        let [side_p, side_q] = [p, q].map(|it| cross(way, sub(it, a)));
        if (side_p > 0.0) != (side_q > 0.0) {
            let at = mix(p, q, side_p / (side_p - side_q));
            cuts.push((dot(sub(at, a), way) / dot(way, way)).clamp(0.0, 1.0));
        }
    }
    cuts.sort_by(f64::total_cmp);
    let least = 1e-6 / norm(way).max(1e-6);
    cuts.windows(2)
        .filter(|w| w[1] - w[0] > least)
        .all(|w| covers_point(near, mix(a, b, f64::midpoint(w[0], w[1]))))
}

fn around(points: &[Point]) -> (Point, Point) {
    let ends = |i: usize| {
        let values = points.iter().map(|p| p[i]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let ([x0, x1], [y0, y1]) = (<[f64; 2]>::from(ends(0)), <[f64; 2]>::from(ends(1)));
    ([x0, y0], [x1, y1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A surface of lanelets along x, each from its right to its left bound.
    fn surface(lanes: &[[[f64; 2]; 2]]) -> Surface {
        let lanelet = |[[x0, x1], [y0, y1]]: &[[f64; 2]; 2]| {
            Lanelet::between(1, vec![[*x0, *y1], [*x1, *y1]], vec![[*x0, *y0], [*x1, *y0]])
        };
        Surface { outlines: lanes.iter().map(|lane| Outline::new(&lanelet(lane))).collect() }
    }

    #[test]
    fn a_triangle_on_two_lanes_is_on_the_road_and_one_over_a_gap_is_not() {
        let triangle = [[1.0, -1.0], [9.0, 0.0], [1.0, 5.0]];
        let beside = surface(&[[[0.0, 10.0], [-2.0, 2.0]], [[0.0, 10.0], [2.0, 6.0]]]);
        assert!(beside.covers(triangle));
        let apart = surface(&[[[0.0, 10.0], [-2.0, 2.0]], [[0.0, 10.0], [2.1, 6.0]]]);
        assert!(!apart.covers(triangle));
        let short = surface(&[[[0.0, 8.0], [-2.0, 2.0]], [[0.0, 10.0], [2.0, 6.0]]]);
        assert!(!short.covers(triangle));
    }

    #[test]
    fn a_hole_is_no_road() {
        // Four lanelets around a square from (4, 0) to (5, 1), all sides of the triangle on them.
        let around = [
            [[-9.0, 4.0], [-9.0, 9.0]],
            [[5.0, 19.0], [-9.0, 9.0]],
            [[4.0, 5.0], [-9.0, 0.0]],
            [[4.0, 5.0], [1.0, 9.0]],
        ];
        let triangle = [[0.0, -5.0], [14.0, -4.0], [3.0, 8.0]];
        assert!(!surface(&around).covers(triangle));
        let filled: Vec<_> = around.into_iter().chain([[[4.0, 5.0], [0.0, 1.0]]]).collect();
        assert!(surface(&filled).covers(triangle));
    }

    #[test]
    fn no_triangle_of_nan_is_on_the_road() {
        let road = surface(&[[[0.0, 10.0], [-2.0, 2.0]]]);
        assert!(!road.covers([[f64::NAN, 0.0], [1.0, 0.0], [1.0, 1.0]]));
    }

    #[test]
    fn a_line_across_is_inside_between_the_bounds() {
        let lanelet =
            Lanelet::between(1, vec![[0.0, 2.0], [10.0, 3.0]], vec![[0.0, -2.0], [10.0, -2.0]]);
        let outline = Outline::new(&lanelet);
        assert_eq!(outline.along([5.0, 0.0], [0.0, 1.0], 9.0), [[-2.0, 2.5]]);
        assert_eq!(outline.along([5.0, 0.0], [0.0, 1.0], 1.0), [[-1.0, 1.0]]);
        assert_eq!(outline.along([11.0, 0.0], [0.0, 1.0], 9.0), [[0.0; 2]; 0]);
    }
}
