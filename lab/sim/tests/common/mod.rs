//! A stand-in for the ego's services: it sees everything, follows its route and keeps its distance.

pub mod maps;

use mufasa_sim::traffic::ahead;
use mufasa_sim::traffic::idm::Idm;
use mufasa_sim::vehicle::Command;
use mufasa_sim::world::World;

/// Steering that leads the rear axle to a point of the route ahead, and the driver model.
pub fn drive(world: &World) -> Command {
    let snapshot = world.snapshot();
    let route = world.route();
    let ego = snapshot.ego;
    let look = 3.0 + 0.4 * ego.speed;
    let seen = route.path.project_within(ego.rear.at, ego.s - 6.0, ego.s + 2.0);
    let (x, y) = ego.rear.local(route.path.pose_at(seen.s + look).at);
    let steering = libm::atan(world.body().wheelbase * 2.0 * y / (x * x + y * y));
    let driver = Idm { v0: route.pace_at(ego.s), ..Idm::default() };
    let mut acceleration = driver.free(ego.speed);
    if let Some(ahead) = ahead::nearest(world.agents(), 0, route, 80.0) {
        acceleration = acceleration.min(driver.behind(ego.speed, ahead.gap, ahead.speed));
    }
    if let Some(stop) = snapshot.stops.first() {
        let gap = stop.s - ego.s - ego.rectangle.length / 2.0;
        if gap < 6.0 + ego.speed + ego.speed * ego.speed / 3.0 {
            acceleration = acceleration.min(driver.behind(ego.speed, gap, 0.0));
        }
    }
    Command { acceleration, steering }
}
