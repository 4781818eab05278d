//! Whether the bounds of a lanelet are on their sides, as a whole and segment by segment.

use crate::geometry::{Point, add, cross, dot, norm, scale, sub};
use crate::readers::lanes::Lanelet;

/// Bounds that are on the wrong sides by no more than this meet there, m: bounds that touch are not
/// always the same to the last digit.
const TOUCH: f64 = 1e-3;
/// Longest way back that is taken as one of drawing, m; lanelet 7683 of BEL_Putte-3 has one, 43489 and 43491 of
/// USA_Peach-3 have others.
const HOOK: f64 = 0.5;

/// The left and the right bound between two points.
type Segment = [[Point; 2]; 2];

/// Where the left bound of a lanelet is not left of the right one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inversion {
    /// In the sum over the lanelet.
    Whole,
    /// In the segment from that point of the bounds to the next; the first such.
    Segment(usize),
}

/// What is wrong with the sides of a lanelet, if anything.
pub(crate) fn inversion(lanelet: &Lanelet) -> Option<Inversion> {
    let Lanelet { left, right, .. } = lanelet;
    let pairs = left.windows(2).zip(right.windows(2));
    let segments: Vec<Segment> = pairs.map(|(l, r)| [[l[0], l[1]], [r[0], r[1]]]).collect();
    let total: f64 = segments.iter().map(area).sum();
    if total.is_nan() || total <= 0.0 {
        return Some(Inversion::Whole);
    }
    let is_inverted = |i: usize| {
        do_cross(&segments[i]) || (is_on_the_wrong_side(&segments[i]) && !is_hook(&segments, i))
    };
    (0..segments.len()).find(|i| is_inverted(*i)).map(Inversion::Segment)
}

/// The signed area of a segment, m^2: positive where the left bound is left.
fn area([[l0, l1], [r0, r1]]: &Segment) -> f64 {
    cross(sub(*r1, *l0), sub(*l1, *r0)) / 2.0
}

/// Whether the bounds go the same way on the wrong sides. Where one goes ahead and the other back, the line
/// across turns: that is how sharp bends and skew ends are drawn.
fn is_on_the_wrong_side(segment: &Segment) -> bool {
    let [left, right] = segment.map(|[a, b]| sub(b, a));
    dot(left, right) > 0.0 && area(segment) < -TOUCH * norm(way(segment))
}

/// Whether both bounds turn back for a short way, as maps have it where lanelets meet.
fn is_hook(segments: &[Segment], i: usize) -> bool {
    let own = way(&segments[i]);
    let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten();
    let turns = beside.filter_map(|at| segments.get(at)).any(|it| dot(way(it), own) < 0.0);
    turns && norm(own) <= HOOK
}

/// The way in the middle of a segment.
fn way(segment: &Segment) -> Point {
    let [left, right] = segment.map(|[a, b]| sub(b, a));
    scale(add(left, right), 0.5)
}

/// Whether two segments cross, the ends of each on both sides of the other and none just touching it.
fn do_cross([left, right]: &Segment) -> bool {
    let sides = |[a, b]: &[Point; 2], points: &[Point; 2]| {
        let way = sub(*b, *a);
        points.map(|p| cross(way, sub(p, *a)) / norm(way))
    };
    // NaN, of a segment without length, is on no side.
    [sides(left, right), sides(right, left)]
        .iter()
        .all(|[p, q]| (*p > TOUCH && *q < -TOUCH) || (*p < -TOUCH && *q > TOUCH))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The inversion of a lanelet whose bounds are at these y, every 10 m along x.
    fn of(bounds: &[[f64; 2]]) -> Option<Inversion> {
        let bound = |side: usize| {
            let points = (0_u32..).zip(bounds).map(|(i, y)| [f64::from(i) * 10.0, y[side]]);
            points.collect::<Vec<Point>>()
        };
        inversion(&Lanelet::between(1, bound(0), bound(1)))
    }

    #[test]
    fn bounds_that_swap_are_inverted_where_they_cross() {
        let [plain, swapped] = [[2.0, -2.0], [-2.0, 2.0]];
        assert_eq!(of(&[plain; 4]), None);
        assert_eq!(of(&[swapped; 4]), Some(Inversion::Whole));
        let back = [plain, plain, plain, swapped, swapped, plain, plain, plain];
        assert_eq!(of(&back), Some(Inversion::Segment(2)));
        // In one segment and no more.
        assert_eq!(of(&[plain, plain, plain, [-0.1, 0.1]]), Some(Inversion::Segment(2)));
        // Through a point that they share.
        let tip = [0.0, 0.0];
        assert_eq!(of(&[plain, plain, tip, [-0.1, 0.1], tip]), Some(Inversion::Segment(2)));
    }

    #[test]
    fn bounds_that_touch_are_on_their_sides() {
        let [plain, tip] = [[2.0, -2.0], [0.0, 0.0]];
        assert_eq!(of(&[tip, plain, plain, tip, tip]), None);
        assert_eq!(of(&[tip, plain, tip, plain]), None);
        assert_eq!(of(&[plain, plain, [-1e-4, 1e-4], [-4e-4, 4e-4]]), None);
        let point = [1.0, 2.0];
        let twice = Lanelet::between(
            1,
            vec![point, point, [9.0, 2.0]],
            vec![[1.0, 0.0], [1.0, 0.0], [9.0, 0.0]],
        );
        assert_eq!(inversion(&twice), None);
    }

    #[test]
    fn a_line_across_may_turn() {
        // The right bound goes back a bit in the last segment, farther than the left one goes on.
        let left = vec![[0.0, 2.0], [10.0, 2.0], [10.1, 2.0]];
        let right = vec![[0.0, -2.0], [10.0, -2.0], [9.7, -2.0]];
        assert_eq!(inversion(&Lanelet::between(1, left.clone(), right)), None);
        // Both turn back, a bit or farther.
        let back = |y: f64, x: f64| vec![[0.0, y], [10.0, y], [x, y]];
        let hook = |x: f64| inversion(&Lanelet::between(1, back(2.0, x + 0.1), back(-2.0, x)));
        assert_eq!((hook(9.7), hook(9.0)), (None, Some(Inversion::Segment(1))));
    }
}
