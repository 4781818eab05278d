//! The stages without one rule, on the vectors, which have cases of each rule.

use std::fs;
use std::path::Path;

use mufasa_model::input::cycle::Cycle;
use mufasa_model::input::profile::Profile;
use mufasa_model::report::{FailedStage, Outcome, Reading, Report, Rule};
use mufasa_model::services::configuration::Configuration;
use mufasa_model::stages::check;
use mufasa_records::cycle_from_line;
use mufasa_sim::cav::without::Without;
use mufasa_sim::cav::without::stages::decide;
use serde_json::Value;

/// A cycle of the hardened profile with valid input, what the model decides, and of which file it is.
struct Case {
    file: String,
    id: String,
    cycle: Cycle,
    report: Report,
}

fn cases() -> Vec<Case> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../vectors");
    let mut cases = Vec::new();
    for part in ["hardened", "findings", "stages"] {
        for entry in fs::read_dir(folder.join(part)).expect("a folder") {
            let file = entry.expect("an entry").path();
            let text = fs::read_to_string(&file).expect("it can be read");
            cases.extend(text.lines().filter_map(|line| case(&file, line)));
        }
    }
    cases
}

fn case(file: &Path, line: &str) -> Option<Case> {
    let vector: Value = serde_json::from_str(line).expect("JSON");
    let (id, mut cycle) = cycle_from_line(vector["input"].to_string(), 1).ok()?;
    cycle.profile = Profile::Hardened;
    let report = check(&cycle, Reading::Exact).ok()?;
    let file = file.file_stem().expect("a name").to_string_lossy().into_owned();
    let is_valid = report.failed_stage != Some(FailedStage::Input);
    is_valid.then_some(Case { file, id, cycle, report })
}

#[test]
fn with_nothing_left_out_the_stages_are_the_model() {
    let cases = cases();
    for Case { id, cycle, report, .. } in &cases {
        assert_eq!(decide(Without::Nothing, cycle), *report, "{id}");
    }
    let failed = cases.iter().filter(|it| it.report.failed_stage.is_some()).count();
    assert!(cases.len() > 400 && failed > 150, "{} {failed}", cases.len());
}

/// A rule changes cases of its own, and none of which it is said that it cannot.
#[test]
fn each_rule_of_the_stages_can_be_left_out() {
    let cases = cases();
    for without in Without::ALL.into_iter().filter(|it| *it != Without::H08) {
        let (mut changed, mut left) = (0, 0);
        for Case { file, id, cycle, report } in &cases {
            let decided = decide(without, cycle);
            let name = without.name();
            if without == Without::H10 && cycle.configuration != Configuration::MotRemote {
                // As the paper has it: one of the stages iii, iv and v at most. A gap is no run of stage iv (H-04).
                let ran = |it: &&Outcome| match it {
                    Outcome::Failed(witness) => witness.rule != Rule::Gap,
                    it => **it == Outcome::Passed,
                };
                assert!(decided.stages[2..].iter().filter(ran).count() < 2, "{id}: {decided:?}");
            }
            let verdicts = [&decided, report].map(|it| it.failed_stage);
            if !without.may_change(report) {
                left += 1;
                assert_eq!(verdicts[0], verdicts[1], "{name}: {id}");
                continue;
            }
            changed += usize::from(verdicts[0] != verdicts[1] && file == name);
            // All but three only ever add a reason to fail.
            let adds = !matches!(without, Without::H01 | Without::H06 | Without::H10);
            assert!(
                !adds || decided.failed_stage.is_none() || report.failed_stage.is_some(),
                "{id}"
            );
        }
        println!("{} changed {changed} of its own, left {left} of {}", without.name(), cases.len());
        assert!(changed > 0, "{}", without.name());
        assert!(left > 0, "{}", without.name());
    }
}
