//! Every attack in every configuration: what finds it, and when.
//!
//! Each attack, and none as the control, with MOT, PLAN or both offered, in the same scenarios for each variant.
//! It begins 5 s after the start and lasts. Counted from then on are the cycles with something remote, and
//! the way driven in them, until the first that fails. The control says how often that happens without an
//! attack: a detection is one only as far as it is above that.

use super::axes::{Axes, Offered};
use super::job::{self, Job};
use super::made::Experiment;
use super::select::Options;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;

/// A few scenarios of each of 216 combinations.
pub const ATTACKS: Experiment = Experiment::new("attacks", Options::town(2, 15, 0), jobs);

fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for attack in [None].into_iter().chain(Kind::IN_THE_LOOP.map(Some)) {
        for offered in Offered::ALL {
            let axes = Axes { attack, offered, ..Axes::default() };
            let word = format!("{}/{}", job::kind_name(attack), offered.name());
            for variant in Variant::ALL {
                jobs.extend(job::on_each_start(name, (&word, axes), variant, (town, options)));
            }
        }
    }
    jobs
}
