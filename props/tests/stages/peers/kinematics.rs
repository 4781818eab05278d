//! Braking distances: numbers of ad-rss-lib's tests.

use mufasa_model::numbers::real::Real;
use mufasa_model::stages::distances::{s_b, s_follow};

/// Tolerance of the peer's own comparison, m; its numbers have one decimal.
const TOLERANCE: f64 = 0.05;

#[test]
fn braking_distances_are_those_of_ad_rss_lib() {
    let Some(text) = super::read("kinematics/ad_rss_vectors.tsv") else { return };
    let mut compared = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let columns: Vec<&str> = line.split('\t').collect();
        let [quantity, v, v_lead, a, expected, ..] = columns[..] else {
            panic!("{line} has too few columns")
        };
        // Rows that expect a refusal belong to the domain, not to the formula.
        let (Ok(v), Ok(expected)) = (v.parse::<f64>(), expected.parse::<f64>()) else { continue };
        let v = Real::from_double(v / 3.6);
        let deceleration = Real::from_double(a.parse().unwrap_or(6.0));
        let found = match quantity {
            "stopping_distance" => s_b(&v, &deceleration),
            "safe_longitudinal_distance" => {
                let v_lead = Real::from_double(v_lead.parse::<f64>().expect("a speed") / 3.6);
                s_follow(&v, &v_lead, &deceleration, &Real::zero())
            }
            other => panic!("unknown quantity {other}"),
        };
        let found = found.to_f64();
        assert!((found - expected).abs() <= TOLERANCE, "{line}: found {found}");
        compared += 1;
    }
    println!("{compared} numbers of ad-rss-lib");
    assert!(compared >= 3, "the file was not understood");
}
