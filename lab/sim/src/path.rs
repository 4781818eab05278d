//! A polyline that is travelled along: arc length, poses, projections and curvature.

use thiserror::Error;

use crate::pose::{Point, Pose};

/// Why points are no path.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PathError {
    /// A path needs two points; this many were given.
    #[error("a path needs two points; given: {0}")]
    TooFew(usize),
    /// The coordinates of the point with this index are not finite.
    #[error("point {0} is not finite")]
    NotFinite(usize),
    /// The point with this index lies on the one before it: drop it.
    #[error("point {0} repeats the one before it: drop it")]
    Repeated(usize),
}

/// A polyline with its arc length from the first point, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    points: Vec<Point>,
    /// Arc length of every point, and of the end of the last piece.
    lengths: Vec<f64>,
    /// Direction of every piece (cosine, sine).
    pieces: Vec<(f64, f64)>,
    /// Direction at every point, the middle of those of its two pieces.
    headings: Vec<(f64, f64)>,
}

/// Where a place lies beside a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Arc length of the nearest point of the path, m.
    pub s: f64,
    /// Signed distance of the place, left positive, m; before and behind the ends, that to the end's tangent.
    pub left: f64,
}

impl Path {
    /// A path through these points, m.
    ///
    /// # Errors
    /// Fewer than two points, one that is not finite, or one that repeats the point before it.
    pub fn new(points: Vec<Point>) -> Result<Self, PathError> {
        let count = points.len();
        if count < 2 {
            return Err(PathError::TooFew(count));
        }
        if let Some(index) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(PathError::NotFinite(index));
        }
        let mut lengths = vec![0.0];
        let mut pieces = Vec::new();
        for (index, pair) in points.windows(2).enumerate() {
            let direction = unit(pair[1].x - pair[0].x, pair[1].y - pair[0].y);
            pieces.push(direction.ok_or(PathError::Repeated(index + 1))?);
            lengths.push(lengths[index] + pair[0].distance(pair[1]));
        }
        let headings = (0..count).map(|index| heading(&pieces, index)).collect();
        Ok(Self { points, lengths, pieces, headings })
    }

    /// The same line with points evenly at about `spacing`, m.
    ///
    /// # Errors
    /// As `new`, for a spacing that is not above zero.
    pub fn resampled(&self, spacing: f64) -> Result<Self, PathError> {
        let length = self.length();
        let pieces = (length / spacing).round().clamp(3.0, 1e6);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most a million"
        )]
        let count = pieces as u32;
        let at = |i| self.pose_at(length * f64::from(i) / pieces).at;
        Self::new((0..=count).map(at).collect())
    }

    /// Arc length of the whole path, m.
    pub fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The points in order, m.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Arc lengths of the points in order, m.
    pub fn arc_lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The arc length held at the ends, m.
    pub fn wrap(&self, s: f64) -> f64 {
        s.clamp(0.0, self.length())
    }

    /// The piece on which an arc length lies, and the share of the piece before it, in [0, 1].
    pub fn locate(&self, s: f64) -> (usize, f64) {
        let s = self.wrap(s);
        let after = self.lengths.partition_point(|&at| at <= s);
        let piece = after.saturating_sub(1).min(self.pieces.len() - 1);
        let (from, to) = (self.lengths[piece], self.lengths[piece + 1]);
        (piece, ((s - from) / (to - from)).clamp(0.0, 1.0))
    }

    /// Place and direction at an arc length, m; the direction turns evenly between the points.
    pub fn pose_at(&self, s: f64) -> Pose {
        let (piece, share) = self.locate(s);
        let (from, to) = (self.points[piece], self.points[piece + 1]);
        let (a, b) = (self.headings[piece], self.headings[piece + 1]);
        let (cos, sin) = unit(a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share)
            .unwrap_or(self.pieces[piece]);
        Pose {
            at: Point::new(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share),
            cos,
            sin,
        }
    }

    /// The nearest point of the whole path.
    pub fn project(&self, place: Point) -> Projection {
        Self::found(self.nearest(place, 0, self.pieces.len(), f64::INFINITY))
    }

    /// The nearest point of the pieces that reach into [from, to], m: for a path that crosses or covers
    /// itself, and for speed.
    pub fn project_within(&self, place: Point, from: f64, to: f64) -> Projection {
        let (first, count) = self.window(from, to);
        Self::found(self.nearest(place, first, count, f64::INFINITY))
    }

    /// The same, if it is nearer than `near`, m: much faster when most places are not.
    pub fn project_near(&self, place: Point, from: f64, to: f64, near: f64) -> Option<Projection> {
        let (first, count) = self.window(from, to);
        self.nearest(place, first, count, near)
    }

    /// Curvature at an arc length, left positive, 1/m: the turn of the direction over the piece, by its length.
    pub fn curvature_at(&self, s: f64) -> f64 {
        let (piece, _) = self.locate(s);
        let (a, b) = (self.headings[piece], self.headings[piece + 1]);
        let turn = libm::atan2(a.0 * b.1 - a.1 * b.0, a.0 * b.0 + a.1 * b.1);
        turn / (self.lengths[piece + 1] - self.lengths[piece])
    }

    /// The first piece and the number of pieces of a stretch, m.
    fn window(&self, from: f64, to: f64) -> (usize, usize) {
        let (first, last) = (self.locate(from).0, self.locate(to).0);
        (first, last.saturating_sub(first) + 1)
    }

    /// With no bound something is nearest, but to a place that is not a number: the path's start then.
    fn found(nearest: Option<Projection>) -> Projection {
        nearest.unwrap_or(Projection { s: 0.0, left: f64::NAN })
    }

    /// The nearest point of `count` pieces from one on, if it is nearer than `bound`, m.
    fn nearest(&self, place: Point, first: usize, count: usize, bound: f64) -> Option<Projection> {
        let mut best = (bound * bound, None);
        let mut nearest = bound;
        // No point within this way of the last one can be nearer: a path comes no faster than its length.
        let mut way = 0.0;
        for offset in 0..count {
            let piece = first + offset;
            let length = self.lengths[piece + 1] - self.lengths[piece];
            if length < way {
                way -= length;
                continue;
            }
            let (from, (cos, sin)) = (self.points[piece], self.pieces[piece]);
            let (x, y) = (place.x - from.x, place.y - from.y);
            let ahead = (x * cos + y * sin).clamp(0.0, length);
            let (dx, dy) = (x - ahead * cos, y - ahead * sin);
            let square = dx * dx + dy * dy;
            if square < best.0 {
                let left = y * cos - x * sin;
                let is_end =
                    piece == 0 && ahead <= 0.0 || piece + 1 == self.pieces.len() && ahead >= length;
                // Outside of a bend the nearest point is a corner, and the distance to it is more than `left`.
                let left = if is_end { left } else { square.sqrt().copysign(left) };
                best = (square, Some(Projection { s: self.lengths[piece] + ahead, left }));
                nearest = square.sqrt();
                way = 0.0;
            } else {
                // Its end is at least that far; a micrometre for what rounding does.
                way = square.sqrt() - nearest - 1e-6;
            }
        }
        best.1
    }
}

/// The direction at a point: the middle of those of the pieces before and behind it.
fn heading(pieces: &[(f64, f64)], index: usize) -> (f64, f64) {
    let (before, behind) = (pieces[index.saturating_sub(1)], pieces[index.min(pieces.len() - 1)]);
    unit(before.0 + behind.0, before.1 + behind.1).unwrap_or(behind)
}

/// The vector at length one; none of one that has no direction.
fn unit(x: f64, y: f64) -> Option<(f64, f64)> {
    let length = (x * x + y * y).sqrt();
    (length > 1e-9).then(|| (x / length, y / length))
}
