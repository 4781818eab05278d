//! `spec/hardened/H-14.md#requirements-the-path`

use mufasa_model::hardened::h14_fail_safe::path::{Place, count, places};
use mufasa_model::input::cycle::{Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::Reading;
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
    assert_eq!(count(&scene, trajectory), places.len() as i128);
    places
}

/// x, y, way, and whether the heading is along x.
fn exact(cycle: &Cycle) -> Vec<(f64, f64, f64, bool)> {
    let of = |place: Place| {
        let [x, y, way] =
            [&place.pose.origin.x, &place.pose.origin.y, &place.way].map(Real::to_f64);
        (x, y, way, place.pose.direction.x == Real::from_integer(1))
    };
    all(cycle, Reading::Exact).into_iter().map(of).collect()
}

fn xs(cycle: &Cycle) -> Vec<f64> {
    exact(cycle).into_iter().map(|(x, ..)| x).collect()
}

/// A node has its own heading, the places before it that of the piece; behind the last one it goes on.
/// H-14.4, H-14.5.
#[test]
fn headings_are_those_of_the_pieces() {
    let turned = cycle(4.0, &[[0.5, 0.5, 0.0, 1.0]]);
    assert_eq!(
        exact(&turned),
        [
            (0.0, 0.0, 0.0, true),
            (0.25, 0.25, 0.25, true),
            (0.5, 0.5, 0.5, false),
            (0.5, 0.75, 0.75, false),
            (0.5, 1.0, 1.0, false),
            (0.5, 1.0, 1.0, false),
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

/// H-14.7, H-14.8: the list ends where the way is s_stop, between two places.
#[test]
fn the_last_place_is_at_s_stop() {
    let ends = all(&cycle(4.0, &[along_x(0.875, 0.0)]), Reading::Exact);
    let [before, last] = [&ends[4], &ends[5]];
    let number = Real::from_double;
    assert_eq!((&before.way, &last.way), (&number(0.875), &number(1.0)));
    assert_eq!((&last.pose.origin.x, ends.len()), (&number(1.0), 6));
    assert_eq!((before.way_after.as_ref(), &last.way_before), (Some(&last.way), &before.way));
    assert_eq!((last.way_after.as_ref(), &ends[0].way_before), (None, &Real::zero()));
    // On a piece that leads aside: a fifth of the way from 0.8 to 1.8 (in parts of 0.2).
    let aside = exact(&cycle(4.0, &[along_x(0.75, 0.0), along_x(1.25, 2.0)]));
    assert_eq!(aside.last(), Some(&(1.0, 1.0, 1.0, true)));
    // Nothing is driven: p, and p as the last place; a step aside alone is no way.
    assert_eq!(xs(&cycle(0.0, &[along_x(0.5, 0.0)])), [0.0, 0.0]);
    let step = exact(&cycle(0.0, &[[0.25, 0.0, 1.0, 0.0]]));
    assert_eq!(step, [(0.0, 0.0, 0.0, true); 2]);
    let mut sideways = cycle(0.0, &[[0.5, 0.5, 1.0, 0.0]]);
    (sideways.ego.cos, sideways.ego.sin) = (0.0, 1.0);
    points(&mut sideways)[0].y = 0.1875;
    points(&mut sideways).push(TrajectoryPoint { x: 9.0, ..at_time(200_000_000, 0.0, 9.0) });
    assert_eq!(exact(&sideways).len(), 2, "0.1875 along y is a way");
}

/// MARGIN-02, MARGIN-03: strictly what is no farther than delta beyond s_stop is examined, too,
/// before the last place and in its window; laxly nothing that is nearer than delta to it, but p.
#[test]
fn the_readings_end_before_and_behind_s_stop() {
    let lengths = |poses: &[[f64; 4]]| {
        [Reading::Strict, Reading::Exact, Reading::Lax].map(|it| all(&cycle(4.0, poses), it).len())
    };
    // 0, 0.25, 0.5, two more, the point, s_stop.
    let ending = |x: f64| lengths(&[along_x(0.5, 0.0), along_x(x, 0.0), along_x(x + 0.25, 0.0)]);
    assert_eq!(ending(1.0 - 2e-6), [6, 6, 5]);
    assert_eq!(ending(1.0 - 0.5e-6), [6, 6, 4]);
    assert_eq!(ending(1.0 + 0.5e-6), [7, 6, 5]);
    assert_eq!(ending(1.0 + 2e-6), [6, 6, 5]);
    // A way aside from there: 7 places of way 1 + 0.5e-6.
    let aside = 1.0 + 0.5e-6;
    let poses = [along_x(0.5, 0.0), along_x(aside, 0.0), along_x(aside, 1.5)];
    assert_eq!(lengths(&poses), [13, 6, 5]);
    let strict = all(&cycle(4.0, &poses), Reading::Strict);
    for place in &strict[5..] {
        assert_eq!((&place.way_before, place.way_after.as_ref()), (&strict[4].way, None));
    }
    assert_eq!(strict[12].way, Real::from_integer(1));
    assert_eq!(all(&cycle(0.0, &poses), Reading::Lax).len(), 1, "p at least");
}

/// How many places there are is the number of places, without going through them.
/// H-14.6.
#[test]
fn places_are_counted_as_they_are() {
    let mut draw = Draw::new(14);
    let mut aside = 0;
    for _ in 0..300 {
        let mut poses = Vec::new();
        let (mut x, mut y) = (f64::from(draw.between(-8, 8)) / 16.0, 0.0);
        for _ in 0..draw.between(1, 12) {
            let cos = [1.0, 0.8, 0.6][usize::try_from(draw.between(0, 2)).expect("small")];
            let sin = f64::sqrt(1.0 - cos * cos);
            poses.push([x, y, cos, sin]);
            x += f64::from(draw.between(-2, 16)) / 16.0 + f64::from(draw.between(-2, 2)) * 5e-7;
            y += f64::from(draw.between(-8, 8)) / 16.0;
        }
        let cycle = cycle(f64::from(draw.between(0, 8)), &poses);
        for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
            aside += usize::from(all(&cycle, reading).len() > 20);
        }
    }
    assert!(aside > 50, "{aside}");
}
