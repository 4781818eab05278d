//! Failures under the attacks of the paper, without and with the stages: the paper's figure.
//!
//! Every attack of the paper, and none as the control, on both routes, in the same scenarios for each variant.
//! It begins 5 s after the start and lasts. A failure is a collision, or a target that is not reached in time.
//!
//! Of the readings of the attack with empty lists (`readings`) it is the one that the text allows and that gives the
//! paper's figure: between the true lists, on the interface within the station alone.

use super::axes::Axes;
use super::job::{self, Job};
use super::made::Experiment;
use super::select::Options;
use crate::attack::Kind;
use crate::attack::means::{Comes, Lists};
use crate::cav::guard::Variant;
use crate::map::Town;

/// As large as the paper's, on each route.
pub const FAILURES: Experiment = Experiment::new("failures", Options::town(10, 15, 0), jobs);

fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for attack in [None].into_iter().chain(Kind::PAPER.map(Some)) {
        let mut axes = Axes { attack, ..Axes::default() };
        if attack == Some(Kind::EmptyTracks) {
            (axes.lists, axes.comes) = (Some(Lists::Planner), Some(Comes::Interleaved));
        }
        for variant in Variant::ALL {
            let word = job::kind_name(attack);
            jobs.extend(job::on_each_start(name, (word, axes), variant, (town, options)));
        }
    }
    jobs
}
