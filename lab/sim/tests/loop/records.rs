//! Recorded cycles are those that the monitor decided.

use mufasa::cycle::check;
use mufasa::input::scratch::{Column, Row, Scratch, Sizes};
use mufasa::services::configuration::Groups;
use mufasa_props::bridge;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::cav::recorder::Share;
use mufasa_sim::experiment::checks::Checks;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Cycle, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;
use mufasa_sim::withheld::Withheld;

use super::drive::FROM;

/// Decides each recorded cycle again, and checks it by the model.
#[derive(Default)]
struct Again {
    cycles: u64,
    recorded: u64,
    failed: u64,
    histories: usize,
    /// Cycles with a grid, with detections, and with a received list without tracks.
    given: [u64; 3],
    checks: Checks,
}

impl Watcher for Again {
    fn cycle(&mut self, _: &Snapshot, _: &Cav<'_>, decided: &Decided, cycle: &Cycle) {
        self.cycles += 1;
        self.checks.see("run", decided);
        let Some(record) = &decided.record else { return };
        self.recorded += 1;
        self.failed += u64::from(cycle.failed > 0);
        self.histories = self.histories.max(record.detection_history.len());
        let received = Some(&record.tracks).filter(|_| cycle.remote & 1 == 1);
        let is_empty = received.is_some_and(|it| it.as_ref().is_some_and(|it| it.items.is_empty()));
        let given = [record.grid.is_some(), record.detections.is_some(), is_empty];
        self.given.iter_mut().zip(given).for_each(|(count, is_it)| *count += u64::from(is_it));
        let owned = bridge::to_impl(record);
        let history = owned.history();
        let mut rows = vec![Row::default(); Sizes::MAX.rows];
        let mut columns = vec![Column::default(); Sizes::MAX.columns];
        let again = check(&owned.borrow(&history), &mut Scratch::new(&mut rows, &mut columns));
        assert_eq!(Some(again), decided.report, "at {} s", cycle.t);
    }
}

fn drive(variant: Variant, kind: Option<Kind>, recorded: Share) -> Again {
    driven(variant, kind, recorded, None)
}

fn driven(
    variant: Variant,
    kind: Option<Kind>,
    recorded: Share,
    withheld: Option<Withheld>,
) -> Again {
    let town = town();
    let route = town.ego_routes().next().expect("a route");
    let scenario = Scenario { time_limit: 25.0, ..Scenario::draw(&town, route, 12, 3) };
    let mut settings = Settings::new(variant, Groups::ALL, 3);
    settings.requester.t_wait_ns = 1_000_000_000;
    settings.attacks = kind.map(|kind| Attack::new(kind, FROM, 1e9, 3)).into_iter().collect();
    (settings.recorded, settings.withheld) = (recorded, withheld);
    let mut again = Again::default();
    simulate(&town, &scenario, &settings, &mut again).expect("settings");
    again
}

#[test]
fn a_recorded_cycle_has_the_report_of_the_monitor_and_conforms_to_the_model() {
    let mut failed = 0;
    for variant in [Variant::Paper, Variant::Hardened] {
        for kind in [None, Some(Kind::EmptyTracks), Some(Kind::Replay), Some(Kind::Delay)] {
            let again = drive(variant, kind, Share::ALL);
            assert!(again.recorded > 100 && again.recorded == again.cycles, "{variant:?} {kind:?}");
            assert_eq!(again.histories, if variant == Variant::Paper { 0 } else { 3 });
            assert_eq!(again.checks.disagreements, [], "{variant:?} {kind:?}");
            assert_eq!((again.checks.decided, again.checks.checked), (again.cycles, again.cycles));
            failed += again.failed;
            if kind == Some(Kind::EmptyTracks) {
                what_is_withheld_is_in_no_cycle(variant, again.given);
            }
        }
    }
    assert!(failed > 5, "there were verdicts to compare: {failed}");
}

/// The monitor does not get it, and neither does the record. `given`: where nothing is withheld.
fn what_is_withheld_is_in_no_cycle(variant: Variant, [grids, detections, empty]: [u64; 3]) {
    assert!(grids > 100 && detections > 100 && empty > 5, "{variant:?}");
    for (withheld, none) in [
        (Withheld::Grid, [true, false, false]),
        (Withheld::Detections, [false, true, false]),
        (Withheld::EmptyLists, [false, false, true]),
    ] {
        let again = driven(variant, Some(Kind::EmptyTracks), Share::ALL, Some(withheld));
        assert_eq!(again.checks.disagreements, [], "{variant:?} {withheld:?}");
        assert!(again.checks.checked > 100, "{variant:?} {withheld:?}");
        for (given, is_none) in again.given.iter().take(2).zip(none) {
            assert_eq!(*given == 0, is_none, "{variant:?} {withheld:?} {:?}", again.given);
        }
        assert!(!none[2] || again.given[2] == 0, "{variant:?} {:?}", again.given);
    }
}

#[test]
fn a_share_is_recorded_from_its_first_on() {
    let again = drive(Variant::Hardened, None, Share { every: 10, first: 23 });
    assert_eq!(again.recorded, (again.cycles - 3).div_ceil(10));
    assert_eq!(again.checks.checked, again.recorded);
    assert_eq!(drive(Variant::Hardened, None, Share::default()).recorded, 0);
    assert_eq!(drive(Variant::Sofof, None, Share::ALL).recorded, 0, "nothing is checked");
}
