//! Distances to the reference path, lengths of trajectories and the gap: in integers.

use mufasa_model::input::cycle::{CrossSection, Profile, Route, Trajectory};
use mufasa_model::input::scene::Point;
use mufasa_model::numbers::real::Real;
use mufasa_model::numbers::vector::{Frame, Vector};
use mufasa_model::report::Stage;
use mufasa_model::services::configuration::Configuration::{MotRemote, PlanRemote};
use mufasa_model::stages::horizon::arc_lengths;

use super::Draw;
use crate::base::{NOW, at_time, base, lead, passes};

/// Whether p is farther than `limit` from the segment from a to b.
fn is_farther([p, a, b]: [[i128; 2]; 3], limit: i128) -> bool {
    let minus = |one: [i128; 2], other: [i128; 2]| [one[0] - other[0], one[1] - other[1]];
    let dot = |one: [i128; 2], other: [i128; 2]| one[0] * other[0] + one[1] * other[1];
    let (side, to) = (minus(b, a), minus(p, a));
    let along = dot(side, to);
    if along <= 0 {
        return dot(to, to) > limit * limit;
    }
    if along >= dot(side, side) {
        return dot(minus(p, b), minus(p, b)) > limit * limit;
    }
    let across = side[0] * to[1] - side[1] * to[0];
    across * across > limit * limit * dot(side, side)
}

/// Whether p is farther than `limit` from a path.
fn is_off(p: [i128; 2], path: &[[i128; 2]; 3], limit: i128) -> bool {
    path.windows(2).all(|pair| is_farther([p, pair[0], pair[1]], limit))
}

/// Whether the distance of p to the path is exactly `limit`: not more, and more than a little less.
fn is_at(p: [i128; 2], path: &[[i128; 2]; 3], limit: i128) -> bool {
    // Distances and limits of so small numbers are equal or farther apart than this.
    const FINE: i128 = 1 << 24;
    let fine = |place: [i128; 2]| place.map(|it| it * FINE);
    !is_off(p, path, limit) && is_off(fine(p), &path.map(fine), limit * FINE - 1)
}

/// Quarters of a metre. A corridor without width holds nothing but the path.
#[test]
fn a_point_is_too_far_from_the_reference_path_as_integers_say() {
    let mut draw = Draw::new(7);
    let (mut seen, mut on) = ([0; 2], 0);
    for _ in 0..2000 {
        let mut place = || [0; 2].map(|_| i128::from(draw.between(-40, 40)));
        let (p, path) = (place(), [place(), place(), place()]);
        if path[0] == path[1] || path[1] == path[2] {
            continue;
        }
        let at = (1..=30).find(|limit| is_at(p, &path, *limit));
        let limit = at.unwrap_or_else(|| i128::from(draw.between(1, 30)));
        let metres = |quarters: i128| f64::from(i32::try_from(quarters).expect("small")) / 4.0;
        let mut cycle = base(Profile::PAPER, PlanRemote);
        cycle.tracks = None;
        let cross_section = |[x, y]: [i128; 2]| {
            let (x, y) = (metres(x), metres(y));
            CrossSection { x, y, left: [x, y], right: [x, y] }
        };
        cycle.route = Route { closed: false, cross_sections: path.map(cross_section).into() };
        let point = at_time(0, metres(p[0]), metres(p[1]));
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![point] });
        cycle.parameters.theta_map = metres(limit);
        let off = is_off(p, &path, limit);
        assert_eq!(passes(&cycle, Stage::Ii), !off, "{cycle:?}");
        seen[usize::from(off)] += 1;
        if at.is_some() {
            cycle.parameters.theta_map = metres(limit).next_down();
            assert!(!passes(&cycle, Stage::Ii), "one double below the distance: {cycle:?}");
            on += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 200) && on > 30, "{seen:?} {on}");
}

/// Steps with whole lengths, and their mirror images.
const STEPS: [[i32; 3]; 5] = [[3, 4, 5], [5, 12, 13], [8, 15, 17], [7, 24, 25], [20, 21, 29]];

#[test]
fn lengths_of_trajectories_with_whole_steps_are_whole() {
    let mut draw = Draw::new(8);
    for _ in 0..200 {
        let (mut at, mut length) = ([0, 0], 0);
        let point = |[x, y]: [i32; 2]| Point {
            t_ns: 0,
            pose: Frame {
                origin: Vector::from_doubles(f64::from(x) / 8.0, f64::from(y) / 8.0),
                direction: Vector::from_doubles(1.0, 0.0),
            },
        };
        let (mut points, mut lengths) = (vec![point(at)], vec![0]);
        for _ in 0..30 {
            let [a, b, c] = STEPS[usize::try_from(draw.between(0, 4)).expect("an index")];
            let factor = draw.between(-9, 9);
            let step = if draw.between(0, 1) == 0 { [a, b] } else { [-b, a] };
            at = [at[0] + factor * step[0], at[1] + factor * step[1]];
            length += factor.abs() * c;
            points.push(point(at));
            lengths.push(length);
        }
        let whole = |length: &i32| Real::from_double(f64::from(*length) / 8.0);
        assert_eq!(arc_lengths(&points), lengths.iter().map(whole).collect::<Vec<_>>());
    }
}

/// `gap <= s_follow` with speeds in quarters of m/s, a braking of whole m/s^2 and a safety time in
/// eighths of a second: times 32 `a_b` everything is whole.
#[test]
fn the_gap_is_compared_as_integers_are() {
    let mut draw = Draw::new(9);
    let mut seen = [0; 2];
    for _ in 0..500 {
        let (v, v_lead) = (draw.between(0, 120), draw.between(0, 120));
        let (a_b, eighths) = (draw.between(1, 10), draw.between(0, 24));
        let s_follow = (v * v - v_lead * v_lead).max(0) + eighths * v * a_b;
        let mut cycle = base(Profile::PAPER, MotRemote);
        cycle.ego.speed = f64::from(v) / 4.0;
        cycle.parameters.a_b = f64::from(a_b);
        cycle.parameters.safety_time = f64::from(eighths) / 8.0;
        // The gap in 1/(32 a_b) m; only multiples of 1/1024 m are doubles of few bits.
        let around = s_follow * 32 / a_b;
        for near in [-1, 0, 1] {
            let gap = around + near;
            if gap < 0 {
                continue;
            }
            cycle.lead = lead(f64::from(gap) / 1024.0, f64::from(v_lead) / 4.0);
            cycle.detections.as_mut().expect("there are some").items.clear();
            let fails = gap * a_b <= s_follow * 32;
            assert_eq!(passes(&cycle, Stage::Iv), !fails, "{cycle:?}");
            seen[usize::from(fails)] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count > 300), "{seen:?}");
}
