//! Trajectories that end before `s_stop`, and what stands at the last place of the path
//! (`spec/hardened/H-14.md#requirements-the-path`).

use mufasa_model::input::cycle::{Cycle, Ego, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame, Obstacle, s_stop, seconds};
use super::draw::Draw;
use super::fail_safe::path::Path;

/// Whether the path of the cycle is examined beyond the end of its trajectory.
pub fn is_examined(cycle: &Cycle) -> bool {
    cycle.profile == Profile::HARDENED && cycle.configuration != Configuration::Local
}

/// The CAV stands at the end of a new trajectory, `missing` before `s_stop`.
pub fn shorten(draw: &mut Draw<'_>, cycle: &mut Cycle, missing: f64) {
    let ego = cycle.ego.clone();
    let ahead = draw.pick(&[0.0, 0.0, 0.5, -0.5, 1.75]);
    let stop = s_stop(cycle) + f64::max(ahead, 0.0);
    let length = (stop - missing).max(0.0);
    let road = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let plan = base::straight(&ego, road, cycle.now_ns, &cycle.parameters);
    let dt_ns = plan.points[1].t_ns - cycle.now_ns;
    let mut points = Vec::new();
    for t_ns in (0..).map(|i| i * dt_ns) {
        let driven = ego.speed * seconds(t_ns);
        let stands = driven >= length && seconds(t_ns) >= ego.speed / cycle.parameters.a_b;
        let along = if ego.speed > 0.0 || t_ns == 0 { driven.min(length) } else { length };
        let (x, y) = road.at(along - ahead, 0.0);
        let Frame { cos, sin, .. } = road;
        points.push(TrajectoryPoint { t_ns: cycle.now_ns + t_ns, x, y, cos, sin });
        if stands || t_ns > 0 && ego.speed == 0.0 {
            break;
        }
    }
    cycle.trajectory = Some(Trajectory { points, ..plan });
}

/// How much may be missing: nothing, a whole number of quarters, or anything up to L.
pub fn missing(draw: &mut Draw<'_>, ego: &Ego) -> f64 {
    match draw.below(4) {
        0 => draw.near(0.0),
        1 | 2 => {
            let quarters = draw.between(1, 4);
            draw.near(0.25 * quarters as f64 - ego.center_offset)
        }
        _ => draw.range(0.0, ego.length),
    }
}

/// Such a trajectory, and an object that touches the CAV's front at its last place, or just does not.
pub fn obstacle(draw: &mut Draw<'_>, cycle: &mut Cycle) -> Obstacle {
    let missing = missing(draw, &cycle.ego);
    shorten(draw, cycle, missing);
    let at = place(cycle);
    let size = draw.pick(&[(1.0, 3.0), (0.01, 0.01), (4.5, 1.8)]);
    let reach = draw.near(0.5 * (cycle.ego.length + size.0));
    let (x, y) = at.at(reach, 0.0);
    let frame = Frame { x, y, ..at };
    let points = cycle.trajectory.as_ref().map_or(0, |list| list.points.len());
    Obstacle { frame, size, point: points.saturating_sub(1), away: (at.cos, at.sin) }
}

/// The centre of the CAV at the last place.
pub fn place(cycle: &Cycle) -> Frame {
    let path = Path::of(cycle);
    path.body(cycle, path.places.len() - 1).frame
}
