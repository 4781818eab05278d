//! Points, poses and rectangles of the plane: metres, x east, y north, angles from x towards y.

/// A point or a vector, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// East, m.
    pub x: f64,
    /// North, m.
    pub y: f64,
}

impl Point {
    /// A point at these coordinates, m.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Distance to another, m.
    pub fn distance(self, other: Self) -> f64 {
        let (x, y) = (other.x - self.x, other.y - self.y);
        (x * x + y * y).sqrt()
    }
}

/// A place and a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Place, m.
    pub at: Point,
    /// Cosine of the heading.
    pub cos: f64,
    /// Sine of the heading.
    pub sin: f64,
}

impl Pose {
    /// A pose that looks along an angle, rad.
    pub fn new(at: Point, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { at, cos, sin }
    }

    /// The heading, rad, in (-pi, pi].
    pub fn angle(self) -> f64 {
        libm::atan2(self.sin, self.cos)
    }

    /// The same place, turned left by an angle with this cosine and sine; its direction keeps length one.
    pub fn turned(self, cos: f64, sin: f64) -> Self {
        let (x, y) = (self.cos * cos - self.sin * sin, self.sin * cos + self.cos * sin);
        let length = (x * x + y * y).sqrt();
        Self { at: self.at, cos: x / length, sin: y / length }
    }

    /// A place given ahead and to the left of this one, m.
    pub fn ahead(self, ahead: f64, left: f64) -> Point {
        Point::new(
            self.at.x + ahead * self.cos - left * self.sin,
            self.at.y + ahead * self.sin + left * self.cos,
        )
    }

    /// How far ahead and to the left a place is, m.
    pub fn local(self, place: Point) -> (f64, f64) {
        let (x, y) = (place.x - self.at.x, place.y - self.at.y);
        (x * self.cos + y * self.sin, y * self.cos - x * self.sin)
    }
}

/// A rectangle around the middle of its pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Its middle and its direction.
    pub pose: Pose,
    /// Size along the direction, m.
    pub length: f64,
    /// Size across it, m.
    pub width: f64,
}
