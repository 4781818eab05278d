//! H-13 (c) of `spec/3-stages.md#hardened-profile` against a search that looks at every pair, every
//! point and many times, in plain doubles and without separating axes: what is too close for it
//! is left out.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::scene::{NOW_NS, Scene, detection, scene, track};
use mufasa::input::cycle::{Detection, Track, TrajectoryPoint};
use mufasa::input::profile::Profile::Hardened;
use mufasa::report::Rule;
use mufasa::services::configuration::Configuration::MotRemote;

/// How far an object moves between two looks, m, and how much larger the CAV is made for what may be
/// between them.
const LOOK: f64 = 0.05;
const BETWEEN: f64 = 0.1;
/// What is farther away from where it could be met is not looked for, m.
const FAR: f64 = 150.0;
/// Detections are 10 ms old, s.
const AGE: f64 = 0.01;

struct Draws(ChaCha8Rng);

impl Draws {
    fn from(&mut self, [least, greatest]: [f64; 2]) -> f64 {
        least + (greatest - least) * self.0.random::<f64>()
    }

    fn below(&mut self, count: usize) -> usize {
        self.0.random_range(0..count)
    }
}

/// Yes, no, or too close.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Answer {
    Yes,
    No,
    Close,
}

impl Answer {
    fn of(surely: bool, perhaps: bool) -> Self {
        match (surely, perhaps) {
            (true, _) => Self::Yes,
            (false, true) => Self::Close,
            (false, false) => Self::No,
        }
    }
}

/// A rectangle: centre, direction, half its length and half its width.
#[derive(Clone, Copy)]
struct Box2 {
    centre: [f64; 2],
    direction: [f64; 2],
    half: [f64; 2],
}

impl Box2 {
    /// The corners, one after the other.
    fn corners(&self) -> [[f64; 2]; 4] {
        let ([x, y], [cos, sin], [a, b]) = (self.centre, self.direction, self.half);
        [[a, b], [-a, b], [-a, -b], [a, -b]]
            .map(|[a, b]| [x + a * cos - b * sin, y + a * sin + b * cos])
    }

    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let ([cx, cy], [cos, sin], [a, b]) = (self.centre, self.direction, self.half);
        let (x, y) = (x - cx, y - cy);
        (x * cos + y * sin).abs() <= a && (y * cos - x * sin).abs() <= b
    }

    /// A corner of one in the other, or two sides that cross.
    fn touches(&self, other: &Self) -> bool {
        let ([x, y], [ox, oy]) = (self.centre, other.centre);
        let reach = self.half[0] + self.half[1] + other.half[0] + other.half[1];
        if (x - ox).abs() > reach || (y - oy).abs() > reach {
            return false;
        }
        let (corners, others) = (self.corners(), other.corners());
        let side = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
        };
        let sides = |of: &[[f64; 2]; 4]| {
            let of = *of;
            (0..4).map(move |i| (of[i], of[(i + 1) % 4]))
        };
        let cross = sides(&corners).any(|(a, b)| {
            sides(&others)
                .any(|(c, d)| side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b))
        });
        cross
            || corners.iter().any(|corner| other.contains(*corner))
            || others.iter().any(|corner| self.contains(*corner))
    }
}

/// A detection that moves.
struct Pair {
    order: usize,
    detection: usize,
    item: usize,
    now: Detection,
    velocity: [f64; 2],
}

impl Pair {
    fn at(&self, seconds: f64) -> Box2 {
        let Detection { x, y, cos, sin, length, width } = self.now;
        let centre = [x + self.velocity[0] * seconds, y + self.velocity[1] * seconds];
        Box2 { centre, direction: [cos, sin], half: [0.5 * length, 0.5 * width] }
    }

    fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }
}

/// How often each thing was seen.
#[derive(Debug, Default)]
struct Seen {
    nothing: u32,
    sooner: u32,
    later: u32,
    /// A collision later on for which the CAV may wait, now or before, or could not at first.
    may_wait: u32,
    may_wait_on_the_way: u32,
    never_could: u32,
    close: u32,
}

/// What a scene holds, for the search.
struct Search<'s> {
    scene: &'s Scene,
    /// How many points are examined, whatever the CAV may do.
    examined: usize,
}

impl Search<'_> {
    fn cav(&self, at: &TrajectoryPoint, more: f64) -> Box2 {
        let ego = &self.scene.ego;
        let centre = [at.x + ego.center_offset * at.cos, at.y + ego.center_offset * at.sin];
        let half = [0.5 * ego.length + more, 0.5 * ego.width + more];
        Box2 { centre, direction: [at.cos, at.sin], half }
    }

    fn collides(&self, at: &TrajectoryPoint, pair: &Pair) -> Answer {
        let object = pair.at(seconds(at));
        let touches = |more: f64| self.cav(at, more).touches(&object);
        Answer::of(touches(-1e-5), touches(1e-5))
    }

    fn may_wait(&self, at: &TrajectoryPoint, pair: &Pair) -> Answer {
        let looks = (FAR / LOOK) as u32;
        let step = if pair.speed() > 0.0 { LOOK / pair.speed() } else { 0.0 };
        let touches = |more: f64| {
            let cav = self.cav(at, more);
            (0..looks).any(|i| cav.touches(&pair.at(seconds(at) + f64::from(i) * step)))
        };
        match Answer::of(touches(-1e-5), touches(BETWEEN)) {
            Answer::Yes => Answer::No,
            Answer::No => Answer::Yes,
            Answer::Close => Answer::Close,
        }
    }

    /// The point of the collision, if there is one.
    fn found(&self, pair: &Pair, seen: &mut Seen) -> Result<Option<usize>, ()> {
        let points = &self.scene.points;
        for (index, at) in points.iter().enumerate().take(self.examined) {
            match self.collides(at, pair) {
                Answer::Yes => return Ok(Some(index)),
                Answer::No => {}
                Answer::Close => return Err(()),
            }
        }
        let on = points.iter().enumerate().skip(self.examined);
        if on.clone().all(|(_, at)| self.collides(at, pair) == Answer::No) {
            return Ok(None);
        }
        match self.may_wait(&points[0], pair) {
            Answer::Yes => {}
            Answer::No => {
                seen.never_could += 1;
                return Ok(None);
            }
            Answer::Close => return Err(()),
        }
        for (index, at) in on {
            match self.may_wait(&points[index - 1], pair) {
                Answer::Yes => {
                    let count = if index == self.examined {
                        &mut seen.may_wait
                    } else {
                        &mut seen.may_wait_on_the_way
                    };
                    *count += 1;
                    return Ok(None);
                }
                Answer::No => {}
                Answer::Close => return Err(()),
            }
            match self.collides(at, pair) {
                Answer::Yes => return Ok(Some(index)),
                Answer::No => {}
                Answer::Close => return Err(()),
            }
        }
        Ok(None)
    }

    /// Compares what stage iv finds, and whether it has to be found.
    fn compare(&self, pairs: &[Pair], seen: &mut Seen) {
        let witness = self.scene.failure_of_iv();
        if witness.is_some_and(|witness| witness.rule == Rule::Collision) {
            return;
        }
        let mut first = None;
        for pair in pairs {
            match self.found(pair, seen) {
                Ok(Some(point)) => {
                    let key = (point, pair.order, pair.item, pair.detection);
                    first = Some(first.map_or(key, |first| key.min(first)));
                }
                Ok(None) => {}
                Err(()) => {
                    seen.close += 1;
                    return;
                }
            }
        }
        let expected = first.map(|(point, _, item, detection)| [point, detection, item].map(Some));
        let found = witness.map(|witness| {
            assert_eq!(witness.rule, Rule::CollisionMoving);
            [witness.point, witness.detection, witness.item]
        });
        assert_eq!(found, expected);
        let count = match first {
            None => &mut seen.nothing,
            Some((point, ..)) if point < self.examined => &mut seen.sooner,
            Some(_) => &mut seen.later,
        };
        *count += 1;
    }
}

/// Since the detections.
fn seconds(at: &TrajectoryPoint) -> f64 {
    (at.t_ns - NOW_NS) as f64 * 1e-9 + AGE
}

/// The CAV on a bow, faster or slower.
fn driving(draws: &mut Draws) -> Scene {
    let mut scene = scene(Hardened, MotRemote, [0.0, 0.0]);
    let speed = draws.from([1.0, 14.0]);
    let sharp = [0.2, 1.5][draws.below(2)];
    let (turn, slower) = (draws.from([-sharp, sharp]), draws.from([-0.4, 0.2]));
    let [mut x, mut y, mut heading] = [0.0, 0.0, draws.from([-3.0, 3.0])];
    (scene.ego.cos, scene.ego.sin) = (heading.cos(), heading.sin());
    scene.ego.speed = speed;
    let count = 12 + draws.below(30);
    scene.points = (0..count)
        .map(|i| {
            let (cos, sin) = (heading.cos(), heading.sin());
            let point = TrajectoryPoint { t_ns: NOW_NS + i as i64 * 100_000_000, x, y, cos, sin };
            let step = 0.1 * speed * (1.0 + slower * i as f64 * 0.05).max(0.1);
            (x, y, heading) = (x + step * cos, y + step * sin, heading + turn * 0.1);
            point
        })
        .collect();
    scene
}

/// How many points H-13 examines in any case: the way is compared far from every point.
fn examined(scene: &Scene) -> Option<usize> {
    let (p, v) = (&scene.parameters, scene.ego.speed);
    let faster = v + p.a_max * p.tau;
    let s_stop = v * p.tau + 0.5 * p.a_max * p.tau * p.tau + faster * faster / (2.0 * p.a_b);
    let limit = (1.0 + 1e-6) * (s_stop + p.tau_motion * v);
    let (mut way, mut count) = (0.0, 1);
    for pair in scene.points.windows(2) {
        way += ((pair[1].x - pair[0].x) * pair[0].cos + (pair[1].y - pair[0].y) * pair[0].sin)
            .max(0.0);
        if (way - limit).abs() < 1e-4 {
            return None;
        }
        if way > limit {
            return Some(count + 1);
        }
        count += 1;
    }
    None
}

/// An object that comes to about where the CAV is at some point, from somewhere.
fn coming(draws: &mut Draws, scene: &Scene) -> (Detection, [f64; 2]) {
    let at = scene.points[draws.below(scene.points.len())];
    let angle = draws.from([-3.2, 3.2]);
    let speed = [draws.from([0.3, 25.0]), draws.from([0.3, 8.0])][draws.below(2)];
    let velocity = [speed * angle.cos(), speed * angle.sin()];
    let aside = [draws.from([-4.0, 4.0]), draws.from([-4.0, 4.0])];
    let ahead = scene.ego.center_offset;
    let x = at.x + ahead * at.cos + aside[0] - velocity[0] * seconds(&at);
    let y = at.y + ahead * at.sin + aside[1] - velocity[1] * seconds(&at);
    let turned = angle + [0.0, draws.from([-0.1, 0.1]), draws.from([-3.0, 3.0])][draws.below(3)];
    let [length, width] = [draws.from([0.5, 6.0]), draws.from([0.5, 2.5])];
    (Detection { cos: turned.cos(), sin: turned.sin(), length, width, ..detection(x, y) }, velocity)
}

#[test]
fn what_nobody_explains_is_examined_on() {
    let mut draws = Draws(ChaCha8Rng::seed_from_u64(44));
    let mut seen = Seen::default();
    for _ in 0..6_000 {
        let mut scene = driving(&mut draws);
        let Some(examined) = examined(&scene) else { continue };
        let objects: Vec<_> = (0..1 + draws.below(3)).map(|_| coming(&mut draws, &scene)).collect();
        let before: Vec<_> = objects
            .iter()
            .map(|(now, [vx, vy])| Detection { x: now.x - 0.5 * vx, y: now.y - 0.5 * vy, ..*now })
            .collect();
        let now: Vec<_> = objects.iter().map(|(now, _)| *now).collect();
        let mut pairs = Vec::new();
        for (index, now) in now.iter().enumerate() {
            for (item, before) in before.iter().enumerate() {
                let velocity = [2.0 * (now.x - before.x), 2.0 * (now.y - before.y)];
                let pair = Pair { order: index, detection: index, item, now: *now, velocity };
                if pair.speed() < scene.parameters.v_object {
                    pairs.push(pair);
                }
            }
        }
        scene.tracks = Some(vec![]);
        scene.detections = Some(now);
        scene.history = vec![(500_000_000, before)];
        Search { scene: &scene, examined }.compare(&pairs, &mut seen);
    }
    assert!(seen.later > 200 && seen.sooner > 200 && seen.nothing > 200, "{seen:?}");
    assert!(seen.may_wait > 200 && seen.never_could > 50, "{seen:?}");
    assert!(seen.may_wait_on_the_way > 5, "{seen:?}");
}

/// Each a confirmed track, with other items near its past.
#[test]
fn confirmed_tracks_are_examined_on() {
    let mut draws = Draws(ChaCha8Rng::seed_from_u64(13));
    let mut seen = Seen::default();
    for _ in 0..6_000 {
        let mut scene = driving(&mut draws);
        let Some(examined) = examined(&scene) else { continue };
        let objects: Vec<_> = (0..1 + draws.below(3)).map(|_| coming(&mut draws, &scene)).collect();
        let ago = |(now, [vx, vy]): &(Detection, [f64; 2]), seconds: f64| {
            [now.x - seconds * vx, now.y - seconds * vy]
        };
        let apart = |seconds: f64| {
            let places: Vec<_> = objects.iter().map(|object| ago(object, seconds)).collect();
            let is_far = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) > 8.0;
            (1..places.len()).all(|i| places[..i].iter().all(|other| is_far(&places[i], other)))
        };
        if ![0.0, 0.3, 0.5].into_iter().all(apart) {
            continue;
        }
        let mut items = Vec::new();
        let (mut tracks, mut sooner, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
        for (index, object) in objects.iter().enumerate() {
            let (now, [vx, vy]) = *object;
            let speed = vx.hypot(vy);
            let now = Detection { cos: vx / speed, sin: vy / speed, ..now };
            let (vx, vy) = (vx + draws.from([-0.5, 0.5]), vy + draws.from([-0.5, 0.5]));
            let at = track(index as i64, now.x, now.y);
            tracks.push(Track { vx, vy, cos: now.cos, sin: now.sin, ..at });
            let [x, y] = ago(object, 0.3);
            sooner.push(Detection { x, y, ..now });
            let [x, y] = ago(object, 0.5);
            for aside in 0..1 + draws.below(3) {
                let aside = f64::from(u32::from(aside > 0)) * 1.8;
                let (x, y) = (x + draws.from([-aside, aside]), y + draws.from([-aside, aside]));
                let off = (x - now.x + 0.5 * vx).hypot(y - now.y + 0.5 * vy);
                if off < 1.999 {
                    let velocity = [2.0 * (now.x - x), 2.0 * (now.y - y)];
                    let item = items.len();
                    pairs.push(Pair { order: index, detection: index, item, now, velocity });
                    items.push(Detection { x, y, ..now });
                }
            }
        }
        scene.tracks = Some(tracks);
        scene.detections = Some(pairs.iter().fold(Vec::new(), |mut now, pair| {
            if pair.detection == now.len() {
                now.push(pair.now);
            }
            now
        }));
        scene.history = vec![(300_000_000, sooner), (500_000_000, items)];
        Search { scene: &scene, examined }.compare(&pairs, &mut seen);
    }
    assert!(seen.later > 100 && seen.sooner > 100 && seen.nothing > 100, "{seen:?}");
}
