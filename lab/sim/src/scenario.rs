//! How a run begins: the ego's route, who else is there, and who crosses when.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::map::Town;
use crate::map::route::Route;
use crate::pose::{Point, Rectangle};
use crate::traffic::idm::Idm;
pub use crate::traffic::start::{Halt, Start};

/// A start of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Index of the ego's route, one with a task.
    pub ego_route: usize,
    /// Where the middle of the ego starts on it, m.
    pub ego_s: f64,
    /// m/s.
    pub ego_speed: f64,
    /// Vehicles.
    pub actors: Vec<Start>,
    /// People who cross, in order of their times.
    pub walkers: Vec<Walk>,
    /// Where in their cycle the signals are at the start, s: one time for all groups, which keep out of
    /// each other's way.
    pub signal_offset: f64,
    /// Whether a vehicle that reaches the end of its route is followed by a new one elsewhere.
    pub refill: bool,
    /// The time within which the ego is to arrive, s.
    pub time_limit: f64,
}

/// Somebody who wants to cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// When they come to the kerb, s.
    pub time: f64,
    /// Index of the route across.
    pub route: usize,
}

/// Length, width, and how many of twenty vehicles are of this size.
const SIZES: [(f64, f64, u32); 5] =
    [(4.1, 1.75, 6), (4.6, 1.82, 7), (5.0, 1.9, 4), (6.2, 2.1, 2), (12.0, 2.5, 1)];
/// Longer vehicles take no bends that are sharper than this, 1/m.
const LONG: (f64, f64) = (7.0, 1.0 / 30.0);
/// Free road between two vehicles at the start, m.
const FREE: f64 = 6.0;
/// Places ahead of a vehicle that came with the map that are kept free, m.
const AHEAD: [f64; 6] = [0.0, 5.0, 10.0, 15.0, 20.0, 25.0];

impl Scenario {
    /// A random start: `vehicles` (fewer when no free place was found) on all roads, in about four of five
    /// draws one of them ahead of the ego on its lane, which at times stops for a while;
    /// people at the crossings; signals at a random time of their cycle. Where a start comes with the map, every
    /// second draw begins with that, and with as many of its vehicles. The same for the same seed.
    pub fn draw(town: &Town, ego_route: usize, vehicles: usize, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let route = &town.routes[ego_route];
        let given = town.given.starts.iter().find(|it| it.ego_route == ego_route);
        let given = given.filter(|_| random.random_bool(0.5));
        let start = route.task.map_or(0.0, |task| task.start);
        let (ego_s, ego_speed) =
            given.map_or((start, 0.7 * route.pace_at(start)), |it| (it.ego_s, it.ego_speed));
        let mut placed = Placed { places: Vec::new() };
        placed.add(route, ego_s, 5.1, 1.89);
        let mut actors: Vec<Start> =
            given.iter().flat_map(|it| &it.actors).take(vehicles).cloned().collect();
        // They drive as they are given: nobody is put so near ahead of them that they would have to be slower.
        let ego = given.map(|_| (ego_route, ego_s));
        for (index, s) in actors.iter().map(|it| (it.route, it.s)).chain(ego) {
            for ahead in AHEAD {
                placed.add(&town.routes[index], s + ahead, 5.1, 2.0);
            }
        }
        let given = actors.len();
        if vehicles > given && random.random_bool(0.8) {
            actors.extend(lead(&mut random, town, (ego_route, ego_s), &mut placed));
        }
        let roads: Vec<usize> = town.roads().collect();
        // A town can be full: each vehicle has twenty tries on the average.
        for _ in 0..20 * vehicles {
            if actors.len() >= vehicles {
                break;
            }
            let index = roads[random.random_range(0..roads.len())];
            let route = &town.routes[index];
            let s = random.random_range(5.0..(route.path.length() - 30.0).max(6.0));
            let (length, width) = size(&mut random, route);
            if waits_before(route, s, length) && placed.is_free(route, s, length, width) {
                placed.add(route, s, length, width);
                actors.push(vehicle(&mut random, town, (index, s), (length, width)));
            }
        }
        let mut scenario = Self {
            ego_route,
            ego_s,
            ego_speed,
            actors,
            walkers: walkers(&mut random, town),
            signal_offset: offset(&mut random, town),
            refill: true,
            time_limit: 120.0,
        };
        scenario.slow_down(town, given);
        scenario
    }

    /// Starts nobody, but those who are given, faster than they can stop behind who is ahead, or before the next
    /// passage, at 2 m/s^2.
    fn slow_down(&mut self, town: &Town, given: usize) {
        let all: Vec<Rectangle> =
            self.actors.iter().map(|a| rectangle(&town.routes[a.route], a)).collect();
        let ego = Rectangle {
            pose: town.routes[self.ego_route].path.pose_at(self.ego_s),
            length: 5.1,
            width: 1.89,
        };
        let limit =
            |route: &Route, s: f64, length: f64, others: &mut dyn Iterator<Item = &Rectangle>| {
                let line =
                    route.passages.iter().map(|p| p.from - s - length / 2.0).find(|gap| *gap > 0.0);
                let mut free = line.unwrap_or(60.0);
                for other in others {
                    let seen = route.path.project_within(other.pose.at, s, s + 60.0);
                    if seen.left.abs() < 2.5 && seen.s > s {
                        free = free.min(seen.s - s - f64::midpoint(length, other.length));
                    }
                }
                (4.0 * (free - 4.0).max(0.0)).sqrt().min(0.9 * route.pace_at(s))
            };
        for index in given..self.actors.len() {
            let actor = &self.actors[index];
            let mut others =
                all.iter().enumerate().filter(|(i, _)| *i != index).map(|(_, r)| r).chain([&ego]);
            let most = limit(&town.routes[actor.route], actor.s, actor.length, &mut others);
            self.actors[index].speed = actor.speed.min(most);
        }
        let most = limit(&town.routes[self.ego_route], self.ego_s, 5.1, &mut all.iter());
        self.ego_speed = self.ego_speed.min(most);
    }
}

/// The rectangle of a vehicle at its start.
pub fn rectangle(route: &Route, start: &Start) -> Rectangle {
    Rectangle { pose: route.path.pose_at(start.s), length: start.length, width: start.width }
}

/// Somebody ahead of the ego on its lane; every second of them stops for a while. None when twenty places
/// were taken or inside of a passage.
fn lead(
    random: &mut ChaCha8Rng,
    town: &Town,
    (index, ego_s): (usize, f64),
    placed: &mut Placed,
) -> Option<Start> {
    let route = &town.routes[index];
    for _ in 0..20 {
        let s = ego_s + random.random_range(16.0..60.0);
        let (length, width) = size(random, route);
        if !waits_before(route, s, length) || !placed.is_free(route, s, length, width) {
            continue;
        }
        placed.add(route, s, length, width);
        let mut lead = vehicle(random, town, (index, s), (length, width));
        let halt = s + random.random_range(30.0..200.0);
        // Nobody halts within a passage, or so that its rear is still in one.
        if random.random_bool(0.5) && waits_before(route, halt - length / 2.0, length + 6.0) {
            lead.halts.push(Halt { s: halt, seconds: random.random_range(5.0..12.0) });
        }
        return Some(lead);
    }
    None
}

/// A vehicle of this size at a place of a route, with a driver: one of those of the map, if it has any.
pub fn vehicle(
    random: &mut ChaCha8Rng,
    town: &Town,
    (route, s): (usize, f64),
    (length, width): (f64, f64),
) -> Start {
    let idm = match &town.given.drivers[..] {
        [] => Idm {
            v0: random.random_range(9.0..15.0),
            headway: random.random_range(1.2..1.8),
            b: random.random_range(2.0..3.0),
            ..Idm::default()
        },
        drivers => drivers[random.random_range(0..drivers.len())],
    };
    Start { route, s, speed: random.random_range(3.0..12.0), length, width, idm, halts: Vec::new() }
}

/// A size that the bends of a route allow.
pub fn size(random: &mut ChaCha8Rng, route: &Route) -> (f64, f64) {
    let mut draw = random.random_range(0..20);
    let found = SIZES.iter().find(|(_, _, share)| {
        let is_it = draw < *share;
        draw = draw.saturating_sub(*share);
        is_it
    });
    let &(length, width, _) = found.unwrap_or(&SIZES[0]);
    let is_straight =
        route.path.arc_lengths().iter().all(|&s| route.path.curvature_at(s).abs() < LONG.1);
    if length > LONG.0 && !is_straight { (SIZES[1].0, SIZES[1].1) } else { (length, width) }
}

/// Whether a place is outside of all passages, with room to stop before the next.
fn waits_before(route: &Route, s: f64, length: f64) -> bool {
    let (rear, front) = (s - length / 2.0 - 1.0, s + length / 2.0 + 4.0);
    route.passages.iter().all(|p| front < p.from || p.to < rear)
}

fn walkers(random: &mut ChaCha8Rng, town: &Town) -> Vec<Walk> {
    let mut walks = Vec::new();
    for crossing in &town.crossings {
        let mut time = random.random_range(0.0..40.0);
        while time < 180.0 {
            walks.push(Walk { time, route: crossing.route });
            time += random.random_range(20.0..70.0);
        }
    }
    walks.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.route.cmp(&b.route)));
    walks
}

fn offset(random: &mut ChaCha8Rng, town: &Town) -> f64 {
    town.signals.first().map_or(0.0, |program| random.random_range(0.0..program.cycle))
}

/// Places that are taken.
struct Placed {
    places: Vec<(Point, f64)>,
}

impl Placed {
    /// Circles that cover the rectangle along its path.
    fn circles(route: &Route, s: f64, length: f64, width: f64) -> Vec<(Point, f64)> {
        let radius = width / 2.0 + 0.2;
        let half = length / 2.0;
        [-half, -half / 2.0, 0.0, half / 2.0, half]
            .map(|at| (route.path.pose_at(s + at).at, radius))
            .to_vec()
    }

    fn is_free(&self, route: &Route, s: f64, length: f64, width: f64) -> bool {
        Self::circles(route, s, length + FREE, width).iter().all(|(place, radius)| {
            self.places.iter().all(|(taken, other)| place.distance(*taken) > radius + other)
        })
    }

    fn add(&mut self, route: &Route, s: f64, length: f64, width: f64) {
        self.places.extend(Self::circles(route, s, length, width));
    }
}
