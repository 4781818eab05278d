//! The history of a cycle: the same scans that earlier cycles had as their detections.

use mufasa_drives::{Drive, Options, Sensor};
use mufasa_model::input::cycle::DetectionList;

use super::files::{Scratch, demo, one, own, small};

fn histories(drive: &Drive) -> impl Iterator<Item = &Vec<DetectionList>> {
    drive.cycles.iter().map(|it| &it.cycle.detection_history)
}

fn scan(drive: &Drive, index: usize) -> DetectionList {
    drive.cycles[index].cycle.detections.clone().expect("detections")
}

#[test]
fn the_history_of_a_cycle_is_what_was_seen_then() {
    let sensor =
        Sensor { probability: 0.9, sigma_m: 0.1, clutter: 2.0, seed: 5, ..Sensor::default() };
    let drive = demo(&Options { sensor, ..Options::default() });
    for (i, history) in histories(&drive).enumerate() {
        let ago: &[usize] = match i {
            0 | 1 => &[],
            2 => &[2],
            3 => &[3],
            4 => &[3, 4],
            5 => &[3, 5],
            6 => &[3, 5, 6],
            7 => &[3, 5, 7],
            _ => &[3, 5, 8],
        };
        let expected: Vec<_> = ago.iter().map(|ago| scan(&drive, i - ago)).collect();
        assert_eq!(*history, expected, "{i}");
    }
    // The scans differ, and miss something.
    assert_ne!(scan(&drive, 0).items, scan(&drive, 1).items);
    let seen =
        drive.cycles.iter().map(|it| it.cycle.detections.as_ref().map_or(0, |d| d.items.len()));
    assert!(seen.clone().max() > seen.min());
}

/// The CAV comes when the others are 0.6 s on the road: it has seen them.
#[test]
fn the_history_begins_before_the_cav_where_the_file_does() {
    let options = Options::default();
    let whole = small("2020a", Some("KS2"), &options);
    let solution = std::fs::read_to_string(own("readers/small.KS2.solution.xml")).unwrap();
    let is_late = |line: &&str| (0..6).all(|step| !line.contains(&format!("<time>{step}</time>")));
    let late: Vec<_> = solution.lines().filter(is_late).collect();
    let folder = Scratch::new();
    let late = folder.write("late.solution.xml", late.join("\n"));
    let late = one(&[own("readers/small-2020a.xml"), late], &options).unwrap();
    assert_eq!(late.cycles[0].id, "late.solution#6");
    assert!(late.notes.iter().any(|it| it.starts_with("the history begins before")));
    // Their clocks start with their first cycles.
    let moved = |index: usize| DetectionList {
        stamp_ns: scan(&whole, index).stamp_ns - 600_000_000,
        items: scan(&whole, index).items,
    };
    assert_eq!(*histories(&late).next().unwrap(), [moved(3), moved(1), moved(0)]);
    assert_eq!(scan(&late, 0).items, scan(&whole, 6).items);
    assert_eq!(*histories(&late).nth(1).unwrap(), [moved(4), moved(2), moved(0)]);
    assert!(histories(&whole).next().unwrap().is_empty());
}

#[test]
fn tracks_are_as_old_as_they_are_asked_to_be() {
    for (age_ms, x) in [(0_i32, 40.0), (30, 39.7), (100, 39.0)] {
        let options = Options { track_age_ns: i64::from(age_ms) * 1_000_000, ..Options::default() };
        let drive = small("2020a", Some("KS2"), &options);
        let cycle = &drive.cycles[0].cycle;
        let tracks = cycle.tracks.as_ref().unwrap();
        assert_eq!(tracks.stamp_ns, cycle.now_ns - options.track_age_ns);
        assert!((tracks.items[0].x - x).abs() < 1e-9, "{}", tracks.items[0].x);
        assert_eq!(scan(&drive, 0).stamp_ns, cycle.now_ns - 30_000_000);
    }
    // The car is not recorded before step 0; in step 3 it was 2 m farther back two steps before.
    let options = Options { track_age_ns: 200_000_000, ..Options::default() };
    let drive = small("2020a", Some("KS2"), &options);
    let x = |index: usize| drive.cycles[index].cycle.tracks.as_ref().unwrap().items[0].x;
    assert!((x(3) - 41.0).abs() < 1e-9, "{}", x(3));
}
