//! How fast somebody goes along a way.

/// A speed, and accelerations one after the other; the last speed is kept.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    /// Until the first acceleration, and before the start, m/s.
    pub(super) speed: f64,
    /// For how long, s, and how much, m/s^2.
    pub(super) parts: Vec<(f64, f64)>,
}

impl Pace {
    /// How far one is after the start, m, and how fast, m/s.
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        let (mut way, mut speed, mut left) = (0.0, self.speed, t);
        for (duration, acceleration) in &self.parts {
            if left <= 0.0 {
                break;
            }
            let now = left.min(*duration);
            way += speed * now + acceleration * now * now / 2.0;
            speed = (speed + acceleration * now).max(0.0);
            left -= now;
        }
        (way + speed * left, speed)
    }

    /// The same up to a time, s, then a brake to a stop.
    pub(super) fn braking(&self, from: f64, deceleration: f64) -> Self {
        let mut parts = Vec::new();
        let mut left = from;
        for (duration, acceleration) in &self.parts {
            let now = duration.min(left);
            parts.push((now, *acceleration));
            left -= now;
        }
        let speed = self.at(from).1;
        parts.extend([(left, 0.0), (speed / deceleration, -deceleration), (f64::INFINITY, 0.0)]);
        Self { speed: self.speed, parts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_brake_ends_after_the_way_of_the_formula() {
        let pace = Pace { speed: 2.0, parts: vec![(1.0, 0.0), (4.0, 2.0)] };
        let (way, speed) = pace.braking(3.0, 8.0).at(20.0);
        assert!(speed.abs() < 1e-9, "{speed}");
        // Two seconds of speeding up from 2 m/s to 6 m/s, behind one at 2 m/s.
        assert!((way - (2.0 + 8.0 + 36.0 / 16.0)).abs() < 1e-9, "{way}");
    }
}
