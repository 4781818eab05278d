//! A cycle that is written out is read back the same.

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;
use mufasa_records::{Record, cycle_to_line, parse};

use crate::common::{CYCLE, Random};

const CYCLES: usize = 3_000;
const SEED: u64 = 20_250_711;

#[test]
fn a_written_cycle_is_read_back_bit_for_bit() {
    let mut random = Random::new(SEED);
    for _ in 0..CYCLES {
        let (id, cycle) = (text(&mut random), cycle(&mut random));
        let line = cycle_to_line(&id, &cycle);
        assert!(!line.contains('\n'), "{line}");
        let Ok(Record::Cycle { id: read_id, cycle: read }) = parse(line.as_bytes(), 1) else {
            panic!("{line}\n{:?}", parse(line.as_bytes(), 1));
        };
        assert_eq!(read_id, id);
        // Debug output holds the shortest digits of every double and the sign of zero.
        assert_eq!(format!("{read:?}"), format!("{:?}", Box::new(cycle)), "{line}");
    }
}

#[test]
fn doubles_are_written_shortest() {
    let Ok(Record::Cycle { id, mut cycle }) = parse(CYCLE.as_bytes(), 1) else {
        panic!("the example is a cycle");
    };
    cycle.ego.x = 0.1 + 0.2;
    cycle.ego.y = -0.0;
    cycle.ego.speed = 5.0;
    cycle.ego.length = f64::MAX;
    cycle.ego.width = 1e-7;
    let line = cycle_to_line(&id, &cycle);
    let ego = "\"ego\": {\"x\": 0.30000000000000004, \"y\": -0, \"cos\": 1, \"sin\": 0, \
               \"speed\": 5, \"length\": 1.7976931348623157e308, \"width\": 1e-7,";
    assert!(line.contains(ego), "{line}");
}

#[test]
fn parameters_at_their_default_are_left_out() {
    let Ok(Record::Cycle { id, cycle }) = parse(CYCLE.as_bytes(), 1) else {
        panic!("the example is a cycle");
    };
    assert!(cycle_to_line(&id, &cycle).contains("\"parameters\": {},"));
}

fn cycle(random: &mut Random) -> Cycle {
    Cycle {
        profile: *random.pick(&[Profile::PAPER, Profile::HARDENED]),
        parameters: parameters(random),
        now_ns: integer(random),
        configuration: *random.pick(&[
            Configuration::Local,
            Configuration::MotRemote,
            Configuration::AllRemote,
            Configuration::PlanRemote,
        ]),
        ego: Ego {
            x: float(random),
            y: float(random),
            cos: float(random),
            sin: float(random),
            speed: float(random),
            length: float(random),
            width: float(random),
            center_offset: float(random),
        },
        trajectory: maybe(random, |random| Trajectory {
            stamp_ns: integer(random),
            points: list(random, point),
        }),
        tracks: maybe(random, tracks),
        detections: maybe(random, |random| DetectionList {
            stamp_ns: integer(random),
            items: list(random, detection),
        }),
        lead: maybe(random, |random| Lead {
            stamp_ns: integer(random),
            gap: float(random),
            speed: float(random),
        }),
        route: Route {
            closed: random.bits() & 1 == 0,
            cross_sections: list(random, cross_section),
        },
        grid: maybe(random, grid),
        detection_history: list(random, |random| DetectionList {
            stamp_ns: integer(random),
            items: list(random, detection),
        }),
    }
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        fn parameters(random: &mut Random) -> Parameters {
            let mut parameters = Parameters::default();
            $(if random.bits() & 1 == 0 {
                parameters.$name = any!($number)(random);
            })*
            parameters
        }
    };
}

macro_rules! any {
    (f64) => {
        float
    };
    (i64) => {
        integer
    };
}

mufasa_model::parameters!(parameters);

fn tracks(random: &mut Random) -> TrackList {
    TrackList {
        stamp_ns: integer(random),
        items: list(random, |random| Track {
            id: integer(random),
            x: float(random),
            y: float(random),
            cos: float(random),
            sin: float(random),
            vx: float(random),
            vy: float(random),
            length: float(random),
            width: float(random),
        }),
    }
}

fn point(random: &mut Random) -> TrajectoryPoint {
    TrajectoryPoint {
        t_ns: integer(random),
        x: float(random),
        y: float(random),
        cos: float(random),
        sin: float(random),
    }
}

fn detection(random: &mut Random) -> Detection {
    Detection {
        x: float(random),
        y: float(random),
        cos: float(random),
        sin: float(random),
        length: float(random),
        width: float(random),
    }
}

fn cross_section(random: &mut Random) -> CrossSection {
    CrossSection {
        x: float(random),
        y: float(random),
        left: [float(random), float(random)],
        right: [float(random), float(random)],
    }
}

/// A grid whose bitmaps fit its size, as those of every valid cycle do, or one with a size
/// outside the domain.
fn grid(random: &mut Random) -> Grid {
    let [columns, rows] = [1 + random.below(40), 1 + random.below(40)];
    let bytes = (columns * rows).div_ceil(8);
    let is_outside = random.below(8) == 0;
    let side = |cells: usize| if is_outside { -1 } else { i64::try_from(cells).unwrap() };
    Grid {
        stamp_ns: integer(random),
        x: float(random),
        y: float(random),
        cos: float(random),
        sin: float(random),
        resolution: float(random),
        width: side(columns),
        height: side(rows),
        occupied: (0..bytes).map(|_| random.byte()).collect(),
        unknown: maybe(random, |random| (0..bytes).map(|_| random.byte()).collect()),
    }
}

fn maybe<T>(random: &mut Random, value: impl Fn(&mut Random) -> T) -> Option<T> {
    (random.below(4) > 0).then(|| value(random))
}

fn list<T>(random: &mut Random, item: impl Fn(&mut Random) -> T) -> Vec<T> {
    (0..random.below(4)).map(|_| item(random)).collect()
}

fn integer(random: &mut Random) -> i64 {
    let any = random.bits().cast_signed();
    *random.pick(&[any, any, any >> 40, 0, i64::MIN, i64::MAX])
}

/// Any bits, numbers of ordinary size, and the corners.
fn float(random: &mut Random) -> f64 {
    let bits = random.bits();
    // NaN has one form in a record.
    let any = if f64::from_bits(bits).is_nan() { f64::NAN } else { f64::from_bits(bits) };
    let small = f64::from(u32::try_from(bits >> 32).unwrap()) / 1e6;
    let corners =
        [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, f64::MAX];
    let corner = *random.pick(&corners);
    *random.pick(&[any, any, small, -small, corner, small.trunc(), f64::from_bits(bits >> 12)])
}

fn text(random: &mut Random) -> String {
    let characters = ['a', '"', '\\', '\n', '\0', '\u{7f}', '\u{e9}', '\u{2028}', '\u{1f697}'];
    (0..random.below(6)).map(|_| *random.pick(&characters)).collect()
}
