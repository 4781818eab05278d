//! The path of the CAV in plain doubles, and when it is where
//! (`spec/hardened/H-14.md#requirements-the-path`): where generators aim, not what decides.

use mufasa_model::input::cycle::Cycle;

use super::super::base::{self, Frame, a_tyre};

/// More places than any aim needs.
const MOST: usize = 4_000;

/// Where the reference point of the CAV is.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Pose of the reference point.
    pub pose: Frame,
    /// How far ahead of the CAV, m.
    pub progress: f64,
    /// Of the path up to there, at least, m.
    pub length: f64,
}

/// The CAV's rectangle at a place.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Centre and direction.
    pub frame: Frame,
    /// Half length and half width, m.
    pub half: (f64, f64),
}

impl Body {
    /// Half of its extent along an axis, m.
    pub fn extent(&self, (x, y): (f64, f64)) -> f64 {
        let Frame { cos, sin, .. } = self.frame;
        self.half.0 * (cos * x + sin * y).abs() + self.half.1 * (cos * y - sin * x).abs()
    }

    /// From which to which distance along `way` another rectangle touches this one, if it ever does.
    pub fn met_by(&self, other: &Self, way: (f64, f64)) -> Option<(f64, f64)> {
        let axes = [self.frame, other.frame].map(|it| [(it.cos, it.sin), (-it.sin, it.cos)]);
        let apart = (other.frame.x - self.frame.x, other.frame.y - self.frame.y);
        axes.into_iter().flatten().try_fold((f64::NEG_INFINITY, f64::INFINITY), |(lo, hi), axis| {
            let reach = self.extent(axis) + other.extent(axis);
            let (start, rate) = (dot(apart, axis), dot(way, axis));
            if rate.abs() < 1e-9 {
                return (start.abs() <= reach).then_some((lo, hi));
            }
            let (one, two) = ((-reach - start) / rate, (reach - start) / rate);
            let (lo, hi) = (lo.max(one.min(two)), hi.min(one.max(two)));
            (lo <= hi).then_some((lo, hi))
        })
    }
}

/// The scalar product.
pub fn dot(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

/// The path of a cycle.
#[derive(Clone, Debug)]
pub struct Path {
    /// At least that of the CAV now.
    pub places: Vec<Place>,
    /// By how much the CAV is wider to each side, m.
    pub aside: f64,
    v: f64,
    tau: f64,
    a_max: f64,
    /// m/s^2.
    pub a_b: f64,
    a_tyre: f64,
    t_yield: f64,
    a_yield: f64,
}

impl Path {
    /// That of a cycle, rounded.
    pub fn of(cycle: &Cycle) -> Self {
        let (p, ego) = (&cycle.parameters, &cycle.ego);
        let places = places(cycle);
        let aside = widening(cycle, &places);
        let (v, tau, a_max, a_b) = (ego.speed, p.tau, p.a_max, p.a_b);
        let (t_yield, a_yield) = (p.t_yield, p.a_yield);
        Self { places, aside, v, tau, a_max, a_b, a_tyre: a_tyre(p), t_yield, a_yield }
    }

    /// `s_b(v)`, m.
    pub fn s_b(&self) -> f64 {
        self.v * self.v / (2.0 * self.a_b)
    }

    /// `s_tyre(v)`, m.
    pub fn s_tyre(&self) -> f64 {
        self.v * self.v / (2.0 * self.a_tyre)
    }

    /// T, s.
    pub fn t_stop(&self) -> f64 {
        self.tau + (self.v + self.a_max * self.tau) / self.a_b
    }

    /// H(w): when who goes on at this speed can still stop, s.
    pub fn until(&self, speed: f64) -> f64 {
        self.t_stop().max(self.tau + self.t_yield + speed / (2.0 * self.a_yield))
    }

    /// The earliest time at f, s.
    pub fn first(&self, f: f64) -> f64 {
        let s_tau = self.v * self.tau + 0.5 * self.a_max * self.tau * self.tau;
        if f <= s_tau {
            return ((self.v * self.v + 2.0 * self.a_max * f).sqrt() - self.v) / self.a_max;
        }
        let v_tau = self.v + self.a_max * self.tau;
        let squared = v_tau * v_tau - 2.0 * self.a_b * (f - s_tau);
        self.tau + (v_tau - squared.max(0.0).sqrt()) / self.a_b
    }

    /// The latest time at f below `s_tyre(v)`, s.
    pub fn last(&self, f: f64) -> f64 {
        (self.v - (self.v * self.v - 2.0 * self.a_tyre * f).max(0.0).sqrt()) / self.a_tyre
    }

    /// When the window of a place begins, s.
    pub fn begin(&self, k: usize) -> f64 {
        let around = &self.places[k.saturating_sub(1)..(k + 2).min(self.places.len())];
        self.first(around.iter().map(|place| place.progress).fold(f64::MAX, f64::min).max(0.0))
    }

    /// When it ends, s, if the CAV may not stand there.
    pub fn end(&self, k: usize) -> Option<f64> {
        let after = self.places.get(k + 1).map(|place| place.length)?;
        (after < self.s_tyre()).then(|| self.last(after))
    }

    /// The CAV at a place.
    pub fn body(&self, cycle: &Cycle, k: usize) -> Body {
        let pose = self.places[k].pose;
        let (x, y) = pose.at(cycle.ego.center_offset, 0.0);
        let half = (0.5 * cycle.ego.length, 0.5 * cycle.ego.width + self.aside);
        Body { frame: Frame { x, y, ..pose }, half }
    }
}

/// How far aside, m, and how much turned a circle leads that the CAV can drive up to f (H-14.64).
pub fn circle(cycle: &Cycle, f: f64) -> [f64; 2] {
    let v = cycle.ego.speed;
    let u = (v - cycle.parameters.a_b * f / v.max(1e-9)).max(0.5 * v);
    let radius = (u * u / 11.5).max(3.0);
    [0.5 * f * f / radius, f / radius]
}

/// How far the farther end of the CAV is from its reference point, m.
pub fn lever(cycle: &Cycle) -> f64 {
    cycle.ego.center_offset.abs() + 0.5 * cycle.ego.length
}

/// By how much half the CAV's width is greater, m (H-14.26).
fn widening(cycle: &Cycle, places: &[Place]) -> f64 {
    let ego = &cycle.ego;
    let seen = |x: f64, y: f64| {
        let away = (x - ego.x, y - ego.y);
        (dot(away, (ego.cos, ego.sin)), dot(away, (-ego.sin, ego.cos)))
    };
    let of_place = |Place { pose, .. }: &Place| {
        let (f, aside) = seen(pose.x, pose.y);
        let [way, turn] = circle(cycle, f.abs());
        let sine = (ego.cos * pose.sin - ego.sin * pose.cos).abs();
        (aside.abs() - way).max(lever(cycle) * (sine - turn))
    };
    let points = cycle.trajectory.as_ref().map_or(&[][..], |list| &list.points);
    let all = points.iter().map(|it| seen(it.x, it.y));
    let others = all.clone().take_while(|&(f, _)| f <= 0.125);
    let of_point = |(f, aside): (f64, f64)| aside.abs() - circle(cycle, f.abs())[0];
    let passes = others.clone().last().zip(all.clone().find(|&(f, _)| f > 0.125));
    let passes = passes.filter(|&((f_y, _), _)| f_y <= 0.0);
    let passes = passes.map(|((f_y, y), (f_z, z))| ((y * f_z - z * f_y) / (f_z - f_y)).abs());
    let excesses = others.map(of_point).chain(places.iter().skip(1).map(of_place));
    excesses.chain(passes).fold(0.0, f64::max)
}

/// The places of a cycle, rounded.
fn places(cycle: &Cycle) -> Vec<Place> {
    let (ego, end) = (&cycle.ego, base::s_stop(cycle));
    let d = ego.length.min(0.25);
    let p = Frame { x: ego.x, y: ego.y, cos: ego.cos, sin: ego.sin };
    let points = cycle.trajectory.as_ref().map_or(&[][..], |list| &list.points);
    let ahead = |x: f64, y: f64| (x - p.x) * p.cos + (y - p.y) * p.sin > 0.125;
    let from = points.iter().position(|it| ahead(it.x, it.y)).unwrap_or(points.len());
    let nodes =
        points[from..].iter().map(|it| Frame { x: it.x, y: it.y, cos: it.cos, sin: it.sin });
    let mut found = vec![Place { pose: p, progress: 0.0, length: 0.0 }];
    let place = |pose: Frame, length: f64| {
        let progress = dot((pose.x - p.x, pose.y - p.y), (p.cos, p.sin));
        Place { pose, progress, length }
    };
    for node in nodes {
        let Place { pose, length, .. } = found[found.len() - 1];
        let u = (node.x - pose.x, node.y - pose.y);
        let n = base::count(u.0.abs().max(u.1.abs()) / d).max(1);
        let more = dot(u, (pose.cos, pose.sin)).abs() + dot(u, (-pose.sin, pose.cos)).abs();
        for k in 1..=n {
            let share = k as f64 / n as f64;
            let between = Frame { x: pose.x + share * u.0, y: pose.y + share * u.1, ..pose };
            let pose = if k == n { node } else { between };
            if !push(&mut found, place(pose, length + share * more), end) {
                return found;
            }
        }
    }
    let Place { pose, length, .. } = found[found.len() - 1];
    for k in 1_i32.. {
        let far = f64::from(k) * d;
        let (x, y) = pose.at(far, 0.0);
        if !push(&mut found, place(Frame { x, y, ..pose }, length + far), end) {
            break;
        }
    }
    found
}

/// Whether there are more; the last one is where the progress is `end`, or farther from p, or behind the greatest length.
fn push(found: &mut Vec<Place>, next: Place, end: f64) -> bool {
    let before = found[found.len() - 1];
    if next.progress <= end {
        found.push(next);
        let p = found[0].pose;
        let distance = (next.pose.x - p.x).hypot(next.pose.y - p.y);
        return distance <= end + 1.0 && next.length <= 2.0 * end + 1.0 && found.len() < MOST;
    }
    let share = ((end - before.progress) / (next.progress - before.progress)).min(1.0);
    let at = |from: f64, to: f64| from + share * (to - from);
    let (x, y) = (at(before.pose.x, next.pose.x), at(before.pose.y, next.pose.y));
    // Behind a node its heading is that of the piece.
    let pose = Frame { x, y, ..before.pose };
    found.push(Place { pose, progress: end, length: at(before.length, next.length) });
    false
}
