//! Who is ahead in an agent's corridor: any rectangle, on whatever route.

use crate::map::route::Route;
use crate::traffic::agent::{Agent, Ahead};

/// Beside the own width this much of the corridor is kept free, either side, m.
const BESIDE: f64 = 0.3;

/// The nearest agent in the corridor ahead, within a way, m.
pub fn nearest(agents: &[Agent], own: usize, route: &Route, reach: f64) -> Option<Ahead> {
    let me = &agents[own];
    let mut best: Option<Ahead> = None;
    for (index, other) in agents.iter().enumerate() {
        let pose = me.rectangle.pose;
        let far = reach + f64::midpoint(me.rectangle.length, other.rectangle.length);
        if index == own || pose.at.distance(other.rectangle.pose.at) > far {
            continue;
        }
        let limit =
            best.map_or(far, |b| b.gap + me.rectangle.length / 2.0 + other.rectangle.length);
        // No part of it is farther from its middle.
        let near =
            (other.rectangle.length + other.rectangle.width + me.rectangle.width) / 2.0 + BESIDE;
        let seen = route.path.project_near(other.rectangle.pose.at, me.s, me.s + limit, near);
        let Some(seen) = seen.filter(|seen| seen.s > me.s) else { continue };
        let at = route.path.pose_at(seen.s);
        let their = other.rectangle.pose;
        let (cos, sin) =
            (their.cos * at.cos + their.sin * at.sin, their.sin * at.cos - their.cos * at.sin);
        let (length, width) = (other.rectangle.length / 2.0, other.rectangle.width / 2.0);
        let aside = (length * sin).abs() + (width * cos).abs();
        if seen.left.abs() - aside >= me.rectangle.width / 2.0 + BESIDE {
            continue;
        }
        let along = (length * cos).abs() + (width * sin).abs();
        let gap = seen.s - along - me.front();
        if gap < reach && best.is_none_or(|b| gap < b.gap) {
            best = Some(Ahead { index, gap, speed: (other.speed * cos).max(0.0) });
        }
    }
    best
}
