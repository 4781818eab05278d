//! Cycles of any numbers at all: nobody aimed them, most are invalid, and none may panic.

use std::collections::BTreeMap;

use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Profile, Route, Track,
    TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;
use mufasa_props::conformance::name;
use mufasa_props::strategy::draw::Draw;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const CYCLES: u64 = 70_000;

/// Numbers for one cycle from a seed.
pub fn tape(seed: u64) -> Vec<u32> {
    ChaCha8Rng::seed_from_u64(seed).random_iter().take(2_000).collect()
}

/// Draws values, of which every so many is of any bits.
struct Any<'a> {
    draw: Draw<'a>,
    /// One in this many; 0 for none.
    wild: usize,
}

impl Any<'_> {
    fn is_wild(&mut self) -> bool {
        self.wild > 0 && self.draw.below(self.wild) == 0
    }

    fn bits(&mut self) -> u64 {
        u64::from(self.draw.bits()) << 32 | u64::from(self.draw.bits())
    }

    /// Within the limits, unless wild.
    fn number(&mut self, lo: f64, hi: f64) -> f64 {
        if !self.is_wild() {
            return self.draw.range(lo, hi);
        }
        let edges = [lo, hi, -hi, 0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX];
        match self.draw.below(2) {
            0 => f64::from_bits(self.bits()),
            _ => self.draw.pick(&edges),
        }
    }

    fn integer(&mut self, lo: i64, hi: i64) -> i64 {
        if self.is_wild() {
            let edges = [lo, hi, lo.saturating_sub(1), hi.saturating_add(1), i64::MIN, i64::MAX];
            let any = i64::from_ne_bytes(self.bits().to_ne_bytes());
            return if self.draw.below(2) == 0 { any } else { self.draw.pick(&edges) };
        }
        let span = u64::try_from(hi - lo).expect("lo is at most hi") + 1;
        lo + i64::try_from(self.bits() % span).expect("at most the span")
    }

    fn direction(&mut self) -> (f64, f64) {
        let (cos, sin) = self.draw.direction();
        if self.is_wild() { (self.number(-1.0, 1.0), sin) } else { (cos, sin) }
    }

    fn list<T>(
        &mut self,
        least: usize,
        most: usize,
        item: fn(&mut Self, f64) -> T,
        s: f64,
    ) -> Vec<T> {
        (0..self.draw.between(least, most)).map(|_| item(self, s)).collect()
    }

    fn maybe<T>(&mut self, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.draw.below(8) == 0 { None } else { Some(value(self)) }
    }

    fn track(&mut self, s: f64) -> Track {
        let (cos, sin) = self.direction();
        Track {
            id: self.integer(-9, 9),
            x: self.number(-s, s),
            y: self.number(-s, s),
            cos,
            sin,
            vx: self.number(-150.0, 150.0),
            vy: self.number(-150.0, 150.0),
            length: self.number(0.01, 100.0),
            width: self.number(0.01, 100.0),
        }
    }

    fn detection(&mut self, s: f64) -> Detection {
        let Track { x, y, cos, sin, length, width, .. } = self.track(s);
        Detection { x, y, cos, sin, length, width }
    }

    fn cross_section(&mut self, s: f64) -> CrossSection {
        let mut n = || self.number(-s, s);
        CrossSection { x: n(), y: n(), left: [n(), n()], right: [n(), n()] }
    }

    fn trajectory(&mut self, now_ns: i64, s: f64) -> Trajectory {
        let mut t_ns = now_ns.saturating_add(self.integer(-100_000_000, 100_000_000));
        let points = (0..self.draw.between(0, 6)).map(|_| {
            t_ns = t_ns.saturating_add(self.integer(1, 500_000_000));
            let (cos, sin) = self.direction();
            TrajectoryPoint { t_ns, x: self.number(-s, s), y: self.number(-s, s), cos, sin }
        });
        let points = points.collect();
        Trajectory { stamp_ns: self.stamp(now_ns), points }
    }

    fn stamp(&mut self, now_ns: i64) -> i64 {
        now_ns.saturating_sub(self.integer(-10_000_000, 200_000_000))
    }

    fn grid(&mut self, now_ns: i64, s: f64) -> Grid {
        let (cos, sin) = self.direction();
        let (width, height) = (self.integer(1, 40), self.integer(1, 40));
        let bytes = width.saturating_mul(height).saturating_add(7) / 8;
        let bytes = usize::try_from(bytes.clamp(0, 200)).expect("not negative");
        let dense = self.draw.below(2) == 0;
        let mut map = || -> Vec<u8> {
            let bits = (0..bytes).map(|_| self.draw.bits().to_le_bytes());
            bits.map(|[a, b, c, d]| if dense { a } else { a & b & c & d }).collect()
        };
        let (occupied, unknown) = (map(), map());
        Grid {
            stamp_ns: self.stamp(now_ns),
            x: self.number(-s, s),
            y: self.number(-s, s),
            cos,
            sin,
            resolution: self.number(0.01, 10.0),
            width,
            height,
            occupied,
            unknown: if self.draw.below(2) == 0 { None } else { Some(unknown) },
        }
    }

    fn ego(&mut self, s: f64) -> Ego {
        let (cos, sin) = self.direction();
        let fastest = self.draw.pick(&[1.0, 15.0, 150.0]);
        Ego {
            x: self.number(-s, s),
            y: self.number(-s, s),
            cos,
            sin,
            speed: self.number(0.0, fastest),
            length: self.number(0.01, 100.0),
            width: self.number(0.01, 100.0),
            center_offset: self.number(-100.0, 100.0),
        }
    }
}

/// A cycle of any numbers: in a third none is outside the domain, in a third a few, in a third
/// many. Nothing fits to anything else but by chance.
pub fn cycle(tape: &[u32]) -> Cycle {
    let mut any = Any { draw: Draw::new(tape), wild: 0 };
    any.wild = any.draw.pick(&[0, 200, 6]);
    let s = any.draw.pick(&[1.0, 30.0, 1e3, 16_777_216.0]);
    let now_ns = any.integer(-1_000_000_000_000, 1_000_000_000_000);
    let profile = any.draw.pick(&[Profile::PAPER, Profile::HARDENED]);
    let tracks = |any: &mut Any<'_>| TrackList {
        stamp_ns: any.stamp(now_ns),
        items: any.list(0, 5, Any::track, s),
    };
    Cycle {
        profile,
        parameters: any.parameters(),
        now_ns,
        configuration: any.draw.pick(&[
            Configuration::AllRemote,
            Configuration::MotRemote,
            Configuration::PlanRemote,
            Configuration::Local,
        ]),
        ego: any.ego(s),
        trajectory: any.maybe(|any| any.trajectory(now_ns, s)),
        tracks: any.maybe(tracks),
        detections: any.maybe(|any| DetectionList {
            stamp_ns: any.stamp(now_ns),
            items: any.list(0, 5, Any::detection, s),
        }),
        lead: any.maybe(|any| Lead {
            stamp_ns: any.stamp(now_ns),
            gap: any.number(0.0, 1e6),
            speed: any.number(0.0, 150.0),
        }),
        route: Route {
            closed: any.draw.below(2) == 0,
            cross_sections: any.list(1, 7, Any::cross_section, s),
        },
        grid: any.maybe(|any| any.grid(now_ns, s)),
        detection_history: (0..any.draw.below(6))
            .map(|_| DetectionList {
                stamp_ns: any.stamp(now_ns),
                items: any.list(0, 5, Any::detection, s),
            })
            .collect(),
    }
}

/// IMPL-07, INPUT-08: whatever the numbers are, there is an
/// answer and no panic (overflow of integers panics in tests too).
#[test]
fn no_numbers_panic() {
    let mut seen: BTreeMap<&str, u64> = BTreeMap::new();
    for seed in 0..CYCLES {
        let verdict = match check_impl(&cycle(&tape(seed))) {
            Ok(report) => name(report.failed_stage),
            Err(_) => "error",
        };
        *seen.entry(verdict).or_default() += 1;
    }
    println!("{seen:?}");
    for verdict in ["error", "input", "i", "ii", "iii", "iv", "v", "safe"] {
        assert!(seen.get(verdict).is_some_and(|count| *count >= 50), "{verdict}: {seen:?}");
    }
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident: $type:ident = $default:literal in $domain:expr;)*) => {
        impl Any<'_> {
            fn parameters(&mut self) -> Parameters {
                Parameters {
                    $($name: any!(self, $type, $domain),)*
                }
            }
        }
    };
}

/// A value of the domain.
macro_rules! any {
    ($draw:ident, f64, $domain:expr) => {
        $draw.number(*$domain.start(), *$domain.end())
    };
    ($draw:ident, i64, $domain:expr) => {
        $draw.integer(*$domain.start(), *$domain.end())
    };
}

mufasa_model::parameters!(parameters);
