//! `spec/hardened/H-14.md#requirements-reach`

use mufasa_model::cycle::check;
use mufasa_model::hardened::h14_fail_safe::path::{Place, places};
use mufasa_model::hardened::h14_fail_safe::reach::ambiguous_end_failure;
use mufasa_model::hardened::h14_fail_safe::times::Driving;
use mufasa_model::input::cycle::{CrossSection, Cycle, Profile, Trajectory, TrajectoryPoint};
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::input::scene::Scene;
use mufasa_model::numbers::real::Real;
use mufasa_model::report::{Outcome, Reading, Rule, Stage};
use mufasa_model::services::configuration::Configuration::PlanRemote;

use super::widening::{found, witness};
use crate::base::*;
use crate::near::*;

const HARDENED: Profile = Profile::HARDENED;

/// A trajectory through these poses, of which H-11 is not asked.
pub(super) fn leads(v: f64, poses: &[[f64; 4]]) -> Cycle {
    let mut cycle = base(HARDENED.without(HardenedRule::H11), PlanRemote);
    cycle.ego.speed = v;
    (cycle.parameters.tau, cycle.parameters.lateral_tolerance) = (0.0, 3.0);
    let point = |(i, [x, y, cos, sin]): (i64, &[f64; 4])| TrajectoryPoint {
        cos: *cos,
        sin: *sin,
        ..at_time(i * 500_000_000, *x, *y)
    };
    let points = (0..).zip(poses).map(point).collect();
    cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points });
    cycle
}

/// s_b(1/2) = 1/64 m, s_stop = 13/16 m, so that a length of 2.625 m is the greatest.
fn slow(poses: &[[f64; 4]]) -> Cycle {
    let mut cycle = leads(0.5, poses);
    (cycle.parameters.tau, cycle.parameters.a_max) = (1.0, 0.5);
    cycle
}

/// H-14.60, H-14.61: what is longer than 2 s_stop + 1 m fails at the place that is; the lax model has no place at s_stop.
#[test]
fn a_path_is_not_longer_than_twice_s_stop() {
    // To the left, to the right and back to the line, at most 0.71 m from p: 2.3125 m.
    let weave = |ys: &[f64]| {
        let poses = [[0.0, 0.0, 1.0, 0.0], [0.5, 0.0, 1.0, 0.0]].into_iter();
        poses.chain(ys.iter().map(|y| [0.5, *y, 1.0, 0.0])).collect::<Vec<_>>()
    };
    let aside =
        |e: f64| slow(&[weave(&[0.5, -0.40625, e]).as_slice(), &[[2.0, e, 1.0, 0.0]]].concat());
    let all = [-3e-6, -0.5e-6, 0.0, 0.5e-6, 3e-6].map(|e| safe(&aside(e)));
    assert_eq!(all, [YES, NEAR_SAFE, NEAR_SAFE, NEAR_UNSAFE, NEAR_UNSAFE]);
    let Outcome::Failed(it) = outcome(&aside(0.25), Stage::Ii) else { panic!("too long") };
    // 0, two to 0.5, nine aside, one ahead.
    let place = (Some(6 + 12), Rule::Reach, "2.8125", "2.625");
    let compared = it.compared.each_ref().map(ToString::to_string);
    assert_eq!((it.point, it.rule, compared[0].as_str(), compared[1].as_str()), place);
    // It turns off and never comes to s_stop: laxly one that ends at 2.625 m is short enough.
    let turns =
        |e: f64| slow(&[weave(&[0.5, -0.5]).as_slice(), &[[0.5, 0.125 + e, 0.96, 0.28]]].concat());
    let all = [-3e-6, -0.5e-6, 0.5e-6, 3e-6].map(|e| safe(&turns(e)));
    assert_eq!(all, [NO, NEAR_UNSAFE, NEAR_UNSAFE, NO]);
    assert_eq!(rule(&turns(0.0), Stage::Ii), Some(Rule::Reach));
}

/// H-14.60: a turn by 90 degrees with a radius of 4.5 m, less than s_stop = 4.64 m, ends by distance: not one place is
/// too long, or turned too far.
#[test]
fn a_turn_at_a_junction_is_within_reach() {
    let turn = |i: u8| {
        let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_2 / 16.0).sin_cos();
        [4.5 * sin, 4.5 * (1.0 - cos), cos, sin]
    };
    let poses: Vec<[f64; 4]> = (0..=16).map(turn).collect();
    let mut cycle = diagonal(leads(5.0, &poses));
    (cycle.parameters.tau, cycle.parameters.lateral_tolerance) = (0.4, 1.0);
    assert_eq!(safe(&cycle), YES);
    let scene = Scene::new(&cycle, Reading::Exact);
    let trajectory = scene.trajectory.as_ref().expect("it is current");
    let all: Vec<Place> = places(&scene, trajectory).collect();
    let s_stop = Driving::of(&scene).s_stop();
    let most = &s_stop + Real::from_integer(1);
    let is_far = |place: &Place| place.pose.origin.distance(&scene.ego.position) > most;
    let (last, before) = all.split_last().expect("p at least");
    assert!(is_far(last) && !before.iter().any(is_far));
    assert!(last.progress < s_stop && last.pose.direction.x > Real::from_double(0.1));
}

/// H-14.61: of both reasons at a place the witness names that it is too far aside.
#[test]
fn at_one_place_too_far_aside_comes_before_too_long() {
    // There and back 2.375 m; at 0.5 m aside it is 2.875 m long, at 0.75 m 3.125 m: s_stop is 1 m. Its excess there is
    // 0.75 m - 9/384 m.
    let to_and_fro = [0.0, 0.5, 0.0, 0.5, 0.0, 0.375].map(|x| [x, 0.0, 1.0, 0.0]);
    let poses = [to_and_fro.as_slice(), &[[0.375, 1.0, 1.0, 0.0]]].concat();
    let first = |lateral_tolerance: f64| {
        let mut cycle = leads(4.0, &poses);
        cycle.parameters.lateral_tolerance = lateral_tolerance;
        let Outcome::Failed(it) = outcome(&cycle, Stage::Ii) else { panic!("aside") };
        (it.rule, it.point, it.compared[0].to_string())
    };
    assert_eq!(first(93.0 / 128.0), (Rule::Reach, Some(7 + 13), "3.125".into()));
    assert_eq!(first(0.726_562_4), (Rule::Reach, Some(7 + 13), "0.7265625".into()));
}

/// H-14.62: an arc of 8 m passes, the same headings on a straight line do not.
/// The bound is asked at a node f ahead and d aside; the piece from there has no place but the next node.
#[test]
fn a_place_is_not_turned_farther_than_an_arc_to_it() {
    let path = |share: f64| {
        let pose = |i: u8| {
            let x = f64::from(i) / 2.0;
            let along = (64.0 - x * x).sqrt();
            [x, share * (8.0 - along), along / 8.0, x / 8.0]
        };
        leads(8.0, &[0, 1, 2, 3, 4, 5, 6, 7, 8].map(pose))
    };
    assert_eq!(safe(&path(1.0)), YES);
    let Outcome::Failed(it) = outcome(&path(0.0), Stage::Ii) else { panic!("turned") };
    let compared = it.compared[0].to_string();
    assert_eq!((it.rule, it.point, compared.as_str()), (Rule::Reach, Some(9 + 12), "1.125"));
    for (f, d, bound) in
        [(1.25, 0.0, 0.7125), (2.0, 0.0, 0.84), (2.0, 0.25, 1.34), (2.0, -0.25, 1.34)]
    {
        for side in [-1.0, 1.0] {
            let all = [-3e-6, -0.5e-6, 0.5e-6, 3e-6].map(|e| {
                let sin: f64 = (bound + e) / f;
                let turned = [f, d, (1.0 - sin * sin).sqrt(), side * sin];
                safe(&leads(8.0, &[[0.0, 0.0, 1.0, 0.0], turned, [f + 0.25, d, 1.0, 0.0]]))
            });
            assert_eq!(all, [YES, NEAR_SAFE, NEAR_UNSAFE, NO], "{f} {d} {side}");
        }
    }
}

/// On a route that leads off to the left by 45 degrees.
fn diagonal(mut cycle: Cycle) -> Cycle {
    let cross_section =
        |x: f64| CrossSection { x, y: x, left: [x - 20.0, x + 20.0], right: [x + 20.0, x - 20.0] };
    cycle.route.cross_sections = vec![cross_section(-100.0), cross_section(200.0)];
    cycle
}

/// H-14.62: h . h_k > 0, on a route that leads off to the left by 45 degrees. H-14.61 comes first.
#[test]
fn a_place_does_not_look_back() {
    let turned = |x: f64, y: f64, cos: f64, sin: f64| {
        let poses = [[0.0, 0.0, 1.0, 0.0], [x, y, cos, sin], [x + 0.25, y, 1.0, 0.0]];
        diagonal(leads(8.0, &poses))
    };
    let back = found(&turned(1.0, 0.0, -0.5, 0.75f64.sqrt()), Reading::Exact);
    assert_eq!(back, Some(witness(Rule::Reach, 3 + 4, ["-0.5", "0"])));
    let across = [-3e-6, -0.5e-6, 0.0, 0.5e-6, 3e-6];
    let all = across.map(|e: f64| safe(&turned(3.0, 1.25, -e, (1.0 - e * e).sqrt())));
    assert_eq!(all, [YES, NEAR_SAFE, NEAR_UNSAFE, NEAR_UNSAFE, NO]);
    let weave = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.5, -0.5]].map(|[x, y]| [x, y, 1.0, 0.0]);
    let long = slow(&[&weave[..], &[[0.5, 0.25, -0.6, 0.8]]].concat());
    let expected = Some(witness(Rule::Reach, 5 + 2 + 9, ["2.75", "2.625"]));
    assert_eq!(found(&diagonal(long), Reading::Exact), expected);
}

/// A trajectory through these points on the line along h, which look along it; h is along x or y.
pub(super) fn on_the_line(v: f64, [cos, sin]: [f64; 2], ways: &[f64]) -> Cycle {
    let poses: Vec<[f64; 4]> = ways.iter().map(|way| [way * cos, way * sin, cos, sin]).collect();
    let mut cycle = diagonal(leads(v, &poses));
    (cycle.ego.cos, cycle.ego.sin) = (cos, sin);
    cycle.parameters.start_tolerance = 4.0;
    cycle
}

pub(super) const ALONG_X: [f64; 2] = [1.0, 0.0];

/// What is beyond a bound by e: at the bound and exactly delta from it, and just beyond.
pub(super) fn fails_beyond(with: impl Fn(f64) -> Cycle) {
    fails_beyond_in(1.0, with);
}

/// The same; each e is a multiple of `unit` times a power of two.
pub(super) fn fails_beyond_in(unit: f64, with: impl Fn(f64) -> Cycle) {
    let (delta, more) = (unit / 1_048_576.0, unit / 1_099_511_627_776.0);
    let all = [-delta, more - delta, 0.0, more, delta, more + delta].map(|e| {
        let mut cycle = with(e);
        cycle.parameters.delta = delta;
        safe(&cycle)
    });
    assert_eq!(all, [YES, NEAR_SAFE, NEAR_SAFE, NEAR_UNSAFE, NEAR_UNSAFE, NO]);
    assert_eq!(found(&with(more), Reading::Exact).map(|it| it.0), Some(Rule::Reach));
}

/// A list of places that would end behind p by its distance: s_stop is 4 m, 5 m the farthest, and 9 m the greatest
/// length. Before the way back was asked, nothing farther ahead than 1 m was examined.
/// H-14.68, H-14.60.
#[test]
fn a_path_does_not_end_behind_the_cav() {
    let mut back = on_the_line(8.0, ALONG_X, &[0.0, 1.0, 0.0, -1.0, -2.0, -3.0, -4.0, -5.0, -6.0]);
    back.parameters.lateral_tolerance = 1.0;
    let scene = Scene::new(&back, Reading::Exact);
    let trajectory = scene.trajectory.as_ref().expect("it is current");
    let last = places(&scene, trajectory).last().expect("p at least");
    assert_eq!([last.progress, last.length], [-5.25, 7.25].map(Real::from_double));
    let expected = Some(witness(Rule::Reach, 2, ["1", "0.125"]));
    for reading in [Reading::Strict, Reading::Exact, Reading::Lax] {
        assert_eq!(found(&back, reading), expected);
    }
}

/// Each point that is no node is compared with the farthest of all before it, wherever p is; a trajectory that begins
/// behind p and comes ahead passes.
/// H-14.67, MARGIN-01.
#[test]
fn a_point_that_is_no_node_goes_back_by_at_most_an_eighth_of_a_metre() {
    let along = |ways: &[f64]| on_the_line(4.0, ALONG_X, ways);
    for comes in [&[-3.0, -2.0, -1.0, 0.0, 1.0, 2.0][..], &[-3.0], &[-3.0, 2.0], &[0.0, 0.0]] {
        assert_eq!(safe(&along(comes)), YES, "{comes:?}");
    }
    fails_beyond(|e| on_the_line(4.0, [0.0, 1.0], &[0.0, -0.125 - e, 1.5]));
    // Without a node, by and by, behind the one before and behind an earlier one.
    fails_beyond(|e| along(&[0.0, -0.125 - e]));
    fails_beyond(|e| along(&[0.0625, 0.0, -0.0625 - e, 1.5]));
    fails_beyond(|e| along(&[-3.0, -2.0, -2.0625, -2.125 - e, 0.0, 1.5]));
    fails_beyond(|e| along(&[-1.0, -1.0625, -1.03125, -1.125 - e, 0.0, 1.5]));
    let back = along(&[0.0625, 0.0, -0.125, -1.0, 1.5]);
    let expected = Some(witness(Rule::Reach, 2, ["0.1875", "0.125"]));
    assert_eq!(found(&back, Reading::Exact), expected, "the first of them");
    let path = along(&[0.0, -0.25, 0.5, -0.5, 1.5]);
    let expected = Some(witness(Rule::Reach, 1, ["0.25", "0.125"]));
    assert_eq!(found(&path, Reading::Exact), expected, "points come before ways");
}

/// H-14.67, H-14.15: at one point the excess comes first; but an earlier point comes before a later one. The excess
/// 3/4 m behind and 1 m aside is 1 m - 9/96 m.
#[test]
fn what_goes_back_comes_last_at_a_point() {
    let point = |lateral_tolerance: f64, points: &[[f64; 2]]| {
        let poses: Vec<[f64; 4]> = points.iter().map(|[x, y]| [*x, *y, 1.0, 0.0]).collect();
        let mut cycle = leads(4.0, &poses);
        cycle.parameters.lateral_tolerance = lateral_tolerance;
        found(&cycle, Reading::Exact)
    };
    let [p, behind, beside, ahead] = [[0.0, 0.0], [-0.75, 0.0], [-0.75, 1.0], [1.5, 0.0]];
    let back = Some(witness(Rule::Reach, 1, ["0.75", "0.125"]));
    let aside = Some(witness(Rule::Reach, 1, ["0.90625", "0.5"]));
    assert_eq!(point(0.5, &[p, beside, p, ahead]), aside);
    assert_eq!(point(1.0, &[p, beside, p, ahead]), back);
    assert_eq!(point(0.5, &[p, behind, beside, p, ahead]), back);
}

/// H-14.68, H-14.7: a U-turn 6 m ahead, and back to 6 m behind p, 8 m aside. An s_stop of 4 m passes; one of 36 m comes
/// to it.
#[test]
fn farther_away_a_path_leads_anywhere() {
    let turn = |radius: f64| {
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0].map(|i| {
            let (sin, cos) = (i * std::f64::consts::PI / 8.0).sin_cos();
            [6.0 + radius * sin, 4.0 - radius * cos, cos, sin]
        })
    };
    let out = [0.0, 2.0, 4.0].map(|x| [x, 0.0, 1.0, 0.0]);
    let back = [4.0, 2.0, 0.0, -2.0, -4.0, -6.0].map(|x| [x, 8.0, -1.0, 0.0]);
    let poses = [&out[..], &turn(4.0), &back].concat();
    let cross_section = |[[x, y], left, right]: [[f64; 2]; 3]| CrossSection { x, y, left, right };
    let [inner, middle, outer] =
        [1.0, 4.0, 7.0].map(|radius| turn(radius).map(|[x, y, ..]| [x, y]));
    let of_turn = (0..9).map(|i| [middle[i], inner[i], outer[i]]);
    let far = |y: f64, side: f64| [[-100.0, y], [-100.0, y + side], [-100.0, y - side]];
    let sections = [far(0.0, 3.0)].into_iter().chain(of_turn).chain([far(8.0, -3.0)]);
    let mut cycle = leads(8.0, &poses);
    cycle.route.cross_sections = sections.map(cross_section).collect();
    assert_eq!(safe(&cycle), YES);
    cycle.ego.speed = 24.0;
    assert_eq!(found(&cycle, Reading::Exact).map(|it| it.0), Some(Rule::Reach));
}

/// MARGIN-04: whether a point is 1/8 m ahead is asked of the first that is, and of
/// those before it, after `reach`.
#[test]
fn a_point_at_an_eighth_of_a_metre_is_ambiguous() {
    const DELTA: f64 = 1.0 / 1_048_576.0;
    let with = |xs: [f64; 3]| {
        let mut cycle = base(HARDENED, PlanRemote);
        (cycle.ego.speed, cycle.parameters.delta) = (0.5, DELTA);
        points(&mut cycle).truncate(3);
        for (point, x) in points(&mut cycle).iter_mut().zip(xs) {
            point.x = x;
        }
        let strict = check(&cycle, Reading::Strict).expect("valid");
        match &strict.stages[Stage::Ii as usize] {
            Outcome::Failed(it) => {
                assert_eq!(safe(&cycle), NEAR_SAFE);
                Some((it.rule, it.point))
            }
            _ => None,
        }
    };
    let ambiguous = |point| Some((Rule::Ambiguous, Some(point)));
    assert_eq!(with([0.125, 1.0, 2.0]), ambiguous(0));
    assert_eq!(with([0.125 - 0.9e-6, 1.0, 2.0]), ambiguous(0));
    assert_eq!(with([0.125 + 0.9e-6, 1.0, 2.0]), ambiguous(0));
    assert_eq!(with([0.125 - 1.1e-6, 1.0, 2.0]), None);
    assert_eq!(with([0.125 + 1.1e-6, 1.0, 2.0]), None);
    let [below, above] = [0.125 - DELTA, 0.125 + DELTA];
    assert_eq!([below, above].map(|x| with([x, 1.0, 2.0])), [ambiguous(0); 2], "exactly delta");
    let beyond = [below.next_down(), above.next_up()];
    assert_eq!(beyond.map(|x| with([x, 1.0, 2.0])), [None; 2]);
    assert_eq!(with([0.0, 0.125, 2.0]), ambiguous(1), "the point before the first");
    assert_eq!(with([0.25, 0.25, 0.25]), None);
    assert_eq!(with([0.131, 0.125, 2.0]), None, "behind the first it is a node anyway");
    assert_eq!(with([0.0, 0.1, 0.125]), ambiguous(2), "none is more than that ahead");
    let mut aside = base(HARDENED.without(HardenedRule::H11), PlanRemote);
    (points(&mut aside)[0].x, points(&mut aside)[1].y) = (0.125, 2.0);
    let strict = check(&aside, Reading::Strict).expect("valid");
    let expected = |it: &Outcome| matches!(it, Outcome::Failed(it) if it.rule == Rule::Reach);
    assert!(expected(&strict.stages[Stage::Ii as usize]), "reach comes first");
}

/// Strictly a piece with a place that ends at a progress above s_stop - M has u . h > M (abs(u_x) + abs(u_y)); this is
/// asked after MARGIN-04, and only with H-14.
/// MARGIN-19.
#[test]
fn the_path_is_not_across_at_its_end() {
    let passes = |cycle: &Cycle| {
        [Reading::Strict, Reading::Exact, Reading::Lax].map(|reading| {
            let scene = Scene::new(cycle, reading);
            let trajectory = scene.trajectory.as_ref().expect("it is current");
            ambiguous_end_failure(&scene, trajectory).is_none()
        })
    };
    // s_stop is 10.75 m: the piece from 10.75 m - `before` on leads 1/4 m aside, and by `ahead` ahead.
    let across = |before: f64, ahead: f64, side: f64| {
        let mut cycle = base(HARDENED.without(HardenedRule::H11), PlanRemote);
        (cycle.ego.speed, cycle.parameters.tau, cycle.parameters.a_max) = (8.0, 0.5, 4.0);
        let points = points(&mut cycle);
        points[10].x = 10.75 - before;
        points[11].x = points[10].x + ahead;
        points.iter_mut().skip(11).for_each(|point| point.y = side);
        cycle
    };
    for side in [0.25, -0.25] {
        let with = |before: f64, ahead: f64| passes(&across(before, ahead, side));
        assert_eq!([1.1e-4, 9e-5, 0.0].map(|it| with(it, 0.0)), [YES, NEAR_SAFE, NEAR_SAFE]);
        assert_eq!([2e-5, 3e-5].map(|it| with(1e-5, it)), [NEAR_SAFE, YES]);
        // Strictly it has places up to s_stop + m.
        assert_eq!([-0.5e-6, -2e-6].map(|it| with(it, 0.0)), [NEAR_SAFE, YES]);
    }
    // s_stop is 28.75 m: the last node looks aside.
    let turned = |before: f64| {
        let mut cycle = across(0.0, 0.25, 0.0);
        cycle.ego.speed = 16.0;
        let points = points(&mut cycle);
        points.truncate(30);
        (points[29].x, points[29].cos, points[29].sin) = (28.75 - before, 0.0, 1.0);
        passes(&cycle)
    };
    assert_eq!([1.1e-4, 9e-5].map(turned), [YES, NEAR_SAFE]);
    // A delta that is greater than 0.0001 is M.
    let mut wide = across(9e-3, 0.0, 0.25);
    assert_eq!(passes(&wide), YES);
    wide.parameters.delta = 1e-2;
    assert_eq!(passes(&wide), NEAR_SAFE);
    // In a cycle: behind p come nine pieces of four places, one of seven, and that aside.
    let mut cycle = across(1e-5, 0.0, 0.25);
    let strict = |cycle: &Cycle| {
        let report = check(cycle, Reading::Strict).expect("valid");
        match &report.stages[Stage::Ii as usize] {
            Outcome::Failed(it) => Some((it.rule, it.point?)),
            _ => None,
        }
    };
    assert_eq!(safe(&cycle), NEAR_SAFE);
    assert_eq!(strict(&cycle), Some((Rule::Ambiguous, 51 + 44)));
    cycle.profile = cycle.profile.without(HardenedRule::H14);
    assert_eq!(strict(&cycle), None);
    cycle.profile = HARDENED.without(HardenedRule::H11);
    points(&mut cycle)[0].x = 0.125;
    assert_eq!(strict(&cycle), Some((Rule::Ambiguous, 0)));
}
