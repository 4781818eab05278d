//! What attacks make of results, item by item.

use mufasa::input::cycle::{Ego, Track, TrajectoryPoint};
use mufasa_sim::attack::{Attack, Attacker, Kind, Results};
use mufasa_sim::cav::sensing::ego;
use mufasa_sim::map::streets::town;
use mufasa_sim::scenario::Scenario;
use mufasa_sim::vehicle::TAU_S;
use mufasa_sim::world::World;

const NOW_NS: i64 = 3_000_000_000;
/// From the CAV's reference point to its front, m, at most.
const FRONT: f64 = 4.5;

/// A track so far ahead of the CAV and to its left, m, with a velocity along both, m/s.
fn track(own: &Ego, id: i64, (ahead, left): (f64, f64), (along, across): (f64, f64)) -> Track {
    let turned = |a: f64, b: f64| (a * own.cos - b * own.sin, a * own.sin + b * own.cos);
    let ((dx, dy), (vx, vy)) = (turned(ahead, left), turned(along, across));
    let (x, y) = (own.x + dx, own.y + dy);
    Track { id, x, y, cos: own.cos, sin: own.sin, vx, vy, length: 4.5, width: 1.8 }
}

/// Tracks with different speeds, the nearest in the CAV's lane 20 m ahead.
fn tracks(own: &Ego) -> Vec<Track> {
    let at = |id: i64, place, velocity| track(own, id, place, velocity);
    vec![
        at(1, (40.0, 5.0), (3.0, 0.0)),
        at(2, (20.0, 0.0), (9.0, 1.0)),
        at(3, (30.0, 0.0), (0.5, 0.0)),
        at(4, (-10.0, 0.0), (5.0, 0.0)),
    ]
}

/// The results before and after an attack of the experiments, on these tracks.
fn attacked(kind: Kind, of: impl Fn(&Ego) -> Vec<Track>) -> (Ego, Results, Results) {
    let town = town();
    let route = town.ego_routes().next().expect("a route");
    let world = World::new(&town, &Scenario::draw(&town, route, 4, 0), 0);
    let truth = world.snapshot();
    let own = ego(&truth, world.body());
    let mut attacker = Attacker::new(vec![Attack::new(kind, 0.0, 100.0, 0)], None);
    attacker.look(NOW_NS, &truth);
    let point = |step: i32| {
        let (x, y) = (own.x + f64::from(step) * own.cos, own.y + f64::from(step) * own.sin);
        let t_ns = NOW_NS + i64::from(step) * 100_000_000;
        TrajectoryPoint { t_ns, x, y, cos: own.cos, sin: own.sin }
    };
    let points = (0..50).map(point).collect();
    let before = Results { stamp_ns: NOW_NS, tracks: of(&own), points };
    let mut after = before.clone();
    attacker.results(&own, &mut after);
    (own, before, after)
}

#[test]
fn a_trajectory_that_starts_late_is_the_same_a_second_later() {
    let (_, before, after) = attacked(Kind::StartsLate, tracks);
    let later = |it: &TrajectoryPoint| TrajectoryPoint { t_ns: it.t_ns + 1_000_000_000, ..*it };
    assert_eq!(after.points, before.points.iter().map(later).collect::<Vec<_>>());
    assert_eq!((after.tracks, after.stamp_ns), (before.tracks, NOW_NS));
}

#[test]
fn false_velocities_are_turned_around() {
    let (_, before, after) = attacked(Kind::FalseVelocities, tracks);
    assert_eq!(after.tracks.len(), before.tracks.len());
    for (it, was) in after.tracks.iter().zip(&before.tracks) {
        assert!((it.vx + was.vx).abs() < 1e-9 && (it.vy + was.vy).abs() < 1e-9, "{it:?}");
        assert_eq!(Track { vx: was.vx, vy: was.vy, ..*it }, *was);
    }
    assert_eq!(after.points, before.points);
}

#[test]
fn the_fastest_and_the_slowest_exchange_their_pasts() {
    let (_, before, after) = attacked(Kind::ExchangedPasts, tracks);
    let of = |list: &[Track], id: i64| *list.iter().find(|it| it.id == id).expect("it is there");
    for (id, moves_as) in [(1, 1), (2, 3), (3, 2), (4, 4)] {
        let (was, other) = (of(&before.tracks, id), of(&before.tracks, moves_as));
        assert_eq!(of(&after.tracks, id), Track { vx: other.vx, vy: other.vy, ..was });
    }
    assert_eq!((after.tracks.len(), after.points), (4, before.points));
    let (_, before, after) = attacked(Kind::ExchangedPasts, |own| tracks(own)[..1].to_vec());
    assert_eq!(after.tracks, before.tracks, "one alone has nobody");
}

#[test]
fn a_ghost_in_the_mean_stands_by_the_nearest_track_of_four() {
    let (own, before, after) = attacked(Kind::GhostInMean, tracks);
    let (ghost, others) = after.tracks.split_last().expect("tracks");
    assert_eq!((others, &after.points), (&before.tracks[..], &before.points));
    let nearest = track(&own, ghost.id, (20.0, 0.0), (0.0, 0.0));
    let (dx, dy) = (ghost.x - nearest.x, ghost.y - nearest.y);
    let (ahead, left) = (dx * own.cos + dy * own.sin, dy * own.cos - dx * own.sin);
    // Ahead is counted from the CAV's front.
    assert!((0.0..=FRONT).contains(&ahead) && left.abs() < 1e-9, "{ahead} {left}");
    assert_eq!((ghost.vx, ghost.vy), (0.0, 0.0));
    assert!(before.tracks.iter().all(|it| it.id != ghost.id));
    let (_, before, after) = attacked(Kind::GhostInMean, |own| tracks(own)[..3].to_vec());
    assert_eq!(after.tracks, before.tracks, "three hide nothing");
}

#[test]
fn a_trajectory_that_ends_early_ends_behind_where_the_cav_can_stop() {
    let (own, before, after) = attacked(Kind::EndsEarly, tracks);
    // Points are 1 m apart.
    let stop = TAU_S * own.speed + own.speed * own.speed / 16.0;
    let way = |count: usize| f64::from(u32::try_from(count).expect("a few")) - 1.0;
    let count = after.points.len();
    assert!(way(count) > stop && way(count) - 1.0 <= stop, "{count} points, {stop} m");
    assert!(count < before.points.len() && after.points == before.points[..count]);
}
