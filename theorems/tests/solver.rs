//! What z3 writes is read.

use mufasa_theorems::solver::number;

#[test]
fn numbers_are_read_as_z3_writes_them() {
    let read = ["1.5", "(- 1.5)", "(/ 1.0 4.0)", "(- (/ 3.0 4.0))", "0.25?"].map(number);
    assert!(read.iter().zip([1.5, -1.5, 0.25, -0.75, 0.25]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(number("(root-obj x 1)").is_nan());
}
