//! Roads that bend, close or are cut back, and roads that are alike but not equal, with a CAV that
//! stands near an edge of the corridor (`spec/3-stages.md#stage-ii-trajectory-to-map`).

use std::f64::consts::TAU;

use mufasa_model::input::cycle::{
    CrossSection, Cycle, DetectionList, Profile, Route, Trajectory, TrajectoryPoint,
};
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame};
use super::draw::Draw;

/// Left and right boundary points of two cross sections, around the corridor between them.
type Corners = [(f64, f64); 4];

/// A place and a direction in the frame of a road.
type Pose = ((f64, f64), (f64, f64));

/// A cycle that stage ii decides on a road of any of these shapes.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let mut cycle = standing(draw, frame, profile);
    match draw.below(4) {
        0 => notch(draw, frame, &mut cycle),
        1 => curve(draw, frame, &mut cycle, false),
        2 => curve(draw, frame, &mut cycle, true),
        _ => return alike(draw, profile),
    }
    cycle
}

/// A cycle on a road that others of this function resemble: in one frame, of four cross sections,
/// the first and the last always the same. Of two in succession the second tells whether a program
/// still judges by the route of the first.
pub fn alike(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let mut cycle = standing(draw, frame, profile);
    let bend = draw.pick(&[4.0, -4.0, 0.0]);
    let half_width = draw.pick(&[1.5, 2.5]);
    let sections = [(0.0, 0.0, 2.0), (10.0, bend, half_width), (20.0, bend, half_width)];
    let sections = sections.into_iter().chain([(30.0, 0.0, 2.0)]);
    let cross_sections = sections.map(|(a, b, half)| base::cross_section(frame, a, b, half));
    // Closed, it leads straight back: the corridor is wider, the path longer.
    cycle.route = Route { closed: draw.one_in(4), cross_sections: cross_sections.collect() };
    // At an edge of this one, or anywhere in one of the others.
    let aside = if draw.one_in(4) {
        draw.pick(&[4.0, -4.0, 0.0, 2.0, -2.0, 5.0, -5.0])
    } else {
        bend + draw.pick(&[half_width, -half_width]) + draw.offset()
    };
    let along = draw.pick(&[15.0, 10.5, 19.5]);
    stand(&mut cycle, frame, ((along, aside), (1.0, 0.0)));
    cycle
}

/// A cycle of a CAV that stands and sees nothing.
fn standing(draw: &mut Draw<'_>, frame: Frame, profile: Profile) -> Cycle {
    let configurations =
        [Configuration::AllRemote, Configuration::PlanRemote, Configuration::MotRemote];
    let configuration = draw.pick(&configurations);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    cycle.ego.speed = 0.0;
    // An empty list is the obstacle check that passes.
    cycle.detections = Some(DetectionList { stamp_ns: cycle.now_ns, items: Vec::new() });
    cycle
}

/// Puts the CAV and its trajectory of one point there.
fn stand(cycle: &mut Cycle, frame: Frame, (place, heading): Pose) {
    let ((x, y), (cos, sin)) = (frame.at(place.0, place.1), frame.turn(heading));
    (cycle.ego.x, cycle.ego.y, cycle.ego.cos, cycle.ego.sin) = (x, y, cos, sin);
    let t_ns = cycle.now_ns;
    let point = TrajectoryPoint { t_ns, x, y, cos, sin };
    cycle.trajectory = Some(Trajectory { stamp_ns: t_ns, points: vec![point] });
}

/// A corridor with one corner drawn in beyond the line between its neighbours: what is left and
/// what is right of that line depends on the diagonal by which it is split. The path is far off, on
/// the other side.
fn notch(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle) {
    let (length, half) = (draw.pick(&[8.0, 6.0, 20.0]), draw.pick(&[3.0, 5.0]));
    // Around the corridor: left, right, right, left.
    let mut corners: Corners = [(0.0, half), (0.0, -half), (length, -half), (length, half)];
    let which = draw.below(4);
    let [before, opposite, after] = [3, 2, 1].map(|step| corners[(which + step) % 4]);
    let middle = (before.0.midpoint(after.0), before.1.midpoint(after.1));
    let inward = (opposite.0 - middle.0, opposite.1 - middle.1);
    let part = draw.pick(&[0.5, 0.25, 0.75]);
    corners[which] = (middle.0 + part * inward.0, middle.1 + part * inward.1);
    let place = if draw.below(4) == 0 {
        (middle.0 + 0.5 * part * inward.0, middle.1 + 0.5 * part * inward.1)
    } else {
        // The diagonal of the text runs from the first left to the second right point.
        let drawn_in = [(corners[which], before), (corners[which], after)];
        let edges = if which % 2 == 1 { [(before, after); 2] } else { drawn_in };
        let ends = draw.pick(&edges);
        beside(draw, ends)
    };
    let path = if matches!(which, 0 | 3) { -half } else { half };
    let [l0, r0, r1, l1] = corners.map(|(a, b)| frame.at(a, b).into());
    let at = |a: f64| frame.at(a, path);
    let section = |(x, y), left, right| CrossSection { x, y, left, right };
    let cross_sections = vec![section(at(0.0), l0, r0), section(at(length), l1, r1)];
    cycle.route = Route { closed: false, cross_sections };
    stand(cycle, frame, (place, (1.0, 0.0)));
}

/// A road on an arc, or all around: left or right about, boundaries along the radius. In a closed
/// one half of the places lie between the last and the first cross section.
fn curve(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle, closed: bool) {
    let radius = draw.pick(&[12.0, 6.0, 40.0]);
    let half = draw.pick(&[2.0, 0.5, 4.0]);
    let count = draw.between(3, 8);
    let turn = draw.pick(&[1.0, -1.0]);
    let step = if closed { TAU / count as f64 } else { draw.pick(&[0.2, 0.5, 0.05]) };
    // The centre is to the left, or to the right, of the first cross section.
    let on = |index: usize, aside: f64| {
        let (sin, cos) = (step * index as f64).sin_cos();
        ((radius - aside) * sin, turn * (radius - (radius - aside) * cos))
    };
    let section = |index: usize| {
        let (x, y) = {
            let (a, b) = on(index, 0.0);
            frame.at(a, b)
        };
        let [left, right] = [turn * half, -turn * half].map(|aside| {
            let (a, b) = on(index, aside);
            frame.at(a, b).into()
        });
        CrossSection { x, y, left, right }
    };
    cycle.route = Route { closed, cross_sections: (0..count).map(section).collect() };
    let from = if closed && draw.one_in(2) { count - 1 } else { draw.below(count - 1) };
    let theta_map = cycle.parameters.theta_map;
    // The boundaries, at times a diagonal; in the paper profile also theta_map beside the path.
    let (near, far) = match (draw.below(8), cycle.profile) {
        (0, _) => draw.pick(&[(half, -half), (-half, half)]),
        (1 | 2, Profile::PAPER) => draw.pick(&[(theta_map, theta_map), (-theta_map, -theta_map)]),
        _ => draw.pick(&[(half, half), (-half, -half)]),
    };
    let place = beside(draw, (on(from, near), on(from + 1, far)));
    let (a, b) = (on(from, 0.0), on(from + 1, 0.0));
    stand(cycle, frame, (place, unit((b.0 - a.0, b.1 - a.1))));
}

/// A place on a segment, or a little beside it.
fn beside(draw: &mut Draw<'_>, (a, b): ((f64, f64), (f64, f64))) -> (f64, f64) {
    let part = draw.pick(&[0.5, 0.25, 0.9, 0.0]);
    let (along, aside) = ((b.0 - a.0, b.1 - a.1), draw.offset());
    let normal = unit((-along.1, along.0));
    (a.0 + part * along.0 + aside * normal.0, a.1 + part * along.1 + aside * normal.1)
}

/// The direction of a vector that is not null.
fn unit((a, b): (f64, f64)) -> (f64, f64) {
    let length = a.hypot(b).max(1e-9);
    (a / length, b / length)
}
