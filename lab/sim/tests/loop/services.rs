//! Sessions of runs, and who computes: how much is offloaded, for how long nothing is after an unsafe cycle; what is
//! computed elsewhere is not computed in the CAV, and what is not, is.

use mufasa::offloading::requester::{GroupState, Parameters};
use mufasa::services::configuration::Group;
use mufasa_sim::attack::Kind;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::run::{Cycle, Outcome, Watcher};
use mufasa_sim::snapshot::Snapshot;

use super::drive::drive;

/// A cycle, and of each group: whether it was remote until it was decided, whether it is afterwards, whether
/// its services run afterwards, and how often they ran.
type Executed = (Cycle, [(bool, bool, bool, u64); 2]);

#[derive(Default)]
struct Executions(Vec<Executed>);

impl Watcher for Executions {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        let services = cav.services();
        let of = |group: Group, place: usize| {
            let was_remote = cycle.remote >> place & 1 == 1;
            let is_remote = matches!(cav.guard().state(group), GroupState::Remote { .. });
            (was_remote, is_remote, services.run(group), services.executions[place])
        };
        self.0.push((*cycle, [of(Group::Mot, 0), of(Group::Plan, 1)]));
    }
}

#[test]
fn services_run_where_they_are_to_and_sessions_end_and_begin_when_they_are_to() {
    for (variant, kind) in [
        (Variant::Sofof, None),
        (Variant::Paper, Some(Kind::WrongMap)),
        (Variant::Hardened, Some(Kind::MissingTrack)),
    ] {
        let mut seen = Seen::default();
        for scenario in [(0, 0), (1, 1), (0, 2)] {
            let (outcome, Executions(cycles)) = drive(variant, kind, scenario, 35.0);
            let at = format!("{variant:?} {scenario:?}");
            match kind {
                None => nearly_always_remote(&outcome, &at),
                Some(_) => seen.held_until_t_wait(&cycles, &at),
            }
            if variant != Variant::Paper {
                seen.run_when_and_only_when_nobody_else_runs_them(&cycles, &at);
            }
        }
        let Seen { idle, back, issues, again } = seen;
        println!("{variant:?}: idle {idle:?}, back {back:?}, {issues} issues, {again} times again");
        let is_looked_at = variant != Variant::Paper;
        assert!(!is_looked_at || idle.iter().all(|it| *it > 50), "{variant:?}: {idle:?}");
        assert!(
            variant != Variant::Hardened || back.iter().all(|it| *it > 0),
            "{variant:?}: {back:?}"
        );
        assert!(kind.is_none() || issues > 0 && again > 0, "{variant:?}: {issues}, {again}");
    }
}

fn nearly_always_remote(outcome: &Outcome, at: &str) {
    for remote in outcome.offloaded {
        assert!(100 * remote > 95 * outcome.cycles, "{at}: {outcome:?}");
    }
}

#[derive(Default)]
struct Seen {
    /// Cycles in which a group stays out, and how often one comes back.
    idle: [usize; 2],
    back: [usize; 2],
    /// Unsafe cycles, and those after which something is remote again.
    issues: usize,
    again: usize,
}

impl Seen {
    fn held_until_t_wait(&mut self, cycles: &[Executed], run: &str) {
        let t_wait = Parameters::default().t_wait_ns as f64 * 1e-9;
        for (at, (cycle, _)) in cycles.iter().enumerate().filter(|(_, it)| it.0.failed > 0) {
            self.issues += 1;
            let later = &cycles[at + 1..];
            let early = later.iter().find(|it| it.0.remote > 0 && it.0.t < cycle.t + t_wait);
            assert_eq!(early, None, "{run}: unsafe at {}", cycle.t);
            self.again += usize::from(later.iter().any(|it| it.0.remote > 0));
        }
    }

    fn run_when_and_only_when_nobody_else_runs_them(&mut self, cycles: &[Executed], run: &str) {
        for (cycle, pair) in cycles.windows(2).enumerate() {
            for place in 0..2 {
                let (_, was_remote, ran, before) = pair[0].1[place];
                let (_, is_remote, runs, after) = pair[1].1[place];
                let at = format!("{run} cycle {cycle} group {place}");
                assert!(is_remote || runs, "{at}: nobody runs it");
                let stays_out = was_remote && is_remote && !ran && !runs;
                let stays_in = !was_remote && !is_remote;
                if stays_out {
                    self.idle[place] += 1;
                    assert_eq!(after, before, "{at}: runs here and there");
                }
                if stays_in {
                    assert_eq!(after, before + 1, "{at}: is to run here");
                }
                self.back[place] += usize::from(was_remote && !is_remote);
            }
        }
        for place in 0..2 {
            let remote = cycles.iter().filter(|it| it.1[place].1).count();
            let twice = cycles.iter().filter(|it| it.1[place].1 && it.1[place].2).count();
            assert!(10 * twice <= remote + 10, "{run}: runs on and on");
        }
    }
}
