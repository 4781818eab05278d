//! The world: a town, the ego as a body, and the others, in steps of 10 ms.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::collision;
use crate::map::conflicts::light;
use crate::map::route::Route;
use crate::map::{Light, Town};
use crate::pose::{Point, Pose, Rectangle};
use crate::scenario::{self, Scenario};
use crate::snapshot::{EgoState, Object, Reason, Snapshot, StopLine};
use crate::traffic::agent::{Agent, Kind};
use crate::traffic::{ahead, give_way};
use crate::vehicle::{Body, Command, Motion};

/// One step, ns and s.
pub const STEP_NS: i64 = 10_000_000;
const STEP: f64 = 0.01;
/// Steps between two decisions of the others: 50 ms.
const DECISION: i64 = 5;
/// Steps between two tries to let a new vehicle in: 0.5 s.
const REFILL: i64 = 50;
/// Road that must be free around a new vehicle, and distance to the ego, m.
const FREE: (f64, f64) = (28.0, 60.0);
/// Farther than this from its route the ego is on none, m.
const OFF_ROUTE: f64 = 5.0;

/// A running world.
#[derive(Clone, Debug)]
pub struct World<'a> {
    town: &'a Town,
    scenario: Scenario,
    random: ChaCha8Rng,
    body: Body,
    motion: Motion,
    steps: i64,
    /// The ego first, then the others by number.
    agents: Vec<Agent>,
    /// Place of the ego beside its route, left positive, m.
    left: f64,
    /// Vehicles that are to be replaced.
    missing: usize,
    walks: usize,
    next_id: u32,
    forced: u32,
}

impl<'a> World<'a> {
    /// A world at the start of a scenario, with the ego of `Body::default`.
    pub fn new(town: &'a Town, scenario: &Scenario, seed: u64) -> Self {
        let body = Body::default();
        let route = &town.routes[scenario.ego_route];
        let motion = body.at(route.path.pose_at(scenario.ego_s), scenario.ego_speed);
        let size = (body.length, body.width);
        let mut ego = Agent::new(0, Kind::Ego, town, scenario.ego_route, scenario.ego_s, size);
        ego.speed = scenario.ego_speed;
        let mut agents = vec![ego];
        let mut next_id = 1;
        for start in &scenario.actors {
            agents.push(Agent::vehicle(next_id, town, start));
            next_id += 1;
        }
        let mut world = Self {
            town,
            scenario: scenario.clone(),
            random: ChaCha8Rng::seed_from_u64(seed),
            body,
            motion,
            steps: 0,
            agents,
            left: 0.0,
            missing: 0,
            walks: 0,
            next_id,
            forced: 0,
        };
        world.decide();
        world
    }

    /// One step of 10 ms. A command is held to the limits of the ego; of one that is not a number the
    /// acceleration is full braking and the steering stays (`Body::step`).
    pub fn step(&mut self, command: Command) {
        self.motion = self.body.step(&self.motion, command, STEP);
        self.steps += 1;
        for agent in &mut self.agents[1..] {
            agent.step(&self.town.routes[agent.route], STEP);
        }
        self.follow_ego();
        if self.steps % DECISION == 0 {
            self.leave();
            self.enter();
            self.decide();
        }
    }

    /// Simulated time, ns.
    pub const fn time_ns(&self) -> i64 {
        self.steps * STEP_NS
    }

    /// The route of the ego.
    pub fn route(&self) -> &'a Route {
        &self.town.routes[self.scenario.ego_route]
    }

    /// The body of the ego.
    pub const fn body(&self) -> &Body {
        &self.body
    }

    /// Everybody, the ego first.
    pub fn agents(&self) -> &[Agent] {
        &self.agents
    }

    /// The truth.
    pub fn snapshot(&self) -> Snapshot {
        let ego = &self.agents[0];
        let state = EgoState {
            rectangle: ego.rectangle,
            rear: self.motion.rear,
            speed: self.motion.speed,
            s: ego.s,
            left: self.left,
        };
        let object = |a: &Agent| Object {
            id: a.id,
            kind: a.kind,
            rectangle: a.rectangle,
            velocity: a.velocity(),
        };
        Snapshot {
            time_ns: self.time_ns(),
            ego: state,
            objects: self.agents[1..].iter().map(object).collect(),
            lights: (0..self.town.signals.len()).map(|group| self.light_of(group)).collect(),
            stops: self.stops(),
        }
    }

    /// The number of somebody whom the ego touches.
    pub fn collision(&self) -> Option<u32> {
        let (ego, others) = self.agents.split_first()?;
        others
            .iter()
            .find(|other| collision::overlap(&ego.rectangle, &other.rectangle))
            .map(|other| other.id)
    }

    /// Distance of the ego's rectangle to the nearest other, m, with its number; none in an empty town.
    pub fn nearest(&self) -> Option<(f64, u32)> {
        let (ego, others) = self.agents.split_first()?;
        let mut best: Option<(f64, u32)> = None;
        for other in others {
            let half = |r: &Rectangle| f64::midpoint(r.length, r.width);
            let far = ego.rectangle.pose.at.distance(other.rectangle.pose.at);
            let least = far - half(&ego.rectangle) - half(&other.rectangle);
            if best.is_some_and(|(distance, _)| least >= distance) {
                continue;
            }
            let distance = collision::distance(&ego.rectangle, &other.rectangle);
            if best.is_none_or(|(nearest, _)| distance < nearest) {
                best = Some((distance, other.id));
            }
        }
        best
    }

    /// Pairs of others who touch each other, by their numbers: a fault of this simulation.
    pub fn collisions_of_others(&self) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for (index, a) in self.agents.iter().enumerate().skip(1) {
            for b in &self.agents[index + 1..] {
                if collision::overlap(&a.rectangle, &b.rectangle) {
                    pairs.push((a.id, b.id));
                }
            }
        }
        pairs
    }

    /// Whether the middle of the ego is in its target zone.
    pub fn has_arrived(&self) -> bool {
        self.route().task.is_some_and(|task| {
            let (ahead, left) = task.target.pose.local(self.agents[0].rectangle.pose.at);
            ahead.abs() <= task.target.length / 2.0 && left.abs() <= task.target.width / 2.0
        })
    }

    /// Whether some part of the ego is outside of its corridor.
    pub fn is_off_road(&self) -> bool {
        !self.route().holds(&self.agents[0].rectangle, self.agents[0].s)
    }

    /// Whether the time limit is over.
    pub fn is_late(&self) -> bool {
        self.seconds() > self.scenario.time_limit
    }

    /// How often another entered a passage that was not granted: 0 unless a scenario starts somebody
    /// who cannot stop.
    pub const fn forced(&self) -> u32 {
        self.forced
    }

    #[allow(clippy::cast_precision_loss, reason = "a run has less than 2^53 steps")]
    fn seconds(&self) -> f64 {
        self.steps as f64 * STEP
    }

    /// Signals run on a clock of their own.
    fn lights_at(&self) -> f64 {
        self.seconds() + self.scenario.signal_offset
    }

    fn light_of(&self, group: usize) -> Light {
        self.town.signals[group].light(self.lights_at())
    }

    fn stops(&self) -> Vec<StopLine> {
        let ego = &self.agents[0];
        let closed = self.route().passages.iter().skip(ego.granted);
        closed
            .map(|passage| {
                let is_green = light(self.town, passage, self.lights_at()) == Light::Green;
                StopLine {
                    s: passage.from,
                    reason: if is_green { Reason::GiveWay } else { Reason::Signal },
                }
            })
            .collect()
    }

    /// Brings the ego's agent to where its body is.
    fn follow_ego(&mut self) {
        let route = self.route();
        let ego = &mut self.agents[0];
        ego.rectangle = self.body.rectangle(&self.motion);
        ego.speed = self.motion.speed;
        ego.acceleration = self.motion.acceleration;
        let seen = route.path.project_within(ego.rectangle.pose.at, ego.s - 3.0, ego.s + 5.0);
        ego.s = seen.s;
        self.left = seen.left;
        ego.on_route = seen.left.abs() < OFF_ROUTE;
        ego.pass(route);
    }

    fn decide(&mut self) {
        for index in 0..self.agents.len() {
            let agent = &self.agents[index];
            let route = &self.town.routes[agent.route];
            let mut reach = 15.0 + 5.0 * agent.speed;
            // Before it asks for a passage it looks whether there is room behind it.
            if let Some(next) = route.passages.get(agent.granted)
                && next.from - agent.front() < agent.request_distance()
            {
                reach = reach.max(next.to - agent.front() + agent.rectangle.length + 4.0);
            }
            self.agents[index].ahead = ahead::nearest(&self.agents, index, route, reach);
        }
        let (time, lights) = (self.seconds(), self.lights_at());
        self.forced += give_way::grant(&mut self.agents, self.town, time, lights);
        for agent in &mut self.agents[1..] {
            agent.decide(&self.town.routes[agent.route], time);
        }
    }

    /// Takes out who is at the end of a route.
    fn leave(&mut self) {
        let town = self.town;
        let is_done =
            |a: &Agent| a.kind != Kind::Ego && a.s >= town.routes[a.route].path.length() - 0.5;
        let vehicles = |agents: &[Agent]| {
            agents.iter().filter(|a| matches!(a.kind, Kind::Car | Kind::Truck)).count()
        };
        let before = vehicles(&self.agents);
        self.agents.retain(|agent| !is_done(agent));
        if self.scenario.refill {
            self.missing += before - vehicles(&self.agents);
        }
    }

    /// Lets in who comes to a crossing, and at times a vehicle for one that left.
    fn enter(&mut self) {
        while let Some(walk) = self.scenario.walkers.get(self.walks)
            && walk.time <= self.seconds()
        {
            let walker = Agent::walker(self.next_id, self.town, walk.route);
            self.walks += 1;
            if self.is_free(walker.rectangle.pose.at, 2.0) {
                self.agents.push(walker);
                self.next_id += 1;
            }
        }
        if self.missing == 0 || self.steps % REFILL != 0 {
            return;
        }
        let roads: Vec<usize> = self.town.roads().collect();
        let route = roads[self.random.random_range(0..roads.len())];
        let size = scenario::size(&mut self.random, &self.town.routes[route]);
        let place = (route, size.0 / 2.0);
        let mut start = scenario::vehicle(&mut self.random, self.town, place, size);
        start.speed = start.speed.min(6.0);
        let pose: Pose = self.town.routes[route].path.pose_at(start.s);
        if self.is_free(pose.at, FREE.0)
            && self.agents[0].rectangle.pose.at.distance(pose.at) > FREE.1
        {
            self.agents.push(Agent::vehicle(self.next_id, self.town, &start));
            self.next_id += 1;
            self.missing -= 1;
        }
    }

    fn is_free(&self, place: Point, distance: f64) -> bool {
        self.agents.iter().all(|agent| agent.rectangle.pose.at.distance(place) > distance)
    }
}
