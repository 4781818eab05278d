//! Paths that few cycles have, where quick answers of the implementation end (`spec/hardened/H-14.md#requirements-the-path`):
//! H-14.1, H-14.7, H-14.12, H-14.13, H-14.15, H-14.39, H-14.42, H-14.51, H-14.62, H-14.64.

use crate::agreed::failed;
use crate::fail_safe::{assert_bears, too_much};
use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, DetectionList, Ego, Profile, Track, TrackList, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::{Reading, Rule};
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;
use mufasa_props::conformance::conforms;
use mufasa_props::strategy::base;
use mufasa_props::strategy::draw::Draw;

/// x, y, and the sine of the heading.
type Point = (f64, f64, f64);

/// A CAV at the origin that drives along x on a wide road, on a plan of these points, one each so many ns.
fn plan(speed: f64, [length, width]: [f64; 2], dt_ns: i64, points: &[Point]) -> Cycle {
    let draw = &mut Draw::new(&[]);
    let frame = base::Frame { x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
    let cycle = base::cycle(draw, frame, Profile::HARDENED, Configuration::PlanRemote);
    let stamp_ns = cycle.now_ns;
    let points = points.iter().zip(0..).map(|(&(x, y, sin), number)| {
        let (t_ns, cos) = (stamp_ns + number * dt_ns, (1.0 - sin * sin).sqrt());
        TrajectoryPoint { t_ns, x, y, cos, sin }
    });
    let ego = Ego { speed, length, width, center_offset: 0.0, ..cycle.ego.clone() };
    // No other stage looks at objects.
    let parameters = Parameters {
        theta_map: 2.0,
        theta_obj: 1e-3,
        safety_time: 0.0,
        work_limit: i64::MAX,
        ..Parameters::default()
    };
    let trajectory = Some(Trajectory { stamp_ns, points: points.collect() });
    let tracks = Some(TrackList { stamp_ns, items: Vec::new() });
    let detections = Some(DetectionList { stamp_ns, items: Vec::new() });
    let route = base::road(frame, 20.0);
    Cycle { ego, parameters, trajectory, tracks, detections, route, ..cycle }
}

/// The same with a small object that now is there and has this velocity.
fn with_object(cycle: &Cycle, (x, y): (f64, f64), (vx, vy): (f64, f64)) -> Cycle {
    let (stamp_ns, size) = (cycle.now_ns, 0.01);
    let track = Track { id: 1, x, y, cos: 1.0, sin: 0.0, vx, vy, length: size, width: size };
    let tracks = Some(TrackList { stamp_ns, items: vec![track] });
    Cycle { tracks, ..cycle.clone() }
}

/// H-14.62: a path that turns by 0.3 may do so 5 m ahead while it is aside, and not where it crosses the line straight on.
#[test]
fn a_path_that_crosses_the_line_straight_on() {
    let straight_on = |x: f64| (x, -0.3 / 0.91_f64.sqrt() * (x - 5.0), -0.3);
    // Up to the straight part a cubic curve.
    let (_, aside, _) = straight_on(3.6);
    let slope = -0.3 / 0.91_f64.sqrt() * 3.6;
    let curve = (0..9).map(|number| {
        let t = f64::from(number) / 9.0;
        let y = aside * t * t * (3.0 - 2.0 * t) + slope * t * t * (t - 1.0);
        let rate = (aside * 6.0 * t * (1.0 - t) + slope * t * (3.0 * t - 2.0)) / 3.6;
        (3.6 * t, y, rate / rate.hypot(1.0))
    });
    let points: Vec<Point> = curve.chain([3.6, 4.4, 5.6, 6.4].map(straight_on)).collect();
    assert_eq!(failed(&plan(10.0, [4.8, 1.9], 100_000_000, &points)), Some(Rule::Reach));
    // Less of a turn is within reach.
    let points: Vec<Point> = points.iter().map(|&(x, y, sin)| (x, 0.8 * y, 0.8 * sin)).collect();
    assert_eq!(failed(&plan(10.0, [4.8, 1.9], 100_000_000, &points)), None);
}

/// H-14.15: points that are no nodes may be no farther aside than the others.
#[test]
fn a_point_beside_the_cav_and_aside() {
    for (aside, expected) in [(0.51, Some(Rule::Reach)), (0.49, None)] {
        let points = [(0.0, aside, 0.0), (0.1, aside, 0.0)];
        assert_eq!(failed(&plan(1.0, [4.8, 1.9], 200_000_000, &points)), expected);
    }
}

/// H-14.1: whether a point is more than 1/8 m ahead is found exactly; there it turns too far to be a node (H-14.64).
#[test]
fn a_point_that_is_just_an_eighth_of_a_metre_ahead() {
    let headings = (1..40).map(|number| 1.0 - 1e-8 * f64::from(number));
    let rounded_down = |cos: f64| {
        let near = (0.125 / cos).to_bits();
        let all = (near - 2..near + 3).map(f64::from_bits);
        let mut all = all.filter(|x| x * cos <= 0.125 && x.mul_add(cos, -0.125) > 0.0);
        all.next().map(|x| (x, cos))
    };
    let (x, cos) = headings.into_iter().find_map(rounded_down).expect("a product");
    let nodes = |x: f64| {
        let points = [(0.0, 0.0, 0.0), (0.06, 0.0, 0.12), (x, 0.0, 0.26), (0.6, 0.1, 0.2)];
        let mut cycle = plan(5.0, [4.8, 1.9], 200_000_000, &points);
        cycle.ego.cos = cos;
        failed(&cycle)
    };
    assert_eq!([nodes(x), nodes(x.next_down())], [Some(Rule::Reach), None]);
}

/// A bend of 2.6 m radius, up to 35 degrees.
fn turning() -> Vec<Point> {
    let points = (0..6).map(|number| {
        let angle = 0.615 * f64::from(number) / 5.0;
        (2.6 * angle.sin(), 2.6 * (1.0 - angle.cos()), angle.sin())
    });
    points.collect()
}

/// H-14.12: before a path ends by its distance the CAV passes places on its last piece, and an object that comes later does
/// not meet it there.
#[test]
fn who_comes_late_where_a_path_ends_by_its_distance() {
    let points = turning();
    let &(x, y, sin) = points.last().expect("points");
    let (cos, speed) = ((1.0 - sin * sin).sqrt(), 10.0);
    let mut cycle = plan(10.0, [0.6, 0.5], 50_000_000, &points);
    cycle.parameters.lateral_tolerance = 3.0;
    let (mut met, mut late) = (0, 0);
    for number in 0..60_i32 {
        // From the left of the path across it.
        let (behind, after) =
            (0.3 + 0.05 * f64::from(number % 6), 0.2 + 0.04 * f64::from(number / 6));
        let way = speed * after + 0.25;
        let at = (x + behind * cos - way * sin, y + behind * sin + way * cos);
        let rule = failed(&with_object(&cycle, at, (speed * sin, -speed * cos)));
        met += u32::from(rule == Some(Rule::FailSafe));
        late += u32::from(rule.is_none());
    }
    assert!(met > 9 && late > 9, "{met} {late}");
}

/// H-14.13: with a tau of 0 and headings shorter than 1 the length where the CAV stops is below `s_tyre`, and it stands there
/// all the same.
#[test]
fn the_cav_stands_at_the_last_place() {
    let points: Vec<Point> = (0..6).map(|x| (f64::from(x), 0.0, 0.0)).collect();
    let mut cycle = plan(12.0, [4.8, 1.9], 100_000_000, &points);
    (cycle.parameters.tau, cycle.parameters.a_b) = (0.0, 12.0);
    for point in &mut cycle.trajectory.as_mut().expect("set").points {
        point.cos = 1.0 - 4e-7;
    }
    let after = |seconds: f64| failed(&with_object(&cycle, (8.3, 5.0 * seconds), (0.0, -5.0)));
    assert_eq!([2.0, 4.0].map(after), [Some(Rule::FailSafe), None]);
}

/// H-14.39: a route that turns back has both ends abreast. The CAV stands there, on the lines through both, and a car that
/// comes from behind keeps beside no path.
#[test]
fn abreast_of_both_ends_of_a_route() {
    let section =
        |x: f64, y: f64, left: [f64; 2], right: [f64; 2]| CrossSection { x, y, left, right };
    let turning_back = vec![
        section(0.0, -20.0, [0.0, -28.0], [0.0, -12.0]),
        section(-400.0, -20.0, [-400.0, -28.0], [-400.0, -12.0]),
        section(-400.0, -8.0, [-400.0, 5.0], [-400.0, -12.0]),
        section(0.0, -8.0, [20.0, 5.0], [20.0, -12.0]),
    ];
    let mut cycle = plan(0.0, [2.0, 2.0], 200_000_000, &[(0.0, -0.4, 0.0)]);
    (cycle.parameters.tau, cycle.parameters.theta_map) = (0.0, 10.0);
    cycle.route.cross_sections = turning_back;
    let car = |cycle: &Cycle| failed(&with_object(cycle, (-75.0, -7.0), (20.0, 1.547)));
    assert_eq!(car(&cycle), Some(Rule::FailSafe));
    // A route that goes on for 30 m has room beside it.
    for section in &mut cycle.route.cross_sections {
        section.x += if section.x < 0.0 { 0.0 } else { 30.0 };
    }
    assert_eq!(car(&cycle), None);
}

/// H-14.42: where a CAV of 0.1 m in width is aside of its plan within 1/8 m, its first places leave room between them, in
/// which no object keeps beside the path.
#[test]
fn between_two_places_of_a_narrow_cav() {
    for side in [1.0, -1.0] {
        let slide = (0..226).map(|number| (5e-4 * f64::from(number), 2e-3 * f64::from(number)));
        let on = [(0.2, 0.45), (1.0, 0.45), (2.0, 0.45)];
        let points: Vec<Point> = slide.chain(on).map(|(x, y)| (x, side * y, 0.0)).collect();
        let mut cycle = plan(5.0, [4.0, 0.1], 200_000_000, &points);
        for section in &mut cycle.route.cross_sections {
            section.y -= 3.0;
        }
        cycle.parameters.theta_map = 5.0;
        let drifting =
            |y: f64| failed(&with_object(&cycle, (-10.0, side * y), (10.0, 0.27 * side)));
        assert_eq!([0.1125, 0.16, 0.175].map(drifting), [Some(Rule::FailSafe); 3], "{side}");
    }
}

/// H-14.7: a node whose progress is `s_stop` exactly, which has more digits than two doubles, does not end the list: the
/// path leads aside from there, to a post. The implementation, which cannot tell, counts a place more before it.
#[test]
fn a_path_that_leads_aside_where_the_cav_stops() {
    // tau^2 is both the progress of the node and `s_stop`.
    let tau = 1.0 + 1e-7;
    let points = |x: f64| {
        let aside = [(x, 0.0, 0.4), (0.99, 0.8, 0.4)];
        let points = [(0.0, 0.0, 0.0), (0.5, 0.0, 0.05), (0.8, 0.0, 0.2)];
        let mut cycle = plan(0.0, [4.8, 1.9], 200_000_000, &[&points[..], &aside].concat());
        let parameters = &mut cycle.parameters;
        parameters.lateral_tolerance = 1.0;
        (parameters.tau, parameters.a_max, parameters.a_b) = (tau, 1.0, 1.0);
        cycle.ego.cos = tau;
        let cycle = with_object(&cycle, (1.0, 1.6), (0.0, 0.0));
        let [exact, strict] = [Reading::Exact, Reading::Strict].map(|it| check(&cycle, it));
        assert_eq!(conforms(&exact, &strict, &check_impl(&cycle)), Ok(()));
        exact.expect("valid").witness().map(|it| it.rule)
    };
    assert_eq!([tau, tau + 1e-3].map(points), [Some(Rule::FailSafe), None]);
}

/// H-14.51, H-14.55: objects just so far to each side of a path that turns that they do not come near it take no more than
/// two motions' work.
#[test]
fn objects_that_do_not_come_near_a_path_that_turns() {
    let mut cycle = plan(10.0, [12.0, 2.55], 50_000_000, &turning());
    cycle.parameters.lateral_tolerance = 3.0;
    let bears = |at: (f64, f64)| {
        let mut cycle = with_object(&cycle, at, (0.0, 0.0));
        cycle.parameters.work_limit = 0;
        let is_far = too_much(&cycle).is_none_or(|work| work <= 320);
        if is_far {
            assert_bears(cycle);
        }
        is_far
    };
    // A place on each side, and where the first one is that is not near.
    let beside = |at: &dyn Fn(f64) -> (f64, f64)| {
        let (mut near, mut far) = (0.0, 40.0);
        while far - near > 1e-3 {
            let middle = f64::midpoint(near, far);
            let side = if bears(at(middle)) { &mut far } else { &mut near };
            *side = middle;
        }
        far
    };
    let left = beside(&|y| (3.0, y));
    let right = beside(&|y| (3.0, -y));
    let ahead = beside(&|x| (x, 0.0));
    let behind = beside(&|x| (-x, 0.0));
    for number in 0..=40 {
        let share = f64::from(number) / 40.0;
        let (x, y) = (share * (ahead + behind) - behind, share * (left + right) - right);
        assert!([(x, left), (x, -right), (ahead, y), (-behind, y)].into_iter().all(bears));
    }
}
