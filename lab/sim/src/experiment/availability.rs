//! What the checks cost without an attack: fallbacks, and time that is not offloaded.
//!
//! One setting at a time differs from the defaults. Settings of the detectors are those of the CAV and of the
//! station alike.

use super::axes::{Axes, Factor};
use super::job::{self, Job};
use super::made::Experiment;
use super::select::Options;
use crate::cav::guard::Variant;
use crate::map::Town;

/// A few scenarios of each of 46 combinations.
pub const AVAILABILITY: Experiment = Experiment::new("availability", Options::town(2, 15, 0), jobs);

fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for factor in Factor::ALL {
        for &value in factor.values() {
            let axes = Axes { set: Some((factor, value)), ..Axes::default() };
            let word = format!("{}={value}", factor.name());
            for variant in [Variant::Paper, Variant::Hardened] {
                jobs.extend(job::on_each_start(name, (&word, axes), variant, (town, options)));
            }
        }
    }
    jobs
}
