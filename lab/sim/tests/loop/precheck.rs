//! A station that asks before it sends, and a planner of the CAV that does (`spec/5-interfaces.md#precheck`).

use mufasa::services::configuration::Groups;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::watch::Watch;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Settings, simulate};
use mufasa_sim::scenario::Scenario;

use super::drive::FROM;

/// Alarms, and cycles with all that is offered remote, in six drives of 40 s, none of which fails.
fn drives(
    variant: Variant,
    offers: Groups,
    prechecks: bool,
    attack: Option<Kind>,
) -> (u64, u64, u64) {
    let town = town();
    let (mut alarms, mut remote, mut detected) = (0, 0, 0);
    for (route, seed) in [0, 1].into_iter().flat_map(|route| [0, 1, 2].map(|seed| (route, seed))) {
        let index = town.ego_routes().nth(route).expect("a route");
        let scenario = Scenario { time_limit: 40.0, ..Scenario::draw(&town, index, 15, seed) };
        let mut settings = Settings { prechecks, ..Settings::new(variant, offers, seed) };
        settings.attacks.extend(attack.map(|kind| Attack::new(kind, FROM, 1e9, seed)));
        let mut watch = Watch::new(FROM, &[]);
        let outcome = simulate(&town, &scenario, &settings, &mut watch).expect("settings");
        assert!(outcome.with.is_none(), "{variant:?} {route} {seed}: {outcome:?}");
        let [mot, plan] = outcome.offloaded;
        remote += if offers == Groups::ALL { watch.both } else { mot.max(plan) };
        alarms += watch.fallbacks;
        detected += u64::from(watch.first.is_some());
    }
    (alarms, remote, detected)
}

/// PRE-02, PRE-05.
#[test]
fn who_asks_is_turned_down_less_and_computes_more() {
    for variant in [Variant::Paper, Variant::Hardened] {
        for offers in [Groups::ALL, Groups { mot: false, plan: true }] {
            let [(alarms, remote, _), (before, less, _)] =
                [true, false].map(|prechecks| drives(variant, offers, prechecks, None));
            println!(
                "{variant:?} {offers:?}: {before} -> {alarms} alarms, {less} -> {remote} cycles"
            );
            // What stays in the hardened profile: `docs/evaluation.md#precheck`.
            let most = if variant == Variant::Paper { before / 2 } else { before };
            assert!(alarms < most, "{variant:?} {offers:?}: {before} -> {alarms} alarms");
            assert!(remote > less, "{variant:?} {offers:?}: {less} -> {remote} cycles");
        }
    }
}

/// PRE-09, PRE-10: with remote tracks alone it is the CAV's own planner that asks.
#[test]
fn the_own_planner_asks_beside_remote_tracks() {
    for variant in [Variant::Paper, Variant::Hardened] {
        let offers = Groups { mot: true, plan: false };
        let [(alarms, remote, _), (before, less, _)] =
            [true, false].map(|prechecks| drives(variant, offers, prechecks, None));
        println!("{variant:?}: {before} -> {alarms} alarms, {less} -> {remote} cycles");
        assert!(alarms < before && remote > less, "{variant:?}: {before} -> {alarms} alarms");
    }
}

/// PRE-11: an attack comes after it, and is found as without.
#[test]
fn an_attack_comes_after_it_and_is_found() {
    for kind in [Kind::GhostTracks, Kind::WrongMap] {
        let [(_, _, with), (_, _, without)] =
            [true, false].map(|asks| drives(Variant::Hardened, Groups::ALL, asks, Some(kind)));
        println!("{kind:?}: found in {without} -> {with} runs");
        // Where nobody asks, a false alarm counts, too.
        assert!(with >= 5, "{kind:?}: found in {without} -> {with} runs");
    }
}
