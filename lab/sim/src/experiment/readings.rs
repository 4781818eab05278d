//! The paper's attack with empty track lists, in each reading of its text: which of them give its figure.
//!
//! The text: the attacker "spams the interface with empty track lists with a frequency of 100 Hz that are used by the
//! ENV service on the MEC server or the CAV". Open are whose lists, what becomes of the true ones, and whether an empty
//! list is a list (I-11). Scenarios and times are those of `failures`.

use super::axes::Axes;
use super::job::{self, Job};
use super::made::Experiment;
use super::select::Options;
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::guard::Variant;
use crate::map::Town;

/// As large as the paper's, on each route.
pub const READINGS: Experiment = Experiment::new("readings", Options::town(10, 15, 0), jobs);

/// Every reading, and what an attacker still does where an empty list is none. What nothing is compared with does not
/// depend on I-11.
fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for lists in [Lists::Planner, Lists::Cav, Lists::Both] {
        for comes in [Comes::Replaced, Comes::Interleaved, Comes::Farthest] {
            for (is_list, word) in [(true, "list"), (false, "none")] {
                let axes = Axes {
                    attack: Some(Kind::EmptyTracks),
                    lists: Some(lists),
                    comes: Some(comes),
                    empty_is_a_list: Some(is_list),
                    ..Axes::default()
                };
                let word = format!("{}+{}+{word}", lists.name(), comes.name());
                let variants: &[Variant] = if is_list { &Variant::ALL } else { &[Variant::Paper] };
                for &variant in variants {
                    jobs.extend(job::on_each_start(name, (&word, axes), variant, (town, options)));
                }
            }
        }
    }
    jobs
}
