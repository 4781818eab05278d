//! Who may enter a passage: reservations, in the order of right of way and of waiting.
//!
//! A passage is granted to one agent at a time of those whose corridors overlap in it, and taken back only
//! from one that can still stop. So two vehicles that obey are never in one conflict together, whatever
//! the order; gaps, right of way and signals only choose the order.

use crate::map::conflicts::light;
use crate::map::route::{Conflict, Passage};
use crate::map::{Light, Town};
use crate::traffic::agent::{Agent, Kind};

/// Who comes later than this after the passage is clear need not be waited for, s.
const AFTER: f64 = 1.0;
/// After waiting this long an agent goes before those who stand and wait shorter, s.
const PATIENCE: f64 = 6.0;
/// After waiting this long it goes before those who come and can still stop, s.
const PATIENCE_MAX: f64 = 25.0;
/// Deceleration at which a grant is taken back when the signal is not green, m/s^2.
const A_SIGNAL: f64 = 3.0;
/// Above this deceleration an agent cannot be asked to wait, m/s^2.
const A_FORCED: f64 = 4.0;
/// The ego goes when it is faster than this, m/s, speeds up by more than this, m/s^2, and is as near to the line, m.
const EGO_GOES: (f64, f64, f64) = (0.3, 0.3, 5.0);

/// Grants what can be granted at a time, s (`lights`: on the signals' clock), and returns how many took what was not.
pub fn grant(agents: &mut [Agent], town: &Town, time: f64, lights: f64) -> u32 {
    let mut forced = 0;
    for agent in agents.iter_mut() {
        forced += u32::from(revoke_or_force(agent, town, lights));
    }
    if town.given.lets_ego_go {
        yield_to_ego(agents, town);
    }
    // The longest waiting first; people and others in the order of their numbers.
    let mut order: Vec<usize> = (0..agents.len()).filter(|&i| asks(&agents[i], town)).collect();
    let since = |i: &usize| agents[*i].waits_since.unwrap_or(f64::INFINITY);
    order.sort_by(|a, b| since(a).total_cmp(&since(b)));
    for index in order {
        if may_enter(agents, index, town, time, lights) {
            agents[index].granted += 1;
            agents[index].waits_since = None;
        } else if agents[index].speed < 0.5 && agents[index].waits_since.is_none() {
            agents[index].waits_since = Some(time);
        }
    }
    forced
}

/// Whether an agent is near enough to a passage that it was not granted.
fn asks(agent: &Agent, town: &Town) -> bool {
    let next = town.routes[agent.route].passages.get(agent.granted);
    agent.on_route
        && next.is_some_and(|passage| passage.from - agent.front() < agent.request_distance())
}

/// Takes a grant back while the signal is not green and there is room; gives one that was taken.
fn revoke_or_force(agent: &mut Agent, town: &Town, lights: f64) -> bool {
    let passages = &town.routes[agent.route].passages;
    let square = agent.speed * agent.speed / 2.0;
    if !agent.on_route {
        agent.granted = agent.cleared;
        return false;
    }
    if agent.granted > agent.cleared {
        let last = &passages[agent.granted - 1];
        let room = last.from - agent.front();
        if room > square / A_SIGNAL + 1.0 && light(town, last, lights) != Light::Green {
            agent.granted -= 1;
        }
    }
    if let Some(next) = passages.get(agent.granted) {
        let room = next.from - agent.front();
        let (speed, acceleration, near) = EGO_GOES;
        let goes = town.given.lets_ego_go
            && agent.speed > speed
            && agent.acceleration > acceleration
            && room < near;
        if room < -0.3 || agent.kind == Kind::Ego && (goes || room < square / A_FORCED) {
            agent.granted += 1;
            return agent.kind != Kind::Ego;
        }
    }
    false
}

/// Takes grants back from those who meet the ego in the passage that it took, as far as they can still stop: it
/// decides for itself, and at times in the moment in which another is granted the way.
fn yield_to_ego(agents: &mut [Agent], town: &Town) {
    let Some(ego) = agents.iter().find(|agent| agent.kind == Kind::Ego && agent.on_route) else {
        return;
    };
    let (route, taken) = (&town.routes[ego.route], ego.cleared..ego.granted);
    for conflict in route.conflicts.iter().filter(|it| taken.contains(&it.passage)) {
        for other in agents.iter_mut().filter(|it| it.route == conflict.with) {
            let is_last = other.granted == conflict.their_passage + 1;
            let line = town.routes[other.route].passages[conflict.their_passage].from;
            let room = line - other.front();
            if is_last && room > other.speed * other.speed / (2.0 * A_FORCED) + 0.3 {
                other.granted -= 1;
            }
        }
    }
}

fn may_enter(agents: &[Agent], index: usize, town: &Town, time: f64, lights: f64) -> bool {
    let me = &agents[index];
    let route = &town.routes[me.route];
    let passage = &route.passages[me.granted];
    if light(town, passage, lights) != Light::Green
        || !is_next(agents, me, town, passage)
        || is_full(me, passage)
    {
        return false;
    }
    let clear = time_to(me, passage.to + me.rectangle.length - me.s);
    let first = route.conflicts.partition_point(|c| c.passage < me.granted);
    let conflicts = &route.conflicts[first..];
    conflicts.iter().take_while(|c| c.passage == me.granted).all(|conflict| {
        agents.iter().filter(|other| other.route == conflict.with && other.on_route).all(|other| {
            if is_inside(other, conflict) {
                return false;
            }
            !conflict.gives_way
                || !comes_first(agents, other, town, conflict, clear, lights)
                || is_patient(me, other, time)
        })
    })
}

/// Whether another has the conflict granted and has not left it.
fn is_inside(other: &Agent, conflict: &Conflict) -> bool {
    other.cleared <= conflict.their_passage
        && conflict.their_passage < other.granted
        && other.rear() < conflict.there.1
}

/// Whether another, who has the right of way, comes before the passage is clear again.
fn comes_first(
    agents: &[Agent],
    other: &Agent,
    town: &Town,
    conflict: &Conflict,
    clear: f64,
    lights: f64,
) -> bool {
    if other.granted != conflict.their_passage {
        return false;
    }
    let passage = &town.routes[other.route].passages[other.granted];
    let room = passage.from - other.front();
    if light(town, passage, lights) == Light::Red
        || is_full(other, passage)
        || !is_next(agents, other, town, passage)
    {
        return false;
    }
    if room < 4.0 && other.speed < 1.0 {
        return other.halts.is_empty() || other.halt_until.is_none();
    }
    (conflict.there.0 - other.front()) / other.speed.max(1.0) < clear + AFTER
}

/// Whether an agent has waited long enough to go before another.
fn is_patient(me: &Agent, other: &Agent, time: f64) -> bool {
    let waited = |agent: &Agent| agent.waits_since.map_or(0.0, |since| time - since);
    let stands = other.speed < 1.0 && waited(me) > PATIENCE && waited(me) > waited(other);
    // Nobody pushes in before people.
    stands || waited(me) > PATIENCE_MAX && !matches!(other.kind, Kind::Pedestrian | Kind::Bicycle)
}

/// Whether nobody waits between an agent and a passage.
fn is_next(agents: &[Agent], me: &Agent, town: &Town, passage: &Passage) -> bool {
    let Some(ahead) = me.ahead.filter(|ahead| ahead.gap < passage.from - me.front()) else {
        return true;
    };
    let other = &agents[ahead.index];
    let next = &town.routes[other.route].passages;
    let entered = next.iter().filter(|p| p.from < other.front()).count();
    other.speed > 1.0 && (other.granted > entered || entered == next.len())
}

/// Whether there would be no room behind a passage: who is ahead stands in it or just behind.
fn is_full(me: &Agent, passage: &Passage) -> bool {
    let needed = passage.to - me.front() + me.rectangle.length + 2.0;
    me.ahead.is_some_and(|ahead| {
        ahead.gap < needed && ahead.speed < 2.0 && ahead.gap > passage.from - me.front()
    })
}

/// Time for a way from now on, accelerating at the driver's ordinary rate, s.
fn time_to(agent: &Agent, way: f64) -> f64 {
    let top = agent.idm.v0.min(8.0).max(agent.speed);
    let (a, v) = (agent.idm.a, agent.speed);
    let speeding = (top * top - v * v) / (2.0 * a);
    if way < speeding {
        ((v * v + 2.0 * a * way.max(0.0)).sqrt() - v) / a
    } else {
        (top - v) / a + (way - speeding) / top
    }
}
