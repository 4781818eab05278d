//! Whether somebody comes: both sides of every threshold.

use mufasa::input::cycle::Track;
use mufasa_sim::map::Town;
use mufasa_sim::map::route::{Conflict, Passage, Route, RouteKind};
use mufasa_sim::path::Path;
use mufasa_sim::pose::{Point, Pose};
use mufasa_sim::services::env::give_way::{Own, closed_lines};

use super::scene::ego_at;

/// Limit of both routes, m/s: the CAV drives as fast, so that its times are ways over this.
const PACE: f64 = 14.0;
/// Where the front of the CAV is, m: 4 s before the conflict, and 4.77 s until its rear is through.
const FRONT: f64 = 141.0;
/// The stop line, the end of the passage, and the conflict on either route, m.
const LINE: f64 = 190.0;
const END: f64 = 215.0;
const MET: (f64, f64) = (197.0, 203.0);
/// Half the length of the others, m.
const HALF: f64 = 2.25;
/// On both sides of a threshold, m, m/s or as a share.
const EPS: f64 = 0.05;

/// Our route along x and another along y; they cross 200 m after the start of either.
fn town(kind: RouteKind, gives_way: bool) -> Town {
    let line = |at: fn(f64) -> Point| {
        Path::new((0..400).map(|s| at(f64::from(s))).collect()).expect("a path")
    };
    let (ours, theirs) = (line(|s| Point::new(s, 0.0)), line(|s| Point::new(200.0, s - 200.0)));
    let mut own = Route::new("ours", RouteKind::Road, ours, 1.75, PACE);
    own.passages = vec![Passage { from: LINE, to: END, group: None }];
    let (passage, with, their_passage) = (0, 1, 0);
    own.conflicts =
        vec![Conflict { passage, here: MET, with, there: MET, their_passage, gives_way }];
    let other = Route::new("theirs", kind, theirs, 1.75, PACE);
    Town { routes: vec![own, other], ..Town::default() }
}

/// Whether the CAV has to wait at the line.
fn waits(town: &Town, (front, speed): (f64, f64), track: Track) -> bool {
    let route = &town.routes[0];
    let ego = ego_at(route.path.pose_at(front - 3.8), speed);
    let own = Own { town, route, s: front - 3.8, ego };
    assert!(closed_lines(&own, &[]).is_empty(), "nobody there");
    match closed_lines(&own, &[track])[..] {
        [] => false,
        [line] => line == LINE,
        _ => panic!("there is one line"),
    }
}

fn track(pose: Pose, speed: f64) -> Track {
    let Pose { at: Point { x, y }, cos, sin } = pose;
    Track {
        id: 1,
        x,
        y,
        cos,
        sin,
        vx: speed * cos,
        vy: speed * sin,
        length: 2.0 * HALF,
        width: 1.8,
    }
}

/// Somebody on the other route, whose front is so far before the conflict, m.
fn other(before: f64, speed: f64) -> Track {
    let s = MET.0 - HALF - before;
    track(Pose { at: Point::new(200.0, s - 200.0), cos: 0.0, sin: 1.0 }, speed)
}

/// Somebody on our route, m along it.
fn ahead(s: f64, speed: f64) -> Track {
    track(Pose { at: Point::new(s, 0.0), cos: 1.0, sin: 0.0 }, speed)
}

#[test]
fn lines_are_looked_at_as_long_as_stopping_there_is_possible() {
    let town = town(RouteKind::Road, true);
    let stands = other(-HALF, 0.0);
    // 10 m/s are stopped in 10 m with 5 m/s^2.
    assert!(waits(&town, (LINE - 10.0 - EPS, 10.0), stands));
    assert!(!waits(&town, (LINE - 10.0 + EPS, 10.0), stands));
    assert!(waits(&town, (LINE - 80.0 + EPS, 10.0), stands));
    assert!(!waits(&town, (LINE - 80.0 - EPS, 10.0), stands));
}

#[test]
fn a_gap_is_a_second_and_a_half_before_and_after() {
    let town = town(RouteKind::Road, true);
    let at = |before: f64| waits(&town, (FRONT, PACE), other(before, 10.0));
    // Our rear is through after 66.8 m; they come 1.5 s later.
    let late = 10.0 * (66.8 / PACE + 1.5);
    assert!(at(late - EPS) && !at(late + EPS));
    // We come after 4 s; their rear was through 1.5 s before: 6 m of conflict and their length.
    let early = 25.0 - (MET.1 - MET.0) - 2.0 * HALF;
    assert!(at(early + EPS) && !at(early - EPS));
}

#[test]
fn who_stands_does_not_come_but_is_in_the_way_where_it_stands() {
    let town = town(RouteKind::Road, true);
    let at = |before: f64, speed: f64| waits(&town, (FRONT, PACE), other(before, speed));
    assert!(at(1.0, 0.5 + EPS) && !at(1.0, 0.5 - EPS));
    assert!(at(-EPS, 0.0) && !at(EPS, 0.0));
    // Expected to go at 0.5 m/s once it is in: its rear is out 1.5 s before we come after 4 s.
    let out = 0.5 * 2.5 - (MET.1 - MET.0) - 2.0 * HALF;
    assert!(at(out + EPS, 0.0) && !at(out - EPS, 0.0));
}

#[test]
fn who_gives_way_to_us_waits_as_long_as_it_can() {
    // 6 m/s are stopped in 6 m with 3 m/s^2.
    let at = |town: &Town, before: f64| waits(town, (FRONT, PACE), other(before, 6.0));
    let theirs = town(RouteKind::Road, false);
    assert!(at(&theirs, 6.0 - EPS) && !at(&theirs, 6.0 + EPS));
    for other in [town(RouteKind::Road, true), town(RouteKind::Foot, false)] {
        assert!(at(&other, 6.0 - EPS) && at(&other, 6.0 + EPS), "goes first, or is on foot");
    }
}

#[test]
fn others_are_looked_for_up_to_120_m_before_and_as_near_to_that_as_to_their_route() {
    let town = town(RouteKind::Road, true);
    // Their middle.
    let at = |before: f64| waits(&town, (FRONT, PACE), other(before - HALF, 25.0));
    assert!(at(122.0 - EPS) && !at(122.0 + EPS));
}

#[test]
fn who_is_beside_the_route_or_drives_across_it_is_not_on_it() {
    let town = town(RouteKind::Road, true);
    let aside = |left: f64| {
        let track = other(20.0, 10.0);
        waits(&town, (FRONT, PACE), Track { x: track.x - left, ..track })
    };
    assert!(aside(2.0 - EPS) && !aside(2.0 + EPS));
    // With the cosine of the angle to the route: as it goes, and who stands as it is turned.
    let going = |cos: f64| {
        let (at, sin) = (other(20.0, 10.0), (1.0 - cos * cos).sqrt());
        waits(&town, (FRONT, PACE), Track { vx: -10.0 * sin, vy: 10.0 * cos, ..at })
    };
    assert!(going(0.7 + EPS) && !going(0.7 - EPS));
    let turned = |cos: f64| {
        let (at, sin) = (other(-HALF, 0.0), (1.0 - cos * cos).sqrt());
        waits(&town, (FRONT, PACE), Track { cos: -sin, sin: cos, ..at })
    };
    assert!(turned(0.7 + EPS) && !turned(0.7 - EPS));
}

#[test]
fn a_passage_behind_which_there_is_no_room_is_not_entered() {
    let town = town(RouteKind::Road, true);
    let at = |s: f64, speed: f64| waits(&town, (FRONT, PACE), ahead(s, speed));
    assert!(at(210.0, 2.0 - EPS) && !at(210.0, 2.0 + EPS));
    // Our length of 4.8 m and 2 m behind the passage, up to its rear.
    let room = END + 4.8 + 2.0 + HALF;
    assert!(at(room - EPS, 0.0) && !at(room + EPS, 0.0));
    assert!(at(LINE + EPS, 0.0) && !at(LINE - EPS, 0.0));
}
