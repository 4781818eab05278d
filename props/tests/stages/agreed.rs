//! What the models find in one cycle, where the implementation has to conform.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::Cycle;
use mufasa_model::report::{Reading, Report, Rule};
use mufasa_props::differential::conforming;

/// The reports of exact and strict model.
pub fn reports(cycle: &Cycle) -> [Report; 2] {
    let answers = [Reading::Exact, Reading::Strict].map(|it| check(cycle, it));
    let [exact, strict] = &answers;
    assert_eq!(conforming(cycle, exact, strict), Ok(()));
    answers.map(|it| it.expect("valid"))
}

/// The rule by which the exact model fails it.
pub fn failed(cycle: &Cycle) -> Option<Rule> {
    let [exact, _] = reports(cycle);
    rule(&exact)
}

/// The same where nothing is too close to call: the strict model finds it, too.
pub fn failed_clearly(cycle: &Cycle) -> Option<Rule> {
    let [exact, strict] = reports(cycle).map(|it| rule(&it));
    assert_eq!(exact, strict, "{cycle:#?}");
    exact
}

fn rule(report: &Report) -> Option<Rule> {
    let witness = report.witness().map(|it| it.rule);
    assert_eq!(report.failed_stage.is_some(), witness.is_some(), "{report:?}");
    witness
}
