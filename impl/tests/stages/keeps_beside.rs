//! Who keeps beside a route that bends, on both sides of each clause (H-14, `spec/hardened/H-14.md#requirements-not-examined`).
//! The CAV is that of `fail_safe`; it goes straight on, and the route bends to the left before it, behind
//! it, or both. What meets it would not, if it went along the route as it goes now.

use std::f64::consts::FRAC_PI_4;
use std::ops::{Add, Mul, Sub};

use crate::fail_safe::{AGE, moving, with};
use crate::scene::Scene;
use mufasa::input::cycle::{CrossSection, Track};
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::PlanRemote;

#[derive(Clone, Copy, Debug)]
struct V(f64, f64);

impl V {
    fn dot(self, other: Self) -> f64 {
        self.0 * other.0 + self.1 * other.1
    }
}

impl Add for V {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl Sub for V {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl Mul<f64> for V {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }
}

/// Corners of the CAV to its left: in front at the last place, and in the rear at the first one.
const FRONT: V = V(1.4 + 2.25 + 2.270_625, 0.95);
const REAR: V = V(1.4 - 2.25, 0.95);

/// A route along a circle to the left, in segments of about 1 m, from an angle to another one.
struct Bend {
    radius: f64,
    /// Segments before the CAV's place and after it.
    segments: [i32; 2],
}

impl Bend {
    /// Half the angle of a segment, which touches the circle in its middle.
    fn half(&self) -> f64 {
        0.5 / self.radius
    }

    /// From the middle of the circle to a place at an angle, so far within it.
    fn place(&self, angle: f64, inside: f64) -> V {
        let within = self.radius - inside;
        V(within * angle.sin(), self.radius - within * angle.cos())
    }

    fn cross_sections(&self) -> Vec<CrossSection> {
        let [before, after] = self.segments;
        let corner = |i: i32| {
            // Corners lie outside of the circle.
            let out = self.radius * (1.0 - 1.0 / self.half().cos());
            let at = |inside: f64| self.place((2.0 * f64::from(i) - 1.0) * self.half(), inside);
            let [V(x, y), left, right] = [out, 4.0, -4.0].map(at);
            CrossSection { x, y, left: [left.0, left.1], right: [right.0, right.1] }
        };
        (-before..=after).map(corner).collect()
    }

    /// The angle of the segment with that number; the CAV is at the middle of segment 0.
    fn angle(&self, segment: i32) -> f64 {
        2.0 * f64::from(segment) * self.half()
    }

    /// The first segment whose angle is at least so much.
    fn segment_at(&self, angle: f64) -> i32 {
        (angle / (2.0 * self.half())).ceil() as i32
    }

    /// Stage iv alone, with one track on this route.
    fn passes(&self, track: Track, change: impl Fn(&mut Scene)) -> bool {
        let mut scene = with(vec![track]);
        (scene.configuration, scene.detections) = (PlanRemote, Some(Vec::new()));
        scene.cross_sections = self.cross_sections();
        change(&mut scene);
        let failure = scene.failure_of_iv();
        assert!(failure.is_none_or(|it| it.rule == Rule::FailSafe), "{failure:?}");
        failure.is_none()
    }
}

/// Now there, pointed at an angle, and so fast along that, backwards if below 0.
fn going(V(x, y): V, angle: f64, speed: f64) -> Track {
    let (sin, cos) = angle.sin_cos();
    let (vx, vy) = (speed * cos, speed * sin);
    Track { sin, cos, ..moving(x - vx * AGE, y - vy * AGE, [vx, vy]) }
}

/// A long object along a segment that now reaches so much farther than to a corner of the CAV, with the
/// middle of its front, at that speed.
fn long(bend: &Bend, segment: i32, (corner, speed): (V, f64), farther: f64) -> Track {
    let angle = bend.angle(segment);
    let (along, middle) = (V(angle.cos(), angle.sin()), V(0.0, bend.radius));
    let half = (corner - middle).dot(along);
    let now = corner - along * half;
    Track { length: 2.0 * (half.abs() + farther), ..going(now, angle, speed) }
}

/// 30 m to 80 m long, and its centre in a lane of its own: what touches the CAV's rectangle at a place, here
/// the last one, is in its way, what does not goes on beside it.
#[test]
fn a_long_object_that_lies_across_the_way_does_not_keep_beside() {
    for (radius, angle, lengths) in
        [(40.0, 0.55, 30.0..40.0), (40.0, 0.74, 40.0..50.0), (60.0, 0.74, 65.0..80.0)]
    {
        let bend = Bend { radius, segments: [40, 80] };
        for (speed, farther, expected) in
            [(10.0, -1e-7, true), (10.0, 1e-7, false), (100.0, -1e-7, true), (100.0, 1e-7, false)]
        {
            let at = |corner: V| {
                let track = long(&bend, bend.segment_at(angle), (corner, -speed), farther);
                assert!(lengths.contains(&track.length), "{}", track.length);
                track
            };
            assert_eq!(bend.passes(at(FRONT), |_| ()), expected, "{radius} {angle} {speed}");
            // By a wider.
            let aside = |scene: &mut Scene| scene.points[0].y = 0.3;
            let wider = at(FRONT + V(0.0, 0.3));
            assert_eq!(bend.passes(wider, aside), expected, "{radius} {angle} {speed}");
            assert!(!bend.passes(at(FRONT), aside));
        }
    }
}

/// The same for who goes the CAV's way from behind, where the route bends as little as it may then: the
/// first place is one of those that count.
#[test]
fn a_long_object_behind_does_not_keep_beside_where_it_touches_the_cav() {
    for (angle, lengths) in [(-0.1, 55.0..65.0), (-0.12, 70.0..80.0)] {
        let bend = Bend { radius: 310.0, segments: [90, 60] };
        for (farther, expected) in [(-1e-7, true), (1e-7, false)] {
            let track = long(&bend, bend.segment_at(angle), (REAR, 10.0), farther);
            assert!(lengths.contains(&track.length), "{}", track.length);
            assert_eq!(bend.passes(track, |_| ()), expected, "{angle}");
        }
    }
}

/// A narrow one that comes towards the CAV, and along straight lines into it.
fn narrow(at: V, angle: f64) -> Track {
    Track { width: 0.4, ..going(at, angle, -20.0) }
}

/// What is far from the route keeps beside nothing that is known.
#[test]
fn nothing_keeps_beside_from_more_than_20_m_away() {
    let bend = Bend { radius: 100.0, segments: [40, 120] };
    let segment = bend.segment_at(0.69);
    for (off, expected) in [(-1e-7, true), (1e-7, false)] {
        let angle = bend.angle(segment);
        let track = narrow(bend.place(angle, 20.0 + off), angle);
        assert_eq!(bend.passes(track, |_| ()), expected, "{off}");
    }
}

/// Who comes straight towards the CAV may be in a bend of 30 m, who comes at more than 45 degrees not.
#[test]
fn who_comes_at_more_than_45_degrees_has_no_bend() {
    let bend = Bend { radius: 40.0, segments: [40, 60] };
    for (off, expected) in [(-1e-7, true), (1e-7, false)] {
        let angle = FRAC_PI_4 + off;
        let (along, aside) = (V(angle.cos(), angle.sin()), V(-angle.sin(), angle.cos()));
        let middle = V(0.0, bend.radius);
        let at = middle + aside * (FRONT - middle).dot(aside);
        assert!((along.dot(at - FRONT) - 23.0).abs() < 1.0, "{}", along.dot(at - FRONT));
        assert_eq!(bend.passes(narrow(at, angle), |_| ()), expected, "{off}");
    }
}
