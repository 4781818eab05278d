//! `spec/2-offloading.md#quality-of-service`.

use mufasa_model::offloading::quality_of_service::{
    inter_arrival_ns, is_silent, is_violation, latency_ns,
};

use mufasa_model::offloading::requester::Parameters;

/// FALL-10: over the whole range of 64 bits.
#[test]
fn differences_are_exact() {
    assert_eq!(latency_ns(i64::MAX, i64::MIN), i128::from(u64::MAX));
    assert_eq!(inter_arrival_ns(i64::MIN, i64::MAX), -i128::from(u64::MAX));
    let parameters =
        Parameters { l_max_ns: i64::MAX, dt_max_ns: i64::MAX, ..Parameters::default() };
    assert!(is_violation(&parameters, i64::MAX, i64::MAX, -1));
    assert!(!is_violation(&parameters, i64::MAX, i64::MAX, 0));
    assert!(is_violation(&parameters, i64::MAX, -1, i64::MAX));
    assert!(is_violation(&parameters, i64::MIN, i64::MAX, i64::MAX));
    assert!(is_silent(&parameters, i64::MAX, -1) && !is_silent(&parameters, i64::MIN, i64::MAX));
}
