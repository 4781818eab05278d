//! `worst`: an adversarial input of the largest sizes for each stage, and how long it takes; and the
//! time of stage i for the work of its assignment, to choose `work_limit` by. An
//! attacker chooses tracks and trajectory; the vehicle, the route, the grid and what is detected
//! are the CAV's own, and stage v is only as slow as this for a vehicle and a grid like these.

use std::time::SystemTime;

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Route, Track, TrackList, Trajectory,
    TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;

const NOW_NS: i64 = 1_000_000_000;
const CELLS: i64 = 4096;

fn main() {
    if std::env::args().nth(1).as_deref() == Some("--vehicle") {
        return vehicle();
    }
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
    let touching = 0.5 * (base.ego.width + 1.8) + 1e-9;
    let near: Vec<_> = (0..1024).map(|id| track(id, 0.0, touching)).collect();
    let still = Cycle { trajectory: Some(trajectory(&standing)), ..base };
    let cycle = Cycle { tracks: Some(tracks(&near)), ..still };
    report("iii", "1024 tracks 1 nm beside the CAV at 1024 points", &cycle, Stage::Iii);
    let near = vec![detection(0.0, touching); 2048];
    let cycle = Cycle { detections: Some(list(&near)), ..still };
    report("iv", "2048 detections 1 nm beside the CAV at 1024 points", &cycle, Stage::Iv);

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
    moving(&still);
}

/// The same kinds of input in the sizes of docs/configuration.md, which are those of
/// `mufasa_monitor_settings_default`, hardened: no station can send more.
fn vehicle() {
    const TRACKS: u32 = 128;
    const POINTS: usize = 128;
    const DETECTIONS: u32 = 256;
    println!("| stage | input | hardened, ms |\n|---|---|---|");
    let cross_sections = road(1024);
    let grid = vec![0; 4096 * 4096 / 8];
    let whole = base(&cross_sections, &grid);
    let work_limit = i64::from(TRACKS) * i64::from(TRACKS) * i64::from(DETECTIONS);
    let parameters = Parameters { work_limit, ..whole.parameters };
    let base = Cycle { profile: Profile::HARDENED, parameters, ..whole };
    let row = |input: &str, cycle: &Cycle<'_>, of: Stage, name: &str| {
        let (ms, passed) = mean(&mut Contestant::new(cycle), of);
        println!("| {name} | {input} | {ms:.3}, {} |", if passed { "passes" } else { "fails" });
    };

    let places = |count: u32, step: f64| (0..count).map(move |i| f64::from(i) * step);
    let line: Vec<_> = places(DETECTIONS, 1.0).map(|x| detection(x, 0.0)).collect();
    let crowd: Vec<_> = places(TRACKS, 0.001).zip(0..).map(|(y, id)| track(id, -1.0, y)).collect();
    // With the threshold of assignments() nothing is settled early.
    let parameters = Parameters { theta_tr: 0.2, ..parameters };
    let lists = Cycle { tracks: Some(tracks(&crowd)), detections: Some(list(&line)), ..base };
    let cycle = Cycle { parameters, ..lists };
    row("128 tracks a millimetre apart, 256 detections in a row across", &cycle, Stage::I, "i");
    let upon = timed(places(128, 0.1).map(|x| point(x, 0.0)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&upon)), ..base };
    row("128 points on 1024 cross sections of a road without width", &cycle, Stage::Ii, "ii");
    let standing = timed(vec![point(0.0, 0.0); POINTS]);
    let still = Cycle { trajectory: Some(trajectory(&standing)), ..base };
    let touching = 0.5 * (base.ego.width + 1.8) + 1e-9;
    let near: Vec<_> = (0..i64::from(TRACKS)).map(|id| track(id, 0.0, touching)).collect();
    let cycle = Cycle { tracks: Some(tracks(&near)), ..still };
    row("128 tracks 1 nm beside the CAV at 128 points", &cycle, Stage::Iii, "iii");
    let (_, beside) = neighbours(&still, DETECTIONS);
    let cycle = Cycle { detections: Some(list(&beside)), ..still };
    row("256 detections 1 nm beside the CAV at 128 points", &cycle, Stage::Iv, "iv");
    // H-14 compares each with each at each point; beyond work_limit it fails at once.
    let before = earlier(&beside, 500);
    let with = |count: usize| {
        (list(&beside[..count]), [DetectionList { items: &beside[..count], ..before }])
    };
    let passes = |count: &usize| {
        let (detections, history) = with(*count);
        let cycle = Cycle { detections: Some(detections), detection_history: &history, ..still };
        Contestant::new(&cycle).stage(Stage::Iv)
    };
    let most = (1..=beside.len()).rev().find(passes).unwrap_or(1);
    let (detections, history) = with(most);
    let cycle = Cycle { detections: Some(detections), detection_history: &history, ..still };
    let name = format!(
        "{most} of them, as many as work_limit allows, with an earlier list like that (H-14)"
    );
    row(&name, &cycle, Stage::Iv, "iv");
    let creeping = timed(places(128, 0.008).map(|x| point(x, 0.0)).collect());
    let cycle = Cycle { trajectory: Some(trajectory(&creeping)), ..base };
    row("128 points on an empty grid of 4096 x 4096 cells of 1 cm", &cycle, Stage::V, "v");
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

    let (_, beside) = neighbours(still, 48);
    let cycle = Cycle { detections: Some(list(&beside)), ..*still };
    report("iv", "48 detections 1 nm beside the CAV at 1024 points", &cycle, Stage::Iv);
    let earlier = [300, 500, 800].map(|ms| self::earlier(&beside, ms));
    let cycle = Cycle { detection_history: &earlier, ..cycle };
    report("iv", "the same with 3 earlier lists like that (H-14)", &cycle, Stage::Iv);
}

/// H-14: what it takes for each detection and each item of the reference list, and at each point.
fn moving(still: &Cycle<'_>) {
    println!("\n| detections | earlier items, each at 1024 points | work of H-14 | ms |");
    println!("|---|---|---|---|");
    for count in [4, 8, 16, 32, 64] {
        let (touching, beside) = neighbours(still, count);
        let earlier = [earlier(&beside, 500)];
        let cycle = Cycle {
            profile: Profile::HARDENED,
            detections: Some(list(&beside)),
            detection_history: &earlier,
            ..*still
        };
        let (ms, passes) = mean(&mut Contestant::new(&cycle), Stage::Iv);
        assert!(passes, "nothing touches at {touching} m");
        let work = f64::from(count) * f64::from(count) * 1024.0;
        println!("| {count} | {count} | {work:.1e} | {ms:.3} |");
    }
}

/// So many detections at the same place, 1 nm beside the CAV where it stands; how far that is aside.
fn neighbours(still: &Cycle<'_>, count: u32) -> (f64, Vec<Detection>) {
    let touching = 0.5 * (still.ego.width + 1.8) + 1e-9;
    (touching, (0..count).map(|_| detection(0.0, touching)).collect())
}

/// A list so many ms before now.
fn earlier(items: &[Detection], ms: i64) -> DetectionList<'_> {
    DetectionList { stamp_ns: NOW_NS - ms * 1_000_000, items }
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

fn base<'a>(cross_sections: &'a [CrossSection], grid: &'a [u8]) -> Cycle<'a> {
    Cycle {
        profile: Profile::PAPER,
        parameters: Parameters {
            theta_tr: 512.0,
            theta_obj: 1e3,
            theta_track_max: 1e3,
            ..Parameters::default()
        },
        now_ns: NOW_NS,
        configuration: Configuration::AllRemote,
        ego: Ego {
            x: -1.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 100.0,
            length: 4.8,
            width: 1.9,
            center_offset: 0.0,
        },
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections },
        grid: Some(Grid {
            stamp_ns: NOW_NS,
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            resolution: 0.01,
            width: CELLS,
            height: CELLS,
            occupied: grid,
            unknown: None,
        }),
        detection_history: &[],
    }
}

fn road(count: u32) -> Vec<CrossSection> {
    let cross_section = |i: u32| {
        let x = 0.02 * f64::from(i);
        CrossSection { x, y: 0.0, left: [x, 0.0], right: [x, 0.0] }
    };
    (0..count).map(cross_section).collect()
}

fn track(id: i64, x: f64, y: f64) -> Track {
    Track { id, x, y, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.5, width: 1.8 }
}

fn detection(x: f64, y: f64) -> Detection {
    Detection { x, y, cos: 1.0, sin: 0.0, length: 4.5, width: 1.8 }
}

fn point(x: f64, y: f64) -> TrajectoryPoint {
    TrajectoryPoint { t_ns: 0, x, y, cos: 1.0, sin: 0.0 }
}

/// The points a millisecond apart.
fn timed(mut points: Vec<TrajectoryPoint>) -> Vec<TrajectoryPoint> {
    for (point, t) in points.iter_mut().zip(0..) {
        point.t_ns = NOW_NS + t * 1_000_000;
    }
    points
}

fn trajectory(points: &[TrajectoryPoint]) -> Trajectory<'_> {
    Trajectory { stamp_ns: NOW_NS, points }
}

fn tracks(items: &[Track]) -> TrackList<'_> {
    TrackList { stamp_ns: NOW_NS, items }
}

fn list(items: &[Detection]) -> DetectionList<'_> {
    DetectionList { stamp_ns: NOW_NS, items }
}
