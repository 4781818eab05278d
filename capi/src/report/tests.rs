//! What a caller reads of a problem of its input.

use core::ffi::CStr;

use mufasa::report::{InvalidInput, Problem};

use super::{MUFASA_TEXT_BYTES, input};

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
