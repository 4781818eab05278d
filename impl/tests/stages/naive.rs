//! The fail-safe rule as the text has it, in plain doubles and without any short cut (H-14,
//! `spec/hardened/H-14.md`), strictly or laxly by a margin. Nothing is explained.

use std::ops::{Add, Mul, Sub};

use crate::scene::Scene;
use mufasa::input::cycle::{Detection, Ego, TrajectoryPoint};

pub const MARGIN: f64 = 1e-6;
/// Of all lists, s.
const AGE: f64 = 0.01;

#[derive(Clone, Copy, Debug)]
pub struct V(pub f64, pub f64);

impl V {
    pub fn dot(self, other: Self) -> f64 {
        self.0 * other.0 + self.1 * other.1
    }

    fn cross(self, other: Self) -> f64 {
        self.0 * other.1 - self.1 * other.0
    }

    pub fn norm(self) -> f64 {
        self.0.hypot(self.1)
    }
}

impl Add for V {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl Sub for V {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl Mul<f64> for V {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }
}

#[derive(Clone, Copy, Debug)]
struct Box2 {
    centre: V,
    along: V,
    half: [f64; 2],
}

impl Box2 {
    fn reach(&self, axis: V) -> f64 {
        self.along.dot(axis).abs() * self.half[0] + self.along.cross(axis).abs() * self.half[1]
    }
}

/// Whether the second box shares a point with the first one while it moves so far.
fn sweeps(a: &Box2, b: &Box2, moved: V) -> bool {
    let left = |v: V| V(-v.1, v.0);
    let axes = [a.along, left(a.along), b.along, left(b.along), left(moved)];
    axes.iter().all(|&axis| {
        let gap = (b.centre - a.centre).dot(axis);
        let (one, other) = (gap, gap + moved.dot(axis));
        let reach = a.reach(axis) + b.reach(axis);
        one.min(other) <= reach && one.max(other) >= -reach
    })
}

struct Place {
    at: V,
    heading: V,
    way: f64,
}

pub struct Naive<'s> {
    scene: &'s Scene,
    /// By so much the CAV is larger.
    more: f64,
    places: Vec<Place>,
}

fn heading(point: &TrajectoryPoint) -> V {
    V(point.cos, point.sin)
}

impl<'s> Naive<'s> {
    pub fn new(scene: &'s Scene, more: f64) -> Self {
        let mut naive = Self { scene, more, places: Vec::new() };
        naive.places = naive.all_places();
        naive
    }

    fn p(&self) -> (V, V) {
        let Ego { x, y, cos, sin, .. } = self.scene.ego;
        (V(x, y), V(cos, sin))
    }

    fn v_tau(&self) -> f64 {
        let p = &self.scene.parameters;
        self.scene.ego.speed + p.a_max * p.tau
    }

    fn s_tau(&self) -> f64 {
        let p = &self.scene.parameters;
        self.scene.ego.speed * p.tau + p.a_max * p.tau * p.tau / 2.0
    }

    fn s_stop(&self) -> f64 {
        self.s_tau() + self.v_tau().powi(2) / (2.0 * self.scene.parameters.a_b)
    }

    /// T
    fn until_stop(&self) -> f64 {
        self.scene.parameters.tau + self.v_tau() / self.scene.parameters.a_b
    }

    /// H(w)
    fn until_yielded(&self, speed: f64) -> f64 {
        let p = &self.scene.parameters;
        self.until_stop().max(p.tau + p.t_yield + speed / (2.0 * p.a_yield))
    }

    fn all_places(&self) -> Vec<Place> {
        let (p, h) = self.p();
        let d = self.scene.ego.length.min(0.25);
        let mut places = vec![Place { at: p, heading: h, way: 0.0 }];
        let (mut node, mut along, mut way) = (p, h, 0.0);
        let is_ahead = |point: &&TrajectoryPoint| (V(point.x, point.y) - p).dot(h) <= 0.125;
        for point in self.scene.points.iter().skip_while(is_ahead) {
            let u = V(point.x, point.y) - node;
            let advance = u.dot(along).max(0.0);
            let n = (u.0.abs() / d).ceil().max((u.1.abs() / d).ceil()).max(1.0);
            for k in 1..n as i64 {
                let share = k as f64 / n;
                places.push(Place {
                    at: node + u * share,
                    heading: along,
                    way: way + advance * share,
                });
            }
            (node, way) = (node + u, way + advance);
            let before = along;
            along = heading(point);
            places.push(Place { at: node, heading: along, way });
            if way > self.s_stop() {
                return self.cut_off(places, before);
            }
        }
        for k in 1.. {
            let ahead = f64::from(k) * d;
            places.push(Place { at: node + along * ahead, heading: along, way: way + ahead });
            if way + ahead > self.s_stop() {
                break;
            }
        }
        self.cut_off(places, along)
    }

    fn cut_off(&self, mut places: Vec<Place>, along: V) -> Vec<Place> {
        let beyond = places.iter().position(|it| it.way > self.s_stop()).expect("the last one");
        places.truncate(beyond + 1);
        let (o, q) = (&places[beyond - 1], &places[beyond]);
        let share = (self.s_stop() - o.way) / (q.way - o.way);
        let at = o.at + (q.at - o.at) * share;
        places[beyond] = Place { at, heading: along, way: self.s_stop() };
        places
    }

    fn first(&self, f: f64) -> f64 {
        let (p, v) = (&self.scene.parameters, self.scene.ego.speed);
        if f <= self.s_tau() {
            return ((v * v + 2.0 * p.a_max * f).sqrt() - v) / p.a_max;
        }
        let left = self.v_tau().powi(2) - 2.0 * p.a_b * (f - self.s_tau());
        p.tau + (self.v_tau() - left.max(0.0).sqrt()) / p.a_b
    }

    /// The latest time, if the CAV may not stand there.
    fn last(&self, f: f64) -> Option<f64> {
        let (v, a_b) = (self.scene.ego.speed, self.scene.parameters.a_b);
        let left = v * v - 2.0 * a_b * f;
        (f < v * v / (2.0 * a_b)).then(|| (v - left.max(0.0).sqrt()) / a_b)
    }

    fn cav(&self, at: V, along: V, more: f64) -> Box2 {
        let Ego { length, width, center_offset, .. } = self.scene.ego;
        let half = [0.5 * length + more, 0.5 * width + more];
        Box2 { centre: at + along * center_offset, along, half }
    }

    fn cav_at(&self, place: &Place, aside: f64) -> Box2 {
        let mut cav = self.cav(place.at, place.heading, self.more);
        cav.half[1] += aside;
        cav
    }

    fn comes_across(&self, object: &Box2, w: V) -> bool {
        let (p, h) = self.p();
        let s_b = self.scene.ego.speed.powi(2) / (2.0 * self.scene.parameters.a_b);
        let b = if self.is_behind(object, w) { 0.0 } else { s_b.min(0.3) };
        let mut inner = self.cav(p, h, -self.more);
        inner.centre = inner.centre + h * (0.5 * (b - 0.3));
        inner.half = [inner.half[0] - 0.5 * (0.3 + b), inner.half[1] - b];
        w.norm() > 0.0 && sweeps(&inner, object, w * 1e4)
    }

    fn is_behind(&self, object: &Box2, w: V) -> bool {
        let (p, h) = self.p();
        let front = (object.centre - self.cav(p, h, 0.0).centre).dot(h) + object.reach(h);
        w.dot(h) > self.more && front < -0.5 * self.scene.ego.length - self.more
    }

    fn goes_along(&self, object: &Box2, w: V) -> bool {
        let (p, h) = self.p();
        let most = 0.05 + (object.centre - p).norm() / 30.0;
        w.cross(h).abs() <= w.norm() * most - self.more
    }

    fn follows(&self, object: &Box2, w: V) -> bool {
        let h = self.p().1;
        self.is_behind(object, w)
            && self.comes_across(object, w)
            && w.cross(h).abs() <= w.dot(h) - self.more
    }

    /// From the nearest points of the reference path, and the segments of these: in the strict model all
    /// that may be nearest.
    fn nearest(&self, at: V) -> Vec<(V, V)> {
        let points = self.scene.cross_sections.iter().map(|it| V(it.x, it.y));
        let segments = points.clone().zip(points.skip(1)).map(|(a, b)| {
            let u = b - a;
            let share = ((at - a).dot(u) / u.dot(u)).clamp(0.0, 1.0);
            (at - (a + u * share), u)
        });
        let least = segments.clone().map(|(q, _)| q.norm()).fold(f64::MAX, f64::min);
        segments.filter(|(q, _)| q.norm() <= least + MARGIN).collect()
    }

    /// Whether it is so in each case, or in the lax model in some.
    fn each<T>(&self, of: &[T], is_so: impl Fn(&T) -> bool) -> bool {
        if self.more > 0.0 { of.iter().all(is_so) } else { of.iter().any(is_so) }
    }

    fn is_between_ends(&self, at: V) -> bool {
        let point = |i: usize| V(self.scene.cross_sections[i].x, self.scene.cross_sections[i].y);
        let last = self.scene.cross_sections.len() - 1;
        let inside = |end: V, next: V| (at - end).dot(next - end) > self.more;
        inside(point(0), point(1)) && inside(point(last), point(last - 1))
    }

    fn route_bends(&self, w: V) -> bool {
        let (p, h) = self.p();
        let comes_towards = w.cross(h).abs() <= -w.dot(h) - self.more;
        let radius = if comes_towards { 30.0 } else { 300.0 };
        let points: Vec<V> = self.scene.cross_sections.iter().map(|it| V(it.x, it.y)).collect();
        points.windows(2).all(|pair| {
            let g = pair[1] - pair[0];
            let share = ((p - pair[0]).dot(g) / g.dot(g)).clamp(0.0, 1.0);
            let far = (p - (pair[0] + g * share)).norm();
            h.cross(g).abs() <= g.norm() * (0.05 + far / radius) - self.more
        })
    }

    fn keeps_beside(&self, object: &Box2, w: V, aside: f64) -> bool {
        let Ego { length, width, .. } = self.scene.ego;
        let (h, speed) = (self.p().1, w.norm());
        let feet = self.nearest(object.centre);
        let away = feet[0].0.norm();
        let late = self.until_yielded(speed);
        let needed = |q: V| {
            let drift = w.dot(q).abs();
            let keeps_lane = self.is_behind(object, w) && drift <= speed * away / 10.0 - self.more;
            object.reach(q) + drift * if keeps_lane { 0.0 } else { late }
        };
        let has_room = |place: &Place| {
            let centre = self.cav(place.at, place.heading, 0.0).centre;
            self.is_between_ends(centre)
                && h.cross(place.heading).abs() <= 0.05 + place.way / 30.0 - self.more
                && self.each(&self.nearest(centre), |&(from, g)| {
                    let across = place.heading.dot(g).abs() * width;
                    let along = place.heading.cross(g).abs() * length;
                    let extent = 0.5 * (across + along) / g.norm() + aside;
                    let room = (away - from.norm()).abs() - extent - self.more;
                    self.each(&feet, |&(q, _)| room * away > needed(q))
                })
        };
        let lies_across = |place: &Place| sweeps(&self.cav_at(place, aside), object, V(0.0, 0.0));
        speed > 0.0
            && away > 0.0
            && away <= 20.0 - self.more
            && !self.places.iter().any(lies_across)
            && self.route_bends(w)
            && self.is_between_ends(object.centre)
            && self.places.iter().all(has_room)
    }

    /// Whether an object with this velocity meets the CAV.
    fn meets(&self, object: &Box2, w: V) -> bool {
        let p = &self.scene.parameters;
        let now = Box2 { centre: object.centre + w * AGE, ..*object };
        let start = &self.scene.points[0];
        let aside = (self.p().0 - V(start.x, start.y)).cross(heading(start)).abs();
        let is_exempt = || self.follows(&now, w) || self.keeps_beside(&now, w, aside);
        if self.goes_along(&now, w) && is_exempt() {
            return false;
        }
        let comes_across = self.comes_across(&now, w);
        let late = if comes_across { self.until_stop() } else { self.until_yielded(w.norm()) };
        let speed = w.norm();
        let unit = if speed > 0.0 { w * (1.0 / speed) } else { V(0.0, 0.0) };
        (0..self.places.len()).any(|i| {
            let place = &self.places[i];
            let from = if i == 0 { 0.0 } else { self.first(self.places[i - 1].way) };
            let until = self.places.get(i + 1).and_then(|next| self.last(next.way)).unwrap_or(late);
            let braked = (from + AGE).min(speed / p.a_b);
            let least = speed * braked - 0.5 * p.a_b * braked * braked;
            let most = speed * (until + AGE);
            let swept = Box2 { centre: object.centre + unit * least, ..*object };
            sweeps(&self.cav_at(place, aside), &swept, unit * (most - least))
        })
    }

    pub fn anything(&self) -> bool {
        self.tracks() || self.detections()
    }

    fn tracks(&self) -> bool {
        self.scene.tracks.iter().flatten().any(|it| {
            let (centre, along) = (V(it.x, it.y), V(it.cos, it.sin));
            let object = Box2 { centre, along, half: [0.5 * it.length, 0.5 * it.width] };
            self.meets(&object, V(it.vx, it.vy))
        })
    }

    /// Nothing is explained; two lists, that of 500 ms first.
    fn detections(&self) -> bool {
        let p = &self.scene.parameters;
        self.scene.detections.iter().flatten().any(|now| {
            let (centre, along) = (V(now.x, now.y), V(now.cos, now.sin));
            let object = Box2 { centre, along, half: [0.5 * now.length, 0.5 * now.width] };
            let [other, reference] = &self.scene.history[..] else {
                return self.meets(&object, V(0.0, 0.0));
            };
            let place = |it: &Detection| V(it.x, it.y);
            reference.1.iter().any(|before| {
                let (dt, other_dt) = (reference.0 as f64 * 1e-9, other.0 as f64 * 1e-9);
                let w = (centre - place(before)) * (1.0 / dt);
                let then = centre - w * other_dt;
                let mut supported = other.1.iter().map(|it| (place(it) - then).norm());
                let may_come = (centre - place(before)).norm() <= p.v_object * dt + self.more
                    && supported.any(|away| away <= p.theta_track_max + self.more);
                let may_stand = (centre - place(before)).norm() <= p.theta_track_max + self.more;
                (may_come || may_stand) && self.meets(&object, w)
            }) || self.meets(&object, V(0.0, 0.0))
        })
    }
}
