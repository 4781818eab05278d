//! Services and compositions: the implementation's check accepts exactly what the model's
//! orchestrator enumerates (`spec/1-services.md`).

use std::cell::RefCell;
use std::collections::BTreeSet;

use mufasa_model::composition::Composition;
use mufasa_model::orchestrator::{Task, closed_choices, compose};
use mufasa_model::service::ServiceSet;
use mufasa_props::bridge::{
    check_change, check_composition, check_services, device_switches, rule_name,
};
use mufasa_props::differential::runner;
use mufasa_props::strategy::composition::{changed, later, services, task};
use mufasa_props::strategy::draw::{Draw, long_tape};
use proptest::test_runner::TestCaseError;

/// Closed choices, each of them and one change of each are judged.
#[test]
fn the_check_accepts_exactly_what_the_orchestrator_enumerates() {
    let seen = RefCell::new((0_u64, 0_u64));
    let result = runner().run(&long_tape(), |tape| {
        let mut draw = Draw::new(&tape);
        let task = task(&mut draw);
        judge(&mut draw, &task, &mut seen.borrow_mut()).map_err(TestCaseError::fail)
    });
    let (accepted, refused) = seen.into_inner();
    println!("compositions: {accepted} accepted, {refused} refused");
    if let Err(error) = result {
        panic!("{error}");
    }
    assert!(10 * accepted > refused && 10 * refused > accepted, "{accepted}, {refused}");
}

fn judge(draw: &mut Draw<'_>, task: &Task, seen: &mut (u64, u64)) -> Result<(), String> {
    let Ok(answer) = compose(task) else { return Ok(()) };
    let set = ServiceSet::new(task.services.clone()).map_err(|error| error.to_string())?;
    let enumerated: BTreeSet<&Composition> = answer.compositions.iter().collect();
    let choices = closed_choices(&set, &task.goal).map_err(|error| error.to_string())?;
    for links in choices.iter().take(20) {
        let choice = Composition::of_links(&set, &task.goal, links);
        let other = changed(draw, task, &choice);
        for candidate in [choice, other] {
            let expected = enumerated.contains(&sorted(&candidate));
            let found = check_composition(task, &candidate);
            if found.is_ok() != expected {
                return Err(format!(
                    "{task:#?}\n{candidate:#?}\nenumerated: {expected}, {found:?}"
                ));
            }
            if expected {
                seen.0 += 1;
            } else {
                seen.1 += 1;
            }
            if expected && check_composition(task, &reversed(&candidate)).is_err() {
                return Err(format!("the order of the lists matters: {candidate:#?}"));
            }
        }
    }
    Ok(())
}

/// The order of the lists means nothing; repetitions do.
fn sorted(composition: &Composition) -> Composition {
    let mut sorted = composition.clone();
    sorted.members.sort();
    sorted.links.sort();
    sorted.switches.sort();
    sorted
}

fn reversed(composition: &Composition) -> Composition {
    let mut reversed = composition.clone();
    reversed.members.reverse();
    reversed.links.reverse();
    reversed.switches.reverse();
    reversed
}

#[test]
fn service_sets_and_their_changes_are_judged_alike() {
    let seen = RefCell::new((0_u64, 0_u64));
    let result = runner().run(&long_tape(), |tape| {
        let mut draw = Draw::new(&tape);
        let before = services(&mut draw);
        let after = later(&mut draw, &before);
        let broken =
            |error: mufasa_model::service::ServiceError| (error.service, rule_name(&error.rule));
        let model = ServiceSet::new(before.clone());
        let expected = model.clone().map(|_| ()).map_err(broken);
        let mut seen = seen.borrow_mut();
        seen.0 += u64::from(expected.is_ok());
        seen.1 += u64::from(expected.is_err());
        proptest::prop_assert_eq!(check_services(&before), expected);
        if let Ok(set) = model {
            proptest::prop_assert_eq!(device_switches(&before), Some(set.device_switches()));
            let expected = set.evolve(after.clone()).map(|_| ()).map_err(broken);
            let found = check_change(&before, &after);
            // Which of several services that did not stay is named is not said.
            let rule = |result: &Result<(), (Option<String>, &'static str)>| {
                result.clone().map_err(|(_, rule)| rule)
            };
            proptest::prop_assert_eq!(rule(&found), rule(&expected));
        }
        Ok(())
    });
    let (sets, others) = seen.into_inner();
    println!("service sets: {sets} sets, {others} that break a rule");
    if let Err(error) = result {
        panic!("{error}");
    }
    assert!(10 * sets > others && 10 * others > sets, "{sets}, {others}");
}
