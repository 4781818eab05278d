//! H-14 of the implementation against the exact model (`spec/hardened/H-14.md`): H-14.8, H-14.41,
//! SEEN-05, SEEN-14.

use crate::agreed::{failed, reports};
use mufasa::cycle::ValidCycle;
use mufasa::input::cycle::Cycle as ImplCycle;
use mufasa::input::profile::HardenedRule;
use mufasa::input::scratch::Scratch;
use mufasa::report as twin;
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    Cycle, DetectionList, Ego, Lead, Profile, Track, TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::profile::HardenedRule as ModelRule;
use mufasa_model::report::{Reading, Rule};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::with_impl;
use mufasa_props::differential::{agree, cases, conforming, hold, near_threshold};
use mufasa_props::strategy::base::Frame;
use mufasa_props::strategy::draw::Draw;
use mufasa_props::strategy::track_validation::{detection, track};
use mufasa_props::strategy::{base, fail_safe, seen};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

#[test]
fn hardened() {
    agree("H-14", Profile::HARDENED, fail_safe::cycle, near_threshold)
        .assert_aimed(&["iv", "safe"]);
}

/// A track whose word counts, or not, by one term of `spec/hardened/what-the-cav-saw.md`.
#[test]
fn what_the_cav_saw() {
    let tally = agree("what the CAV saw", Profile::HARDENED, seen::cycle, near_threshold);
    assert!(["iv", "safe"].iter().all(|verdict| 4 * tally.count(verdict) > tally.cases), "{tally}");
}

/// H-14.52, MARGIN-09: the limit is what the strict model counts, which an implementation has to bear, or less
/// by one.
#[test]
fn limited() {
    let (title, profile) = ("H-14, limited", Profile::HARDENED);
    let tally = hold(cases() / 4, title, profile, limited_cycle, near_threshold, conforming);
    assert!(10 * tally.undecided > tally.cases, "the limit decides: {tally}");
    tally.assert_aimed(&["iv", "safe"]);
}

fn limited_cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = fail_safe::cycle(draw, profile);
    cycle.parameters.work_limit = i64::MAX;
    if check(&cycle, Reading::Strict).is_err() {
        return cycle;
    }
    // Pairs are counted first, and then the motions with them.
    cycle.parameters.work_limit = 0;
    while let Some(steps) = too_much(&cycle) {
        cycle.parameters.work_limit = steps;
    }
    cycle.parameters.work_limit -= i64::from(draw.one_in(2));
    cycle.parameters.work_limit = cycle.parameters.work_limit.max(0);
    cycle
}

/// The steps that are too many for the strict model, if they are.
pub fn too_much(cycle: &Cycle) -> Option<i64> {
    let report = check(cycle, Reading::Strict).expect("valid");
    let witness = report.witness().filter(|witness| witness.rule == Rule::WorkLimit)?;
    witness.compared[0].to_string().parse().ok()
}

/// H-14.67, H-14.68, MARGIN-01: a node, or a point that is none, is about 1/8 m behind one before it.
#[test]
fn going_back() {
    let (title, profile) = ("H-14, going back", Profile::HARDENED);
    let tally = hold(cases() / 4, title, profile, leads_back, near_threshold, conforming);
    tally.assert_aimed(&["ii", "no_obstacle_check"]);
}

fn leads_back(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let far = if draw.one_in(2) { draw.range(0.2, 2.0) } else { draw.range(0.0, 0.12) };
    let behind = draw.near(far - 0.125);
    let ahead = [(0, 0.0), (200_000_000, far), (25_000_000_000, behind), (26_000_000_000, behind)];
    leads(draw, profile, 3.0, &ahead.map(|(after_ns, f)| (after_ns, [f, 0.0])))
}

/// H-14.68, MARGIN-01: the path goes aside, to about the bound of distance and back to about s_stop; or it goes farther
/// ahead, and comes back at about the bound, backwards or forwards.
#[test]
fn coming_back() {
    let (title, profile) = ("H-14, coming back", Profile::HARDENED.without(ModelRule::H11));
    let tally = hold(cases() / 4, title, profile, comes_back, near_threshold, conforming);
    tally.assert_aimed(&["ii", "no_obstacle_check"]);
}

fn comes_back(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let far = if draw.one_in(2) { draw.near(0.0) } else { draw.range(-0.2, 2.0) };
    let near = if draw.one_in(2) { draw.near(0.0) } else { draw.range(-0.5, 0.2) };
    let shape = draw.below(4);
    let mut cycle = leads(draw, profile, 30.0, &[]);
    cycle.ego.speed = 8.0;
    let parameters = &mut cycle.parameters;
    (parameters.a_b, parameters.a_max, parameters.tau) = (8.0, 2.0, 0.25);
    // Its times run ahead of the CAV.
    (parameters.start_tolerance, parameters.lateral_tolerance) = (100.0, 0.5);
    let (s_stop, bound) = (6.578_125, 7.578_125);
    let at = |f: f64, distance: f64| [f, (distance * distance - f * f).sqrt()];
    let way = match shape {
        0 => {
            let y = bound + near;
            vec![[0.0, 0.0], [9.6, 0.0], [9.6, 20.0], [-5.0, 20.0], [-5.0, y], [12.0, y]]
        }
        1 => vec![[0.0, 0.0], [9.6, 0.0], [9.6, bound + far], at(3.0, bound + near)],
        _ => vec![
            [0.0, 0.0],
            [2.6, 0.6],
            at(6.0, s_stop),
            at(6.0, bound + far),
            at(6.0, s_stop + near),
        ],
    };
    let way: Vec<(i64, [f64; 2])> = (0..).map(|k| 200_000_000 * k).zip(way).collect();
    cycle.trajectory = Some(plan(&cycle, &way));
    cycle
}

/// A plan through points ahead and to the left, each at its time after now, on a road of that half width.
fn leads(
    draw: &mut Draw<'_>,
    profile: Profile,
    half_width: f64,
    points: &[(i64, [f64; 2])],
) -> Cycle {
    let frame = base::frame(draw);
    let mut cycle = base::cycle(draw, frame, profile, Configuration::PlanRemote);
    cycle.parameters.step_max_ns = 60_000_000_000;
    cycle.route = base::road_to(frame, half_width, 120.0);
    cycle.trajectory = Some(plan(&cycle, points));
    cycle
}

/// All with the CAV's heading.
pub fn plan(cycle: &Cycle, points: &[(i64, [f64; 2])]) -> Trajectory {
    let Ego { x, y, cos, sin, .. } = cycle.ego;
    let frame = Frame { x, y, cos, sin };
    let point = |&(after_ns, [f, left]): &(i64, [f64; 2])| {
        let (x, y) = frame.at(f, left);
        TrajectoryPoint { t_ns: cycle.now_ns + after_ns, x, y, cos, sin }
    };
    Trajectory { stamp_ns: cycle.now_ns, points: points.iter().map(point).collect() }
}

/// H-14.42: a path that may have thousands of places.
#[test]
fn beside_a_path_that_may_have_thousands_of_places() {
    let (mut rng, mut safe, mut unsafe_) = (ChaCha8Rng::seed_from_u64(0), 0, 0);
    for _ in 0..60 {
        let tape: Vec<u32> = (0..200).map(|_| rng.random()).collect();
        let cycle = fail_safe::beside_many_points(&mut Draw::new(&tape), Profile::HARDENED);
        let rule = failed(&cycle);
        if cycle.trajectory.is_none_or(|it| it.points.len() < 1000) {
            continue;
        }
        safe += u32::from(rule.is_none());
        unsafe_ += u32::from(rule == Some(Rule::FailSafe));
    }
    assert!(safe > 20 && unsafe_ > 8, "{safe} {unsafe_}");
}

/// H-14.51: twenty detections without a track may come from the own origin of a confirmed track, or not. An implementation
/// asks each of them twice, and looks through a list of 1500 items each time.
#[test]
fn an_origin_that_many_may_come_from() {
    let (frame, mut cycle) = planned();
    let list = lists(frame, cycle.now_ns);
    let behind = (0..20).map(|k| (-10.0 + 0.1 * f64::from(k), 0.0));
    let seen = list(0, [(-30.0, 0.0)].into_iter().chain(behind).collect());
    let elsewhere = std::iter::repeat_n((-100.0, 50.0), 1499);
    let of_300_ms = list(300, [(-36.0, 0.0)].into_iter().chain(elsewhere).collect());
    cycle.detection_history = vec![of_300_ms, list(500, vec![(-40.0, 0.0)])];
    let (vx, vy) = frame.turn((20.0, 0.0));
    let items = vec![Track { vx, vy, ..track(frame, (-30.0, 0.0), 1) }];
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items });
    cycle.detections = Some(seen);
    assert_bears(cycle);
}

/// H-14.51, H-14.63: a person stood, and twenty items of 500 ms ago are near, from none of which the person comes. An
/// implementation asks twice of each, since from there the person would come to where the CAV drives.
#[test]
fn items_that_are_not_taken() {
    let (frame, mut cycle) = planned();
    let list = lists(frame, cycle.now_ns);
    let person = (4.0, -5.0);
    let near = (0..20).map(|k| (4.0, -6.5 + 0.001 * f64::from(k)));
    let of_500_ms = list(500, std::iter::once(person).chain(near).collect());
    cycle.detection_history = vec![list(250, vec![person]), of_500_ms];
    cycle.detections = Some(list(0, vec![person]));
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items: vec![track(frame, person, 1)] });
    assert_bears(cycle);
}

/// MARGIN-12, H-14.46: a track as fast as `v_object` is too close to call, and nothing is between the CAV and the lead. In a
/// cycle the gap is told; the stage alone tells what is too close to call, of H-14 only.
#[test]
fn what_is_too_close_to_call_is_told_before_the_gap_by_the_stage_alone() {
    let (frame, mut cycle) = planned();
    let (seen, list) = ((30.0, 40.0), lists(frame, cycle.now_ns));
    cycle.detection_history = [300, 500].map(|ms| list(ms, vec![seen])).to_vec();
    cycle.detections = Some(list(0, vec![seen]));
    let vx = cycle.parameters.v_object;
    let items = vec![Track { vx, ..track(frame, seen, 1) }];
    cycle.tracks = Some(TrackList { stamp_ns: cycle.now_ns, items });
    assert_eq!(rules_of_iv(&cycle), [twin::Rule::Ambiguous, twin::Rule::Ambiguous].map(Some));
    cycle.lead = Some(Lead { stamp_ns: cycle.now_ns, gap: 0.0, speed: 0.0 });
    assert_eq!(rules_of_iv(&cycle), [twin::Rule::Gap, twin::Rule::Ambiguous].map(Some));
    with_impl(&cycle, |cycle, scratch| {
        let profile = cycle.profile.without(HardenedRule::H14);
        let cycle = ImplCycle { profile, ..*cycle };
        assert_eq!(rule_of_iv_alone(&cycle, scratch), Some(twin::Rule::Gap));
        let cycle = ImplCycle { lead: None, ..cycle };
        assert_eq!(rule_of_iv_alone(&cycle, scratch), None);
    });
}

/// The rule by which stage iv fails, in the cycle and alone.
fn rules_of_iv(cycle: &Cycle) -> [Option<twin::Rule>; 2] {
    with_impl(cycle, |cycle, scratch| {
        let report = mufasa::cycle::check(cycle, scratch).expect("valid");
        let [.., iv, _] = report.stages;
        [rule(iv), rule_of_iv_alone(cycle, scratch)]
    })
}

fn rule_of_iv_alone(cycle: &ImplCycle<'_>, scratch: &mut Scratch<'_>) -> Option<twin::Rule> {
    let valid = ValidCycle::new(cycle, None, scratch).expect("valid");
    rule(valid.stage(twin::Stage::Iv, scratch))
}

fn rule(outcome: twin::Outcome) -> Option<twin::Rule> {
    if let twin::Outcome::Failed(witness) = outcome { Some(witness.rule) } else { None }
}

/// A cycle of `PlanRemote`, and where it is.
fn planned() -> (Frame, Cycle) {
    let draw = &mut Draw::new(&[]);
    let frame = base::frame(draw);
    (frame, base::cycle(draw, frame, Profile::HARDENED, Configuration::PlanRemote))
}

/// Detections at these places so many ms ago.
fn lists(frame: Frame, now_ns: i64) -> impl Fn(i64, Vec<(f64, f64)>) -> DetectionList {
    move |ms, places| DetectionList {
        stamp_ns: now_ns - ms * 1_000_000,
        items: places.into_iter().map(|place| detection(frame, place)).collect(),
    }
}

/// With the least limit that the strict model bears the implementation conforms, and both find the cycle safe.
pub fn assert_bears(mut cycle: Cycle) {
    cycle.parameters.work_limit = 0;
    while let Some(steps) = too_much(&cycle) {
        cycle.parameters.work_limit = steps;
    }
    let [_, strict] = reports(&cycle);
    assert_eq!(strict.failed_stage, None);
}

/// The cycle with the CAV's heading turned by the angle of this sine.
fn turned(cycle: &Cycle, sin: f64) -> Cycle {
    let mut cycle = cycle.clone();
    let ego = &mut cycle.ego;
    let cos = (1.0 - sin * sin).sqrt();
    (ego.cos, ego.sin) = (ego.cos * cos - ego.sin * sin, ego.sin * cos + ego.cos * sin);
    cycle
}

/// H-14.41: who keeps beside does so up to a heading of the CAV, which is found to 10^-12. The implementation
/// asks few places all at once, and each of many by itself.
#[test]
fn a_path_that_bends_as_much_as_it_may() {
    let is_safe = |cycle: &Cycle| reports(cycle)[0].failed_stage.is_none();
    let (mut rng, mut few, mut many) = (ChaCha8Rng::seed_from_u64(0), 0, 0);
    let beside = fail_safe::AIMS.iter().position(|(name, _)| *name == "beside").expect("an aim");
    for case in 0..200 {
        let tape: Vec<u32> = (0..200).map(|_| rng.random()).collect();
        let draw = &mut Draw::new(&tape);
        let sign = if case % 4 < 2 { 1.0 } else { -1.0 };
        if case % 2 == 0 {
            let cycle = fail_safe::beside_many_points(draw, Profile::HARDENED);
            let differs = is_safe(&cycle) && !is_safe(&turned(&cycle, 0.09 * sign));
            many += u32::from(differs);
            continue;
        }
        let cycle = fail_safe::aimed(draw, Profile::HARDENED, beside);
        let (mut least, mut most) = (0.0_f64, 0.12);
        if !is_safe(&cycle) || is_safe(&turned(&cycle, most * sign)) {
            continue;
        }
        while most - least > 1e-12 {
            let middle = f64::midpoint(least, most);
            let side = if is_safe(&turned(&cycle, middle * sign)) { &mut least } else { &mut most };
            *side = middle;
        }
        few += u32::from((0.05..0.12).contains(&most));
    }
    assert!(few > 4 && many > 2, "{few} {many}");
}
