//! Attacks on time: what ends them.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::run::{Cycle, Watcher};
use mufasa_sim::snapshot::Snapshot;

use super::drive::{FROM, drive};

#[derive(Default)]
struct Cycles(Vec<(Cycle, u64)>);

impl Watcher for Cycles {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        self.0.push((*cycle, cav.counts.ended));
    }
}

/// Of the cycles from 1 s after the attack's start: those with something remote, sessions that ended other than by a
/// verdict, and where cycles failed.
fn seen(variant: Variant, kind: Option<Kind>, scenario: (usize, u64)) -> (f64, u64, Vec<u8>) {
    let (_, Cycles(cycles)) = drive::<Cycles>(variant, kind, scenario, 20.0);
    let before = cycles.iter().rfind(|it| it.0.t < FROM).expect("a cycle").1;
    let from: Vec<_> = cycles.iter().filter(|it| it.0.t >= FROM + 1.0).collect();
    let remote = from.iter().filter(|it| it.0.remote != 0).count();
    let failed = from.iter().filter(|it| it.0.failed != 0);
    let ended = from.last().expect("a cycle").1 - before;
    (remote as f64 / from.len() as f64, ended, failed.map(|it| it.0.failed).collect())
}

/// No stage finds what is late or silent. What is stamped ahead by 1 s is current a second later, once, if its session
/// has not ended by then: stage i looks at it.
#[test]
fn quality_of_service_ends_what_is_late_or_silent_and_the_monitor_what_is_stamped_ahead() {
    for scenario in [(0, 0), (1, 1)] {
        for variant in Variant::ALL {
            let (clean, ..) = seen(variant, None, scenario);
            assert!(clean > 0.9, "{variant:?} {scenario:?}: {clean}");
            for kind in [Kind::HeldBack, Kind::Silent, Kind::StampsAhead] {
                let (remote, ended, failed) = seen(variant, Some(kind), scenario);
                let at = format!("{variant:?} {} {scenario:?}", kind.name());
                println!("{at}: {:.0} %, {ended} ended, failed {failed:?}", 100.0 * remote);
                let most: &[u8] = if kind == Kind::StampsAhead { &[1] } else { &[] };
                assert!(failed.is_empty() || failed == most, "{at}: {failed:?}");
                match (variant, kind) {
                    // SOFOF asks no stamp.
                    (Variant::Sofof, Kind::StampsAhead) => {
                        assert!(remote > 0.9 && ended == 0, "{at}");
                    }
                    // It asks again at once; the monitor waits (F-43).
                    (Variant::Sofof, _) => assert!(remote < 0.7 && ended > 50, "{at}"),
                    _ => assert!(remote < 0.11 && ended > 2, "{at}"),
                }
            }
        }
    }
}
