//! Throw-away: cycles that are safe, and at whose last point the CAV may not wait for a pair examined on.
use std::path::PathBuf;

use mufasa_drives::{Options, streams};
use mufasa_model::hardened::detection_history::usable;
use mufasa_model::hardened::h13_moving::{pairs, places};
use mufasa_model::hardened::h13_waiting::{Margin, may_wait};
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::scene::Scene;
use mufasa_model::report::{Outcome, Reading, Rule};
use mufasa_model::stages::check;

fn judged(cycle: &Cycle) -> (bool, bool) {
    let Ok(report) = check(cycle, Reading::Exact) else { return (false, false) };
    let gap = report.stages.iter().any(|it| matches!(it, Outcome::Failed(w) if w.rule == Rule::Gap));
    (report.failed_stage.is_none(), gap)
}

fn ends(cycle: &Cycle) -> Option<String> {
    let scene = Scene::new(cycle, Reading::Exact);
    let (trajectory, detections) = (scene.trajectory.as_ref()?, scene.detections.as_ref()?);
    let lists = usable(&scene);
    let count = places(&scene, trajectory).count_points();
    let mut of = pairs(&scene, &lists, &detections.items);
    of.retain(|pair| may_wait(&scene, detections, pair, &trajectory[0], Margin::First));
    for point in &trajectory[count - 1..] {
        of.retain(|pair| !may_wait(&scene, detections, pair, point, Margin::Later));
    }
    let pair = of.first()?;
    let d = &cycle.detections.as_ref()?.items[pair.detection];
    let w = pair.velocity(&detections.items[pair.detection]);
    let last = cycle.trajectory.as_ref()?.points.last()?;
    Some(format!(
        "count {count} of {} t_end {:.1} v {:.1} last ({:.1} {:.1}) heading {:.2} {:.2} d ({:.1} {:.1}) w ({:.1} {:.1}) {}x{} ego ({:.1} {:.1}) h {:.2} {:.2}",
        trajectory.len(), (last.t_ns - cycle.now_ns) as f64 / 1e9, cycle.ego.speed, last.x, last.y, last.cos, last.sin, d.x, d.y,
        w.x.bounds()[0], w.y.bounds()[0], d.length, d.width, cycle.ego.x, cycle.ego.y, cycle.ego.cos, cycle.ego.sin
    ))
}

fn main() {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let mut n = [0; 4];
    for drive in streams(&files, &Options { profile: Profile::Hardened, ..Options::default() }) {
        let Ok(drive) = drive else { continue };
        for (k, it) in drive.cycles().enumerate() {
            let mut cycle = it.cycle;
            let (is_safe, gap) = judged(&cycle);
            n[0] += u32::from(is_safe);
            let mut safe_without = is_safe;
            if gap {
                cycle.lead = None;
                safe_without = judged(&cycle).0;
            }
            n[1] += u32::from(safe_without);
            if !safe_without { continue }
            if let Some(text) = ends(&cycle) {
                n[2] += u32::from(is_safe);
                n[3] += 1;
                println!("{} {k} gap {gap} {text}", drive.name);
            }
        }
        eprintln!("{} {n:?}", drive.name);
    }
}
