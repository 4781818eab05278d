//! Sessions in a run: how much is offloaded, and for how long nothing is after an unsafe cycle.

use mufasa::offloading::requester::Parameters;
use mufasa_sim::attack::Kind;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::run::{Cycle, Watcher};
use mufasa_sim::snapshot::Snapshot;

use crate::digest::drive;

#[derive(Default)]
struct Cycles(Vec<Cycle>);

impl Watcher for Cycles {
    fn cycle(&mut self, _: &Snapshot, _: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        self.0.push(*cycle);
    }
}

#[test]
fn sofof_offloads_nearly_always_over_a_good_link() {
    for scenario in [(0, 0), (1, 1), (0, 2)] {
        let (outcome, _) = drive::<Cycles>(Variant::Sofof, None, scenario, 30.0);
        for remote in outcome.offloaded {
            assert!(100 * remote > 95 * outcome.cycles, "{scenario:?}: {outcome:?}");
        }
    }
}

#[test]
fn after_an_unsafe_cycle_nothing_is_remote_until_t_wait_is_over() {
    let t_wait_ns = Parameters::default().t_wait_ns;
    let t_wait = t_wait_ns as f64 * 1e-9;
    for (variant, kind) in
        [(Variant::Paper, Kind::MapReplaced), (Variant::Hardened, Kind::OneRemoved)]
    {
        let (mut issues, mut again) = (0, 0);
        for scenario in [(0, 0), (1, 1), (0, 2)] {
            let (_, Cycles(cycles)) = drive::<Cycles>(variant, Some(kind), scenario, 35.0);
            for (at, cycle) in cycles.iter().enumerate().filter(|(_, it)| it.failed > 0) {
                issues += 1;
                let later = &cycles[at + 1..];
                let early = later.iter().find(|it| it.remote > 0 && it.t < cycle.t + t_wait);
                assert_eq!(early, None, "{variant:?} {scenario:?}: unsafe at {}", cycle.t);
                again += usize::from(later.iter().any(|it| it.remote > 0));
            }
        }
        println!("{variant:?}: {issues} issues, {again} times offloaded again");
        assert!(issues > 0 && again > 0, "{variant:?}: {issues} issues, {again} times again");
    }
}
