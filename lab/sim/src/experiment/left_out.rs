//! What each stage and each rule is for: what is found, and missed, without it, and without what stages need.
//!
//! The paper leaves open "if the grid validation stage is actually necessary" (Sec. V-B). Here the stages do not get the
//! grid (no stage v) or the detections (no stages i and iv), or a stage or a rule is left out, with detectors that are
//! exact, noisy, or blind for one object in two, with tracking, planning or both offered, without an attack and under
//! seven. Rays meet whom a detector is blind for: the grid has them. The CAV's and the station's detectors are blind for
//! the same ones.

use super::axes::{Axes, Detectors, LeftOut, Offered};
use super::job::{self, Job};
use super::kept::Run;
use super::made::Experiment;
use super::select::Options;
use crate::attack::Kind;
use crate::cav::guard::Variant;
use crate::map::Town;

/// A few scenarios on each route of many combinations; those with all attacks and offers are one row.
pub const LEFT_OUT: Experiment =
    Experiment { same, ..Experiment::new("left-out", Options::town(2, 15, 0), jobs) };

/// Attacks that hide somebody, lie about somebody, or drive into somebody.
const ATTACKS: [Kind; 7] = [
    Kind::EmptyTracks,
    Kind::MissingTrack,
    Kind::FalseVelocities,
    Kind::GhostTracks,
    Kind::IntoLead,
    Kind::Swerve,
    Kind::StartsLate,
];

fn same(a: &Run, b: &Run) -> bool {
    let key = |run: &Run| (run.detectors, run.variant, run.left_out);
    key(a) == key(b)
}

fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for detectors in Detectors::ALL {
        for variant in [Variant::Paper, Variant::Hardened] {
            for left_out in LeftOut::all(variant, detectors) {
                let (detected, without) = (detectors.name(), left_out.name());
                let (detectors, left_out) = (Some(detectors), Some(left_out));
                for attack in [None].into_iter().chain(ATTACKS.map(Some)) {
                    for offered in Offered::ALL {
                        let axes = Axes { attack, offered, detectors, left_out, ..Axes::default() };
                        let (by, to) = (job::kind_name(attack), offered.name());
                        let word = format!("{detected}+{without}+{by}+{to}");
                        let case = (&*word, axes);
                        jobs.extend(job::on_each_start(name, case, variant, (town, options)));
                    }
                }
            }
        }
    }
    jobs
}
