//! Plane geometry of the readers, in doubles: nothing here decides a verdict.

/// A point or a vector, m.
pub(crate) type Point = [f64; 2];

pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn scale(a: Point, k: f64) -> Point {
    [a[0] * k, a[1] * k]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn norm(a: Point) -> f64 {
    a[0].hypot(a[1])
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    norm(sub(a, b))
}

/// Between `a` (w = 0) and `b` (w = 1).
pub(crate) fn mix(a: Point, b: Point, w: f64) -> Point {
    [a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])]
}

pub(crate) fn direction(angle: f64) -> Point {
    [angle.cos(), angle.sin()]
}

/// The angle in (-pi, pi].
pub(crate) fn wrap(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}

/// An angle between two, by the shorter way round.
pub(crate) fn mix_angle(a: f64, b: f64, w: f64) -> f64 {
    a + w * wrap(b - a)
}

/// The foot of a point on a segment: how far along (0 to 1), and where.
pub(crate) fn foot(p: Point, a: Point, b: Point) -> (f64, Point) {
    let u = sub(b, a);
    let square = dot(u, u);
    let w = if square > 0.0 { (dot(sub(p, a), u) / square).clamp(0.0, 1.0) } else { 0.0 };
    (w, mix(a, b, w))
}

/// Whether a point is inside a simple polygon (even-odd rule).
pub(crate) fn inside(p: Point, polygon: &[Point]) -> bool {
    let mut odd = false;
    let mut a = match polygon.last() {
        Some(last) => *last,
        None => return false,
    };
    for &b in polygon {
        if (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        {
            odd = !odd;
        }
        a = b;
    }
    odd
}

/// A rectangle: centre, direction of its length, length and width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    pub center: Point,
    pub heading: f64,
    pub length: f64,
    pub width: f64,
}

impl Rectangle {
    /// The corners, counter-clockwise.
    pub(crate) fn corners(&self) -> [Point; 4] {
        let [c, s] = direction(self.heading);
        let (a, b) = (self.length / 2.0, self.width / 2.0);
        [[a, b], [-a, b], [-a, -b], [a, -b]]
            .map(|[x, y]| add(self.center, [x * c - y * s, x * s + y * c]))
    }

    /// Whether two rectangles share a point: no side of either has all of the other beyond it.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let apart = |a: &Self, b: &Self| {
            let turned = Self::around(&b.corners(), a.heading);
            let [c, s] = direction(a.heading);
            let [x, y] = sub(turned.center, a.center);
            (x * c + y * s).abs() > f64::midpoint(a.length, turned.length)
                || (y * c - x * s).abs() > f64::midpoint(a.width, turned.width)
        };
        !apart(self, other) && !apart(other, self)
    }

    /// The bounding rectangle of points in the direction of `heading`.
    pub(crate) fn around(points: &[Point], heading: f64) -> Self {
        let [c, s] = direction(heading);
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for p in points {
            let q = [p[0] * c + p[1] * s, p[1] * c - p[0] * s];
            for i in 0..2 {
                low[i] = low[i].min(q[i]);
                high[i] = high[i].max(q[i]);
            }
        }
        let m = mix(low, high, 0.5);
        Self {
            center: [m[0] * c - m[1] * s, m[0] * s + m[1] * c],
            heading,
            length: high[0] - low[0],
            width: high[1] - low[1],
        }
    }

    /// The smallest of the bounding rectangles along the sides of a polygon.
    pub(crate) fn smallest_around(points: &[Point]) -> Option<Self> {
        let next = points.iter().cycle().skip(1);
        let sides = points.iter().zip(next).map(|(a, b)| sub(*b, *a)).filter(|u| norm(*u) > 1e-6);
        sides
            .map(|u| Self::around(points, u[1].atan2(u[0])))
            .min_by(|a, b| (a.length * a.width).total_cmp(&(b.length * b.width)))
    }
}

/// A line through points with the arc length at each.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polyline {
    pub points: Vec<Point>,
    pub arc: Vec<f64>,
}

/// The place on a line nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foot {
    /// Arc length, m.
    pub s: f64,
    /// Distance, m; positive when the point is left of the line.
    pub lateral: f64,
    /// Direction of the line there.
    pub tangent: Point,
}

impl Polyline {
    pub(crate) fn new(points: Vec<Point>) -> Self {
        let mut arc = Vec::with_capacity(points.len());
        let mut s = 0.0;
        for (i, p) in points.iter().enumerate() {
            if i > 0 {
                s += distance(points[i - 1], *p);
            }
            arc.push(s);
        }
        Self { points, arc }
    }

    pub(crate) fn length(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// The segment that holds arc length `s`, and how far along it (0 to 1); ends are clamped.
    /// The line must have two points at least.
    pub(crate) fn locate(&self, s: f64) -> (usize, f64) {
        let last = self.arc.len().saturating_sub(2);
        let i = self.arc.partition_point(|x| *x <= s).saturating_sub(1).min(last);
        let span = self.arc[i + 1] - self.arc[i];
        let w = if span > 0.0 { ((s - self.arc[i]) / span).clamp(0.0, 1.0) } else { 0.0 };
        (i, w)
    }

    /// The nearest place to a point; `None` for a line of less than two points.
    pub(crate) fn project(&self, p: Point) -> Option<Foot> {
        let mut best: Option<(f64, Foot)> = None;
        for (i, pair) in self.points.windows(2).enumerate() {
            let u = sub(pair[1], pair[0]);
            let n = norm(u);
            if n <= 0.0 {
                continue;
            }
            let (w, q) = foot(p, pair[0], pair[1]);
            let d = distance(p, q);
            if best.is_none_or(|(b, _)| d < b) {
                let side = if cross(u, sub(p, pair[0])) < 0.0 { -d } else { d };
                let s = self.arc[i] + w * (self.arc[i + 1] - self.arc[i]);
                best = Some((d, Foot { s, lateral: side, tangent: scale(u, 1.0 / n) }));
            }
        }
        best.map(|(_, foot)| foot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_found_on_both_sides_of_a_corner() {
        let line = Polyline::new(vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]);
        let left = line.project([4.0, 1.0]).unwrap();
        assert_eq!((left.s, left.lateral), (4.0, 1.0));
        let right = line.project([12.0, 5.0]).unwrap();
        assert_eq!((right.s, right.lateral, right.tangent), (15.0, -2.0, [0.0, 1.0]));
        assert_eq!(line.locate(15.0), (1, 0.5));
        assert_eq!(line.locate(-1.0), (0, 0.0));
        assert_eq!(line.locate(99.0), (1, 1.0));
    }

    #[test]
    fn the_smallest_rectangle_of_a_turned_square_is_the_square() {
        let square = Rectangle { center: [3.0, -2.0], heading: 0.4, length: 2.0, width: 2.0 };
        let found = Rectangle::smallest_around(&square.corners()).unwrap();
        assert!((found.length - 2.0).abs() < 1e-9 && (found.width - 2.0).abs() < 1e-9);
        assert!(distance(found.center, square.center) < 1e-9);
        assert!(inside([3.0, -2.0], &square.corners()));
        assert!(!inside([3.0, -0.5], &square.corners()));
    }

    #[test]
    fn rectangles_meet_where_they_share_a_point() {
        let at = |x: f64, y: f64, heading: f64| {
            let center = [x, y];
            Rectangle { center, heading, length: 4.0, width: 2.0 }
        };
        assert!(at(0.0, 0.0, 0.0).meets(&at(3.9, 0.0, 0.0)));
        assert!(!at(0.0, 0.0, 0.0).meets(&at(4.1, 0.0, 0.0)));
        // Corner to corner the bounding rectangles overlap, the rectangles do not.
        assert!(!at(0.0, 0.0, 0.8).meets(&at(2.2, -2.2, 0.8)));
        assert!(at(0.0, 0.0, 0.8).meets(&at(2.2, 2.2, 0.8)));
    }

    #[test]
    fn angles_are_mixed_by_the_shorter_way() {
        assert!((wrap(mix_angle(3.0, -3.0, 0.5)).abs() - std::f64::consts::PI).abs() < 1e-9);
    }
}
