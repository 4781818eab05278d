//! Time per stage and per whole cycle, beside the peers on the same input, and per period of the
//! requester (criterion). The table
//! of ratios comes from the program `race`, which interleaves.

use criterion::{BenchmarkId, Criterion};
use mufasa::input::profile::Profile;
use mufasa::offloading::requester::StationRecord;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::peer;
use mufasa_benches::periods::Periods;
use mufasa_benches::workload::{SIZES, Variant, Workload};

const PROFILES: [(&str, Profile); 2] = [("paper", Profile::PAPER), ("hardened", Profile::HARDENED)];

fn stages(criterion: &mut Criterion) {
    for stage in Stage::ALL {
        let mut group = criterion.benchmark_group(format!("stage {stage:?}"));
        for size in &SIZES {
            let workload = Workload::new(size, Variant::Pass);
            for (name, profile) in PROFILES {
                let cycle = workload.cycle(profile, Configuration::AllRemote);
                let mut it = Contestant::new(&cycle);
                let id = BenchmarkId::new(format!("mufasa, {name}"), &workload.name);
                group.bench_function(id, |bencher| {
                    bencher.iter(|| it.stage(stage));
                });
            }
            let cycle = workload.cycle(Profile::PAPER, Configuration::AllRemote);
            for mut peer in peer::all(&cycle) {
                if peer.stage == stage && !peer.slow {
                    let id = BenchmarkId::new(peer.name, &workload.name);
                    group.bench_function(id, |bencher| bencher.iter(|| (peer.decide)()));
                }
            }
        }
        group.finish();
    }
}

fn cycles(criterion: &mut Criterion) {
    let configurations =
        [Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote];
    for configuration in configurations {
        let mut group = criterion.benchmark_group(format!("whole cycle {configuration:?}"));
        for size in &SIZES {
            let workload = Workload::new(size, Variant::Pass);
            for (name, profile) in PROFILES {
                let cycle = workload.cycle(profile, configuration);
                let mut it = Contestant::new(&cycle);
                assert_eq!(it.check().failed_stage, None, "{}", workload.name);
                let id = BenchmarkId::new(name, &workload.name);
                group.bench_function(id, |bencher| {
                    bencher.iter(|| it.check());
                });
            }
        }
        group.finish();
    }
}

/// A period of the requester with both groups remote: a tick, an element of each group, a safe verdict;
/// and a fallback, from the tick that asks to the verdict that ends both sessions.
fn requester(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("requester step");
    for (name, profile) in PROFILES {
        let mut table = [StationRecord::FREE; 4];
        let mut it = Periods::new(profile, &mut table);
        group.bench_function(format!("a period without an issue, {name}"), |bencher| {
            bencher.iter(|| it.period());
        });
        group.bench_function(format!("a fallback and back, {name}"), |bencher| {
            bencher.iter(|| it.fallback());
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    stages(&mut criterion);
    cycles(&mut criterion);
    requester(&mut criterion);
    criterion.final_summary();
}
