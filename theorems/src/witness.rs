//! Witnesses of findings, found by the solver: numbers for the holes of a cycle that the paper
//! profile accepts although something is wrong with it.

use std::io;

use crate::configuration::Configuration::{self, AllRemote, MotRemote, PlanRemote};
use crate::cycle::{Cycle, Detection, DetectionList, Lead, Profile, Track, TrackList, Trajectory};
use crate::distance::s_b;
use crate::prove::{Verdict, prove};
use crate::real::Real;
use crate::real::formula::{Formula, at_most, given, less, not};
use crate::real::hole::{hole, name_of};
use crate::scene::Scene;
use crate::schedule::decide;
use crate::theorem::base::{self, NOW_NS};

/// A finding whose witness is searched.
#[derive(Debug)]
pub struct Search {
    /// The finding.
    pub finding: &'static str,
    /// What is wrong with the cycle.
    pub wrong: &'static str,
    /// The cycle with holes.
    pub cycle: fn(Profile) -> Cycle,
    /// What the holes are within, and what is wrong.
    pub conditions: fn(&Scene) -> [Formula; 2],
}

/// All searches. Objects are as large as the CAV and along x, so that two of them meet when their
/// centres on the x axis are at most 4 m apart.
pub const SEARCHES: [Search; 8] = [
    Search {
        finding: "F-02",
        wrong: "a track 10 m from the only detection, within the field of view",
        cycle: |profile| {
            let mut cycle = bare(profile, MotRemote);
            cycle.tracks = Some(tracks(vec![track(1, 60.0), track(2, hole("x"))]));
            cycle.detections = Some(detections(60.0));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &integer(50))],
    },
    Search {
        finding: "F-03",
        wrong: "a lorry of 12 m meets the CAV",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.tracks = Some(tracks(vec![Track { length: 12.0, ..track(1, hole("x")) }]));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &Real::ratio(79, 10))],
    },
    Search {
        finding: "F-04",
        wrong: "a standing car meets the CAV at a trajectory point within its braking distance",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = hole("v_now");
            cycle.trajectory = Some(straight(&[0.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0]));
            cycle.tracks = Some(tracks(vec![track(1, hole("x"))]));
            cycle
        },
        conditions: |scene| [both(within("v_now", 10, 40), within("x", 0, 110)), met(scene, 80)],
    },
    Search {
        finding: "F-05",
        wrong: "a detection meets the CAV at a trajectory point within its braking distance",
        cycle: |profile| {
            let mut cycle = bare(profile, MotRemote);
            cycle.ego.speed = hole("v_now");
            cycle.trajectory = Some(straight(&[0.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0]));
            cycle.lead = Some(Lead { stamp_ns: NOW_NS, gap: 200.0, speed: hole("v_lead") });
            cycle.detections = Some(detections(hole("x")));
            cycle
        },
        conditions: |scene| {
            let speeds = both(within("v_now", 10, 40), within("v_lead", 0, 40));
            [both(speeds, within("x", 0, 110)), met(scene, 80)]
        },
    },
    Search {
        finding: "F-06",
        wrong: "the first step of a standing CAV ends in a car",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.trajectory = Some(straight(&[0.0, 1.0]));
            cycle.tracks = Some(tracks(vec![track(1, hole("x"))]));
            cycle
        },
        conditions: |_| [within("x", 0, 60), at_most(&Real::named("x"), &Real::ratio(49, 10))],
    },
    Search {
        finding: "F-13",
        wrong: "a car that stands in the way, with a made-up velocity",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.ego.speed = 5.0;
            cycle.trajectory = Some(straight(&[0.0, 1.0, 2.0]));
            cycle.tracks = Some(tracks(vec![Track { vx: hole("vx"), ..track(1, 4.5) }]));
            cycle.detections = Some(detections(4.5));
            cycle
        },
        conditions: |_| [within("vx", -50, 50), Formula::Known(true)],
    },
    Search {
        finding: "F-15",
        wrong: "a car that stands in the way, with a made-up length",
        cycle: |profile| {
            let mut cycle = bare(profile, AllRemote);
            cycle.ego.speed = 5.0;
            cycle.trajectory = Some(straight(&[0.0, 0.5]));
            cycle.tracks = Some(tracks(vec![Track { length: hole("length"), ..track(1, 4.2) }]));
            cycle.detections = Some(detections(4.2));
            cycle
        },
        conditions: |_| [within("length", 1, 10), Formula::Known(true)],
    },
    Search {
        finding: "F-23",
        wrong: "a trajectory that ends before the car in the braking distance",
        cycle: |profile| {
            let mut cycle = bare(profile, PlanRemote);
            cycle.ego.speed = 16.0;
            cycle.trajectory = Some(straight(&[0.0, hole("end")]));
            cycle.tracks = Some(tracks(vec![track(1, 14.0)]));
            cycle
        },
        conditions: |_| [within("end", 1, 20), Formula::Known(true)],
    },
];

impl Search {
    /// A cycle that the paper profile accepts in spite of what is wrong; none where there is none
    /// or the solver knows none. Errors are those of talking to the solver.
    pub fn find(&self) -> io::Result<Option<Cycle>> {
        let proof = prove(&|| {
            let scene = base::scene(&(self.cycle)(Profile::Paper));
            let [bounds, wrong] = (self.conditions)(&scene);
            given(bounds);
            given(wrong);
            not(Formula::from(decide(&scene).failed_stage.is_none()))
        })?;
        let Verdict::Refuted(values) = proof.verdict else { return Ok(None) };
        let mut cycle = (self.cycle)(Profile::Paper);
        for number in numbers(&mut cycle) {
            let Some(name) = name_of(*number) else { continue };
            let found = values.iter().find(|(other, _)| *other == name);
            *number = found.map_or(0.0, |(_, value)| *value);
        }
        Ok(Some(cycle))
    }
}

/// The numbers that a search may leave open.
fn numbers(cycle: &mut Cycle) -> impl Iterator<Item = &mut f64> {
    let points = cycle.trajectory.iter_mut().flat_map(|list| &mut list.points);
    let tracks = cycle.tracks.iter_mut().flat_map(|list| &mut list.items);
    let detections = cycle.detections.iter_mut().flat_map(|list| &mut list.items);
    [&mut cycle.ego.speed]
        .into_iter()
        .chain(points.map(|point| &mut point.x))
        .chain(tracks.flat_map(|track| [&mut track.x, &mut track.vx, &mut track.length]))
        .chain(detections.map(|detection| &mut detection.x))
        .chain(cycle.lead.iter_mut().map(|lead| &mut lead.speed))
}

fn bare(profile: Profile, configuration: Configuration) -> Cycle {
    base::cycle(profile, configuration)
}

fn integer(value: i64) -> Real {
    Real::from_integer(value.into())
}

fn both(a: Formula, b: Formula) -> Formula {
    Formula::All(vec![a, b])
}

fn within(name: &str, least: i64, most: i64) -> Formula {
    let number = Real::named(name);
    both(at_most(&integer(least), &number), at_most(&number, &integer(most)))
}

/// The car at x meets the CAV at the point this far along, which is within s_b.
fn met(scene: &Scene, along: i64) -> Formula {
    let (x, reach) = (Real::named("x"), Real::ratio(39, 10));
    let s_b = s_b(&scene.ego.v_now, &scene.parameters.a_b);
    Formula::All(vec![
        less(&integer(along), &s_b),
        at_most(&(integer(along) - &reach), &x),
        at_most(&x, &(integer(along) + reach)),
    ])
}

/// Points along x, 100 ms apart.
fn straight(places: &[f64]) -> Trajectory {
    let point = |(i, x): (i64, &f64)| base::point(NOW_NS + i * 100_000_000, *x, 0.0);
    Trajectory { stamp_ns: NOW_NS, points: (0..).zip(places).map(point).collect() }
}

fn tracks(items: Vec<Track>) -> TrackList {
    TrackList { stamp_ns: NOW_NS, items }
}

fn track(id: i64, x: f64) -> Track {
    Track { id, x, y: 0.0, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.0, width: 2.0 }
}

fn detections(x: f64) -> DetectionList {
    let detection = Detection { x, y: 0.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 };
    DetectionList { stamp_ns: NOW_NS, items: vec![detection] }
}
