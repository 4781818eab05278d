//! What is computed elsewhere is not computed in the CAV, and what is not, is.

use mufasa::offloading::requester::GroupState;
use mufasa::services::configuration::Group;
use mufasa_sim::attack::Kind;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::run::{Cycle, Watcher};
use mufasa_sim::snapshot::Snapshot;

use crate::digest::drive;

/// Of each cycle: whether each group was remote until it was decided, whether it is afterwards, whether
/// its services run afterwards, and how often they ran.
#[derive(Default)]
struct Executions(Vec<[(bool, bool, bool, u64); 2]>);

impl Watcher for Executions {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        let services = cav.services();
        let of = |group: Group, place: usize| {
            let was_remote = cycle.remote >> place & 1 == 1;
            let is_remote = matches!(cav.guard().state(group), GroupState::Remote { .. });
            (was_remote, is_remote, services.run(group), services.executions[place])
        };
        self.0.push([of(Group::Mot, 0), of(Group::Plan, 1)]);
    }
}

#[test]
fn services_run_in_the_cav_when_and_only_when_nobody_else_runs_them() {
    for (variant, kind) in [(Variant::Sofof, None), (Variant::Hardened, Some(Kind::OneRemoved))] {
        let (mut idle, mut back) = ([0; 2], [0; 2]);
        for scenario in [(0, 0), (1, 1), (0, 2)] {
            let (_, Executions(cycles)) = drive::<Executions>(variant, kind, scenario, 30.0);
            for (cycle, pair) in cycles.windows(2).enumerate() {
                for place in 0..2 {
                    let (_, was_remote, ran, before) = pair[0][place];
                    let (_, is_remote, runs, after) = pair[1][place];
                    let at = format!("{variant:?} {scenario:?} cycle {cycle} group {place}");
                    assert!(is_remote || runs, "{at}: nobody runs it");
                    let stays_out = was_remote && is_remote && !ran && !runs;
                    let stays_in = !was_remote && !is_remote;
                    if stays_out {
                        idle[place] += 1;
                        assert_eq!(after, before, "{at}: runs here and there");
                    }
                    if stays_in {
                        assert_eq!(after, before + 1, "{at}: is to run here");
                    }
                    back[place] += usize::from(was_remote && !is_remote);
                }
            }
            let remote = |place: usize| cycles.iter().filter(|it| it[place].1).count();
            let twice =
                |place: usize| cycles.iter().filter(|it| it[place].1 && it[place].2).count();
            for place in 0..2 {
                assert!(10 * twice(place) <= remote(place) + 10, "{variant:?}: runs on and on");
            }
        }
        println!("{variant:?}: idle {idle:?}, back {back:?}");
        assert!(idle.iter().all(|it| *it > 50), "{variant:?}: {idle:?}");
        assert!(kind.is_none() || back.iter().all(|it| *it > 0), "{variant:?}: {back:?}");
    }
}
