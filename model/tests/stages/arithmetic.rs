//! `spec/4-arithmetic.md`: exactness, the strict and the lax reading, margin by margin.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Profile, Track, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::input::profile::HardenedRule;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::base::*;
use crate::near::*;

/// DOM-02, I-12: defaults are the doubles nearest to the decimals of spec/.
#[test]
fn defaults_are_the_nearest_doubles() {
    let text = include_str!("../../../spec/3-stages.md");
    let after = |name: &str| {
        let (_, rest) = text.split_once(&format!(" {name} = ")).expect(name);
        let end = rest.find(|c: char| !".,".contains(c) && !c.is_ascii_digit());
        rest[..end.expect("a number ends")].trim_end_matches(['.', ',']).replace(',', "")
    };
    let (_, margin) = include_str!("../../../spec/4-arithmetic.md")
        .split_once("delta (default ")
        .expect("the margin has a default");
    let margin = margin.split(')').next().expect("a text");
    for (name, default) in defaults() {
        let written = match name.strip_suffix("_ns") {
            Some(name) => after(name) + "000000",
            None if name == "delta" => margin.to_owned(),
            None => after(name),
        };
        let [written, default] = [written, default].map(|it| it.parse::<f64>().expect(name));
        assert_eq!(written.to_bits(), default.to_bits(), "{name}");
    }
}

macro_rules! all_defaults {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Shortest decimals that give the double again.
        fn defaults() -> Vec<(&'static str, String)> {
            let parameters = Parameters::default();
            vec![$((stringify!($name), parameters.$name.to_string())),*]
        }
    };
}

mufasa_model::parameters!(all_defaults);

/// DOM-03, DOM-04: directions are used as given, not normalised.
#[test]
fn directions_are_used_as_given() {
    let with = |cos: f64| {
        let mut cycle = base(Profile::PAPER, PlanRemote);
        cycle.ego.speed = 0.0;
        cycle.trajectory.as_mut().expect("there is one").points[0].cos = cos;
        cycle.tracks = tracks(vec![track(1, 4.0 + 5e-7, 0.0)]);
        cycle
    };
    assert!(check(&with(1.0), Reading::Exact).expect("valid").failed_stage.is_none());
    assert!(check(&with(1.000_000_4), Reading::Exact).expect("valid").failed_stage.is_some());
}

/// EXACT-01, EXACT-02, EXACT-03, EXACT-04,
/// EXACT-05: far from the origin, where doubles are 2^-29 m apart,
/// a difference of one of them decides.
#[test]
fn the_last_bit_decides_far_away() {
    let east = 16_777_000.0;
    let with = |y: f64| {
        let mut cycle = base(Profile::PAPER, MotRemote);
        cycle.parameters.theta_tr = 0.25;
        cycle.ego.x += east;
        cycle.trajectory = None;
        cycle.tracks = tracks(vec![track(1, east + 60.0, 0.0)]);
        cycle.detections = detections(vec![detection(east + 60.0, y)]);
        cycle
    };
    assert_eq!(safe(&with(0.25)), NEAR_UNSAFE);
    assert_eq!(safe(&with(0.25f64.next_down())), NEAR_SAFE);
}

const NEAR: &[Near] = &[
    ("mean < theta_tr - m", MotRemote, Profile::PAPER, |c, e| {
        list(c).items[0].y = 0.2 + e;
    }),
    ("matched distance < theta_track_max - m", MotRemote, Profile::HARDENED, |c, e| {
        c.parameters.theta_tr = 100.0;
        list(c).items[0].y = 1.0 + e;
    }),
    ("square in the corridor", PlanRemote, Profile::HARDENED.without(HardenedRule::H14), |c, e| {
        narrow(c, 0.25);
        points(c).iter_mut().for_each(|point| point.y = 0.25 + e);
    }),
    ("arc length <= s + m", PlanRemote, Profile::PAPER, |c, e| {
        // s_CAV = 18 m; the point that is about there touches the car, the one before does not.
        points(c)[18].x = 18.0 - e;
        c.tracks = tracks(vec![track(1, 21.999, 0.0)]);
    }),
    ("gap <= s_follow + m", MotRemote, Profile::PAPER, |c, e| {
        c.parameters.safety_time = 1.5;
        c.lead = lead(15.0 - e, 10.0);
    }),
    ("gap <= s_react + m", PlanRemote, Profile::HARDENED, |c, e| {
        // s_stop = 2.5 + 3/32 + 10.75^2 / 16, and s_tyre(5.75) = 1.4375.
        c.parameters.tau = 0.25;
        c.lead = lead(9.816_406_25 - 1.4375 - e, 5.75);
    }),
    ("half length of the CAV + m", PlanRemote, Profile::PAPER, |c, e| {
        c.ego.speed = 0.0;
        c.tracks = tracks(vec![track(1, 4.0 - e, 0.0)]);
    }),
    ("half width of the CAV + m", PlanRemote, Profile::PAPER, |c, e| {
        c.ego.speed = 0.0;
        c.tracks = tracks(vec![track(1, 0.0, 2.0 - e)]);
    }),
    ("centre distance < theta_obj + m", PlanRemote, Profile::PAPER, |c, e| {
        c.ego.speed = 0.0;
        c.tracks = tracks(vec![Track { length: 12.0, ..track(1, 5.0 - e, 0.0) }]);
    }),
    ("disk radius r + m, hardened", MotRemote, Profile::HARDENED, |c, e| {
        (c.ego.length, c.ego.width) = (24.0, 8.0);
        mark(&mut c.grid.as_mut().expect("there is a grid").occupied, 3.5, 5.5);
        c.grid.as_mut().expect("there is a grid").y -= e;
    }),
    ("half width of the CAV at a cell + m", PlanRemote, Profile::HARDENED, |c, e| {
        // The cell begins at y = 1, and disks reach it.
        mark(&mut c.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
        c.tracks = None;
        c.ego.width = 2.0 + 2.0 * e;
    }),
    ("disk centre in a marked cell", MotRemote, Profile::PAPER, |c, e| {
        mark(&mut c.grid.as_mut().expect("there is a grid").occupied, 3.5, 1.5);
        for point in points(c) {
            point.y = e;
        }
    }),
    ("heading . route segment >= m", PlanRemote, Profile::HARDENED, |c, e| {
        c.route.cross_sections = [-0.5, 0.5]
            .map(|x| CrossSection { x, y: 0.0, left: [x, 9.0], right: [x, -9.0] })
            .into();
        c.ego.speed = 0.0;
        c.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![at_time(0, 0.0, 0.0)] });
        (points(c)[0].cos, points(c)[0].sin) = (-e, 1.0);
        (c.ego.cos, c.ego.sin) = (0.0, 1.0);
    }),
];

const NEAR_THETA_MAP: Near =
    ("distance to the reference path > theta_map - m", PlanRemote, Profile::PAPER, |c, e| {
        narrow(c, 0.125);
        c.parameters.theta_map = 0.25;
        points(c)[9].y = 0.25 + e;
    });

fn list(cycle: &mut Cycle) -> &mut mufasa_model::input::cycle::DetectionList {
    // A second detection keeps the track in view.
    cycle.detections = detections(vec![detection(60.0, 0.0), detection(-90.0, 0.0)]);
    cycle.detections.as_mut().expect("set")
}

fn narrow(cycle: &mut Cycle, half_width: f64) {
    for cross_section in &mut cycle.route.cross_sections {
        (cross_section.left[1], cross_section.right[1]) = (half_width, -half_width);
    }
}

/// Strict and lax move each comparison by the margin, strictly that of theta_map by 10^-5 m at least.
/// MARGIN-01, MARGIN-05, MARGIN-06.
#[test]
fn margins_move_each_comparison() {
    margins_move(NEAR);
    margins_move_strictly(&[NEAR_THETA_MAP], 1e-5);
}

/// Strictly heading . g >= 10^-14 (abs(g_x) + abs(g_y)), where that is more than m.
/// MARGIN-01.
#[test]
fn the_heading_across_a_long_segment_is_not_sure() {
    // A heading across g = (2^24, -2^24), but for `along`.
    let with = |along: f64| {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
        cycle.parameters.delta = 1e-8;
        let far = f64::from(1 << 23);
        let at = |x: f64| [x, -x, x + 9.0, 9.0 - x, x - 9.0, -x - 9.0];
        cycle.route.cross_sections = [-far, far]
            .map(at)
            .map(|[x, y, a, b, c, d]| CrossSection { x, y, left: [a, b], right: [c, d] })
            .into();
        let half = 0.5f64.sqrt();
        (cycle.ego.speed, cycle.ego.cos, cycle.ego.sin) = (0.0, half + along, half);
        let point = TrajectoryPoint { cos: half + along, sin: half, ..at_time(0, 0.0, 0.0) };
        cycle.trajectory = Some(Trajectory { stamp_ns: NOW, points: vec![point] });
        safe(&cycle)
    };
    assert_eq!([2.2e-14, 1.8e-14, 0.0].map(with), [YES, NEAR_SAFE, NEAR_SAFE]);
    assert_eq!([-2e-16, -1e-15].map(with), [NEAR_UNSAFE, NO]);
}

/// MARGIN-07: a track on the edge of the field of view counts both
/// ways; with more than six of them strict rejects and lax accepts.
#[test]
fn tracks_on_the_edge_count_both_ways() {
    let with = |offset: f64, ghosts: i64| {
        let mut cycle = base(Profile::PAPER, MotRemote);
        // r = 90 m; the ghosts are as far, and nowhere near a detection.
        cycle.detections = detections(vec![detection(60.0, 0.0), detection(-90.0, 0.0)]);
        let ghost = |i: i64| {
            let angle = f64::from(i32::try_from(i).expect("small")) / 10.0;
            track(100 + i, (90.0 + offset) * angle.cos(), (90.0 + offset) * angle.sin())
        };
        cycle.tracks = tracks((1..=ghosts).map(ghost).collect());
        cycle
    };
    assert_eq!(safe(&with(3e-6, 1)), YES);
    assert_eq!(safe(&with(0.5e-6, 1)), NEAR_SAFE);
    assert_eq!(safe(&with(-0.5e-6, 1)), NEAR_UNSAFE);
    assert_eq!(safe(&with(-3e-6, 1)), NO);
    assert_eq!(safe(&with(-0.5e-6, 6)), NEAR_UNSAFE);
    assert_eq!(safe(&with(-0.5e-6, 7)), NEAR_UNSAFE);
    // Seven that would all be matched: no choice fails, but strict does not try.
    let mut seven = with(0.0, 7);
    let items = seven.tracks.as_ref().expect("set").items.clone();
    let seen = |track: &Track| detection(track.x, track.y);
    seven.detections.as_mut().expect("set").items.extend(items.iter().map(seen));
    assert_eq!(safe(&seven), NEAR_SAFE);
    let mut six = seven;
    six.tracks.as_mut().expect("set").items.pop();
    assert_eq!(safe(&six), YES);
}

/// Strict asks every segment that may be the nearest, by the greater of delta and 10^-5 m, lax some.
#[test]
fn nearest_segments_within_delta_are_asked() {
    let with = |delta: f64, y: f64| {
        let mut cycle = base(Profile::HARDENED, PlanRemote);
        cycle.parameters.delta = delta;
        // Two parallel ways, 2 m apart, the second against the first.
        let cross_section =
            |x: f64, y: f64| CrossSection { x, y, left: [x, 90.0], right: [x, -90.0] };
        cycle.route.cross_sections = vec![
            cross_section(-300.0, -1.0),
            cross_section(300.0, -1.0),
            cross_section(300.0, 1.0),
            cross_section(-300.0, 1.0),
        ];
        for point in points(&mut cycle) {
            point.y = y;
        }
        safe(&cycle)
    };
    for (delta, near) in [(1e-6, 1e-5), (1e-3, 1e-3)] {
        assert_eq!(with(delta, -near), YES);
        assert_eq!(with(delta, -0.25 * near), NEAR_SAFE);
        assert_eq!(with(delta, 0.0), NEAR_SAFE);
        assert_eq!(with(delta, 0.25 * near), NEAR_UNSAFE);
        assert_eq!(with(delta, near), NO);
    }
}

/// "a step of length 0 passes in every model"
#[test]
fn a_step_of_length_zero_passes_in_every_reading() {
    let mut cycle = base(Profile::HARDENED, PlanRemote);
    two_points(&mut cycle, 100, [0.0, 0.0]);
    assert_eq!(safe(&cycle), YES);
}

/// Counts, ages and times never move. MARGIN-13.
#[test]
fn ages_never_move() {
    let mut cycle = base(Profile::HARDENED, AllRemote);
    for point in points(&mut cycle) {
        point.t_ns += 100_000_000;
    }
    assert_eq!(safe(&cycle), YES);
    for point in points(&mut cycle) {
        point.t_ns += 1;
    }
    assert_eq!(safe(&cycle), NO);
}

/// MARGIN-08: two gated tracks and three detections are 2^2 * 3 steps, with
/// one more column for a backed track that may be left out 2^2 * 4; a limit below fails the strict
/// reading alone, and nothing where no track has to be assigned.
/// S1-07, H-01.5.
#[test]
fn work_above_the_limit_fails_the_strict_reading() {
    let with = |profile, work_limit, miss_budget, backed: &[[f64; 4]]| {
        let mut cycle = base(profile, MotRemote);
        (cycle.parameters.work_limit, cycle.parameters.miss_budget) = (work_limit, miss_budget);
        cycle.trajectory = None;
        cycle.tracks = tracks(vec![track(1, 20.0, 9.0), track(2, 40.0, 9.0)]);
        let items = vec![detection(20.0, 9.0), detection(40.0, 9.0), detection(60.0, 9.0)];
        cycle.detections = detections(items);
        cycle.detection_history = history(backed);
        safe(&cycle)
    };
    let [one, two] = [[20.0, 9.0, 0.0, 0.0], [40.0, 9.0, 0.0, 0.0]];
    for profile in [Profile::PAPER, Profile::HARDENED] {
        assert_eq!(with(profile, 12, 0, &[one, two]), YES, "{profile:?}");
        assert_eq!(with(profile, 11, 0, &[one, two]), NEAR_SAFE, "{profile:?}");
    }
    assert_eq!(with(Profile::HARDENED, 12, 2, &[]), YES, "none is backed");
    assert_eq!(with(Profile::HARDENED, 16, 2, &[one]), YES);
    assert_eq!(with(Profile::HARDENED, 15, 2, &[one]), NEAR_SAFE);
    assert_eq!(with(Profile::HARDENED, 16, 1, &[one, two]), YES);
    assert_eq!(with(Profile::HARDENED, 15, 1, &[one, two]), NEAR_SAFE);
    assert_eq!(with(Profile::HARDENED, 0, 2, &[one, two]), YES, "all may be left out");
    let mut cycle = base(Profile::PAPER, MotRemote);
    cycle.parameters.work_limit = 0;
    cycle.tracks = tracks(Vec::new());
    assert_eq!(safe(&cycle), YES, "k = 0");
}
