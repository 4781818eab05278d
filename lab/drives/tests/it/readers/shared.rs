//! The shared recordings: every file gives a drive that the monitor can judge, or says why not.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use mufasa_drives::{Drive, DriveCycle, Options, read};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::FailedStage;

use super::files::{judged, shared};

/// Scenarios of a folder, each with its solutions, in the order of their names.
fn scenarios(folder: &Path) -> Vec<(PathBuf, Vec<PathBuf>)> {
    let stem = |p: &Path| p.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let (solutions, scenarios): (Vec<_>, Vec<_>) =
        files(folder, "xml").into_iter().partition(|p| stem(p).contains(".solution"));
    let own = |scenario: &Path| {
        let prefix = format!("{}.", stem(scenario));
        solutions.iter().filter(|s| stem(s).starts_with(&prefix)).cloned().collect()
    };
    scenarios.into_iter().map(|s| (s.clone(), own(&s))).collect()
}

/// Files of a folder and those below with an extension, sorted.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the folder can be listed") {
        let path = entry.expect("an entry of the folder").path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|e| e == extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// What every cycle made from a recording keeps to.
fn assert_sane(drive: &Drive) {
    let name = &drive.name;
    assert!(!drive.cycles.is_empty(), "{name} has no cycle");
    let mut last: Option<&Cycle> = None;
    for cycle in drive.cycles.iter().map(|c| &c.cycle) {
        let now = cycle.now_ns;
        let fresh = |stamp: i64| (0..=100_000_000).contains(&(now - stamp));
        let trajectory = cycle.trajectory.as_ref().expect("a trajectory");
        let tracks = cycle.tracks.as_ref().expect("tracks");
        let detections = cycle.detections.as_ref().expect("detections");
        let grid = cycle.grid.as_ref().expect("a grid");
        let stamps = [trajectory.stamp_ns, tracks.stamp_ns, detections.stamp_ns, grid.stamp_ns];
        assert!(stamps.into_iter().all(fresh), "{name}: {stamps:?}");
        assert!(cycle.lead.as_ref().is_none_or(|l| fresh(l.stamp_ns)));
        let first = &trajectory.points[0];
        assert_eq!((first.t_ns, [first.x, first.y]), (now, [cycle.ego.x, cycle.ego.y]), "{name}");
        for pair in trajectory.points.windows(2) {
            let dt = pair[1].t_ns - pair[0].t_ns;
            assert!(dt > 0 && dt <= 200_000_000, "{name}: {dt}");
        }
        assert!(cycle.route.cross_sections.len() <= 8192);
        for pair in cycle.route.cross_sections.windows(2) {
            let step = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
            assert!(step[0].hypot(step[1]) > 0.0, "{name}: equal stations");
            let across = [pair[0].left[0] - pair[0].right[0], pair[0].left[1] - pair[0].right[1]];
            assert!(step[0] * across[1] - step[1] * across[0] > 0.0, "{name}: left is not left");
        }
        if let Some(last) = last {
            assert!(now > last.now_ns);
        }
        last = Some(cycle);
    }
}

/// Judges the drive of every `every`th cycle in both profiles and counts what comes of it. The
/// model refuses none of them as invalid.
fn judge(drive: &Drive, every: usize) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for (profile, name) in [(Profile::PAPER, "Paper"), (Profile::HARDENED, "Hardened")] {
        let cycles = drive.cycles.iter().step_by(every).map(|it| DriveCycle {
            id: it.id.clone(),
            cycle: Cycle { profile, ..it.cycle.clone() },
        });
        let thinned = Drive { cycles: cycles.collect(), ..drive.clone() };
        let (checked, all) = judged(thinned);
        assert_eq!(checked.disagreements(), 0, "{}", drive.name);
        for judged in &all {
            let report = judged.model.as_ref();
            let report = report.unwrap_or_else(|e| panic!("{}: {e:?}", drive.name));
            assert_ne!(report.failed_stage, Some(FailedStage::Input), "{}", drive.name);
            let verdict = report.failed_stage.map_or("safe".into(), |s| format!("{s:?}"));
            *counts.entry(format!("{name} {verdict}")).or_insert(0) += 1;
        }
    }
    counts
}

#[test]
fn every_scenario_and_solution_gives_a_drive() {
    let Some(folder) = shared("commonroad") else { return };
    let scenarios = scenarios(&folder);
    let (mut drives, mut refused, mut solved) = (0, Vec::new(), 0);
    let mut totals: BTreeMap<String, usize> = BTreeMap::new();
    for (scenario, solutions) in &scenarios {
        let mut paths = vec![scenario.clone(), scenario.clone()];
        paths.extend(solutions.iter().cloned());
        // The scenario with one of its own vehicles, then with its solutions.
        let paths = if solutions.is_empty() { &paths[..1] } else { &paths[..] };
        let results = read(paths, &Options::default());
        assert_eq!(results.len(), 1 + solutions.len());
        for (i, result) in results.into_iter().enumerate() {
            match result {
                Ok(drive) => {
                    assert_sane(&drive);
                    for (verdict, n) in judge(&drive, 7) {
                        *totals.entry(verdict).or_insert(0) += n;
                    }
                    drives += 1;
                    solved += usize::from(i > 0);
                }
                Err(error) => refused.push(error.to_string()),
            }
        }
    }
    println!("{drives} drives, refused {refused:#?}, {totals:#?}");
    let solutions: usize = scenarios.iter().map(|(_, s)| s.len()).sum();
    assert_eq!((scenarios.len(), solutions, solved), (34, 19, 19));
    assert!(refused.len() <= 3, "{refused:#?}");
    // Most of real driving is safe, and not everything.
    let safe = |p: &str| totals.get(&format!("{p} safe")).copied().unwrap_or(0);
    let all =
        |p: &str| totals.iter().filter(|(k, _)| k.starts_with(p)).map(|(_, n)| n).sum::<usize>();
    assert!(safe("Paper") * 10 > all("Paper") * 8 && safe("Paper") < all("Paper"));
    assert!(safe("Hardened") * 2 > all("Hardened"));
}

#[test]
fn every_map_gives_a_safe_drive() {
    let Some(folder) = shared("ulm/maps") else { return };
    let maps = files(&folder, "npy");
    let results = read(&maps, &Options::default());
    let mut closed = 0;
    let mut outside = Vec::new();
    for result in results {
        let drive = result.expect("every map is read");
        assert_sane(&drive);
        closed += usize::from(drive.cycles[0].cycle.route.closed);
        let every = drive.cycles.len() / 3;
        let counts = judge(&drive, every.max(1));
        assert!(
            counts.keys().all(|k| k.ends_with("safe") || k == "Hardened Stage(Ii)"),
            "{counts:?}"
        );
        if counts.len() > 2 {
            outside.push(drive.notes);
        }
    }
    assert_eq!(maps.len(), 49);
    assert!(closed >= 2, "{closed} maps are closed");
    // One map has the right bound left of its path over 412 stations. On 18 the made-up drive follows
    // the kinks of the control points more sharply than H-11 lets a vehicle slide.
    let on_the_other_side = |notes: &Vec<String>| notes.iter().any(|n| n.contains("other side"));
    assert!(outside.iter().filter(|notes| on_the_other_side(notes)).count() <= 1);
    assert!(outside.len() <= 19, "{} maps with alarms", outside.len());
}

#[test]
fn a_test_without_recordings_says_so_aloud() {
    let program = std::env::current_exe().expect("the path of this program");
    let output = std::process::Command::new(program)
        .arg("every_map_gives_a_safe_drive")
        .env("MUFASA_DATA", "/no such folder")
        .output()
        .expect("this program starts");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success()
            && text.contains("every_map_gives_a_safe_drive: no recordings in /no such"),
        "{text}"
    );
}
