//! Objects that keep beside the path along the route, or just do not
//! (`spec/hardened/H-14.md#requirements-not-examined`).

use mufasa_model::input::cycle::{Cycle, Route, Trajectory, TrajectoryPoint};

use super::super::base::{self, Frame, cross_section, seconds};
use super::super::draw::Draw;
use super::super::moving::Aimed;
use super::path::Path;
use super::{shape, unit};

/// Beside a straight road: from behind it comes nearer by a tenth of its way or less, or it is ahead and
/// would come nearer in the time that it has.
pub fn object(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let road = shape::frame(cycle);
    // From the last of them the CAV crosses the reference path to who is on the left.
    let apart = draw.pick(&[0.0, 6.0, 10.0, -0.3]);
    let (x, y) = road.at(0.0, -apart);
    let on_route = Frame { x, y, ..road };
    cycle.route = base::road(on_route, 20.0);
    if draw.one_in(3) {
        // It, or the last place of the CAV, is about at the end of the route.
        let stop = base::s_stop(cycle) + cycle.ego.center_offset;
        let end = draw.pick(&[8.0, stop, -9.0]);
        let end = draw.near(end);
        let from = if end < 0.0 { end } else { -60.0 };
        let to = if end < 0.0 { 60.0 } else { end };
        let cross_sections = [from, 0.5 * (from + to), to];
        let cross_sections = cross_sections.map(|a| cross_section(on_route, a, 0.0, 20.0)).to_vec();
        cycle.route = Route { closed: false, cross_sections };
    }
    let is_behind = draw.below(5) > 0;
    let speed = if is_behind { draw.pick(&[10.0, 6.0, 25.0]) } else { draw.pick(&[1.0, 0.5, 2.0]) };
    let side = if apart > 0.0 { 1.0 } else { draw.pick(&[1.0, -1.0]) };
    let size = draw.pick(&[(4.5, 1.8), (8.0, 2.5)]);
    let ahead = if is_behind { -draw.pick(&[9.0, 12.0]) } else { draw.pick(&[4.0, 1.0]) };
    let share = if is_behind { 0.1 } else { 0.3 };
    let drift = share * speed;
    let drift = if is_behind || draw.one_in(2) { draw.near(drift) } else { drift };
    let e = (((speed * speed - drift * drift).max(0.0)).sqrt(), -side * drift);
    let velocity = road.turn(e);
    if is_behind && draw.one_in(4) {
        // The CAV comes about as near to it as to who keeps to its lane.
        let (x, y) = road.turn((0.0, side * draw.near(0.125)));
        for point in cycle.trajectory.iter_mut().flat_map(|it| &mut it.points) {
            (point.x, point.y) = (point.x + x, point.y + y);
        }
    }
    let path = Path::of(cycle);
    // So far aside that who is behind passes the CAV as it is now, which it would follow, and meets it
    // farther on.
    let front = 0.5 * cycle.ego.length + cycle.ego.center_offset;
    let passed = share * (front + 0.5 * size.0 - ahead) + draw.pick(&[0.01, 0.03]);
    let gap = if is_behind { passed } else { draw.near(drift * path.until(speed)) };
    let aside = 0.5 * cycle.ego.width + path.aside + 0.5 * size.1 + gap;
    let age = seconds(age_ns);
    let at = (ahead - age * e.0, side * aside - age * e.1);
    let (x, y) = road.at(at.0, at.1);
    Aimed { frame: Frame { x, y, ..road }, size, velocity, age_ns }
}

/// On the inner side of a bend that the CAV follows: straight on it would meet the CAV, and along the route
/// it is beside it, or just is not. It may be wider than it is long.
pub fn in_a_bend(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let road = shape::frame(cycle);
    let radius = draw.pick(&[55.0, 60.0, 75.0, 52.0]);
    let side = draw.pick(&[1.0, -1.0]);
    let on_arc = |way: f64, inside: f64| {
        let angle = way / radius;
        let (cos, sin) = (angle.cos(), side * angle.sin());
        let (x, y) = road
            .at((radius - inside) * angle.sin(), side * (radius - (radius - inside) * angle.cos()));
        let (cos, sin) = unit(road.turn((cos, sin)));
        Frame { x, y, cos, sin }
    };
    let section = |way: f64| cross_section(on_arc(way, 0.0), 0.0, 0.0, 8.0);
    let cross_sections = (-6_i8..12).map(|k| section(5.0 * f64::from(k))).collect();
    cycle.route = Route { closed: false, cross_sections };
    cycle.ego.speed = draw.pick(&[8.0, 5.0, 10.0]);
    let speed = cycle.ego.speed;
    let dt = (0.9 * cycle.ego.length / speed).min(0.2);
    let points = (0_i32..12).map(|k| {
        let way = speed * dt * f64::from(k);
        let Frame { x, y, cos, sin } = on_arc(way, 0.0);
        let t_ns = cycle.now_ns + base::to_ns(dt * f64::from(k));
        TrajectoryPoint { t_ns, x, y, cos, sin }
    });
    cycle.trajectory = Some(Trajectory { stamp_ns: cycle.now_ns, points: points.collect() });
    let inside = draw.pick(&[3.2, 3.5, 2.8]);
    // In the middle of a segment of the route, along which it comes: it does not drift.
    let now = on_arc(draw.pick(&[7.5, 12.5, 12.5, 17.5]), inside);
    let velocity = draw.pick(&[6.0, 9.0, 12.0]);
    let w = (-velocity * now.cos, -velocity * now.sin);
    let length = draw.pick(&[2.0, 4.5]);
    let lane = Lane::of(cycle);
    // Each time the width is exact to a tenth of what it was.
    let width = (0..16).fold(0.0, |width: f64, _| lane.width(now, [length, length.max(width)], w));
    let width = draw.near(width).clamp(0.3, 5.0);
    let age = seconds(age_ns);
    let frame = Frame { x: now.x - age * w.0, y: now.y - age * w.1, ..now };
    Aimed { frame, size: (length, width), velocity: w, age_ns }
}

/// Beside a route that turns off ahead, or has just done so, as far away as lanes may still bend, or just nearer; and
/// who lies across the way, or is far from the route.
pub fn before_a_corner(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    match draw.below(6) {
        0 | 1 => return from_a_corner(draw, cycle, age_ns),
        2 => return across(draw, cycle, age_ns),
        3 => return far_beside(draw, cycle, age_ns),
        _ => {}
    }
    let aimed = object(draw, cycle, age_ns);
    let road = shape::frame(cycle);
    let far = draw.pick(&[50.0, 35.0, -45.0]);
    let apart = cycle
        .route
        .cross_sections
        .first()
        .map_or(0.0, |it| (it.y - road.y) * road.cos - (it.x - road.x) * road.sin);
    let sin = draw.near(0.05 + f64::hypot(far, apart) / 300.0).min(1.0);
    turn_off(draw, cycle, [far, apart], sin);
    aimed
}

/// The route turns off by an angle of this sine at a place beside the CAV's way: ahead, or behind the CAV.
fn turn_off(draw: &mut Draw<'_>, cycle: &mut Cycle, [far, apart]: [f64; 2], sin: f64) {
    let road = shape::frame(cycle);
    let (cos, sin) = ((1.0 - sin * sin).sqrt(), draw.pick(&[1.0, -1.0]) * sin);
    let at = |x: f64, y: f64| {
        let (x, y) = road.at(x, y);
        cross_section(Frame { x, y, ..road }, 0.0, 0.0, 20.0)
    };
    let turned = |way: f64| at(far + way * cos, apart + way * sin);
    let cross_sections = if far > 0.0 {
        vec![at(-60.0, apart), at(far, apart), turned(40.0)]
    } else {
        vec![turned(-40.0), at(far, apart), at(60.0, apart)]
    };
    cycle.route = Route { closed: false, cross_sections };
}

/// It comes from where the route leads behind a corner, beside that leg, and drives straight on across the CAV's
/// way: the corner is as near as is still a bend, or nearer, or it turns by about 45 degrees.
fn from_a_corner(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let road = shape::frame(cycle);
    let (cos, sin, corner) = if draw.one_in(2) {
        let slope = draw.near(1.0);
        (1.0 / slope.hypot(1.0), slope / slope.hypot(1.0), 22.0)
    } else {
        let (cos, sin) = draw.pick(&[(0.8, 0.6), (0.96, 0.28)]);
        (cos, sin, draw.near(30.0 * (sin - 0.05)))
    };
    turn_off(draw, cycle, [corner, 0.0], sin);
    let end = cycle
        .route
        .cross_sections
        .last()
        .map_or(0.0, |it| (it.y - road.y) * road.cos - (it.x - road.x) * road.sin);
    let (side, aside) = (end.signum(), 3.0);
    // So fast that its front may stand where the other crosses.
    let front = 0.5 * cycle.ego.length + cycle.ego.center_offset;
    while base::s_stop(cycle) + front < corner - aside / sin + 0.5 {
        cycle.ego.speed += 0.25;
    }
    let (way, speed) = (draw.pick(&[10.0, 14.0]), draw.pick(&[10.0, 14.0]));
    let (x, y) = (corner + way * cos - aside * sin, side * (way * sin + aside * cos));
    let w = (-speed * cos, -side * speed * sin);
    let age = seconds(age_ns);
    let (x, y) = road.at(x - age * w.0, y - age * w.1);
    let (cos, sin) = unit(road.turn((-cos, -side * sin)));
    Aimed { frame: Frame { x, y, cos, sin }, size: (2.0, 1.0), velocity: road.turn(w), age_ns }
}

/// A long object backs along a leg that ends behind the CAV. Its centre is beside the route; its end touches the CAV's
/// rear, or just does not.
fn across(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let road = shape::frame(cycle);
    turn_off(draw, cycle, [-18.0, 0.0], 0.6);
    let side = cycle
        .route
        .cross_sections
        .first()
        .map_or(1.0, |it| ((it.y - road.y) * road.cos - (it.x - road.x) * road.sin).signum());
    let ego = &cycle.ego;
    let (rear, beside) =
        (ego.center_offset - 0.5 * ego.length, 0.5 * ego.width + Path::of(cycle).aside);
    // Along the leg to the corner, and aside of it.
    let (end, aside) = (0.8 * (18.0 + rear) - 0.6 * beside, 0.6 * (18.0 + rear) + 0.8 * beside);
    let back = draw.pick(&[5.0, 2.0]);
    let length = draw.near(2.0 * (end + back)).clamp(1.0, 100.0);
    let speed = draw.pick(&[8.0, 4.0]);
    let (x, y) = (-18.0 - 0.8 * back + 0.6 * aside, side * (0.6 * back + 0.8 * aside));
    let (cos, sin) = unit(road.turn((0.8, -0.6 * side)));
    let w = (-speed * cos, -speed * sin);
    let (x, y) = road.at(x, y);
    let age = seconds(age_ns);
    let frame = Frame { x: x - age * w.0, y: y - age * w.1, cos, sin };
    Aimed { frame, size: (length, 2.0), velocity: w, age_ns }
}

/// Behind, about as far aside as who keeps beside may be: it comes nearer by less than a tenth of its way.
fn far_beside(draw: &mut Draw<'_>, cycle: &mut Cycle, age_ns: i64) -> Aimed {
    let road = shape::frame(cycle);
    let section = |a: f64| cross_section(road, a, 0.0, 60.0);
    cycle.route =
        Route { closed: false, cross_sections: [-300.0, 0.0, 60.0].map(section).to_vec() };
    let side = draw.pick(&[1.0, -1.0]);
    let aside = draw.near(20.0);
    let speed = draw.pick(&[30.0, 40.0]);
    let drift = 0.099 * speed;
    let e = (f64::sqrt(speed * speed - drift * drift), -side * drift);
    let until = (aside - 0.5 * cycle.ego.width - 1.0) / drift;
    let age = seconds(age_ns);
    let ahead = draw.pick(&[0.0, 3.0]) - until * e.0;
    let (x, y) = road.at(ahead - age * e.0, side * aside - age * e.1);
    Aimed { frame: Frame { x, y, ..road }, size: (4.5, 1.8), velocity: road.turn(e), age_ns }
}

/// The CAV's places beside the reference path, rounded.
struct Lane<'a> {
    cycle: &'a Cycle,
    path: Path,
}

impl<'a> Lane<'a> {
    fn of(cycle: &'a Cycle) -> Self {
        Self { cycle, path: Path::of(cycle) }
    }

    /// How wide an object of this length, and of this longer side, may be, m.
    fn width(&self, at: Frame, [length, longer]: [f64; 2], w: (f64, f64)) -> f64 {
        let (near, _) = self.nearest((at.x, at.y));
        let q = (at.x - near.0, at.y - near.1);
        let distance = q.0.hypot(q.1);
        let ego = &self.cycle.ego;
        let least = (0..self.path.places.len()).map(|k| {
            let body = self.path.body(self.cycle, k);
            let Frame { x, y, cos, sin } = body.frame;
            let (near, g) = self.nearest((x, y));
            let (aside, g_length) = ((x - near.0).hypot(y - near.1), g.0.hypot(g.1));
            let (along, across) = ((cos * g.0 + sin * g.1).abs(), (cos * g.1 - sin * g.0).abs());
            let half = (along * ego.width + across * ego.length) / (2.0 * g_length);
            (distance - aside).abs() - half - self.path.aside
        });
        let least = least.fold(f64::INFINITY, f64::min);
        let horizon = self.path.until(w.0.hypot(w.1));
        let drift = (w.0 * q.0 + w.1 * q.1).abs() / distance;
        let sagitta = (longer * longer + ego.length * ego.length) / (6.0 * 30.0);
        let room = least - sagitta - drift * horizon;
        let (along, across) = (at.cos * q.0 + at.sin * q.1, at.cos * q.1 - at.sin * q.0);
        (2.0 * room * distance - along.abs() * length) / across.abs()
    }

    /// The nearest point of the reference path and its segment.
    fn nearest(&self, (x, y): (f64, f64)) -> ((f64, f64), (f64, f64)) {
        let pairs = self.cycle.route.cross_sections.windows(2).map(|pair| {
            let g = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
            let share = ((x - pair[0].x) * g.0 + (y - pair[0].y) * g.1) / (g.0 * g.0 + g.1 * g.1);
            let share = share.clamp(0.0, 1.0);
            ((pair[0].x + share * g.0, pair[0].y + share * g.1), g)
        });
        let far = |(near, _): &((f64, f64), (f64, f64))| (near.0 - x).hypot(near.1 - y);
        pairs.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(((x, y), (1.0, 0.0)))
    }
}
