//! Time per stage and per whole cycle, beside the obvious alternative on the same input.
//!
//! Stage ii runs with every trajectory, so the times of iii, iv and v include it, on both sides.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use mufasa::cycle::{Cycle, Profile};
use mufasa_benches::alternative;
use mufasa_benches::workload::{Inputs, Memory, SIZES, Workload};

/// A stage's name, the inputs that make it run, and the plain program for it.
type Contest = (&'static str, Inputs, fn(&Cycle<'_>) -> bool);

fn stages(criterion: &mut Criterion) {
    let contests: [Contest; 5] = [
        ("i", Inputs::StageI, alternative::stage_i),
        ("ii", Inputs::StageIi, alternative::stage_ii),
        ("iii", Inputs::StageIii, |c| alternative::stage_ii(c) && alternative::stage_iii(c)),
        ("iv", Inputs::StageIv, |c| alternative::stage_ii(c) && alternative::stage_iv(c)),
        ("v", Inputs::StageV, |c| alternative::stage_ii(c) && alternative::stage_v(c)),
    ];
    for (name, of, plain) in contests {
        let mut group = criterion.benchmark_group(format!("stage {name}"));
        for size in &SIZES[..2] {
            let workload = Workload::new(*size);
            let cycle = workload.cycle(Profile::Paper, of);
            let mut memory = Memory::for_cycle(&cycle);
            assert!(memory.check(&cycle).failed_stage.is_none() && plain(&cycle));
            group.bench_function(BenchmarkId::new("mufasa", size.name), |bencher| {
                bencher.iter(|| memory.check(black_box(&cycle)));
            });
            group.bench_function(BenchmarkId::new("plain", size.name), |bencher| {
                bencher.iter(|| plain(black_box(&cycle)));
            });
        }
        group.finish();
    }
}

fn cycles(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("whole cycle");
    for size in SIZES {
        let workload = Workload::new(size);
        for (name, profile) in [("paper", Profile::Paper), ("hardened", Profile::Hardened)] {
            let cycle = workload.cycle(profile, Inputs::Whole);
            let mut memory = Memory::for_cycle(&cycle);
            assert!(memory.check(&cycle).failed_stage.is_none());
            group.bench_function(BenchmarkId::new(name, size.name), |bencher| {
                bencher.iter(|| memory.check(black_box(&cycle)));
            });
        }
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    stages(&mut criterion);
    cycles(&mut criterion);
    criterion.final_summary();
}
