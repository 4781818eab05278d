//! What a station sends that asks before: it passes, by the implementation and by the exact model; and what it
//! does not send is named (`spec/5-interfaces.md#precheck`).

use std::cell::RefCell;

use mufasa::input::cycle::{self as twin, Ego};
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::provider::{Failure, Precheck};
use mufasa::report::{FailedStage, InvalidInput, Problem, Stage};
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile, TrajectoryPoint};
use mufasa_model::report::Reading;
use mufasa_props::bridge::{check_impl, from_impl, to_impl, with_impl};
use mufasa_props::differential::{Generator, runner};
use mufasa_props::strategy::draw::{Draw, tape};
use mufasa_props::strategy::{detections, track_validation, tracks};
use proptest::strategy::Strategy;
use proptest::test_runner::TestCaseError;

/// Asks about a cycle in the types of the implementation, with scratch of the size that it needs, less so much.
fn ask<T>(
    cycle: &Cycle,
    less: [usize; 2],
    question: impl FnOnce(&mut Precheck<'_>, &twin::Cycle<'_>) -> T,
) -> T {
    let owned = to_impl(cycle);
    let history = owned.history();
    let borrowed = owned.borrow(&history);
    let sizes = Sizes::for_cycle(&borrowed);
    let mut rows = vec![Row::default(); sizes.rows - less[0]];
    let mut columns = vec![Column::default(); sizes.columns - less[1]];
    question(&mut Precheck::new(&mut rows, &mut columns), &borrowed)
}

/// What the implementation says of a cycle.
fn failure(cycle: &Cycle) -> Option<Failure> {
    with_impl(cycle, |cycle, scratch| {
        Failure::of(&mufasa::cycle::check(cycle, scratch).expect("valid local input"))
    })
}

/// Whether a cycle is safe, to the exact model and to the implementation.
fn is_safe(cycle: &Cycle) -> [bool; 2] {
    let exact = check(cycle, Reading::Exact).is_ok_and(|it| it.failed_stage.is_none());
    [exact, check_impl(cycle).is_ok_and(|it| it.failed_stage.is_none())]
}

/// A property of cycles, which counts what it sees; one of each in a hundred at least.
fn hold<const N: usize>(
    title: &str,
    profile: Profile,
    generator: Generator,
    property: impl Fn(&Cycle, &mut Draw<'_>) -> Result<[bool; N], String>,
) {
    let counts = RefCell::new([0_u32; N]);
    let cases = tape().prop_map(|tape| (generator(&mut Draw::new(&tape), profile), tape));
    let result = runner().run(&cases, |(cycle, mut tape)| {
        // Other choices than those of the cycle.
        tape.reverse();
        let seen = property(&cycle, &mut Draw::new(&tape)).map_err(TestCaseError::fail)?;
        counts.borrow_mut().iter_mut().zip(seen).for_each(|(count, it)| *count += u32::from(it));
        Ok(())
    });
    let counts = counts.into_inner();
    println!("{title}, {profile:?}: {counts:?}");
    result.unwrap_or_else(|error| panic!("{title}, {profile:?}: {error}"));
    let least = mufasa_props::differential::cases() / 100;
    assert!(counts.iter().all(|count| *count >= least), "{title}, {profile:?}: {counts:?}");
}

fn said(what: &str, cycle: &Cycle) -> String {
    format!("{what}: {cycle:#?}")
}

/// PRE-02, PRE-04: what is kept passes stage i, by the
/// implementation and by the exact model, together and each alone; every other track is named once, with a
/// failure that is one of cycles with it.
#[test]
fn what_is_kept_passes_and_what_is_left_out_is_named() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        hold("tracks", profile, track_validation::cycle, |cycle, _| kept(cycle));
    }
}

/// Counted: all kept although something fails without asking, something left out, all left out.
fn kept(cycle: &Cycle) -> Result<[bool; 3], String> {
    let Some(given) = &cycle.tracks else { return Ok([false; 3]) };
    let [exact, _] = is_safe(cycle);
    ask(cycle, [0; 2], |precheck, asked| {
        let mut tracks = asked.tracks.map_or_else(Vec::new, |list| list.items.to_vec());
        let mut left_out = Vec::new();
        let answer = precheck.tracks(asked, given.stamp_ns, &mut tracks, |track, why| {
            left_out.push((*track, why));
        });
        let Ok(Some(kept)) = answer else { return Err(said("no list", cycle)) };
        let with = |items| {
            let tracks = Some(twin::TrackList { stamp_ns: given.stamp_ns, items });
            twin::Cycle { trajectory: None, tracks, ..*asked }
        };
        if is_safe(&from_impl(&with(kept.tracks.items))) != [true; 2] {
            return Err(said("what is kept fails", cycle));
        }
        for track in kept.tracks.items {
            if is_safe(&from_impl(&with(std::slice::from_ref(track)))) != [true; 2] {
                return Err(said("what is kept fails alone", cycle));
            }
        }
        let mut all: Vec<_> = left_out.iter().map(|(track, _)| *track).collect();
        all.extend(kept.tracks.items);
        let mut ids: Vec<i64> = all.iter().map(|it| it.id).collect();
        let mut of_list: Vec<i64> = given.items.iter().map(|it| it.id).collect();
        ids.sort_unstable();
        of_list.sort_unstable();
        if ids != of_list || kept.left_out != left_out.len() {
            return Err(said("a track is neither kept nor named once", cycle));
        }
        let is_of_i = |why: &Failure| {
            why.failed == FailedStage::Stage(Stage::I) && why.witness.is_some()
                || why.failed == FailedStage::Input && why.input.is_some()
        };
        if let Some((track, why)) = left_out.iter().find(|(_, why)| !is_of_i(why)) {
            return Err(said(&format!("{track:?} is left out for {why:?}"), cycle));
        }
        if !exact && left_out.is_empty() {
            return Err(said("the list fails, and nothing is left out", cycle));
        }
        let kept = kept.tracks.items.len();
        Ok([exact && left_out.is_empty(), !exact && kept > 0, kept == 0])
    })
}

/// PRE-01, PRE-05, PRE-06, PRE-07: the first candidate that passes is chosen, and what is said of those before it is what
/// the stages say.
#[test]
fn the_first_candidate_that_passes_is_chosen() {
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for generator in [tracks::cycle as Generator, detections::cycle] {
            hold("candidates", profile, generator, chosen);
        }
    }
}

/// Counted: the first is chosen, a later one, none; and a later one, where another order chooses otherwise.
fn chosen(cycle: &Cycle, draw: &mut Draw<'_>) -> Result<[bool; 4], String> {
    // Local input at the border of the domain is an error.
    let (Some(own), Ok(_)) = (&cycle.trajectory, check_impl(cycle)) else { return Ok([false; 4]) };
    let aside = |metres: f64| {
        let moved = |it: &TrajectoryPoint| TrajectoryPoint {
            x: it.x - metres * it.sin,
            y: it.y + metres * it.cos,
            ..*it
        };
        own.points.iter().map(moved).collect::<Vec<_>>()
    };
    let mut candidates = vec![aside(0.0), aside(3.0), aside(-0.4), aside(20.0)];
    candidates.rotate_left(draw.below(4));
    if draw.one_in(4) {
        candidates.truncate(1);
    }
    let with = |points: &Vec<TrajectoryPoint>| {
        let mut cycle = cycle.clone();
        cycle.trajectory.iter_mut().for_each(|it| it.points.clone_from(points));
        cycle
    };
    let cycles: Vec<Cycle> = candidates.iter().map(with).collect();
    let ask_in = |cycles: &[Cycle]| -> (Option<usize>, Vec<Option<Failure>>) {
        let owned: Vec<_> = cycles.iter().map(to_impl).collect();
        let points = |at: &mufasa_props::bridge::Owned| {
            at.borrow(&[]).trajectory.map_or_else(Vec::new, |it| it.points.to_vec())
        };
        let mut told = Vec::new();
        let first = ask(cycle, [0; 2], |precheck, asked| {
            let candidates = owned.iter().map(points);
            precheck.first(asked, own.stamp_ns, candidates, |index, why| {
                assert_eq!(index, told.len(), "in their order");
                told.push(Some(why));
            })
        });
        (first.expect("valid local input").map(|(index, _)| index), told)
    };
    let (first, told) = ask_in(&cycles);
    if first.is_some_and(|index| is_safe(&cycles[index]) != [true; 2]) {
        return Err(said(&format!("{first:?} fails"), cycle));
    }
    let before = &cycles[..first.unwrap_or(cycles.len())];
    if told != before.iter().map(failure).collect::<Vec<_>>() {
        return Err(said(&format!("told {told:?}"), cycle));
    }
    let mut reversed = cycles.clone();
    reversed.reverse();
    let (other, _) = ask_in(&reversed);
    let is_other = other.is_some_and(|at| first != Some(cycles.len() - 1 - at));
    Ok([first == Some(0), first.is_some_and(|at| at > 0), first.is_none(), is_other])
}

/// A cycle with three tracks and as many detections.
fn three() -> Cycle {
    let mut tape = Vec::new();
    (0..u32::MAX)
        .map(|seed| {
            tape.clear();
            tape.extend((0..600_u32).map(|at| (seed * 600 + at).wrapping_mul(2_654_435_761)));
            track_validation::cycle(&mut Draw::new(&tape), Profile::HARDENED)
        })
        .find(|cycle| {
            let tracks = cycle.tracks.as_ref().map_or(0, |it| it.items.len());
            tracks > 2 && cycle.detections.as_ref().is_some_and(|it| it.items.len() > 2)
        })
        .expect("there is one")
}

/// PRE-08: memory that is too small is an error, whatever would have been kept; nothing
/// is cut.
#[test]
fn too_little_memory_is_an_error() {
    let cycle = three();
    let list = |precheck: &mut Precheck<'_>, asked: &twin::Cycle<'_>| {
        let mut tracks = asked.tracks.map_or_else(Vec::new, |list| list.items.to_vec());
        let kept = precheck.tracks(asked, asked.now_ns, &mut tracks, |_, _| {});
        kept.map(|kept| kept.map(|kept| kept.tracks.items.len() + kept.left_out))
    };
    let all = cycle.tracks.as_ref().map(|it| it.items.len());
    let problem = Problem::ScratchTooSmall;
    let too_small = InvalidInput { field: "scratch", index: None, problem };
    assert_eq!(ask(&cycle, [0, 0], list), Ok(all));
    for less in [[1, 0], [0, 1]] {
        assert_eq!(ask(&cycle, less, list), Err(too_small));
        let plan = |precheck: &mut Precheck<'_>, asked: &twin::Cycle<'_>| {
            let Ego { x, y, cos, sin, .. } = asked.ego;
            let stays = [twin::TrajectoryPoint { t_ns: asked.now_ns, x, y, cos, sin }];
            precheck.first(asked, asked.now_ns, [stays], |_, _| panic!("asked"))
        };
        assert_eq!(ask(&cycle, less, plan), Err(too_small));
    }
}

/// PRE-03: where not even an empty list passes, none is sent.
#[test]
fn no_list_is_sent_where_no_list_passes() {
    let cycle = three();
    let (stamp_ns, mut named) = (cycle.now_ns - 61_000_000_000, 0);
    let kept = ask(&cycle, [0; 2], |precheck, asked| {
        let mut tracks = asked.tracks.map_or_else(Vec::new, |list| list.items.to_vec());
        let kept = precheck.tracks(asked, stamp_ns, &mut tracks, |_, why| {
            assert_eq!(why.failed, FailedStage::Input);
            named += 1;
        });
        kept.map(|kept| kept.map(|it| it.left_out))
    });
    assert_eq!(kept, Ok(None));
    assert_eq!(Some(named), cycle.tracks.map(|it| it.items.len()));
}
