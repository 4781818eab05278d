//! What is compared, and what a margin or the rounding of a norm explains.

use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration;

use super::*;
use crate::cases::generate::Generator;

/// A cycle with a valid ego.
fn valid() -> Cycle {
    let generator = Generator { seed: 0, profile: Profile::PAPER, kinds: vec![Kind::Cycle] };
    let cycles = (0..100).filter_map(|case| match generator.question(case) {
        Question::Cycle(cycle) => Some(*cycle),
        _ => None,
    });
    cycles.into_iter().find(|it| check(it, Reading::Exact).is_ok()).expect("a valid cycle")
}

/// Whether a margin explains this answer to the cycle, which differs from the exact one.
fn explained(cycle: &Cycle, said: Said) -> bool {
    explained_at(cycle, said, &Map::new())
}

/// The same of an answer that names a place.
fn explained_at(cycle: &Cycle, said: Said, object: &Map<String, Value>) -> bool {
    let exact = check(cycle, Reading::Exact);
    let differs = compare_cycle(cycle, &exact, said, object).expect("a difference");
    is_explained(&Question::Cycle(Box::new(cycle.clone())), &differs, object, ROUNDING_M)
}

/// Class `work`: what the model has too much to compute for is left out, whatever is answered.
#[test]
fn a_cycle_too_large_for_the_model_is_left_out() {
    let cycle = Question::Cycle(Box::new(valid()));
    let compared = |field: &str, answer: &str| {
        let (field, message) = (field.to_owned(), String::new());
        let exact = Err(InvalidInput { field, index: None, message });
        let object = serde_json::from_str(answer).expect("an object");
        compare(&cycle, &Expected::Cycle(Box::new(exact)), &object)
    };
    let safe = r#"{"verdict": "safe", "failed_stage": null}"#;
    let error =
        r#"{"verdict": "error", "failed_stage": null, "error": {"field": "work", "index": null}}"#;
    assert!([safe, error].iter().all(|it| matches!(compared("work", it), Ok(None))));
    assert!(matches!(compared("ego.x", safe), Ok(Some(_))));
    assert!(compared("work", "{}").is_err());
}

#[test]
fn a_norm_within_rounding_of_its_bound_is_explained_and_no_other() {
    let mut cycle = valid();
    let right = check(&cycle, Reading::Exact).expect("valid").failed_stage;
    assert!(!explained(&cycle, Said::Error), "a direction of length 1 was refused");
    let border = (1.0_f64 + 1e-6).sqrt();
    (cycle.ego.cos, cycle.ego.sin) = (0.0, border);
    let inside = |cycle: &Cycle| check(cycle, Reading::Exact).is_ok();
    while !inside(&cycle) {
        cycle.ego.sin = cycle.ego.sin.next_down();
    }
    assert!(explained(&cycle, Said::Error), "the last valid direction");
    while inside(&cycle) {
        cycle.ego.sin = cycle.ego.sin.next_up();
    }
    let inner = norm::either_way(&cycle).next().expect("a direction at the bound");
    let turned = check(&inner, Reading::Exact).expect("valid").failed_stage;
    assert!(explained(&cycle, Said::Verdict(turned)), "the first direction too long");
    cycle.ego.sin = border + 1e-9;
    assert!(!explained(&cycle, Said::Verdict(right)), "a direction that is clearly too long");
}

/// The reproducer of a campaign: a local detection and a remote point, both beyond the bound by less than doubles
/// see; each may be decided either way, whatever becomes of the other.
#[test]
fn each_of_several_norms_at_the_bound_may_be_decided_either_way() {
    let record = r#"{"kind": "cycle", "id": "two-norms", "profile": "paper", "parameters": {},
        "now_ns": 1000000000, "configuration": "PlanRemote",
        "ego": {"x": 0, "y": 0, "cos": 1, "sin": 0, "speed": 2, "length": 4, "width": 2, "center_offset": 0},
        "trajectory": {"stamp_ns": 1000000000,
            "points": [{"t_ns": 1000000000, "x": 0, "y": 0, "cos": 1.0000005, "sin": 0}]},
        "tracks": null, "detections": {"stamp_ns": 1000000000,
            "items": [{"x": 8, "y": 9, "cos": 0.5999991666660879, "sin": -0.8, "length": 5, "width": 2}]},
        "lead": null, "route": {"closed": false, "stations": [
            {"x": -40, "y": 0, "left": [0, 3], "right": [0, 0]},
            {"x": 0, "y": 0, "left": [0, 3], "right": [0, 0]}]},
        "grid": null, "detection_history": []}"#;
    let mut cycles = mufasa_records::cycles_from_lines(&record.replace('\n', " "));
    let (_, cycle) = cycles.remove(0).expect("a cycle");
    let input = Said::Verdict(Some(FailedStage::Input));
    assert!(explained(&cycle, input), "the point alone is too long");
    assert!(explained(&cycle, Said::Verdict(None)), "neither is");
    let collision = Said::Verdict(Some(FailedStage::Stage(Stage::Iv)));
    assert!(!explained(&cycle, collision), "neither is, and it collides");
    // The same where the answer names the places.
    let at = |key: &str, field: &str| {
        let object = format!(r#"{{"{key}": {{"field": "{field}", "index": 0}}}}"#);
        serde_json::from_str::<Map<String, Value>>(&object).expect("an object")
    };
    assert!(explained_at(&cycle, input, &at("input", "trajectory.points.cos")));
    assert!(!explained_at(&cycle, input, &at("input", "trajectory.points.x")));
    let mut local = cycle;
    local.configuration = Configuration::Local;
    assert!(explained_at(&local, Said::Error, &at("error", "trajectory.points.cos")));
    assert!(!explained_at(&local, Said::Error, &at("error", "trajectory.points.x")));
}

/// The margin is not the cycle's own: that one may be invalid, and stays so.
#[test]
fn no_margin_makes_invalid_input_valid() {
    let mut cycle = valid();
    let right = check(&cycle, Reading::Exact).expect("valid").failed_stage;
    cycle.parameters.delta = 1.0;
    assert!(!explained(&cycle, Said::Verdict(right)));
}
