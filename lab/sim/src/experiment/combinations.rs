//! Combinations of attacks of all kinds, drawn at random over time: who fails.
//!
//! With MOT, PLAN or both offered, in the same scenarios for each variant. Attacks begin one after the other, each of
//! a random kind and as long as it happens, so that none, one or several go on at a time; half of them are of the size that
//! the other experiments have, half of one at random. Left out are kinds that cost time alone, which a run does not
//! know (`flood`, `slow`), and those that came after runs of this experiment had been named in findings
//! (`stamps-ahead`, `silent`, `held-back`): with them an id would name another run. The wait after a failure is 2 s, as in the paper's random experiment.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::axes::{Axes, Offered};
use super::falsify::genome::{KINDS, means};
use super::job::{self, Job};
use super::made::Experiment;
use super::select::Options;
use crate::attack::Attack;
use crate::cav::guard::Variant;
use crate::map::Town;

/// Scenarios on each route.
pub const COMBINATIONS: Experiment =
    Experiment::new("combinations", Options::town(10, 15, 0), jobs);
/// The wait after a failure, ns.
const T_WAIT_NS: i64 = 2_000_000_000;
/// Attacks until then, s: no run is longer.
const UNTIL: f64 = 130.0;
/// Of `KINDS` so many, the first ones, are drawn.
pub const DRAWN: usize = 18;
/// From the start of an attack to that of the next one, and how long one lasts, s: at least, and at most.
const BETWEEN: (f64, f64) = (0.5, 8.0);
const LASTS: (f64, f64) = (0.5, 10.0);

fn jobs(name: &str, town: &Town, options: Options) -> Vec<Job> {
    let mut jobs = Vec::new();
    for offered in Offered::ALL {
        let axes = Axes { offered, ..Axes::default() };
        for variant in Variant::ALL {
            let of = job::on_each_start(name, (offered.name(), axes), variant, (town, options));
            jobs.extend(of.map(|mut job| {
                job.settings.requester.t_wait_ns = T_WAIT_NS;
                job.settings.attacks = attacks(job.settings.seed, job.route);
                job
            }));
        }
    }
    jobs
}

/// Attacks of a run, the same for each variant and offer.
pub fn attacks(seed: u64, route: usize) -> Vec<Attack> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::try_from(route).unwrap_or(0) + 1);
    let mut attacks = Vec::new();
    let mut from = random.random_range(BETWEEN.0..BETWEEN.1);
    while from < UNTIL {
        let kind = KINDS[random.random_range(0..DRAWN)];
        let until = from + random.random_range(LASTS.0..LASTS.1);
        let attack = Attack::new(kind, from, until, seed);
        let shares: [f64; 4] = std::array::from_fn(|_| random.random());
        let is_random = random.random_bool(0.5);
        attacks.push(if is_random {
            Attack { means: means(kind, shares), ..attack }
        } else {
            attack
        });
        from += random.random_range(BETWEEN.0..BETWEEN.1);
    }
    attacks
}
