//! What z3 writes is read, and a solver that hangs is not waited for.

use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

use mufasa_theorems::solver::{Effort, Satisfiability, Solver, is_version_4_8, number};

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

#[test]
fn a_solver_that_hangs_does_not_know() {
    let program = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("hangs");
    std::fs::write(&program, "#!/bin/sh\nexec sleep 60\n").expect("a script");
    std::fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).expect("it may be run");
    let start = Instant::now();
    let mut solver = Solver::start_program(&program).expect("it starts");
    for questions in 1..=2 {
        let answer = solver.check("", &[], Effort { steps: 1, limit_ms: 100 });
        assert_eq!((answer, solver.questions), (Satisfiability::Unknown, questions));
        assert!(solver.error.is_none(), "{:?}", solver.error);
    }
    assert!(start.elapsed() < Duration::from_secs(30));
}

#[test]
fn a_solver_that_ends_is_an_error() {
    let mut solver = Solver::start_program("true".as_ref()).expect("true is everywhere");
    let effort = Effort { steps: 1, limit_ms: 100 };
    assert_eq!(solver.check("", &[], effort), Satisfiability::Unknown);
    assert!(solver.error.is_some());
}
