//! `growth FILE.svg`: time against tracks, trajectory points, cross sections and grid side, each over
//! three decades as far as the domain goes; ours, the best library for the same stages, and for
//! stage v the loop by hand.

use std::error::Error;

use mufasa::input::cycle::Cycle;
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::peer;
use mufasa_benches::plot::{Line, Panel, svg};
use mufasa_benches::race::{Entry, Rounds, measure};
use mufasa_benches::table::{BY_HAND, OURS, hardened};
use mufasa_benches::workload::recipe::Size;
use mufasa_benches::workload::{SIZES, Variant, Workload};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("growth FILE.svg")?;
    // A wide place, so that there is room for a thousand tracks, and a coarse grid on it.
    let base = Size { tracks: 30, detections: 40, points: 50, ..SIZES[2] };
    let base = Size { cells: 1000, resolution: 0.4, cross_sections: 1000, step: 1.0, ..base };
    let counts = [1, 3, 10, 30, 100, 300, 1000];
    let panels = [
        panel("stages i and iii", "tracks", &[Stage::I, Stage::Iii], &counts, |count| {
            let size = Size { tracks: count, detections: count + count / 5, ..base };
            Workload::new(&Size { on_lanes: size.on_lanes.min(count), ..size }, Variant::Pass)
        }),
        panel("stages ii and iii", "trajectory points", &[Stage::Ii, Stage::Iii], &counts, |n| {
            Workload::new(&Size { points: n, ..base }, Variant::Pass)
        }),
        panel(
            "stage ii",
            "cross sections",
            &[Stage::Ii],
            &[8, 24, 80, 240, 800, 2400, 8000],
            |count| {
                let step = 1000.0 / f64::from(u32::try_from(count).unwrap_or(u32::MAX));
                Workload::new(&Size { cross_sections: count, step, ..base }, Variant::Pass)
            },
        ),
        panel(
            "stage v",
            "grid side, cells",
            &[Stage::V],
            &[5, 15, 50, 150, 500, 1500, 4096],
            |n| Workload::new(&base, Variant::Pass).with_grid(n),
        ),
    ];
    std::fs::write(file, svg(&panels, "time, us"))?;
    Ok(())
}

/// Measures the stages at every count.
fn panel(
    title: &str,
    axis: &'static str,
    stages: &[Stage],
    counts: &[usize],
    workload: impl Fn(usize) -> Workload,
) -> Panel {
    let mut lines = [(OURS, "#1f6feb", false), ("mufasa, hardened", "#1f6feb", true)]
        .into_iter()
        .chain([("best library", "#d1570a", false), ("loop by hand", "#d1570a", true)])
        .map(|(name, colour, dashed)| Line { name, colour, dashed, points: Vec::new() })
        .collect::<Vec<_>>();
    for &count in counts {
        let workload = workload(count);
        let x = f64::from(u32::try_from(count).unwrap_or(u32::MAX));
        for (line, us) in lines.iter_mut().zip(times(&workload, stages)) {
            if !us.is_nan() {
                line.points.push((x, us));
            }
        }
    }
    Panel { title: title.to_owned(), axis, lines }
}

/// The sums over the stages: paper, hardened, the best library for each; and the loop by hand,
/// which is for stage v alone.
fn times(workload: &Workload, stages: &[Stage]) -> [f64; 4] {
    let paper = workload.cycle(Profile::PAPER, Configuration::AllRemote);
    let strict = workload.cycle(Profile::HARDENED, Configuration::AllRemote);
    let mut sums = [0.0; 4];
    for &stage in stages {
        let mut entries =
            vec![ours(OURS.to_owned(), &paper, stage), ours(hardened(), &strict, stage)];
        let peers = peer::all(&paper).into_iter().filter(|peer| {
            let quick = !peer.slow && !peer.name.ends_with("mask");
            peer.stage == stage && quick
        });
        entries.extend(peers.map(|peer| Entry {
            task: String::new(),
            name: peer.name.to_owned(),
            slow: false,
            run: peer.decide,
        }));
        let verdicts: Vec<bool> = entries.iter_mut().map(|entry| (entry.run)()).collect();
        // A trajectory of a few points is refused by the hardened profile: its time says nothing.
        let refused = !verdicts[1];
        assert!(verdicts.iter().filter(|&&passes| !passes).count() <= usize::from(refused));
        let times = measure(&mut entries, Rounds { warm: 7, cold: 0 });
        let (by_hand, libraries): (Vec<_>, Vec<_>) =
            times.iter().skip(2).partition(|time| time.name == BY_HAND);
        let best = libraries.iter().map(|time| time.warm_us).fold(f64::MAX, f64::min);
        let by_hand = by_hand.first().map_or(f64::NAN, |time| time.warm_us);
        let strict = if refused { f64::NAN } else { times[1].warm_us };
        for (sum, us) in sums.iter_mut().zip([times[0].warm_us, strict, best, by_hand]) {
            *sum += us;
        }
    }
    sums
}

fn ours<'a>(name: String, cycle: &'a Cycle<'a>, stage: Stage) -> Entry<'a> {
    let mut it = Contestant::new(cycle);
    Entry { task: String::new(), name, slow: false, run: Box::new(move || it.stage(stage)) }
}
