//! What z3 writes is read.

use mufasa_theorems::solver::{is_version_4_8, number};

#[test]
fn numbers_are_read_as_z3_writes_them() {
    let read = ["1.5", "(- 1.5)", "(/ 1.0 4.0)", "(- (/ 3.0 4.0))", "0.25?"].map(number);
    assert!(read.iter().zip([1.5, -1.5, 0.25, -0.75, 0.25]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(number("(root-obj x 1)").is_nan());
}

#[test]
fn old_versions_and_other_programs_are_refused() {
    let new = ["Z3 version 4.8.12 - 64 bit", "Z3 version 4.13.3 - 64 bit", "Z3 version 5.0"];
    let old = ["Z3 version 4.7.1 - 64 bit", "Z3 version 3.9", "cvc5 4.8", "Z3 version x", ""];
    assert!(new.into_iter().all(is_version_4_8));
    assert!(!old.into_iter().any(is_version_4_8));
}
