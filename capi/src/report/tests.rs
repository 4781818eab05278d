//! What a caller reads of a problem of its input.

use core::ffi::CStr;
use core::fmt::Debug;

use mufasa::monitor::{Advice, DropReason};
use mufasa::report::{FailedStage, InvalidInput, Problem, Rule, Stage};

use super::{MUFASA_TEXT_BYTES, failed_stage, input, rule};
use crate::monitor::{MufasaAdvice, MufasaDropReason};

const PROBLEMS: [Problem; 14] = [
    Problem::NotFinite,
    Problem::OutOfDomain,
    Problem::NotADirection,
    Problem::TimeOutOfRange,
    Problem::DuplicateId,
    Problem::EqualPoints,
    Problem::TimeNotIncreasing,
    Problem::StampNotDecreasing,
    Problem::TooFew,
    Problem::TooMany,
    Problem::BitmapLength,
    Problem::ScratchTooSmall,
    Problem::NoRoute,
    Problem::NoTick,
];

#[test]
fn messages_fit_and_end_with_a_zero() {
    for problem in PROBLEMS {
        let field = "detection_history.items.length";
        let told = input(Some(InvalidInput { field, index: Some(3), problem }));
        let bytes: Vec<u8> = told.message.iter().map(|byte| byte.to_ne_bytes()[0]).collect();
        let text = CStr::from_bytes_until_nul(&bytes).unwrap().to_str().unwrap();
        assert_eq!(text, problem.message());
        assert!(field.len() < MUFASA_TEXT_BYTES);
        assert_eq!(told.index, 3);
    }
}

#[test]
fn a_text_that_is_too_long_is_cut_off_and_ends() {
    let text = super::joined(["field.", &"x".repeat(200)]);
    assert_eq!(text.map(|it| it != 0), core::array::from_fn(|at| at < MUFASA_TEXT_BYTES - 1));
}

/// A slip in the table would tell an integrator of another rule.
#[test]
fn what_c_is_told_has_the_name_of_rust() {
    let rules = [
        Rule::Ambiguous,
        Rule::MeanCost,
        Rule::WorkLimit,
        Rule::NoAssignment,
        Rule::ThetaMap,
        Rule::StartTime,
        Rule::Position,
        Rule::StartHeading,
        Rule::StartOffset,
        Rule::Corridor,
        Rule::Direction,
        Rule::StepTime,
        Rule::StepLength,
        Rule::StepSpeed,
        Rule::StepForward,
        Rule::StepLateral,
        Rule::StepTurn,
        Rule::Slide,
        Rule::Reach,
        Rule::Gap,
        Rule::Collision,
        Rule::FailSafe,
        Rule::Occupied,
        Rule::Unknown,
        Rule::Outside,
    ];
    for it in rules {
        same(rule(it), it);
    }
    for it in Stage::ALL {
        same(failed_stage(Some(FailedStage::Stage(it))), it);
    }
    for it in DropReason::ALL {
        same(MufasaDropReason::from(it), it);
    }
    for it in Advice::ALL {
        same(MufasaAdvice::from(it), it);
    }
}

fn same(in_c: impl Debug, in_rust: impl Debug) {
    assert_eq!(format!("{in_c:?}"), format!("{in_rust:?}"));
}
