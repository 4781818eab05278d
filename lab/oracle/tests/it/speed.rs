//! How long an urban cycle takes the oracle: 30 tracks, 40 detections, three earlier lists of 40, 50
//! points and a grid of 600 x 600 cells, from the line to the answer, in all three readings.

use std::time::{Duration, Instant};

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Profile, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration::{
    self, AllRemote, MotRemote, PlanRemote,
};
use mufasa_records::{Answer, answer, cycle_to_line};

const NOW: i64 = 100_000_000_000;
const SPEED: f64 = 12.0;
/// Cells of a side of 120 m.
const SIDE: usize = 600;
const RESOLUTION: f64 = 0.2;

/// Where the street is: in UTM coordinates, at an angle to the axes.
struct Street {
    cos: f64,
    sin: f64,
}

impl Street {
    /// The place `u` m ahead and `w` m to the left of the CAV.
    fn at(&self, u: f64, w: f64) -> (f64, f64) {
        let (east, north) = (573_412.25, 5_362_801.5);
        (east + u * self.cos - w * self.sin, north + u * self.sin + w * self.cos)
    }

    fn detection(&self, u: f64, w: f64) -> Detection {
        let (x, y) = self.at(u, w);
        Detection { x, y, cos: self.cos, sin: self.sin, length: 4.5, width: 1.8 }
    }

    fn track(&self, id: i64, [u, w, v]: [f64; 3]) -> Track {
        let ((x, y), (cos, sin)) = (self.at(u, w), (self.cos, self.sin));
        Track { id, x, y, cos, sin, vx: v * cos, vy: v * sin, length: 4.5, width: 1.8 }
    }

    fn point(&self, tenths: i32) -> TrajectoryPoint {
        let ahead = f64::from(tenths) / 10.0;
        let (x, y) = self.at(SPEED * ahead, 0.05 * (2.0 * ahead).sin());
        let t_ns = NOW + i64::from(tenths) * 100_000_000;
        TrajectoryPoint { t_ns, x, y, cos: self.cos, sin: self.sin }
    }

    fn cross_section(&self, tens: i32) -> CrossSection {
        let side = |w| self.at(f64::from(tens) * 10.0, w).into();
        let (x, y) = self.at(f64::from(tens) * 10.0, 0.0);
        CrossSection { x, y, left: side(3.0), right: side(-3.0) }
    }

    /// Kerbs and parked cars are occupied.
    fn grid(&self, objects: &[[f64; 3]]) -> Grid {
        let (x, y) = self.at(-60.0, -60.0);
        let mut occupied = vec![0_u8; SIDE * SIDE / 8];
        for row in 0..SIDE {
            for column in 0..SIDE {
                let metres = |cells: usize| {
                    (f64::from(u32::try_from(cells).expect("small")) + 0.5) * RESOLUTION - 60.0
                };
                let (u, w) = (metres(column), metres(row));
                let is_car = |it: &[f64; 3]| (it[0] - u).abs() < 2.3 && (it[1] - w).abs() < 0.9;
                if (w.abs() - 9.0).abs() < 0.15 || objects.iter().any(is_car) {
                    let bit = row * SIDE + column;
                    occupied[bit / 8] |= 1 << (bit % 8);
                }
            }
        }
        let side = i64::try_from(SIDE).expect("small");
        let (cos, sin, resolution) = (self.cos, self.sin, RESOLUTION);
        let (width, height, unknown) = (side, side, None);
        Grid { stamp_ns: NOW, x, y, cos, sin, resolution, width, height, occupied, unknown }
    }
}

fn urban(profile: Profile, configuration: Configuration, degrees: f64) -> Cycle {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let street = Street { cos, sin };
    // Beside the street, spread by multiples of irrational numbers.
    let spread = |i: u32, factor: f64| (f64::from(i) * factor).fract();
    let object = |i: u32| {
        let side = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let (u, w) =
            (110.0 * spread(i, 0.618_034) - 40.0, side * (3.5 + 21.0 * spread(i, 0.414_214)));
        [u, w, 16.0 * spread(i, 0.732_051) - 8.0]
    };
    let objects: Vec<[f64; 3]> = (1..=30).map(object).collect();
    let noise = |i: u32| 0.1 * (spread(i, 0.236_068) - 0.5);
    // What the CAV saw so many ms ago: the objects where they were, and clutter.
    let seen = |millis: u32| {
        let object = |(i, [u, w, v]): (u32, &[f64; 3])| {
            let then = u - v * f64::from(millis) / 1000.0;
            street.detection(then + noise(i + millis), w + noise(i + millis + 50))
        };
        let clutter = |i: u32| {
            let u = 90.0 * spread(i + millis, 0.618_034) - 10.0;
            street.detection(u, 30.0 + noise(i + millis))
        };
        let items = (1..).zip(&objects).map(object).chain((31..=40).map(clutter)).collect();
        DetectionList { stamp_ns: NOW - i64::from(millis) * 1_000_000, items }
    };
    let tracks: Vec<Track> = (1..).zip(&objects).map(|(id, it)| street.track(id, *it)).collect();
    let (x, y) = street.at(0.0, 0.0);
    Cycle {
        profile,
        parameters: Parameters { theta_tr: 0.5, ..Parameters::default() },
        now_ns: NOW,
        configuration,
        ego: Ego { x, y, cos, sin, speed: SPEED, length: 4.8, width: 1.9, center_offset: 1.4 },
        trajectory: Some(Trajectory {
            stamp_ns: NOW,
            points: (0..50).map(|i| street.point(i)).collect(),
        }),
        tracks: Some(TrackList { stamp_ns: NOW, items: tracks }),
        detections: Some(seen(0)),
        lead: None,
        route: Route {
            closed: false,
            cross_sections: (-10..=20).map(|i| street.cross_section(i)).collect(),
        },
        grid: Some(street.grid(&objects)),
        detection_history: [300, 500, 800].map(seen).into(),
    }
}

/// Shows the time of an urban cycle; a clock decides nothing here. What is asserted is that no
/// cycle is cheap because it fails early.
#[test]
fn an_urban_cycle_goes_through_all_stages() {
    let settings = [Profile::PAPER, Profile::HARDENED]
        .into_iter()
        .flat_map(|profile| [MotRemote, AllRemote, PlanRemote].map(|it| (profile, it)));
    for (profile, configuration) in settings {
        let mut slowest = Duration::ZERO;
        for turn in 0..12 {
            let cycle = urban(profile, configuration, 7.0 + 29.0 * f64::from(turn));
            let line = cycle_to_line("urban", &cycle);
            let times = (0..3).map(|_| {
                let begun = Instant::now();
                let found = answer(line.as_bytes(), 1);
                let time = begun.elapsed();
                let Answer::Cycle(found) = found else { panic!("{found:?}") };
                assert_eq!(found.failed_stage, None, "{profile:?} {configuration:?} {found:?}");
                time
            });
            slowest = slowest.max(times.min().unwrap_or_default());
        }
        println!(
            "{profile:?} {configuration:?}: {slowest:?}, the slowest of 12, each the least of 3"
        );
    }
}
