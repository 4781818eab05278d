//! What the cycles of small hand-made files are, number by number.

use mufasa_drives::{DriveCycle, Options, Sensor, Tail, read, streams};
use mufasa_model::input::cycle::{Profile, Route};
use mufasa_model::services::configuration::Configuration;
use mufasa_records::cycle_to_line;

use super::files::{Scratch, one, own, small};

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn both_versions_say_the_same() {
    let options = Options::default();
    for solution in [None, Some("KS2"), Some("ST1"), Some("MB3")] {
        let [old, new] = ["2018b", "2020a"].map(|version| small(version, solution, &options));
        let cycles = |drive: &mufasa_drives::Drive| {
            drive.cycles.iter().map(|c| c.cycle.clone()).collect::<Vec<_>>()
        };
        assert_eq!(cycles(&old), cycles(&new));
        assert!(!old.cycles.is_empty());
    }
}

#[test]
fn the_first_cycle_is_the_first_state_with_data_of_their_ages() {
    let sensor = Sensor { clutter: 0.0, ..Sensor::default() };
    let drive = small("2020a", Some("KS2"), &Options { sensor, ..Options::default() });
    let cycle = &drive.cycles[0].cycle;
    assert_eq!(
        (cycle.now_ns, drive.cycles[0].id.as_str()),
        (1_000_000_000, "small.KS2.solution#0")
    );
    assert_eq!((cycle.profile, cycle.configuration), (Profile::HARDENED, Configuration::AllRemote));
    let ego = &cycle.ego;
    assert!(near(ego.x, 10.0) && near(ego.y, -1.75) && near(ego.speed, 10.0));
    assert!(near(ego.length, 4.508) && near(ego.width, 1.610) && near(ego.center_offset, 0.0));

    let trajectory = cycle.trajectory.as_ref().unwrap();
    assert_eq!((trajectory.stamp_ns, trajectory.points.len()), (980_000_000, 21));
    for (i, point) in (0_i32..).zip(&trajectory.points) {
        assert_eq!(point.t_ns, 1_000_000_000 + i64::from(i) * 100_000_000);
        assert!(near(point.x, 10.0 + f64::from(i)) && near(point.y, -1.75));
    }

    // 30 ms ago the car that is at 40 m now, at 10 m/s, was at 39.7 m.
    let tracks = cycle.tracks.as_ref().unwrap();
    let ids: Vec<i64> = tracks.items.iter().map(|t| t.id).collect();
    assert_eq!((tracks.stamp_ns, ids), (970_000_000, vec![7, 8, 9, 10]));
    let car = &tracks.items[0];
    assert!(near(car.x, 39.7) && near(car.vx, 10.0) && near(car.length, 4.0));
    // The circle is the square around it, the polygon the bounding rectangle in its frame.
    let pedestrian = &tracks.items[2];
    assert!(near(pedestrian.length, 0.8) && near(pedestrian.width, 0.8));
    let heap = &tracks.items[3];
    assert!(near(heap.x, 71.0) && near(heap.y, 8.0));
    assert!(near(heap.length, 4.0) && near(heap.width, 2.0));

    let detections = cycle.detections.as_ref().unwrap();
    assert_eq!((detections.stamp_ns, detections.items.len()), (970_000_000, 4));
    for (track, seen) in tracks.items.iter().zip(&detections.items) {
        let error = (track.x - seen.x).hypot(track.y - seen.y);
        assert!(error > 0.0 && error < 0.3, "{error}");
    }

    // Both 10 ms ago: 39.9 - 9.9 m between the centres, less half of either length.
    let lead = cycle.lead.as_ref().unwrap();
    assert_eq!(lead.stamp_ns, 990_000_000);
    assert!((lead.gap - (30.0 - 2.0 - 2.254)).abs() < 1e-6 && near(lead.speed, 10.0));

    let grid = cycle.grid.as_ref().unwrap();
    assert_eq!((grid.stamp_ns, grid.width, grid.height), (990_000_000, 500, 300));
    let bits: u32 = grid.occupied.iter().map(|b| b.count_ones()).sum();
    // The area of all four is 24.64 m^2, or 616 cells, and those cut by an edge.
    assert!((616..800).contains(&bits), "{bits}");
    let bit = |x: f64, y: f64| {
        let [column, row] = [(x - grid.x) / 0.2, (y - grid.y) / 0.2].map(f64::floor);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in the grid")]
        let index = row as usize * 500 + column as usize;
        grid.occupied[index / 8] >> (index % 8) & 1
    };
    assert_eq!(
        [bit(39.9, -1.75), bit(38.1, -1.0), bit(37.5, -1.75), bit(20.0, -1.75)],
        [1, 1, 0, 0]
    );
}

#[test]
fn the_route_of_one_lane_is_that_lane() {
    let drive = small("2018b", Some("KS2"), &Options::default());
    let route = &drive.cycles[0].cycle.route;
    assert!(!route.closed);
    for station in &route.cross_sections {
        assert!(
            near(station.y, -1.75) && near(station.left[1], 0.0) && near(station.right[1], -3.5)
        );
        assert!(near(station.left[0], station.x) && near(station.right[0], station.x));
    }
    let [first, last] =
        [&route.cross_sections[0], &route.cross_sections[route.cross_sections.len() - 1]];
    // 30 m behind the first and 80 m ahead of the last position, where the lanes are that long.
    assert!(near(first.x, 0.0) && near(last.x, 110.0));
}

#[test]
fn a_change_of_lane_crosses_over_and_opens_both_lanes() {
    let drive = small("2018b", Some("ST1"), &Options::default());
    let Route { cross_sections: stations, .. } = &drive.cycles[0].cycle.route;
    assert!(drive.notes.iter().any(|n| n == "route along lanelets 1 | lane change | 2"));
    assert!(near(stations[0].y, -1.75) && near(stations[stations.len() - 1].y, 1.75));
    for pair in stations.windows(2) {
        assert!(pair[1].x > pair[0].x && pair[1].y >= pair[0].y - 1e-9, "{pair:?}");
    }
    // The crossing is at x = 20.5; there the corridor spans both lanes, and at the end only one.
    let middle = stations.iter().find(|s| (s.x - 20.0).abs() < 2.0).unwrap();
    assert!(near(middle.left[1], 3.5) && near(middle.right[1], -3.5) && middle.y.abs() < 0.5);
    let end = &stations[stations.len() - 1];
    assert!(near(end.left[1], 3.5) && near(end.right[1], 0.0));
    // Nothing that is driven is outside.
    assert!(!drive.notes.iter().any(|n| n.contains("outside")), "{:?}", drive.notes);
}

#[test]
fn the_vehicle_is_picked_or_named() {
    // Car 7 is faster, but of its 2 s only 0.8 give cycles, of those of car 8 1.1: 7 m and 8 m.
    let picked = small("2020a", None, &Options::default());
    let note = "CAV: recorded car 8 (picked), 21 states over 16.0 m";
    assert!(picked.notes.iter().any(|n| n == note), "{:?}", picked.notes);
    let asked = small("2020a", None, &Options { ego: Some(7), ..Options::default() });
    assert!(near(asked.cycles[0].cycle.ego.x, 40.0));
    let ids = |d: &mufasa_drives::Drive| {
        let tracks = d.cycles[0].cycle.tracks.as_ref().unwrap();
        tracks.items.iter().map(|t| t.id).collect::<Vec<_>>()
    };
    assert_eq!((ids(&picked), ids(&asked)), (vec![7, 9, 10], vec![8, 9, 10]));
}

#[test]
fn the_tail_is_left_out_or_kept() {
    let options = Options::default();
    // Braking from 10 m/s takes 1.25 s: of 2 s the first 0.7 have a plan that reaches so far.
    assert_eq!(small("2020a", Some("KS2"), &options).cycles.len(), 8);
    let kept = small("2020a", Some("KS2"), &Options { tail: Tail::Keep, ..options.clone() });
    assert_eq!(kept.cycles.len(), 21);
    assert_eq!(kept.cycles[20].cycle.trajectory.as_ref().unwrap().points.len(), 1);
    let short = small("2020a", Some("KS2"), &Options { horizon_s: 0.3, ..options });
    assert_eq!(short.cycles[0].cycle.trajectory.as_ref().unwrap().points.len(), 4);
}

#[test]
fn equal_options_give_equal_drives_and_another_seed_another() {
    let options = Options::default();
    let first = small("2018b", Some("KS2"), &options);
    assert_eq!(first, small("2018b", Some("KS2"), &options));
    let sensor = Sensor { seed: 2, ..Sensor::default() };
    assert_ne!(first, small("2018b", Some("KS2"), &Options { sensor, ..options }));
}

#[test]
fn files_pair_in_their_order() {
    let scenario = own("readers/small-2018b.xml");
    let solutions = ["KS2", "ST1"].map(|s| own(&format!("readers/small.{s}.solution.xml")));
    let [ks, st] = solutions;
    let names = |paths: &[std::path::PathBuf]| {
        let drives = read(paths, &Options::default());
        let name = |d: Result<mufasa_drives::Drive, _>| d.map_or("error".into(), |d| d.name);
        drives.into_iter().map(name).collect::<Vec<String>>()
    };
    let both = [scenario.clone(), ks.clone(), st.clone()];
    assert_eq!(names(&both), ["small.KS2.solution", "small.ST1.solution"]);
    let alone = [scenario.clone(), scenario.clone(), ks.clone()];
    assert_eq!(names(&alone), ["small-2018b", "small.KS2.solution"]);
    let twice = [scenario.clone(), scenario.clone()];
    assert_eq!(names(&twice), ["small-2018b", "small-2018b (2)"]);
    // A solution finds its scenario by the benchmark id, whichever is named first.
    assert_eq!(names(&[ks.clone(), scenario.clone()]), ["small.KS2.solution"]);
    assert_eq!(names(&[ks.clone(), scenario, st]), ["small.KS2.solution", "small.ST1.solution"]);
    // Without it there is nothing to find, and the scenario of another benchmark is none for it.
    let alone = read(std::slice::from_ref(&ks), &Options::default()).remove(0).unwrap_err();
    assert_eq!((&*alone.file, alone.message.contains("no scenario")), (&*ks, true), "{alone}");
    assert_eq!(names(&[ks, own("demo/urban.xml")]), ["error", "urban"]);
}

#[test]
fn a_wrong_line_is_named_and_the_others_are_read() {
    let drive = small("2018b", Some("KS2"), &Options::default());
    let line = |c: &DriveCycle| cycle_to_line(&c.id, &c.cycle);
    let lines: Vec<String> = drive.cycles.iter().map(line).collect();
    let folder = Scratch::new();
    let broken = folder.write("broken.jsonl", format!("{}\n{{}}\n{}\n", lines[0], lines[1]));
    let mut results = read(&[broken], &Options::default()).into_iter();
    let error = results.next().unwrap().unwrap_err();
    assert_eq!(error.line, Some(2), "{error}");
    assert_eq!(results.next().unwrap().unwrap().cycles, drive.cycles[..2]);
}

/// A file is one error, however many of its lines are wrong.
#[test]
fn wrong_lines_of_a_file_are_one_error() {
    let folder = Scratch::new();
    let lines = |count: usize| {
        let file = folder.write("wrong.jsonl", "{}\n".repeat(count));
        one(&[file], &Options::default()).unwrap_err().to_string()
    };
    let text = lines(2);
    assert!(text.contains("wrong.jsonl:1: ") && text.contains("wrong.jsonl:2: "), "{text}");
    assert_eq!((text.lines().count(), lines(10).lines().count()), (2, 10));
    assert!(!lines(10).contains("more line"), "{}", lines(10));
    assert!(lines(11).ends_with("wrong.jsonl: and 1 more line"), "{}", lines(11));
    assert!(lines(300).ends_with("wrong.jsonl: and 290 more lines"), "{}", lines(300));
    assert_eq!(lines(300).lines().count(), 11);
}

#[test]
fn a_json_document_spread_over_lines_is_told_from_json_lines() {
    let drive = small("2018b", Some("KS2"), &Options::default());
    let line = cycle_to_line("the id", &drive.cycles[0].cycle);
    let value: serde_json::Value = serde_json::from_str(&line).unwrap();
    let pretty = serde_json::to_string_pretty(&value).unwrap();
    assert!(pretty.lines().count() > 100);
    let folder = Scratch::new();
    let error = one(&[folder.write("pretty.json", &pretty)], &Options::default()).unwrap_err();
    assert_eq!((error.line, &error.others), (None, &None), "{error}");
    assert!(error.message.contains("one JSON document spread over lines"), "{error}");
    // What is not even that is told line by line.
    let cut = &pretty[..pretty.len() - 2];
    let error = one(&[folder.write("cut.json", cut)], &Options::default()).unwrap_err();
    assert_eq!(error.line, Some(1), "{error}");
}

/// Records keep ids and order, sensible or not.
#[test]
fn records_are_taken_as_given() {
    let drive = small("2018b", Some("KS2"), &Options::default());
    let lines = [1, 0].map(|i| cycle_to_line("same", &drive.cycles[i].cycle));
    let folder = Scratch::new();
    let back = one(&[folder.write("back.jsonl", lines.join("\n"))], &Options::default()).unwrap();
    let found: Vec<_> = back.cycles.iter().map(|c| (c.id.as_str(), &c.cycle)).collect();
    assert_eq!(found, [1, 0].map(|i| ("same", &drive.cycles[i].cycle)));
}

#[test]
fn a_streamed_drive_is_the_drive_read_at_once() {
    let scenario = own("readers/small-2020a.xml");
    let solution = own("readers/small.KS2.solution.xml");
    let whole = small("2020a", Some("KS2"), &Options::default());
    let line = |c: &DriveCycle| cycle_to_line(&c.id, &c.cycle);
    let text: String = whole.cycles.iter().map(|c| line(c) + "\n").collect();
    let folder = Scratch::new();
    let records = folder.write("records.jsonl", text);
    let mut streams = streams(&[scenario, solution, records], &Options::default()).into_iter();
    for _ in 0..2 {
        let stream = streams.next().unwrap().unwrap();
        assert_eq!(stream.count(), whole.cycles.len());
        // Any of them, and any of them again.
        for index in [3, 0, 3] {
            assert_eq!(stream.cycle(index).unwrap(), whole.cycles[index]);
        }
        assert_eq!(stream.collect().unwrap().cycles, whole.cycles);
    }
    assert!(streams.next().is_none());
}
