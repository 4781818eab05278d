//! `worst`: an adversarial input of the largest sizes for each stage, and how long it takes; and the
//! time of stage i for the work of its assignment, to choose `work_limit` by.

use std::time::SystemTime;

use mufasa::input::cycle::{Cycle, Detection, Ego, Grid, Track};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::worst::{
    base, detection, earlier, list, neighbours, point, road, timed, track, tracks, trajectory,
};

fn main() {
    println!("| stage | input | paper, ms | hardened, ms |\n|---|---|---|---|");
    let cross_sections = road(8192);
    let grid = vec![0; 4096 * 4096 / 8];
    let base = base(&cross_sections, &grid);

    let places = |count: u32, step: f64| (0..count).map(move |i| f64::from(i) * step);
    let line: Vec<_> = places(2048, 1.0).map(|x| detection(x, 0.0)).collect();
    // No two of their distances are equal, so that nothing is settled early.
    let crowd: Vec<_> = places(1024, 0.001).zip(0..).map(|(y, id)| track(id, -1.0, y)).collect();
    let crowded = Cycle { tracks: Some(tracks(&crowd)), detections: Some(list(&line)), ..base };
    report(
        "i",
        "1024 tracks a millimetre apart, 2048 detections in a row across",
        &crowded,
        Stage::I,
    );
    let parameters = Parameters { work_limit: 10_000_000, ..base.parameters };
    let limited = Cycle { parameters, ..crowded };
    report("i", "the same with work_limit = 10^7", &limited, Stage::I);

    let beside = timed(places(1024, 0.1).map(|x| point(x, 0.2)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&beside)), ..base };
    let name = "1024 points near 8192 cross sections of a road without width";
    report("ii", name, &cycle, Stage::Ii);
    report_without_index("ii", name, &cycle, Stage::Ii);
    let upon = timed(places(1024, 0.1).map(|x| point(x, 0.0)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&upon)), ..base };
    report("ii", "1024 points on it", &cycle, Stage::Ii);
    report_without_index("ii", "1024 points on it", &cycle, Stage::Ii);

    let standing = timed(vec![point(0.0, 0.0); 1024]);
    let touching = 0.5 * (base.ego.width + 1.8) + 1e-8;
    let near: Vec<_> = (0..1024).map(|id| track(id, 0.0, touching)).collect();
    let still = Cycle { trajectory: Some(trajectory(&standing)), ..base };
    let cycle = Cycle { tracks: Some(tracks(&near)), ..still };
    report("iii", "1024 tracks 10 nm beside the CAV at 1024 points", &cycle, Stage::Iii);
    let near = vec![detection(0.0, touching); 2048];
    let cycle = Cycle { detections: Some(list(&near)), ..still };
    report("iv", "2048 detections 10 nm beside the CAV at 1024 points", &cycle, Stage::Iv);

    history(&base, &still);

    // A cell in the corner of the square around each disk, which only looking at the disk excludes.
    let mut corner = grid.clone();
    corner[(4 * 4096 + 520) / 8] = 1;
    let ego = Ego { length: 20.0, width: 20.0, ..base.ego };
    let creeping = timed(places(1024, 0.001).map(|x| point(x, 0.0)).collect());
    for (n, name) in [
        (4, "20 m by 20 m in 4 disks creeps over 4096 x 4096 cells of 1 cm, 1024 points"),
        (64, "the same in 64 disks"),
    ] {
        let parameters = Parameters { n, ..base.parameters };
        let grid = base.grid.map(|grid| Grid { occupied: &corner, x: -22.0, y: -9.2, ..grid });
        let cycle =
            Cycle { ego, parameters, grid, trajectory: Some(trajectory(&creeping)), ..base };
        report("v", name, &cycle, Stage::V);
    }

    assignments(&base, &crowd, &line);
}

/// Tracks and detections in a row of 0.2 m that look like one place to every index, as there is
/// one thing far off; the same with earlier lists of them.
fn history(base: &Cycle<'_>, still: &Cycle<'_>) {
    let places = |count: u32, from: f64| (0..count).map(move |i| (f64::from(i) + from) * 1e-4);
    let far = detection(1e5, 1e5);
    let row: Vec<_> =
        places(2047, 0.0).map(|x| detection(x, 0.0)).chain(std::iter::once(far)).collect();
    let beside: Vec<_> = places(1024, 0.3).zip(0..).map(|(x, id)| track(id, x, 0.01)).collect();
    let cycle = Cycle { tracks: Some(tracks(&beside)), detections: Some(list(&row)), ..*base };
    report("i", "1024 tracks along a row of 2048 detections 0.1 mm apart", &cycle, Stage::I);
    let earlier = [300, 500, 800, 900].map(|ms| earlier(&row, ms));
    let cycle = Cycle { detection_history: &earlier, ..cycle };
    report("i", "the same with 4 earlier lists like that", &cycle, Stage::I);

    let beside = neighbours(still, 48);
    let cycle = Cycle { detections: Some(list(&beside)), ..*still };
    report("iv", "48 detections 10 nm beside the CAV at 1024 points", &cycle, Stage::Iv);
    let earlier = [300, 500, 800].map(|ms| self::earlier(&beside, ms));
    let cycle = Cycle { detection_history: &earlier, ..cycle };
    report("iv", "the same with 3 earlier lists like that (H-14)", &cycle, Stage::Iv);
}

fn assignments(base: &Cycle<'_>, crowd: &[Track], line: &[Detection]) {
    println!(
        "\n| tracks a millimetre apart | detections in a row across | work of the assignment | ms |"
    );
    println!("|---|---|---|---|");
    for count in [16, 32, 64, 128, 256, 512, 1024_usize] {
        let (crowd, line) = (&crowd[..count], &line[..2 * count]);
        let parameters = Parameters { theta_tr: 0.2, ..base.parameters };
        let lists = Cycle { tracks: Some(tracks(crowd)), detections: Some(list(line)), ..*base };
        let cycle = Cycle { parameters, ..lists };
        let (ms, _) = mean(&mut Contestant::new(&cycle), Stage::I);
        println!("| {count} | {} | {:.1e} | {ms:.3} |", 2 * count, work(count));
    }
}

/// The work of `spec/3-stages.md#stage-i-track-validation` for twice as many detections as tracks.
#[expect(clippy::cast_precision_loss, reason = "two digits are shown")]
fn work(tracks: usize) -> f64 {
    (tracks * tracks * 2 * tracks) as f64
}

/// Both profiles, with an index of the route.
fn report(stage: &str, input: &str, cycle: &Cycle<'_>, of: Stage) {
    line(stage, input, cycle, |cycle| mean(&mut Contestant::new(cycle), of));
}

fn report_without_index(stage: &str, input: &str, cycle: &Cycle<'_>, of: Stage) {
    let input = format!("{input}, no index");
    line(stage, &input, cycle, |cycle| mean(&mut Contestant::with_index(cycle, None), of));
}

fn line(stage: &str, input: &str, cycle: &Cycle<'_>, run: impl Fn(&Cycle<'_>) -> (f64, bool)) {
    let cells = [Profile::PAPER, Profile::HARDENED].map(|profile| {
        let (ms, passed) = run(&Cycle { profile, ..*cycle });
        format!("{ms:.3}, {}", if passed { "passes" } else { "fails" })
    });
    println!("| {stage} | {input} | {} | {} |", cells[0], cells[1]);
}

/// The mean of as many runs as take a tenth of a second, ms, and whether the stage passes.
fn mean(it: &mut Contestant<'_>, of: Stage) -> (f64, bool) {
    let start = cpu_ms();
    let (mut passed, mut runs, mut total) = (false, 0.0, 0.0);
    while total < 100.0 {
        passed = it.stage(of);
        runs += 1.0;
        total = cpu_ms() - start;
    }
    (total / runs, passed)
}

/// Time that this process has had a core, ms, so that others on the machine do not count; where
/// the system does not tell, time since 1970.
fn cpu_ms() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|it| it.parse::<f64>().ok());
    nanoseconds.map_or_else(
        || SystemTime::UNIX_EPOCH.elapsed().map_or(0.0, |since| since.as_secs_f64() * 1e3),
        |ns| ns / 1e6,
    )
}
