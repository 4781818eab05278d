//! What the vectors do not say of invalid input (`spec/3-stages.md#invalid-input`): the kind of each
//! problem, extreme stamps, the norm to the last bit, and scratch.

use crate::scene::{NOW_NS, scene};
use mufasa::cycle;
use mufasa::input::cycle::{Cycle, Track};
use mufasa::input::profile::Profile;
use mufasa::input::scratch::Scratch;
use mufasa::report::{InvalidInput, Problem};
use mufasa::services::configuration::Configuration::{AllRemote, MotRemote};

fn invalid(field: &'static str, index: Option<usize>, problem: Problem) -> InvalidInput {
    InvalidInput { field, index, problem }
}

#[test]
fn local_problems_are_errors() {
    type Change = fn(&mut Cycle<'_>);
    let cases: [(Change, InvalidInput); 7] = [
        (
            |cycle| cycle.parameters.theta_tr = 0.0,
            invalid("parameters.theta_tr", None, Problem::OutOfDomain),
        ),
        (|cycle| cycle.ego.x = f64::NAN, invalid("ego.x", None, Problem::NotFinite)),
        (|cycle| cycle.ego.sin = 0.0011, invalid("ego.cos", None, Problem::NotADirection)),
        (|cycle| cycle.ego.speed = -1e-300, invalid("ego.speed", None, Problem::OutOfDomain)),
        (
            |cycle| cycle.route.cross_sections = &[],
            invalid("route.stations", None, Problem::TooFew),
        ),
        (
            |cycle| cycle.grid.as_mut().expect("a grid").width = 201,
            invalid("grid.occupied", None, Problem::BitmapLength),
        ),
        (
            |cycle| cycle.detections.as_mut().expect("a list").stamp_ns = NOW_NS + 60_000_000_001,
            invalid("detections.stamp_ns", None, Problem::TimeOutOfRange),
        ),
    ];
    for (change, problem) in cases {
        let mut scene = scene(Profile::HARDENED, AllRemote, [0.0, 0.0]);
        scene.change = change;
        assert_eq!(scene.check(), Err(problem));
    }
}

/// The extremes of 64 bits are stamps like others.
#[test]
fn stamps_may_be_as_far_apart_as_64_bits_allow() {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    scene.change = |cycle| {
        cycle.now_ns = i64::MAX;
        for stamp_ns in [
            &mut cycle.trajectory.as_mut().expect("a trajectory").stamp_ns,
            &mut cycle.detections.as_mut().expect("detections").stamp_ns,
            &mut cycle.grid.as_mut().expect("a grid").stamp_ns,
        ] {
            *stamp_ns = i64::MIN;
        }
        cycle.tracks = None;
    };
    assert_eq!(scene.report().failed_stage, None);
}

/// The check of the norm is exact: the nearest doubles on both sides of 1 + 1e-6.
#[test]
fn the_norm_has_no_margin() {
    let last = (1.0_f64 + 1e-6).sqrt();
    let accepted = |cos: f64| {
        let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
        scene.ego.cos = cos;
        scene.check().is_ok()
    };
    let next = |value: f64, ulps: u64| f64::from_bits(value.to_bits() + ulps);
    assert!(accepted(next(last, 0) - 1e-15) && !accepted(next(last, 0) + 1e-15));
    let changes =
        (0..8).filter(|&i| accepted(next(last - 8e-16, i)) != accepted(next(last - 8e-16, i + 1)));
    assert_eq!(changes.count(), 1);
}

#[test]
fn scratch_that_is_too_small_is_an_error() {
    let mut scene = scene(Profile::HARDENED, MotRemote, [0.0, 0.0]);
    scene.change = |cycle| {
        let small = cycle::check(cycle, &mut Scratch::new(&mut [], &mut []));
        assert_eq!(small, Err(invalid("scratch", None, Problem::ScratchTooSmall)));
    };
    assert!(scene.check().is_ok());
}

/// INPUT-04: ids that a table of bits cannot tell apart are two.
#[test]
fn ids_that_are_4096_apart_are_two() {
    let mut scene = scene(Profile::PAPER, MotRemote, [0.0, 0.0]);
    let tracks = scene.tracks.as_mut().expect("a list");
    let first = tracks[0];
    tracks.extend([4096, 8192].map(|more| Track {
        id: first.id + more,
        x: first.x + 9.0,
        ..first
    }));
    assert_eq!(scene.check().map(|report| report.input), Ok(None));
    scene.tracks.as_mut().expect("a list")[2].id = first.id;
    let problem = scene.check().expect("a report").input.expect("a problem");
    assert_eq!(problem, invalid("tracks.items.id", Some(2), Problem::DuplicateId));
}
