//! The ego as a body: a kinematic bicycle with limits and lags.

use crate::pose::{Pose, Rectangle};

/// The hardest braking of this simulated CAV, and its `a_b`, m/s^2.
pub const A_B: f64 = 8.0;
/// `tau` as A-07 of `docs/assumptions.md` asks for it here, s: 0.1 until the next cycle, 0.04 until it is decided, 0.1
/// until the CAV's own planner answers.
pub const TAU_S: f64 = 0.25;

/// What a controller asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Along the road, m/s^2.
    pub acceleration: f64,
    /// Angle of the front wheels, left positive, rad.
    pub steering: f64,
}

/// Size and limits of the ego. The default is the car of the institute's simulation
/// (uulm-mrm/tpl, `SimEgo`), without its lags.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// m.
    pub length: f64,
    /// m.
    pub width: f64,
    /// Between the axles, m.
    pub wheelbase: f64,
    /// From the rear axle to the middle of the rectangle, m.
    pub middle: f64,
    /// Hardest braking, below zero, m/s^2.
    pub acceleration_min: f64,
    /// m/s^2.
    pub acceleration_max: f64,
    /// Either way, rad.
    pub steering_max: f64,
    /// Either way, rad/s.
    pub steering_rate: f64,
}

impl Default for Body {
    fn default() -> Self {
        Self {
            length: 5.1,
            width: 1.89,
            wheelbase: 3.165,
            middle: 5.1 / 2.0 - 1.0825,
            acceleration_min: -A_B,
            acceleration_max: 3.0,
            steering_max: 0.71,
            steering_rate: 0.6,
        }
    }
}

/// Where the ego is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The middle of the rear axle.
    pub rear: Pose,
    /// Never below zero, m/s.
    pub speed: f64,
    /// In force, m/s^2.
    pub acceleration: f64,
    /// In force, rad.
    pub steering: f64,
}

impl Body {
    /// At rest wheels, with the middle of the rectangle at a pose.
    pub fn at(&self, middle: Pose, speed: f64) -> Motion {
        let rear = Pose { at: middle.ahead(-self.middle, 0.0), ..middle };
        Motion { rear, speed, acceleration: 0.0, steering: 0.0 }
    }

    /// The rectangle.
    pub fn rectangle(&self, motion: &Motion) -> Rectangle {
        let pose = Pose { at: motion.rear.ahead(self.middle, 0.0), ..motion.rear };
        Rectangle { pose, length: self.length, width: self.width }
    }

    /// Turn of the heading, left positive, rad/s.
    pub fn yaw_rate(&self, motion: &Motion) -> f64 {
        motion.speed * libm::tan(motion.steering) / self.wheelbase
    }

    /// The motion after `time`, s. A command is held to the limits; of one that is not a number, the
    /// acceleration is full braking and the steering stays as it is.
    pub fn step(&self, motion: &Motion, command: Command, time: f64) -> Motion {
        let wanted = if command.acceleration.is_nan() {
            self.acceleration_min
        } else {
            command.acceleration
        };
        let acceleration = wanted.clamp(self.acceleration_min, self.acceleration_max);
        let wanted = if command.steering.is_nan() { motion.steering } else { command.steering };
        let wanted = wanted.clamp(-self.steering_max, self.steering_max);
        let most = self.steering_rate * time;
        let steering = wanted.clamp(motion.steering - most, motion.steering + most);
        let speed = motion.speed + acceleration * time;
        // It stops within the step and does not roll back.
        let way = if speed >= 0.0 {
            f64::midpoint(motion.speed, speed) * time
        } else {
            motion.speed * motion.speed / (-2.0 * acceleration)
        };
        let turn = way * libm::tan(steering) / self.wheelbase;
        // An arc: its chord lies at half the turn.
        let chord =
            if turn.abs() < 1e-9 { way } else { way * libm::sin(turn / 2.0) / (turn / 2.0) };
        let (half_sin, half_cos) = libm::sincos(turn / 2.0);
        let rear = motion.rear;
        let across = rear.turned(half_cos, half_sin);
        let ahead = Pose { at: rear.at, ..across }.ahead(chord, 0.0);
        let (sin, cos) = libm::sincos(turn);
        Motion {
            rear: Pose { at: ahead, ..rear.turned(cos, sin) },
            speed: speed.max(0.0),
            acceleration,
            steering,
        }
    }
}
