//! The state of one track: a Kalman filter with constant velocity.

use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2, Vector4};

use crate::pose::Point;

/// Place and velocity (x, y, vx, vy) with their covariance, SI units.
#[derive(Clone, Debug)]
pub struct Filter {
    mean: Vector4<f64>,
    covariance: Matrix4<f64>,
}

/// What a filter expects to be detected.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    place: Vector2<f64>,
    inverse: Matrix2<f64>,
    log_determinant: f64,
}

impl Expected {
    /// Square of the Mahalanobis distance of a detected place, and minus twice its log likelihood but for a
    /// constant.
    pub fn distances(&self, place: Point) -> [f64; 2] {
        let off = Vector2::new(place.x, place.y) - self.place;
        let square = off.dot(&(self.inverse * off));
        [square, square + self.log_determinant]
    }
}

impl Filter {
    /// A filter after its first detection: the velocity is unknown, but for its standard deviation, m/s.
    pub fn new(place: Point, position_sigma: f64, speed_sigma: f64) -> Self {
        let (place_variance, speed_variance) =
            (position_sigma * position_sigma, speed_sigma * speed_sigma);
        let variances =
            Vector4::new(place_variance, place_variance, speed_variance, speed_variance);
        Self {
            mean: Vector4::new(place.x, place.y, 0.0, 0.0),
            covariance: Matrix4::from_diagonal(&variances),
        }
    }

    /// Moves on by a time, s; `acceleration_sigma`: of an acceleration that is constant over it, m/s^2.
    pub fn predict(&mut self, dt: f64, acceleration_sigma: f64) {
        let mut step = Matrix4::identity();
        (step[(0, 2)], step[(1, 3)]) = (dt, dt);
        let variance = acceleration_sigma * acceleration_sigma;
        let place = dt * dt / 2.0;
        self.mean = step * self.mean;
        self.covariance = step * self.covariance * step.transpose();
        for axis in 0..2 {
            self.covariance[(axis, axis)] += place * place * variance;
            self.covariance[(axis, axis + 2)] += place * dt * variance;
            self.covariance[(axis + 2, axis)] += place * dt * variance;
            self.covariance[(axis + 2, axis + 2)] += dt * dt * variance;
        }
    }

    /// What it expects of a detection with errors of this standard deviation, m.
    pub fn expected(&self, sigma: f64) -> Expected {
        let covariance = self.of_detection(sigma);
        let determinant = covariance.determinant();
        let [a, b, c, d] = [(1, 1), (0, 1), (1, 0), (0, 0)].map(|at| covariance[at] / determinant);
        Expected {
            place: self.mean.fixed_rows::<2>(0).into(),
            inverse: Matrix2::new(a, -b, -c, d),
            log_determinant: libm::log(determinant),
        }
    }

    /// Takes a detected place into account, with errors of this standard deviation, m.
    pub fn update(&mut self, place: Point, sigma: f64) {
        let Expected { place: expected, inverse, .. } = self.expected(sigma);
        let to_place: Matrix2x4<f64> = Matrix2x4::identity();
        let gain = self.covariance * to_place.transpose() * inverse;
        self.mean += gain * (Vector2::new(place.x, place.y) - expected);
        let rest = Matrix4::identity() - gain * to_place;
        // Joseph's form: symmetric and positive whatever is rounded.
        self.covariance =
            rest * self.covariance * rest.transpose() + gain * gain.transpose() * (sigma * sigma);
    }

    /// Where it is, m.
    pub fn place(&self) -> Point {
        Point::new(self.mean[0], self.mean[1])
    }

    /// Velocity, m/s.
    pub fn velocity(&self) -> Point {
        Point::new(self.mean[2], self.mean[3])
    }

    /// Square of the Mahalanobis distance of the velocity from standing still.
    pub fn moving(&self) -> f64 {
        let velocity = Vector2::new(self.mean[2], self.mean[3]);
        let covariance: Matrix2<f64> = self.covariance.fixed_view::<2, 2>(2, 2).into();
        let determinant = covariance.determinant();
        let [a, b, c, d] = [(1, 1), (0, 1), (1, 0), (0, 0)].map(|at| covariance[at] / determinant);
        velocity.dot(&(Matrix2::new(a, -b, -c, d) * velocity))
    }

    /// The larger standard deviation of the two coordinates, m.
    pub fn position_sigma(&self) -> f64 {
        self.covariance[(0, 0)].max(self.covariance[(1, 1)]).sqrt()
    }

    fn of_detection(&self, sigma: f64) -> Matrix2<f64> {
        let covariance: Matrix2<f64> = self.covariance.fixed_view::<2, 2>(0, 0).into();
        covariance + Matrix2::identity() * (sigma * sigma)
    }
}
