//! Time per stage and per whole cycle, beside the peers on the same input (criterion). The table
//! of ratios comes from the program `race`, which interleaves.

use criterion::{BenchmarkId, Criterion};
use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::peer;
use mufasa_benches::workload::{SIZES, Variant, Workload};

const PROFILES: [(&str, Profile); 2] = [("paper", Profile::Paper), ("hardened", Profile::Hardened)];

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
            let cycle = workload.cycle(Profile::Paper, Configuration::AllRemote);
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

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    stages(&mut criterion);
    cycles(&mut criterion);
    criterion.final_summary();
}
