//! A drive in a small scene: the ego's body under plan and control.

use mufasa::input::cycle::{Ego, Track, TrackList, TrajectoryPoint};
use mufasa_sim::path::Path;
use mufasa_sim::pose::Pose;
use mufasa_sim::services::control::Controller;
use mufasa_sim::services::env::model::Environment;
use mufasa_sim::services::env::{Situation, environment};
use mufasa_sim::services::tpl::trajectory;
use mufasa_sim::vehicle::{Body, Motion};

use super::scene::ego_at;

/// Speed limit, m/s.
pub const LIMIT: f64 = 13.9;
pub const PLAN_NS: i64 = 50_000_000;
const STEPS: u32 = 5;

/// The ego on its path.
pub struct Drive<'a> {
    pub path: &'a Path,
    body: Body,
    pub motion: Motion,
    pub t_ns: i64,
    controller: Controller,
}

impl<'a> Drive<'a> {
    /// With the rear axle at a pose.
    pub fn new(path: &'a Path, rear: Pose, speed: f64) -> Self {
        let reference = ego_at(rear, speed);
        let (length, width) = (reference.length, reference.width);
        let body = Body { length, width, middle: reference.center_offset, ..Body::default() };
        let motion = Motion { rear, speed, acceleration: 0.0, steering: 0.0 };
        let controller = Controller::new(body);
        Self { path, body, motion, t_ns: 0, controller }
    }

    pub fn ego(&self) -> Ego {
        ego_at(self.motion.rear, self.motion.speed)
    }

    pub fn environment(&self, tracks: &[Track]) -> Environment {
        let situation = Situation {
            now_ns: self.t_ns,
            ego: self.ego(),
            path: self.path,
            near_s: None,
            stops: &[],
        };
        environment(&situation, &TrackList { stamp_ns: self.t_ns, items: tracks })
    }

    pub fn plan(&self, tracks: &[Track]) -> Vec<TrajectoryPoint> {
        let environment = self.environment(tracks);
        trajectory(self.t_ns, &self.ego(), self.path, &environment, &|_| LIMIT)
    }

    /// Follows points for the time between two plans.
    pub fn follow(&mut self, points: &[TrajectoryPoint]) {
        for _ in 0..STEPS {
            let ego = self.ego();
            let command = self.controller.command(&ego, points, self.t_ns);
            self.motion = self.body.step(&self.motion, command, 0.01);
            self.t_ns += PLAN_NS / i64::from(STEPS);
        }
    }
}
