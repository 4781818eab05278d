//! How far the CAV is when: its speed simulated forward.

use mufasa::input::cycle::Ego;

use crate::path::Path;
use crate::services::env::model::{Crossing, Environment, Leading};
use crate::services::tpl::bends::Bends;
use crate::services::tpl::settings::{
    ACCELERATION, BRAKING, CROSSING, HEADWAY, POINTS, STANDING_GAP, STEP_S, STOP_MARGIN,
};
use crate::vehicle::A_B;

/// Ways from the CAV's place now along the path, m, one for each point of a trajectory.
///
/// Whoever crosses is given way when the CAV would be in the same stretch at about the same time: then it
/// stops before that stretch.
pub(super) fn speed_profile(
    ego: &Ego,
    path: &Path,
    environment: &Environment,
    limit: &impl Fn(f64) -> f64,
) -> Vec<f64> {
    let front = ego.center_offset + ego.length / 2.0;
    let rear = ego.length / 2.0 - ego.center_offset;
    let bends = Bends::new(path, environment.s, ego.speed, limit);
    let mut laws = Laws {
        bends: &bends,
        lead: environment.lead.map(|lead| Leading { ahead: lead.ahead - front, ..lead }),
        stops: environment.stops.iter().map(|way| way - front - STOP_MARGIN).collect(),
    };
    let mut given_way = vec![false; environment.crossings.len()];
    loop {
        let ways = laws.simulate(ego.speed);
        let conflict = environment
            .crossings
            .iter()
            .zip(&mut given_way)
            .find(|(crossing, given)| !**given && meets(&ways, crossing, front, rear));
        let Some((crossing, given)) = conflict else { return ways };
        *given = true;
        laws.stops.push(crossing.ways[0] - front - CROSSING.0);
    }
}

/// Whether the CAV is in the stretch of a crossing at about the same time.
fn meets(ways: &[f64], crossing: &Crossing, front: f64, rear: f64) -> bool {
    let margin = CROSSING;
    // Who is in the stretch before the other leaves it, and does not stop there.
    if crossing.ways[0] <= front && crossing.time[0] > 0.0 {
        return false;
    }
    let [near, far] = [crossing.ways[0] - margin.0, crossing.ways[1] + margin.0];
    let [first, last] = [crossing.time[0] - margin.1, crossing.time[1] + margin.1];
    (0_u32..).zip(ways).any(|(index, way)| {
        let t = f64::from(index) * STEP_S;
        first <= t && t <= last && way + front >= near && way - rear <= far
    })
}

/// What limits the acceleration.
struct Laws<'a> {
    bends: &'a Bends,
    /// `ahead` from the front edge.
    lead: Option<Leading>,
    /// How far the reference point may go, m.
    stops: Vec<f64>,
}

/// Steps of the simulation between two points.
const SUBSTEPS: u32 = 2;

impl Laws<'_> {
    fn simulate(&self, speed: f64) -> Vec<f64> {
        let dt = STEP_S / f64::from(SUBSTEPS);
        let (mut way, mut speed, mut t) = (0.0, speed, 0.0);
        let mut ways = Vec::with_capacity(POINTS);
        for _ in 0..POINTS {
            ways.push(way);
            for _ in 0..SUBSTEPS {
                let acceleration = self.acceleration(way, speed, t);
                let next = (speed + acceleration * dt).max(0.0);
                // Who comes to a stop within the step stops at its braking distance.
                let moved = if next > 0.0 || acceleration >= 0.0 {
                    f64::midpoint(speed, next) * dt
                } else {
                    speed * speed / (-2.0 * acceleration)
                };
                (way, speed, t) = (way + moved, next, t + dt);
            }
        }
        ways
    }

    /// The hardest of all laws.
    fn acceleration(&self, way: f64, speed: f64, t: f64) -> f64 {
        // In half a second at the speed of the place where the CAV will be then.
        let allowed = self.bends.at(way + 0.5 * speed);
        let free = ((allowed - speed) / 0.5).clamp(-BRAKING, ACCELERATION);
        let lead = self.lead.map_or(f64::INFINITY, |lead| {
            Self::behind(lead.ahead + lead.speed * t - way, speed, lead.speed)
        });
        let stops = self.stops.iter().map(|stop| Self::before(stop - way, speed));
        stops.fold(free.min(lead), f64::min).max(-A_B)
    }

    /// Behind the leading vehicle: the intelligent driver model; harder below `s_follow`, and as hard as it
    /// takes where braking comfortably is not enough.
    fn behind(gap: f64, speed: f64, lead: f64) -> f64 {
        let comfort = 2.0 * (ACCELERATION * BRAKING).sqrt();
        let closing = speed * (speed - lead) / comfort;
        let wanted = STANDING_GAP + (speed * HEADWAY + closing).max(0.0);
        let share = wanted / gap.max(0.1);
        let model = ACCELERATION * (1.0 - share * share);
        let model = model.max(-BRAKING);
        let s_b = |speed: f64| speed * speed / (2.0 * A_B);
        let s_follow = (s_b(speed) - s_b(lead)).max(0.0) + 1.8 * speed;
        let follow = if gap <= s_follow + 1.0 { -1.4 * BRAKING } else { f64::INFINITY };
        let closed = (speed * speed - lead * lead).max(0.0);
        let needed = closed / (2.0 * (gap - STANDING_GAP / 2.0).max(0.05));
        let needed = if needed > BRAKING { -needed } else { f64::INFINITY };
        let crash = if gap <= 0.5 && speed > 0.0 { -A_B } else { f64::INFINITY };
        model.min(follow).min(needed).min(crash)
    }

    /// Before a place to stop at: evenly, once that takes a comfortable deceleration.
    fn before(rest: f64, speed: f64) -> f64 {
        let needed = speed * speed / (2.0 * rest.max(0.02));
        if rest <= 0.02 {
            // There or past it: it stays, or brakes as hard as it can.
            return if speed > 0.3 { -A_B } else { -BRAKING };
        }
        if needed >= 0.8 * BRAKING { -needed } else { f64::INFINITY }
    }
}
