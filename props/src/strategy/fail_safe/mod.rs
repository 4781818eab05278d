//! Objects at the thresholds of the fail-safe rule (`spec/hardened/H-14.md#requirements-failure`): who touches the CAV at a
//! place, just before or after its window, comes across it, is behind it, or keeps beside its path.

mod lane;
pub mod path;
pub mod reach;
mod shape;

use mufasa_model::input::cycle::{
    Cycle, Detection, DetectionList, Lead, Profile, Track, TrackList,
};
use mufasa_model::services::configuration::Configuration;

use self::path::{Body, Path, dot};
use super::base::{self, Frame, a_tyre, seconds};
use super::draw::Draw;
use super::moving::{self, Aimed, detection};
use super::obstacle;

/// Finds an object for a cycle, whose path it may change; the last number is the age of its list, ns.
type Aimer = fn(&mut Draw<'_>, &mut Cycle, i64) -> Aimed;

/// What a cycle is aimed at, by name. Some are drawn more often.
#[expect(
    clippy::redundant_closure_for_method_calls,
    reason = "the methods themselves are of one lifetime"
)]
pub const AIMS: [(&str, Aimer); 13] = [
    ("standing", standing),
    ("passed", |draw, cycle, age_ns| {
        shaped(draw, cycle, age_ns, |aim, draw| aim.passed(draw, 0.0))
    }),
    ("coming", |draw, cycle, age_ns| shaped(draw, cycle, age_ns, |aim, draw| aim.coming(draw))),
    ("braked before", |draw, cycle, age_ns| {
        shaped(draw, cycle, age_ns, |aim, draw| aim.passed(draw, 0.5))
    }),
    ("coming", |draw, cycle, age_ns| shaped(draw, cycle, age_ns, |aim, draw| aim.coming(draw))),
    ("across from behind", |draw, cycle, age_ns| {
        shaped(draw, cycle, age_ns, |aim, draw| aim.along(draw))
    }),
    ("across from the side", |draw, cycle, age_ns| {
        shaped(draw, cycle, age_ns, |aim, draw| aim.across(draw))
    }),
    ("behind", |draw, cycle, age_ns| shaped(draw, cycle, age_ns, |aim, draw| aim.behind(draw))),
    ("slanted", |draw, cycle, age_ns| shaped(draw, cycle, age_ns, |aim, draw| aim.slanted(draw))),
    ("may stand", at_the_stop),
    ("beside", lane::object),
    ("beside in a bend", lane::in_a_bend),
    ("beside before a corner", lane::before_a_corner),
];

/// A cycle that H-14 decides.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let aim = draw.below(AIMS.len());
    aimed(draw, profile, aim)
}

/// A cycle that one of the `AIMS` is for.
pub fn aimed(draw: &mut Draw<'_>, profile: Profile, aim: usize) -> Cycle {
    let mut cycle = scene(draw, profile);
    decide(draw, &mut cycle, AIMS[aim]);
    cycle
}

/// An object beside a path of a thousand points, which may have thousands of places; no limit of work decides.
pub fn beside_many_points(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = scene(draw, profile);
    shape::divide(&mut cycle);
    cycle.parameters.work_limit = i64::MAX;
    decide(draw, &mut cycle, ("beside", lane::object));
    cycle
}

fn scene(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration =
        draw.pick(&[Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    cycle
}

/// Puts one object where H-14 decides, by one of the `AIMS` or another.
pub fn decide(draw: &mut Draw<'_>, cycle: &mut Cycle, (name, find): (&str, Aimer)) {
    // No other stage looks at it.
    (cycle.parameters.theta_obj, cycle.parameters.safety_time) = (1e-3, 0.0);
    let age_ns = draw.pick(&[0, 30_000_000, 100_000_000]);
    let age_ns = draw.odd_ns(age_ns);
    let aimed = find(draw, cycle, age_ns);
    if name == "braked before" {
        seen_before(cycle, aimed);
    } else if name != "passed" && draw.one_in(3) {
        moving::carry(draw, cycle, aimed);
    } else {
        with_track(draw, cycle, aimed);
    }
    if draw.one_in(16) {
        cycle.lead = Some(Lead { stamp_ns: cycle.now_ns, gap: 300.0, speed: 3.0 });
    }
}

/// An object on a path of any shape.
fn shaped(
    draw: &mut Draw<'_>,
    cycle: &mut Cycle,
    age_ns: i64,
    find: fn(&Aim<'_>, &mut Draw<'_>) -> Found,
) -> Aimed {
    shape::draw(draw, cycle);
    let (path, body) = (Path::of(cycle), body(draw, cycle));
    find(&Aim { cycle, path, body, age: seconds(age_ns) }, draw).aged(age_ns)
}

/// Of any size and direction, at the origin.
fn body(draw: &mut Draw<'_>, cycle: &Cycle) -> Body {
    let (length, width) =
        draw.pick(&[(4.5, 1.8), (0.6, 0.6), (0.01, 0.01), (12.0, 2.5), (1.0, 3.0)]);
    // Between places that are too far apart for a short CAV nothing larger fits.
    let is_small = cycle.ego.length < 0.25 && draw.one_in(2);
    let (length, width) = if is_small { (0.01, 0.01) } else { (length, width) };
    let road = shape::frame(cycle);
    let turned = draw.direction();
    let (cos, sin) = unit(road.turn(if draw.one_in(2) { turned } else { (1.0, 0.0) }));
    Body { frame: Frame { x: 0.0, y: 0.0, cos, sin }, half: (0.5 * length, 0.5 * width) }
}

/// Two directions that are not quite unit vectors multiply out of the domain.
fn unit((cos, sin): (f64, f64)) -> (f64, f64) {
    let norm = cos.hypot(sin);
    if (norm - 1.0).abs() > 4e-7 { (cos / norm, sin / norm) } else { (cos, sin) }
}

/// What an aim needs to know: `body` is the object's, `age` that of its list in s.
struct Aim<'a> {
    cycle: &'a Cycle,
    path: Path,
    body: Body,
    age: f64,
}

/// An object found, its list still without a time.
struct Found {
    body: Body,
    velocity: (f64, f64),
}

impl Found {
    fn aged(self, age_ns: i64) -> Aimed {
        let Self { body: Body { frame, half }, velocity } = self;
        Aimed { frame, size: (2.0 * half.0, 2.0 * half.1), velocity, age_ns }
    }
}

impl Aim<'_> {
    /// It is there after `moved` in the direction e, whose speed is this.
    fn found(&self, at: (f64, f64), e: (f64, f64), moved: f64, speed: f64) -> Found {
        let (x, y) = (at.0 - moved * e.0, at.1 - moved * e.1);
        let frame = Frame { x, y, ..self.body.frame };
        Found { body: Body { frame, ..self.body }, velocity: (speed * e.0, speed * e.1) }
    }

    fn at(&self, (x, y): (f64, f64)) -> Body {
        Body { frame: Frame { x, y, ..self.body.frame }, ..self.body }
    }

    /// Beside the CAV at a place, in line with its front (1) or its rear (-1), of which it covers a
    /// little; a direction across.
    fn corridor(&self, draw: &mut Draw<'_>, k: usize, end: f64) -> ((f64, f64), (f64, f64)) {
        let cav = self.path.body(self.cycle, k);
        let h = (cav.frame.cos, cav.frame.sin);
        let spacing = 0.25_f64.min(self.cycle.ego.length);
        let covers = draw.pick(&[0.5, 0.1]) * spacing;
        let ahead = end * (cav.half.0 + self.body.extent(h) - covers);
        let side = draw.pick(&[1.0, -1.0]);
        let slant = draw.pick(&[0.0, 0.0, 0.0, 0.3, -0.3]);
        let e = unit(cav.frame.turn((slant, side)));
        (cav.frame.at(ahead, 0.0), e)
    }

    /// It is by, braking since its list and for so many seconds before it, when the window of a place begins, or nearly so.
    fn passed(&self, draw: &mut Draw<'_>, before: f64) -> Found {
        // Who passes the last place meets the CAV nowhere else.
        let last = self.path.places.len() - 1;
        let k = if draw.one_in(2) { last } else { draw.below(last + 1) };
        let (at, e) = self.corridor(draw, k, 1.0);
        let (a, t) = (a_tyre(&self.cycle.parameters), self.age + self.path.begin(k));
        let speed = draw.pick(&[8.0, 25.0, 3.0, a * t, 0.5]).min(60.0);
        let lost = 0.5 * a * before;
        let mean = if draw.one_in(4) { speed } else { speed + lost };
        let speed = draw.near(mean).max(0.0);
        // It is slower than its mean.
        let least = (speed - lost).max(0.0);
        let t = t.min(least / a);
        let braked = least * t - 0.5 * a * t * t;
        let met = self.path.body(self.cycle, k).met_by(&self.at(at), e);
        let (_, by) = met.unwrap_or((0.0, 0.0));
        let by = draw.near(by);
        self.found((at.0 + by * e.0, at.1 + by * e.1), e, braked, speed)
    }

    /// It goes on and arrives when the window of a place ends, or nearly so.
    fn coming(&self, draw: &mut Draw<'_>) -> Found {
        let k = draw.below(self.path.places.len());
        let end = self.path.end(k);
        let (at, e) = self.corridor(draw, k, if end.is_some() { -1.0 } else { 1.0 });
        let speed = draw.pick(&[8.0, 3.0, 20.0, 0.5]);
        let met = self.path.body(self.cycle, k).met_by(&self.at(at), e);
        let (from, _) = met.unwrap_or((0.0, 0.0));
        let from = draw.near(from);
        let reached = (at.0 + from * e.0, at.1 + from * e.1);
        let after = |seconds: f64| self.found(reached, e, speed * (self.age + seconds), speed);
        let found = after(end.unwrap_or(self.path.until(speed)));
        if end.is_none() && self.comes_across(&found) { after(self.path.t_stop()) } else { found }
    }

    /// The inner rectangle: the CAV now, its front moved in by 0.3 m, its other sides less at low speed, and
    /// not at all for who is behind.
    fn inner(&self, is_behind: bool) -> Body {
        let Body { frame, half } = self.path.body(self.cycle, 0);
        let b = if is_behind { 0.0 } else { self.path.s_b().min(0.3) };
        let (x, y) = frame.at(-0.5 * (0.3 - b), 0.0);
        let half = (half.0 - 0.5 * (0.3 + b), half.1 - self.path.aside - b);
        Body { frame: Frame { x, y, ..frame }, half }
    }

    fn is_behind(&self, found: &Found) -> bool {
        let cav = self.path.body(self.cycle, 0);
        let (h, age) = ((cav.frame.cos, cav.frame.sin), self.age);
        let Found { body: Body { frame, .. }, velocity: w } = found;
        let now = (frame.x + w.0 * age - cav.frame.x, frame.y + w.1 * age - cav.frame.y);
        dot(*w, h) > 0.0 && dot(now, h) + found.body.extent(h) < -0.5 * self.cycle.ego.length
    }

    fn comes_across(&self, found: &Found) -> bool {
        let (inner, speed) =
            (self.inner(self.is_behind(found)), found.velocity.0.hypot(found.velocity.1));
        let met =
            || inner.met_by(&found.body, (found.velocity.0 / speed, found.velocity.1 / speed));
        inner.half.0 >= 0.0
            && inner.half.1 >= 0.0
            && speed > 0.0
            && met().is_some_and(|(_, to)| to >= speed * self.age)
    }

    /// It comes from behind in line with the CAV, and across it or just not.
    fn along(&self, draw: &mut Draw<'_>) -> Found {
        let (inner, speed) = (self.inner(true), draw.pick(&[8.0, 20.0, 3.0]));
        let (h, side) = ((inner.frame.cos, inner.frame.sin), draw.pick(&[1.0, -1.0]));
        let aside = draw.near(inner.half.1 + self.body.extent((-h.1, h.0)));
        let gap = draw.pick(&[1.0, 0.1, 5.0]);
        let behind = 0.5 * self.cycle.ego.length + self.body.extent(h) + gap;
        self.found(inner.frame.at(-behind, side * aside), h, speed * self.age, speed)
    }

    /// It comes from the side, and across the CAV or just not, between when the CAV surely stands and when it
    /// could have stopped itself.
    fn across(&self, draw: &mut Draw<'_>) -> Found {
        let (inner, speed) = (self.inner(false), draw.pick(&[8.0, 20.0, 3.0]));
        let (h, side) = ((inner.frame.cos, inner.frame.sin), draw.pick(&[1.0, -1.0]));
        let ahead = draw.near(inner.half.0 + self.body.extent(h));
        let (at, e) = (inner.frame.at(ahead, 0.0), (-side * h.1, side * h.0));
        let cav = self.path.body(self.cycle, 0);
        let from = cav.met_by(&self.at(at), e).map_or(0.0, |(from, _)| from);
        let share = draw.pick(&[0.5, 0.9, 0.1]);
        let arrives = self.path.t_stop() * (1.0 - share) + self.path.until(speed) * share;
        self.found((at.0 + from * e.0, at.1 + from * e.1), e, speed * (self.age + arrives), speed)
    }

    /// It drives into the CAV from behind and is wholly behind it now, or just is not.
    fn behind(&self, draw: &mut Draw<'_>) -> Found {
        let cav = self.path.body(self.cycle, 0);
        let h = (cav.frame.cos, cav.frame.sin);
        let behind = draw.near(cav.half.0 + self.body.extent(h));
        let aside = draw.pick(&[0.0, 0.5, -0.5]) * cav.half.1;
        let speed = draw.pick(&[8.0, 1.0, 30.0, 0.0]);
        let speed = draw.near(speed).max(0.0);
        let e = unit(cav.frame.turn(draw.pick(&[(1.0, 0.0), (0.96, 0.28), (0.96, -0.28)])));
        self.found(cav.frame.at(-behind, aside), e, speed * self.age, speed)
    }

    /// It comes across from behind, at 45 degrees or as far aside as goes along from there, or nearly so.
    fn slanted(&self, draw: &mut Draw<'_>) -> Found {
        let cav = self.path.body(self.cycle, 0);
        let (h, speed) = ((cav.frame.cos, cav.frame.sin), draw.pick(&[30.0, 20.0, 45.0]));
        let (gap, side) = (draw.pick(&[0.05, 0.2, 3.0, 20.0]), draw.pick(&[1.0, -1.0]));
        let behind = cav.half.0 + self.body.extent(h) + gap;
        // Its way to the middle of the CAV, at an angle with this sine.
        let from = |sine: f64| {
            let e = cav.frame.turn(((1.0 - sine * sine).max(0.0).sqrt(), side * sine));
            let back = behind / dot(e, h).max(0.1);
            ((cav.frame.x - back * e.0, cav.frame.y - back * e.1), e)
        };
        let p = self.path.places[0].pose;
        let most = (0..50).fold(0.0, |sine, _| {
            let ((x, y), _) = from(sine);
            along_at((x - p.x).hypot(y - p.y))
        });
        let sine = draw.near(most.min(std::f64::consts::FRAC_1_SQRT_2)).clamp(0.0, 1.0);
        let ((x, y), e) = from(sine);
        let (w, length) = ((speed * e.0, speed * e.1), speed);
        let Found { body, .. } = self.found((x, y), e, length * self.age, length);
        Found { body, velocity: w }
    }
}

/// The greatest sine of an angle to the CAV's heading at which an object goes along at that distance.
fn along_at(distance: f64) -> f64 {
    (0.05 + distance / 30.0).min(1.0)
}

/// One place has a way of `s_tyre(v)`, nearly, and who arrives there before it can stop does so only where the
/// CAV may stand.
fn at_the_stop(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let k = draw.between(1, 12);
    let d = cycle.ego.length.min(0.25);
    cycle.ego.speed = draw.near((2.0 * a_tyre(&cycle.parameters) * d * k as f64).sqrt());
    for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points).skip(1) {
        point.t_ns += 1;
    }
    if let Some(list) = &mut cycle.trajectory {
        list.points.truncate(1);
    }
    let (path, body) = (Path::of(cycle), body(draw, cycle));
    let k = (k - 1).min(path.places.len() - 1);
    let aim = Aim { cycle, path, body, age: seconds(age_ns) };
    let (at, e) = aim.corridor(draw, k, -1.0);
    let speed = draw.pick(&[8.0, 3.0, 15.0]);
    let from = aim.path.body(cycle, k).met_by(&aim.at(at), e).map_or(0.0, |(from, _)| from);
    let reached = (at.0 + from * e.0, at.1 + from * e.1);
    // After it would have passed, before it surely stands: whoever comes across is not examined longer.
    let arrives = 0.5 * (aim.path.last(aim.path.s_tyre()) + aim.path.t_stop());
    aim.found(reached, e, speed * (aim.age + arrives), speed).aged(age_ns)
}

/// Something that stands beside the CAV at a place or ahead of the last one, and touches it, or just does
/// not.
fn standing(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    shaped(draw, cycle, age_ns, |aim, draw| {
        let last = aim.path.places.len() - 1;
        let ahead = draw.one_in(2);
        let k = if ahead { last } else { draw.below(last + 1) };
        let cav = aim.path.body(aim.cycle, k);
        let side = draw.pick(&[1.0, -1.0]);
        let normal = if ahead { (1.0, 0.0) } else { (0.0, side) };
        let reach = if ahead { cav.half } else { (cav.half.1, cav.half.0) };
        let away = draw.near(reach.0 + aim.body.extent(cav.frame.turn(normal)));
        let along = draw.pick(&[0.0, 0.5, -0.9]) * reach.1;
        let at =
            cav.frame.at(away * normal.0 - along * normal.1, away * normal.1 + along * normal.0);
        aim.found(at, (1.0, 0.0), 0.0, 0.0)
    })
}

/// As a track beside current detections without any.
fn with_track(draw: &mut Draw<'_>, cycle: &mut Cycle, aimed: Aimed) {
    let stamp_ns = cycle.now_ns - aimed.age_ns;
    let mut items = vec![track(aimed)];
    if draw.one_in(8) {
        let far = shape::frame(cycle).at(-90.0, 20.0);
        let frame = Frame { x: far.0, y: far.1, ..aimed.frame };
        items.insert(0, Track { id: 3, ..track(Aimed { frame, velocity: (0.0, 0.0), ..aimed }) });
    }
    cycle.tracks = Some(TrackList { stamp_ns, items });
    // In `PlanRemote` stage iii is the obstacle check.
    if cycle.configuration != Configuration::PlanRemote || draw.one_in(2) {
        cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: Vec::new() });
    }
}

/// As a detection that was seen 0.5 s before, and a track that explains it with the mean velocity since then.
fn seen_before(cycle: &mut Cycle, aimed: Aimed) {
    let stamp_ns = cycle.now_ns - aimed.age_ns;
    // Wherever its rectangle points.
    cycle.parameters.theta_velocity = 100.0;
    cycle.detections = Some(DetectionList { stamp_ns, items: vec![detection(aimed)] });
    cycle.tracks = Some(TrackList { stamp_ns, items: vec![track(aimed)] });
    let before = |dt_ns: i64| {
        let (dt, Frame { x, y, .. }, (vx, vy)) = (seconds(dt_ns), aimed.frame, aimed.velocity);
        let frame = Frame { x: x - vx * dt, y: y - vy * dt, ..aimed.frame };
        let items = vec![detection(Aimed { frame, ..aimed })];
        DetectionList { stamp_ns: stamp_ns - dt_ns, items }
    };
    cycle.detection_history = [300_000_000, 500_000_000].map(before).into();
}

/// As a track with its own velocity.
fn track(aimed: Aimed) -> Track {
    let Detection { x, y, cos, sin, length, width } = detection(aimed);
    let bounded = |speed: f64| speed.clamp(-150.0, 150.0);
    let (vx, vy) = (bounded(aimed.velocity.0), bounded(aimed.velocity.1));
    Track { id: 7, x, y, cos, sin, vx, vy, length, width }
}
