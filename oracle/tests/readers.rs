//! Readers: small files of our own, broken files, and the shared recordings where they are.

use std::path::{Path, PathBuf};

use mufasa_oracle::drive::{Drive, Options, ReadError, read};

/// The folder of shared data: `MUFASA_DATA`, or `shared/data` beside the workspace.
fn data() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("MUFASA_DATA").map_or(beside, PathBuf::from);
    folder.is_dir().then_some(folder)
}

/// Scenarios of a folder, each with its solutions, in the order of their names.
fn scenarios(folder: &Path) -> Vec<(PathBuf, Vec<PathBuf>)> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the folder can be listed")
        .map(|entry| entry.expect("an entry of the folder").path())
        .filter(|path| path.extension().is_some_and(|e| e == "xml"))
        .collect();
    files.sort();
    let stem = |p: &Path| p.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let (solutions, scenarios): (Vec<_>, Vec<_>) =
        files.into_iter().partition(|p| stem(p).contains(".solution"));
    scenarios
        .into_iter()
        .map(|scenario| {
            let prefix = format!("{}.", stem(&scenario));
            let own = solutions.iter().filter(|s| stem(s).starts_with(&prefix)).cloned().collect();
            (scenario, own)
        })
        .collect()
}

#[test]
fn look() {
    use mufasa_oracle::drive::*;
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    for d in read(
        &[own.join("demo/urban.xml"), own.join("demo/urban.solution.xml")],
        &Options::default(),
    ) {
        let d = d.unwrap();
        summary(&d);
        for a in Attack::ALL {
            summary(&inject(&d, &Injection { attack: a, from_s: 1.0, to_s: 9.0 }));
        }
    }
    for s in ["KS2", "ST1", "MB3"] {
        for v in ["2018b", "2020a"] {
            for d in read(
                &[
                    own.join(format!("readers/small-{v}.xml")),
                    own.join(format!("readers/small.{s}.solution.xml")),
                ],
                &Options::default(),
            ) {
                summary(&d.unwrap());
            }
        }
    }
    if let Some(folder) = data() {
        let mut maps = Vec::new();
        for set in std::fs::read_dir(folder.join("ulm/maps")).unwrap() {
            for m in std::fs::read_dir(set.unwrap().path().join("extern")).unwrap() {
                maps.push(m.unwrap().path());
            }
        }
        maps.sort();
        maps.retain(|m| m.extension().is_some_and(|e| e == "npy"));
        maps.truncate(12);
        for d in read(&maps, &Options::default()) {
            match d {
                Ok(d) => summary(&d),
                Err(e) => println!("REFUSED {e}"),
            }
        }
    }
}

#[test]
fn every_shared_scenario_and_solution_gives_a_drive() {
    let Some(folder) = data() else {
        eprintln!("NOT RUN: no shared data; set MUFASA_DATA to the folder that holds commonroad/");
        return;
    };
    let mut refused: Vec<ReadError> = Vec::new();
    for (scenario, solutions) in scenarios(&folder.join("commonroad")) {
        let mut runs = vec![vec![scenario.clone()]];
        runs.extend(solutions.iter().map(|s| vec![scenario.clone(), s.clone()]));
        for paths in runs {
            for drive in read(&paths, &Options::default()) {
                match drive {
                    Ok(drive) => summary(&drive),
                    Err(e) => {
                        println!("REFUSED {e}");
                        refused.push(e);
                    }
                }
            }
        }
    }
}

fn summary(d: &Drive) {
    println!("{} {} cycles", d.name, d.cycles.len());
    for n in &d.notes {
        println!("    {n}");
    }
    if let Some(c) = d.cycles.first() {
        let c = &c.cycle;
        println!(
            "    {} stations, {} tracks, {} detections, lead {:?} v {}",
            c.route.stations.len(),
            c.tracks.as_ref().unwrap().items.len(),
            c.detections.as_ref().unwrap().items.len(),
            c.lead.as_ref().map(|l| (l.gap, l.speed)),
            c.ego.speed
        );
    }
    use mufasa_model::{cycle::Profile, schedule::check, verdict::*};
    let t = std::time::Instant::now();
    for profile in [Profile::Paper, Profile::Hardened] {
        let mut count: std::collections::BTreeMap<String, (usize, String)> = Default::default();
        for c in &d.cycles {
            let mut cycle = c.cycle.clone();
            cycle.profile = profile;
            let text = match check(&cycle, Reading::Exact) {
                Err(e) => format!("ERROR {e:?}"),
                Ok(r) => {
                    let w = r.stages.iter().find_map(|s| match s {
                        Outcome::Failed(w) => Some(w),
                        _ => None,
                    });
                    match (r.failed_stage, w) {
                        (None, _) => "safe".into(),
                        (Some(f), Some(w)) => format!("{f:?} {:?}", w.rule),
                        (Some(f), None) => format!("{f:?}"),
                    }
                }
            };
            let e = count.entry(text).or_insert((0, c.id.clone()));
            e.0 += 1;
        }
        println!(
            "    {profile:?}: {:?}",
            count
                .iter()
                .map(|(k, v)| format!("{k}: {} ({})", v.0, v.1.rsplit('#').next().unwrap()))
                .collect::<Vec<_>>()
        );
    }
    println!("    {:?}", t.elapsed());
}
