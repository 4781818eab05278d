//! `spec/3-stages.md#distances`

use mufasa_model::numbers::real::Real;
use mufasa_model::stages::distances::{s_b, s_cav, s_follow, s_valid};
use mufasa_model::stages::v_grid_map::disk_radius;

fn r(value: f64) -> Real {
    Real::from_double(value)
}

/// DIST-01, DIST-02: the formulas on speeds >= 0, against values worked out by hand.
#[test]
fn distances_are_the_formulas() {
    assert_eq!(s_b(&r(16.0), &r(8.0)), r(16.0));
    assert_eq!(s_cav(&r(1.5), &r(16.0)), r(24.0));
    // max(16 - 4, 0) + 24, and max(4 - 16, 0) + 12.
    assert_eq!(s_follow(&r(16.0), &r(8.0), &r(8.0), &r(1.5)), r(36.0));
    assert_eq!(s_follow(&r(8.0), &r(16.0), &r(8.0), &r(1.5)), r(12.0));
    assert_eq!(s_valid(&r(16.0), Some(&r(8.0)), &r(8.0), &r(1.5)), r(36.0));
    assert_eq!(s_valid(&r(16.0), None, &r(8.0), &r(1.5)), r(16.0));
}

/// Published numbers of others: 100 km/h braked with 6 m/s^2 takes 64.3 m.
#[test]
fn s_b_is_the_known_braking_distance() {
    let v = Real::from_integer(100) / r(3.6);
    assert!((s_b(&v, &r(6.0)) - r(64.3)).abs() < r(0.01));
}

/// S5-02: each of the n disks covers its part of the footprint, L/n by W.
#[test]
fn disk_radius_is_half_the_diagonal_of_a_part() {
    // Parts of 3 m by 4 m, and one of 1 m by 1 m whose radius is no rational.
    assert_eq!(disk_radius(&r(9.0), &r(4.0), &r(3.0)), r(2.5));
    assert_eq!(disk_radius(&r(3.0), &r(4.0), &r(1.0)), r(2.5));
    assert_eq!(disk_radius(&r(2.0), &r(1.0), &r(2.0)).square(), r(0.5));
}
