//! A race between programs that answer differently is worth nothing: implementation and peers
//! come to the same verdict on every variant of the workloads.

use mufasa::input::profile::Profile;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;
use mufasa_benches::contestant::Contestant;
use mufasa_benches::peer;
use mufasa_benches::workload::{SIZES, Variant, Workload};

#[test]
fn peers_and_implementation_agree() {
    let fails = Stage::ALL.map(|stage| (Variant::Fail(stage), Some(stage)));
    let others =
        [(Variant::Pass, None), (Variant::Ghost, Some(Stage::I)), (Variant::Drift, Some(Stage::I))];
    for size in &SIZES {
        for (variant, failing) in others.into_iter().chain(fails) {
            let workload = Workload::new(size, variant);
            let cycle = workload.cycle(Profile::PAPER, Configuration::AllRemote);
            let mut it = Contestant::new(&cycle);
            for stage in failing.map_or(Stage::ALL.to_vec(), |stage| vec![stage]) {
                let expected = failing.is_none();
                assert_eq!(it.stage(stage), expected, "{} {variant:?}", workload.name);
                let peers = peer::all(&cycle).into_iter().filter(|peer| peer.stage == stage);
                for mut peer in peers.filter(|peer| !peer.slow || size.number == 1) {
                    assert_eq!((peer.decide)(), expected, "{} {variant:?}", peer.name);
                }
            }
        }
    }
}

#[test]
fn whole_cycles_pass_in_every_configuration_and_profile() {
    for size in &SIZES {
        let workload = Workload::new(size, Variant::Pass);
        for profile in [Profile::PAPER, Profile::HARDENED] {
            for configuration in Configuration::ALL {
                let cycle = workload.cycle(profile, configuration);
                let report = Contestant::new(&cycle).check();
                assert_eq!(report.failed_stage, None, "{} {report:?}", workload.name);
            }
        }
    }
}
