//! The environment model: who leads, who crosses, who is far.

use core::f64::consts::{FRAC_PI_2, PI};

use mufasa::input::cycle::Track;
use mufasa_sim::path::Path;
use mufasa_sim::pose::{Point, Pose};

use super::drive::Drive;
use super::scene::{bend, straight};

fn track(id: i64, x: f64, y: f64, angle: f64, speed: f64) -> Track {
    let (sin, cos) = libm::sincos(angle);
    Track { id, x, y, cos, sin, vx: speed * cos, vy: speed * sin, length: 4.5, width: 1.8 }
}

fn drive(path: &Path) -> Drive<'_> {
    Drive::new(path, Pose::new(Point::new(10.0, 0.0), 0.0), 10.0)
}

#[test]
fn the_nearest_in_the_lane_leads() {
    let path = straight();
    let tracks = [
        track(1, 60.0, 0.0, 0.0, 9.0),
        track(2, 40.0, 0.5, 0.0, 7.0),
        track(3, 30.0, 3.5, PI, 9.0),
        track(4, 0.0, 0.0, 0.0, 12.0),
        track(5, 25.0, -3.0, 0.0, 0.0),
    ];
    let model = drive(&path).environment(&tracks);
    let lead = model.lead.expect("a lead");
    assert!((lead.ahead - (30.0 - 2.25)).abs() < 1e-9 && (lead.speed - 7.0).abs() < 1e-9);
    assert_eq!((model.crossings.len(), model.objects.len()), (0, 5));
    assert!((model.s - 10.0).abs() < 1e-9 && model.left.abs() < 1e-9);
    assert_eq!(drive(&path).environment(&tracks[2..]).lead, None);
}

#[test]
fn along_a_bend_ways_are_those_of_the_path() {
    let path = bend(20.0, FRAC_PI_2);
    // In the middle of the bend, across it: 80 + 20 pi/4 on the path.
    let at = path.pose_at(80.0 + 5.0 * PI);
    let model = drive(&path).environment(&[track(1, at.at.x, at.at.y, at.angle(), 5.0)]);
    let placed = model.objects[0];
    assert!((placed.ahead - (70.0 + 5.0 * PI)).abs() < 0.05 && placed.left.abs() < 0.05);
    assert!((placed.along - 5.0).abs() < 0.01 && (placed.half_length - 2.25).abs() < 0.05);
    assert!(model.lead.is_some());
}

#[test]
fn who_crosses_does_so_when_and_where_it_goes_straight_on() {
    let path = straight();
    // Its front is 12 m from the corridor's edge at -1.45 m: 1.5 s; then 2.9 m and its length.
    let crossing = track(1, 40.0, -1.45 - 2.25 - 12.0, FRAC_PI_2, 8.0);
    let model = drive(&path).environment(&[crossing]);
    assert_eq!(model.lead, None);
    let [found] = model.crossings[..] else { panic!("{model:?}") };
    // To the step of 0.25 s after and before.
    assert!((1.5..1.76).contains(&found.time[0]), "{found:?}");
    let last = 1.5 + (2.9 + 4.5) / 8.0;
    assert!(found.time[1] > last - 0.26 && found.time[1] <= last + 0.01, "{found:?}");
    assert!((found.ways[0] - 29.1).abs() < 1e-6 && (found.ways[1] - 30.9).abs() < 1e-6);
    // Later than 5 s, away from us, behind us, and standing at the side: nobody.
    let others = [
        track(2, 40.0, -60.0, FRAC_PI_2, 8.0),
        track(3, 40.0, -6.0, -FRAC_PI_2, 8.0),
        track(4, 0.0, -10.0, FRAC_PI_2, 8.0),
        track(5, 40.0, -6.0, FRAC_PI_2, 0.1),
    ];
    assert_eq!(drive(&path).environment(&others).crossings, []);
}

#[test]
fn who_cuts_in_leads_and_who_comes_towards_us_counts_as_far_as_stage_iii_looks() {
    let path = straight();
    let cutting = track(1, 30.0, -3.5, 0.2, 8.0);
    let model = drive(&path).environment(&[cutting]);
    assert!(model.lead.is_some() && model.crossings.is_empty());
    // Towards us and into our lane, 10 m ahead and 60 m ahead of the front: s_CAV is 18 m.
    let towards = |ahead: f64| track(1, 13.8 + ahead + 14.0, 4.5, PI + 0.2, 10.0);
    assert_eq!(drive(&path).environment(&[towards(10.0)]).crossings.len(), 1);
    assert_eq!(drive(&path).environment(&[towards(60.0)]).crossings.len(), 0);
}

#[test]
fn tracks_are_moved_on_to_now_and_stops_are_ahead() {
    let path = straight();
    let mut drive = drive(&path);
    drive.stops = vec![5.0, 100.0, 50.0];
    let model = drive.environment(&[]);
    assert_eq!(model.stops, [40.0, 90.0, 389.0]);
}
