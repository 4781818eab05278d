//! Assignments: the model's search against scipy's, and stage i of both against its means.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Profile, Route, Track, TrackList,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::numbers::assignment::{Costs, least_cost};
use mufasa_model::numbers::real::Real;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;
use serde_json::Value;

/// Most tracks of a list that the exact model is asked about: more take it half a minute.
const MODEL_TRACKS: usize = 50;

fn parsed(name: &str) -> Option<Vec<Value>> {
    let text = super::read(name)?;
    let value: Value = serde_json::from_str(&text).expect("the file is JSON");
    Some(value.as_array().expect("a list of cases").clone())
}

fn numbers(value: &Value) -> Vec<Option<f64>> {
    value.as_array().expect("a list of numbers").iter().map(Value::as_f64).collect()
}

fn places(value: &Value) -> Vec<(f64, f64)> {
    let place = |pair: &Value| match numbers(pair)[..] {
        [Some(x), Some(y)] => (x, y),
        _ => panic!("{pair} is not a pair of numbers"),
    };
    value.as_array().expect("a list of places").iter().map(place).collect()
}

/// The sums of scipy's own test cases, exactly; they are whole numbers.
#[test]
fn the_model_finds_the_sums_of_scipy_test_cases() {
    let Some(cases) = parsed("assignment/scipy_cases.json") else { return };
    assert!(!cases.is_empty());
    for case in cases {
        let cost = case["cost"].as_array().expect("rows");
        let costs: Costs = cost
            .iter()
            .map(|row| numbers(row).into_iter().map(|c| c.map(Real::from_double)).collect())
            .collect();
        let columns = costs[0].len();
        let pairs = costs.len().min(columns);
        let found = least_cost(&costs, pairs).expect("scipy found an assignment");
        let sum = case["sum"].as_f64().expect("a sum");
        assert!(found.cost == Real::from_double(sum), "{} is not {sum}", found.cost.to_f64());
    }
}

/// A list passes stage i with `theta_tr` just above scipy's mean and fails with one just below,
/// in the model and in the implementation.
#[test]
fn stage_i_meets_the_means_of_scipy() {
    let Some(cases) = parsed("assignment/scipy_euclidean.json") else { return };
    let mut ran = 0;
    for case in &cases {
        let (tracks, detections) = (places(&case["tracks"]), places(&case["detections"]));
        let mean = case["mean"].as_f64().expect("a mean");
        let Some(position) = position_that_gates_all(&tracks, &detections) else { continue };
        ran += 1;
        for (factor, safe) in [(1.0 + 1e-9, true), (1.0 - 1e-9, false)] {
            let mut cycle = cycle(position, &tracks, &detections);
            cycle.parameters.theta_tr = mean * factor;
            // Two of the lists are beyond the default.
            cycle.parameters.work_limit = i64::MAX;
            if tracks.len() <= MODEL_TRACKS {
                let model = check(&cycle, Reading::Exact).expect("valid input");
                assert_eq!(model.failed_stage.is_none(), safe, "model, mean {mean}");
            }
            let implementation = check_impl(&cycle).expect("valid input");
            assert_eq!(implementation.failed_stage.is_none(), safe, "implementation, {mean}");
        }
    }
    println!("{ran} of {} cases of scipy with all tracks gated", cases.len());
    assert!(2 * ran >= cases.len(), "only {ran} of {}", cases.len());
}

/// A position so far off that the farthest detection is farther than every track.
fn position_that_gates_all(tracks: &[(f64, f64)], detections: &[(f64, f64)]) -> Option<(f64, f64)> {
    (0..360).map(f64::from).find_map(|degrees| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let p = (1e6 * cos, 1e6 * sin);
        let farthest = |list: &[(f64, f64)]| {
            list.iter().map(|(x, y)| (x - p.0).hypot(y - p.1)).fold(0.0, f64::max)
        };
        (farthest(detections) > farthest(tracks) + 1e-3).then_some(p)
    })
}

fn cycle(position: (f64, f64), tracks: &[(f64, f64)], detections: &[(f64, f64)]) -> Cycle {
    let cross_section = |x| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
    let (cos, sin, length, width) = (1.0, 0.0, 4.5, 1.8);
    let track = |((x, y), id): (&(f64, f64), i64)| Track {
        id,
        x: *x,
        y: *y,
        cos,
        sin,
        vx: 0.0,
        vy: 0.0,
        length,
        width,
    };
    let detection = |(x, y): &(f64, f64)| Detection { x: *x, y: *y, cos, sin, length, width };
    Cycle {
        profile: Profile::PAPER,
        parameters: Parameters::default(),
        now_ns: 0,
        configuration: Configuration::MotRemote,
        ego: Ego {
            x: position.0,
            y: position.1,
            cos,
            sin,
            speed: 0.0,
            length,
            width,
            center_offset: 0.0,
        },
        trajectory: None,
        tracks: Some(TrackList { stamp_ns: 0, items: tracks.iter().zip(1..).map(track).collect() }),
        detections: Some(DetectionList {
            stamp_ns: 0,
            items: detections.iter().map(detection).collect(),
        }),
        lead: None,
        route: Route {
            closed: false,
            cross_sections: vec![cross_section(0.0), cross_section(10.0)],
        },
        grid: None,
        detection_history: Vec::new(),
    }
}
