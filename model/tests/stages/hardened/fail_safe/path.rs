//! `spec/hardened/H-14.md#requirements-the-path`

use mufasa_model::hardened::h14_fail_safe::failure;
use mufasa_model::hardened::h14_fail_safe::path::{
    Place, count, greatest_length, places, places_by_length,
};
use mufasa_model::hardened::h14_fail_safe::times::Driving;
use mufasa_model::input::cycle::{Cycle, Profile, Track, Trajectory, TrajectoryPoint};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Reading, Rule};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use super::scene;
use crate::base::*;
use crate::exact::Draw;
use crate::near::points;

/// The CAV at `v` m/s brakes at once: s_stop = v^2 / 16. The trajectory leads to these poses.
fn cycle(v: f64, poses: &[[f64; 4]]) -> Cycle {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    (cycle.ego.speed, cycle.parameters.tau) = (v, 0.0);
    let point = |(i, [x, y, cos, sin]): (i64, &[f64; 4])| TrajectoryPoint {
        cos: *cos,
        sin: *sin,
        ..at_time(i * 100_000_000, *x, *y)
    };
    let points = (0..).zip(poses).map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    cycle
}

/// A pose that looks along x.
fn along_x(x: f64, y: f64) -> [f64; 4] {
    [x, y, 1.0, 0.0]
}

fn all(cycle: &Cycle, reading: Reading) -> Vec<Place> {
    let scene = scene(cycle, reading);
    let trajectory = scene.trajectory.as_ref().expect("it is current");
    let places: Vec<Place> = places(&scene, trajectory).collect();
    let by_length = by_length(cycle, reading);
    assert!(places.len() <= by_length);
    if reading == Reading::Exact {
        assert_eq!(count(&scene, trajectory), by_length as i128);
    }
    places
}

/// How many places there are without an end by distance.
fn by_length(cycle: &Cycle, reading: Reading) -> usize {
    let scene = scene(cycle, reading);
    places_by_length(&scene, scene.trajectory.as_ref().expect("it is current")).count()
}

/// How many places there are: strict, exact, lax.
fn counts(cycle: &Cycle) -> [usize; 3] {
    [Reading::Strict, Reading::Exact, Reading::Lax].map(|it| all(cycle, it).len())
}

/// x, y, progress, and whether the heading is along x.
fn exact(cycle: &Cycle) -> Vec<(f64, f64, f64, bool)> {
    let of = |place: Place| {
        let [x, y, progress] =
            [&place.pose.origin.x, &place.pose.origin.y, &place.progress].map(Real::to_f64);
        (x, y, progress, place.pose.direction.x == Real::from_integer(1))
    };
    all(cycle, Reading::Exact).into_iter().map(of).collect()
}

fn xs(cycle: &Cycle) -> Vec<f64> {
    exact(cycle).into_iter().map(|(x, ..)| x).collect()
}

/// Progress and length of each place.
fn measures(cycle: &Cycle) -> Vec<[f64; 2]> {
    let of = |place: &Place| [&place.progress, &place.length].map(Real::to_f64);
    all(cycle, Reading::Exact).iter().map(of).collect()
}

/// A node has its own heading, the places before it that of the piece; behind the last one it goes on.
/// H-14.4, H-14.5.
#[test]
fn headings_are_those_of_the_pieces() {
    let turned = cycle(4.0, &[[0.5, 0.5, 0.0, 1.0]]);
    assert_eq!(
        exact(&turned)[..5],
        [
            (0.0, 0.0, 0.0, true),
            (0.25, 0.25, 0.25, true),
            (0.5, 0.5, 0.5, false),
            (0.5, 0.75, 0.5, false),
            (0.5, 1.0, 0.5, false),
        ]
    );
    // On a piece the last place has the heading of the piece, even where it takes the place of a node.
    let ends = exact(&cycle(4.0, &[[1.25, 0.0, 0.0, 1.0]]));
    assert_eq!(ends[5], (1.0, 0.0, 1.0, true));
    let ends = exact(&cycle(4.0, &[[0.75, 0.0, 1.0, 0.0], [1.0625, 0.0, 0.0, 1.0]]));
    assert_eq!(
        ends[3..],
        [(0.75, 0.0, 0.75, true), (0.90625, 0.0, 0.90625, true), (1.0, 0.0, 1.0, true)]
    );
}

/// H-14.7, H-14.8: the list ends where the progress is s_stop, between two places.
#[test]
fn the_last_place_is_at_s_stop() {
    let ends = all(&cycle(4.0, &[along_x(0.875, 0.0)]), Reading::Exact);
    let [before, last] = [&ends[4], &ends[5]];
    let number = Real::from_double;
    assert_eq!((&before.progress, &last.progress), (&number(0.875), &number(1.0)));
    assert_eq!((&last.pose.origin.x, &last.length, ends.len()), (&number(1.0), &number(1.0), 6));
    assert_eq!((before.length_after.as_ref(), &last.least), (Some(&last.length), &before.progress));
    assert_eq!((last.length_after.as_ref(), &ends[0].least), (None, &Real::zero()));
    // Half of a piece that leads 0.25 m ahead and 0.25 m aside: half of its length of 0.5 m.
    let half = measures(&cycle(4.0, &[along_x(0.875, 0.0), along_x(1.125, 0.25)]));
    assert_eq!(half.last(), Some(&[1.0, 0.875 + 0.25]));
    // On a piece that leads aside.
    let aside = exact(&cycle(4.0, &[along_x(0.875, 0.0), along_x(1.375, 0.5)]));
    assert_eq!(aside.last(), Some(&(1.0, 0.125, 1.0, true)));
    // Nothing is driven: p, and p as the last place.
    assert_eq!(xs(&cycle(0.0, &[along_x(0.5, 0.0)])), [0.0, 0.0]);
    let step = exact(&cycle(0.0, &[[0.25, 0.0, 1.0, 0.0]]));
    assert_eq!(step, [(0.0, 0.0, 0.0, true); 2]);
    let mut sideways = cycle(0.0, &[[0.5, 0.5, 1.0, 0.0]]);
    (sideways.ego.cos, sideways.ego.sin) = (0.0, 1.0);
    points(&mut sideways)[0].y = 0.1875;
    points(&mut sideways).push(TrajectoryPoint { x: 9.0, ..at_time(200_000_000, 0.0, 9.0) });
    assert_eq!(exact(&sideways).len(), 2, "ahead is along y");
}

/// MARGIN-02, MARGIN-03: strictly what is no farther than delta beyond s_stop is examined, too,
/// before the last place and in its window; laxly nothing that is nearer than delta to it, but p.
#[test]
fn the_readings_end_before_and_behind_s_stop() {
    let lengths = |poses: &[[f64; 4]]| counts(&cycle(4.0, poses));
    // 0, 0.25, 0.5, two more, the point, s_stop.
    let ending = |x: f64| lengths(&[along_x(0.5, 0.0), along_x(x, 0.0), along_x(x + 0.25, 0.0)]);
    assert_eq!(ending(1.0 - 2e-6), [6, 6, 5]);
    assert_eq!(ending(1.0 - 0.5e-6), [6, 6, 4]);
    assert_eq!(ending(1.0 + 0.5e-6), [7, 6, 5]);
    assert_eq!(ending(1.0 + 2e-6), [6, 6, 5]);
    // From there aside: 7 places with a progress of 1 + 0.5e-6, the last one at s_stop.
    let aside = 1.0 + 0.5e-6;
    let poses = [along_x(0.5, 0.0), along_x(aside, 0.0), along_x(aside, 1.5)];
    assert_eq!(lengths(&poses), [13, 6, 5]);
    // Up to 2 m from p, and the first one beyond.
    let farther = [along_x(0.5, 0.0), along_x(aside, 0.0), along_x(aside, 3.0)];
    assert_eq!(lengths(&farther), [14, 6, 5]);
    let strict = all(&cycle(4.0, &poses), Reading::Strict);
    for place in &strict[5..] {
        assert_eq!((&place.least, place.length_after.as_ref()), (&strict[4].progress, None));
    }
    assert_eq!(strict[12].progress, Real::from_integer(1));
    assert_eq!(strict[6].length, Real::from_double(aside) + Real::from_double(0.25));
    // From there back to 0.75, and on to 1.
    assert_eq!(lengths(&[along_x(0.5, 0.0), along_x(aside, 0.0), along_x(0.75, 0.0)]), [10, 6, 5]);
    assert_eq!(all(&cycle(0.0, &poses), Reading::Lax).len(), 1, "p at least");
}

/// H-14.2: headings to and fro do not make the CAV come farther or less far, moves across do not either, and who goes
/// back loses what it had gained.
#[test]
fn only_what_is_ahead_is_progress() {
    let turned: &[[f64; 2]] = &[[0.6, 0.8], [0.6, -0.8], [0.0, 1.0], [-1.0, 0.0]];
    let weave: Vec<[f64; 4]> = (1..=8)
        .map(|i| f64::from(i) / 4.0)
        .zip(turned.iter().cycle())
        .map(|(x, [c, s])| [x, 0.0, *c, *s])
        .collect();
    assert_eq!(xs(&cycle(4.0, &weave)), [0.0, 0.25, 0.5, 0.75, 1.0, 1.0]);
    let zigzag: Vec<[f64; 4]> =
        (1..=8).map(|i| along_x(f64::from(i) / 4.0, f64::from(i % 2) / 8.0)).collect();
    assert_eq!(xs(&cycle(4.0, &zigzag)), [0.0, 0.25, 0.5, 0.75, 1.0, 1.0]);
    let back = cycle(4.0, &[along_x(0.5, 0.0), along_x(-0.25, 0.0)]);
    let expected = [0.0, 0.25, 0.5, 0.25, 0.0, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0];
    assert_eq!(xs(&back), expected);
    let progress: Vec<f64> = measures(&back).iter().map(|[progress, _]| *progress).collect();
    assert_eq!(progress, expected);
}

/// H-14.59: along and across a heading, whatever it is, a piece is not shorter than it is.
#[test]
fn headings_do_not_shorten_the_length() {
    let lengths = |[cos, sin]: [f64; 2]| {
        // 0.25 m ahead, ahead and aside, and back.
        let poses = [[0.25, 0.0, cos, sin], [0.5, 0.25, cos, sin], along_x(0.25, 0.25)];
        let all = measures(&cycle(4.0, &poses));
        [1, 2, 3].map(|k| all[k][1]).to_vec()
    };
    assert_eq!(lengths([1.0, 0.0]), [0.25, 0.75, 1.0]);
    for aside in [[0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
        assert_eq!(lengths(aside), [0.25, 0.75, 1.0], "{aside:?}");
    }
    let turned = lengths([0.6, 0.8]);
    let [second, third] = [1, 2].map(|k| turned[k] - turned[k - 1]);
    assert!((second - 0.4).abs() < 1e-9 && (third - 0.35).abs() < 1e-9, "{turned:?}");
}

/// H-14.60: a path that never comes to s_stop ends with the first place that is farther than 2 s_stop + 1 m = 3 m.
#[test]
fn a_path_that_does_not_come_to_s_stop_ends_by_length() {
    // There and back and there again: 2.5 m, and nowhere farther than 1 m from p.
    let to_and_fro = [along_x(0.5, 0.0), along_x(-0.5, 0.0)];
    for [cos, sin] in [[0.0, 1.0], [0.0, -1.0], [-1.0, 0.0]] {
        let poses = [&to_and_fro[..], &[[0.5, 0.0, cos, sin]]].concat();
        let all = all(&cycle(4.0, &poses), Reading::Exact);
        let lengths: Vec<f64> = all.iter().map(|place| place.length.to_f64()).collect();
        assert_eq!((lengths.len(), &lengths[11..]), (14, &[2.75, 3.0, 3.25][..]));
        assert_eq!(all[13].length_after, None);
    }
    // Between two places at 3 m: strictly one more, laxly one less.
    let lengths = |e: f64| {
        let turned = [along_x(0.5, 0.0), [0.5, 0.5 + e, 0.0, 1.0]];
        counts(&cycle(4.0, &[&to_and_fro[..], &turned].concat()))
    };
    assert_eq!(lengths(-0.5e-6), [14, 14, 13]);
    assert_eq!(lengths(-2e-6), [14; 3]);
    let beyond = lengths(0.5e-6);
    assert_eq!(beyond, [15, 14, 14]);
    assert_eq!(lengths(2e-6), [14; 3]);
}

/// H-14.60: a turn by 90 degrees ends with the first place that is farther than s_stop + 1 m = 2 m from p, behind the
/// last node or on a piece; the same to the right, and a path that goes back.
#[test]
fn a_sharp_turn_ends_by_distance() {
    for side in [1.0, -1.0] {
        let ends = [[1.0, 0.0], [0.0, side]].map(|[cos, sin]| [0.5, 2.0 * side, cos, sin]);
        let turns = [vec![[0.5, 0.0, 0.0, side]], vec![along_x(0.5, 0.0), ends[0]]];
        for (poses, is_along_x) in turns.iter().zip([false, true]) {
            let all = exact(&cycle(4.0, poses));
            let turned = [1, 2, 3, 4, 5, 6, 7, 8]
                .map(|k| (0.5, side * 0.25 * f64::from(k), 0.5, is_along_x));
            assert_eq!(all[3..], turned, "1.8 m from p is not the last one");
        }
    }
    let turn = all(&cycle(4.0, &[[0.5, 0.0, 0.0, 1.0]]), Reading::Exact);
    let last = &turn[10];
    assert_eq!((last.length.to_f64(), last.length_after.as_ref()), (2.5, None));
    assert_eq!((last.least.to_f64(), turn[9].length_after.as_ref()), (0.5, Some(&last.length)));
    // 2 m from p is not farther than that.
    let back = xs(&cycle(4.0, &[[0.5, 0.0, -1.0, 0.0]]));
    assert_eq!(back[9..], [-1.25, -1.5, -1.75, -2.0, -2.25]);
    // A CAV may be farther aside than 1 m: 1 m + 2 m.
    let mut beside = cycle(4.0, &[[0.5, 0.0, 0.0, 1.0]]);
    for (lateral_tolerance, places) in [(0.5, 11), (1.0, 11), (1.25, 12), (2.0, 14)] {
        beside.parameters.lateral_tolerance = lateral_tolerance;
        assert_eq!(exact(&beside).len(), places, "{lateral_tolerance}");
    }
    // What is too far from p comes before what is ahead of s_stop.
    let aside = exact(&cycle(4.0, &[along_x(0.75, 0.0), along_x(1.5, 6.0)]));
    let to = [1, 2, 3, 4, 5, 6, 7].map(|k| (0.75 + f64::from(k) / 32.0, f64::from(k) / 4.0));
    assert_eq!(aside[4..], to.map(|(x, y)| (x, y, x, true)));
}

/// H-14.60, MARGIN-01, MARGIN-03: s_stop = 1.25 m, and a place at (0.75, 1 + e): strictly one more, laxly one less, and
/// the windows of the exact model.
#[test]
fn the_readings_end_before_and_behind_the_distance() {
    let turn = |e: f64| {
        let mut turn = cycle(1.0, &[along_x(1.25, 0.0), [1.25, 3.0 + e, 0.0, 1.0]]);
        let parameters = &mut turn.parameters;
        (parameters.tau, parameters.a_max, parameters.a_b) = (1.0, 0.5, 1.125);
        turn
    };
    let at = |e: f64| counts(&turn(e));
    assert_eq!(at(-2e-6), [19; 3]);
    assert_eq!(at(-0.5e-6), [19, 19, 18]);
    assert_eq!(at(0.0), [19, 19, 18]);
    assert_eq!(at(1e-15), [20, 19, 19]);
    assert_eq!(at(0.5e-6), [20, 19, 19]);
    assert_eq!(at(2e-6), [19; 3]);
    let windows = |reading| {
        let of = |place: Place| (place.least, place.length_after);
        all(&turn(0.0), reading).into_iter().map(of).collect::<Vec<_>>()
    };
    let (exact, lax) = (windows(Reading::Exact), windows(Reading::Lax));
    assert_eq!(exact[..18], lax);
    assert!(lax[17].1.is_some());
}

/// H-14.51: the work counts the places that the list of a turn has without an end by distance.
#[test]
fn an_end_by_distance_makes_no_work_less() {
    let mut turn = cycle(4.0, &[[0.5, 0.0, 0.0, 1.0]]);
    turn.tracks = tracks(vec![track(1, 3.0, 0.0)]);
    (turn.detections, turn.parameters.work_limit) = (None, 0);
    assert_eq!(counts(&turn), [11; 3]);
    let scene = scene(&turn, Reading::Strict);
    let witness = failure(&scene, scene.trajectory.as_ref().expect("it is current"));
    let found = witness.map(|it| (it.rule, it.compared[0].to_string()));
    assert_eq!(found, Some((Rule::WorkLimit, (320 + 3360 + 528 * 14).to_string())));
}

/// H-14.51: K is 6 places, E the 2 at s_stop, and C 2 cross sections, for an object that comes near and keeps beside.
#[test]
fn who_keeps_beside_takes_more_work() {
    let mut beside = cycle(4.0, &[along_x(0.5, 0.0)]);
    beside.tracks = tracks(vec![Track { vx: 1.0, ..track(1, 3.0, 2.05) }]);
    (beside.detections, beside.parameters.work_limit) = (None, 0);
    let scene = scene(&beside, Reading::Strict);
    let witness = failure(&scene, scene.trajectory.as_ref().expect("it is current"));
    let (near, keeps_beside) = (3360 + 528 * 8, 1712 + 528 * 8 + 32 * 2);
    let work = witness.expect("there is work").compared[0].to_string();
    assert_eq!(work, (320 + near + keeps_beside).to_string());
}

/// H-14.51: E are the places beyond s_stop - delta = 1023/1024 m. The node there is not among them.
#[test]
fn a_place_exactly_delta_before_s_stop_is_none_of_those_at_its_end() {
    let work = |delta: f64| {
        let mut cycle = cycle(4.0, &[along_x(1023.0 / 1024.0, 0.0)]);
        cycle.tracks = tracks(vec![track(1, 3.0, 0.0)]);
        (cycle.detections, cycle.parameters.work_limit) = (None, 0);
        cycle.parameters.delta = delta;
        let scene = scene(&cycle, Reading::Strict);
        let found = failure(&scene, scene.trajectory.as_ref().expect("it is current"));
        found.expect("there is work").compared[0].to_string().parse::<i64>().expect("whole")
    };
    let exactly = work(1.0 / 1024.0);
    assert_eq!(work(1.0 / 2048.0), exactly);
    assert_eq!(work((1.0_f64 / 1024.0).next_up()), exactly + 528);
}

/// H-14.11: the least progress of a place, of the one before it and of the one after it, at least 0.
#[test]
fn a_window_begins_with_the_least_progress_around_its_place() {
    let poses = [along_x(0.5, 0.0), along_x(-0.25, 0.0), along_x(1.0, 0.0)];
    let least: Vec<f64> =
        all(&cycle(4.0, &poses), Reading::Exact).iter().map(|place| place.least.to_f64()).collect();
    assert_eq!(least, [0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0]);
}

/// How many places there are without an end by distance, without going through them; strictly there are no fewer, laxly
/// no more.
/// H-14.6, H-14.60.
#[test]
fn places_are_counted_as_they_are() {
    let mut draw = Draw::new(14);
    let (mut many, mut too_far, mut too_long) = (0, 0, 0);
    for _ in 0..600 {
        let mut poses = Vec::new();
        let (mut x, mut y) = (f64::from(draw.between(-8, 8)) / 16.0, 0.0);
        for _ in 0..draw.between(1, 12) {
            let cos =
                [1.0, 0.8, 0.6, 0.0, -0.6][usize::try_from(draw.between(0, 4)).expect("small")];
            let sin = f64::sqrt(1.0 - cos * cos);
            poses.push([x, y, cos, sin]);
            x += f64::from(draw.between(-2, 16)) / 16.0 + f64::from(draw.between(-2, 2)) * 5e-7;
            y += f64::from(draw.between(-8, 8)) / 16.0;
        }
        let cycle = cycle(f64::from(draw.between(0, 8)), &poses);
        let [strict, exact, lax] =
            [Reading::Strict, Reading::Exact, Reading::Lax].map(|reading| all(&cycle, reading));
        assert!(strict.len() >= exact.len() && exact.len() >= lax.len());
        let scene = scene(&cycle, Reading::Exact);
        let most = Driving::of(&scene).s_stop() + Real::from_integer(1);
        let is_far = |place: &Place| place.pose.origin.distance(&scene.ego.position) > most;
        let (last, before) = exact.split_last().expect("p at least");
        assert!(!before.iter().any(is_far));
        assert!(is_far(last) || exact.len() == by_length(&cycle, Reading::Exact));
        too_far += usize::from(is_far(last));
        too_long += usize::from(last.length > greatest_length(&scene));
        many += usize::from(exact.len() > 20);
    }
    assert!(many > 30 && too_far > 30 && too_long > 5, "{many}, {too_far}, {too_long}");
}
