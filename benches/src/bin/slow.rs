//! `slow SECONDS`: searches, for each stage, an input that takes as long as possible for its steps
//! (`spec/4-arithmetic.md#steps`): a random one, changed as long as it gets slower. Prints the slowest and its bytes.
//! `slow STAGE BYTES`: one call of the stage on such an input, for `scripts/steps`, and how many steps it may take.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::hint::black_box;
use std::time::{Duration, Instant};

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, Ego, Grid, Track, TrackList, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::steps::{allowed, just_enough};
use mufasa_benches::worst::{NOW_NS, base, earlier, list, timed, tracks, trajectory};

const STAGES: [&str; 6] = ["input", "i", "ii", "iii", "iv", "v"];
const BYTES: usize = 30;
type Bytes = [u8; BYTES];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [seconds] => search(Duration::from_secs(seconds.parse()?)),
        [name, hex] => {
            let pair =
                |at: usize| u8::from_str_radix(hex.get(2 * at..2 * at + 2).unwrap_or(""), 16);
            let bytes = (0..BYTES).map(pair).collect::<Result<Vec<_>, _>>()?;
            let bytes = bytes.try_into().map_err(|_| "not 58 digits")?;
            input(&bytes, stage(name), &mut |cycle| {
                let passes = measured(&mut Contestant::new(cycle), stage(name));
                println!("{} {passes}", allowed(stage(name), cycle));
            });
        }
        _ => return Err("slow SECONDS | slow STAGE BYTES".into()),
    }
    Ok(())
}

fn stage(name: &str) -> Option<Stage> {
    Stage::ALL.into_iter().zip(&STAGES[1..]).find(|it| *it.1 == name).map(|it| it.0)
}

#[inline(never)]
fn measured(it: &mut Contestant<'_>, stage: Option<Stage>) -> bool {
    black_box(it.part(stage))
}

/// A sixth of the time for each stage.
fn search(time: Duration) {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.to_le_bytes()[3]
    };
    for name in STAGES {
        let (began, mut slowest) = (Instant::now(), (0, [0; BYTES]));
        while began.elapsed() < time / 6 {
            let mut here = (0, std::array::from_fn(|_| random()));
            let mut tries = 0;
            while tries < 60 && began.elapsed() < time / 6 {
                let mut bytes = here.1;
                for _ in 0..=random() % 3 {
                    bytes[usize::from(random()) % BYTES] = random();
                }
                let ps = time_of(&bytes, stage(name));
                // Else noise decides.
                let is_slower = 100 * ps > 101 * here.0;
                (here, tries) = if is_slower { ((ps, bytes), 0) } else { (here, tries + 1) };
            }
            slowest = slowest.max(here);
        }
        let hex = slowest.1.iter().fold(String::new(), |hex, it| hex + &format!("{it:02x}"));
        println!("{name} {hex}: {} ps a step", slowest.0);
    }
}

/// The time of a step, ps: of the shortest of some calls; 0 of an input of few steps.
fn time_of(bytes: &Bytes, stage: Option<Stage>) -> u128 {
    let mut found = 0;
    input(bytes, stage, &mut |cycle| {
        let (steps, mut it) = (allowed(stage, cycle), Contestant::new(cycle));
        let times = (0..7).map(|_| {
            let began = Instant::now();
            measured(&mut it, stage);
            began.elapsed().as_nanos()
        });
        found = if steps < 2000 { 0 } else { 1000 * times.min().unwrap_or(0) / u128::from(steps) };
    });
    found
}

/// Chooses by one byte after the other.
struct Choice<'b>(std::slice::Iter<'b, u8>);

impl Choice<'_> {
    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[usize::from(*self.0.next().expect("a byte")) % all.len()]
    }

    /// From 0 to 1.
    fn share(&mut self) -> f64 {
        f64::from(*self.0.next().expect("a byte")) / 255.0
    }
}

fn input(bytes: &Bytes, stage: Option<Stage>, run: &mut dyn FnMut(&Cycle<'_>)) {
    let it = &mut Choice(bytes.iter());
    let profile = it.of(&[Profile::HARDENED, Profile::HARDENED, Profile::PAPER]);
    let configuration = it.of(&[Configuration::AllRemote, Configuration::PlanRemote]);
    let points = plan(it);
    let road = road(it);
    let things = Things::new(it);
    let [tracked, seen] = [it.of(&[0, 1, 4, 16, 48]), it.of(&[0, 1, 4, 16, 48])];
    // Cells that several detections cover take more than is counted.
    let seen = if stage == Some(Stage::V) { seen.min(1) } else { seen };
    let items: Vec<_> = (0..tracked).map(|id| things.track(id)).collect();
    let [now, a, b, c] = [0, 300, 500, 800].map(|ms| things.detections(seen, ms));
    let earlier = [earlier(&a, 300), earlier(&b, 500), earlier(&c, 800)];
    let (occupied, unknown) = (bits(it), bits(it));
    let base = base(&road, &[0; 8]);
    let age_ns = it.of(&[0, 100_000_000, 37_000_001]);
    let parameters = Parameters {
        theta_tr: it.of(&[0.001, 0.2, 512.0]),
        theta_map: it.of(&[0.3, 1e3]),
        work_limit: i64::MAX >> 1,
        ..base.parameters
    };
    let resolution = it.of(&[0.05, 0.2]);
    let at = -0.5 * resolution * 64.0;
    let grid = Grid {
        width: 64,
        height: 64,
        resolution,
        x: at,
        y: at,
        occupied: &occupied,
        unknown: Some(&unknown),
        ..base.grid.expect("a grid")
    };
    let detections = if it.of(&[true, true, false]) { Some(list(&now)) } else { None };
    let cycle = Cycle {
        profile,
        parameters,
        configuration,
        ego: Ego { speed: it.of(&[0.0, 3.0, 10.0, 30.0]), ..base.ego },
        trajectory: Some(trajectory(&points)),
        tracks: Some(TrackList { stamp_ns: NOW_NS - age_ns, ..tracks(&items) }),
        detections,
        detection_history: &earlier,
        grid: Some(grid),
        ..base
    };
    run(&just_enough(stage, &cycle));
}

/// Straight on, or along a bend, from the CAV on or beside it; behind the last point perhaps elsewhere.
fn plan(it: &mut Choice<'_>) -> Vec<TrajectoryPoint> {
    let (count, bend) = (it.of(&[2, 4, 32, 128]), it.of(&[0.0, 0.0, 0.001, 0.01, 0.05]));
    let step = it.of(&[0.0, 0.008, 0.13, 0.24, 0.26, 0.5, 1.0, 3.0]);
    let (mut x, mut y, mut angle) =
        (-1.0, it.of(&[0.0, 1e-7, 0.01, 1.0, 0.3 - 1e-9, 0.3 - 1e-5]), 0.0_f64);
    let turn = it.of(&[0.0, 0.0, 0.3, 0.66]);
    let points = (1..=count).map(|number| {
        let (sin, cos) = (angle + if number == count { turn } else { 0.0 }).sin_cos();
        let point = TrajectoryPoint { t_ns: 0, x, y, cos, sin };
        (x, y, angle) = (x + step * cos, y + step * sin, angle + bend * step);
        point
    });
    timed(points.collect())
}

/// Straight on, or back and forth, in parts that are about equally near to a place.
fn road(it: &mut Choice<'_>) -> Vec<CrossSection> {
    let (count, step) = (it.of(&[3_u8, 16, 64, 255]), it.of(&[1e-3, 0.5, 4.0, 100.0]));
    let half = it.of(&[0.3, 3.0, 100.0]);
    let folded = it.of(&[None, None, Some(0.0), Some(1e-7), Some(1e-3)]);
    let cross_section = |at: u8| {
        let number = f64::from(at);
        let (x, y) = match folded {
            Some(apart) if !at.is_multiple_of(2) => (80.0, apart * number),
            Some(apart) => (-20.0, apart * number),
            None => (number * step - 20.0, 0.0),
        };
        CrossSection { x, y, left: [x, y + half], right: [x, y - half] }
    };
    (0..count).map(cross_section).collect()
}

/// Objects in a row beside the CAV's way, all of one kind.
struct Things {
    at: [f64; 2],
    apart: [f64; 2],
    velocity: [f64; 2],
    direction: [f64; 2],
    length: f64,
}

impl Things {
    fn new(it: &mut Choice<'_>) -> Self {
        let gap = it.of(&[6e-9, 1e-7, 1e-5, 1e-3, 0.1, -0.1, 1.0, 3.0]);
        let x = it.of(&[-10.0, -1.0, 4.0, 9.0, 20.0, 40.0]) + it.share();
        let (along, aside) = (it.of(&[0.0, 1e-4, 0.5, 3.0]), it.of(&[0.0, 1e-3, 0.1]));
        let (speed, angle) = (it.of(&[0.0, 0.0, 1e-3, 1.0, 5.0, 20.0]), it.share() * 6.3);
        let heading: f64 = it.of(&[0.0, 0.0, 1e-3, 0.3, FRAC_PI_2, PI]);
        let length = it.of(&[0.5, 4.5, 20.0, 100.0]);
        Self {
            at: [x, 0.5 * (1.9 + 1.8) + gap],
            apart: [along, aside],
            velocity: [speed * angle.cos(), speed * angle.sin()],
            direction: [heading.cos(), heading.sin()],
            length,
        }
    }

    /// Where they were so many ms ago.
    fn detections(&self, count: i64, ms: i16) -> Vec<Detection> {
        let seconds = f64::from(ms) / 1000.0;
        let detection = |id| {
            let Track { x, y, vx, vy, cos, sin, length, width, .. } = self.track(id);
            let (x, y) = (x - vx * seconds, y - vy * seconds);
            Detection { x, y, cos, sin, length, width }
        };
        (0..count).map(detection).collect()
    }

    fn track(&self, id: i64) -> Track {
        let number = f64::from(i32::try_from(id).unwrap_or(0));
        let [[x, y], [along, aside]] = [self.at, self.apart];
        let ([vx, vy], [cos, sin]) = (self.velocity, self.direction);
        let (x, y) = (x + number * along, y + number * aside);
        Track { id, x, y, cos, sin, vx, vy, length: self.length, width: 1.8 }
    }
}

/// 64 by 64 cells, of which none, all, or every so many is set.
fn bits(it: &mut Choice<'_>) -> Vec<u8> {
    let every = it.of(&[0, 1, 2, 7, 61, 997]);
    let set = |at: usize| every > 0 && at.is_multiple_of(every);
    (0..512).map(|byte| (0..8).map(|bit| u8::from(set(8 * byte + bit)) << bit).sum()).collect()
}
