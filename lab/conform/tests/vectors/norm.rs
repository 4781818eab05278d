//! The vectors at the bound of the norm of a direction (`spec/4-arithmetic.md#domain`).

use std::collections::BTreeSet;

use mufasa_model::cycle::check;
use mufasa_model::report::Reading;
use mufasa_props::strategy::input::directions;
use mufasa_records::Record;

use crate::vectors::{all, record};

/// The check as it is written first.
fn in_doubles(cos: f64, sin: f64) -> bool {
    (cos * cos + sin * sin - 1.0).abs() <= 1e-6
}

/// Each of them is on the side of the bound on which doubles do not see it.
#[test]
fn the_norm_check_in_doubles_is_wrong_on_every_vector_about_the_norm() {
    let mut seen = BTreeSet::new();
    for vector in all() {
        let Some(about) = vector.id.strip_prefix("input-norm-") else { continue };
        let Some(Record::Cycle { mut cycle, .. }) = record(vector) else {
            panic!("{}: no cycle", vector.id)
        };
        let report = check(&cycle, Reading::Exact);
        let is_valid = report.is_ok_and(|report| report.input.is_none());
        assert_eq!(is_valid, about.ends_with("-inside"), "{about}");
        let seems_valid = directions(&mut cycle).iter().all(|(cos, sin)| in_doubles(**cos, **sin));
        assert_ne!(seems_valid, is_valid, "{about}: doubles decide it");
        seen.insert(about.to_owned());
    }
    for object in ["ego", "detection", "track", "point"] {
        for side in ["long-inside", "long-outside", "short-inside", "short-outside"] {
            assert!(seen.remove(&format!("{object}-{side}")), "{object} {side}");
        }
    }
    assert!(seen.is_empty(), "{seen:?}");
}
