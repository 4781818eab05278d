//! Before the history reaches back no station is asked (MON-43).

use mufasa::input::profile::Profile;
use mufasa::monitor::{Inputs, Monitor, Settings};
use mufasa::offloading::requester::Groups;

use super::kit::{Buffers, MS, Station, World, at, road, route, settings};

/// A cycle of a CAV that saw what is around so long ago, or nothing.
fn look(monitor: &mut Monitor<'_>, now_ns: i64, age_ns: Option<i64>) {
    let world = World::at(now_ns);
    let mut inputs = Inputs::new(at(now_ns), world.ego);
    let seen = age_ns.map(|age_ns| World::at(now_ns - age_ns));
    if let Some(seen) = &seen {
        inputs = inputs.detections(at(seen.now_ns), &seen.detections);
    }
    let (_decision, actions) = monitor.cycle(&inputs);
    assert!(actions.is_empty());
}

/// How many requests a tick sends.
pub fn asked(monitor: &mut Monitor<'_>, now_ns: i64) -> usize {
    let mut station = Station::default();
    station.take(&monitor.offer(at(now_ns), 1, Groups::ALL).expect("a station"));
    station.take(&monitor.tick(at(now_ns)));
    station.asked.len()
}

/// With scans that are 30 ms old the first list reaches back half a second at 470 ms; in the paper profile
/// nothing is kept and nothing is waited for. MON-43, MON-44.
#[test]
fn a_station_is_asked_when_half_a_second_was_seen() {
    let cross_sections = road();
    for (profile, first_ms) in [(Profile::HARDENED, 470), (Profile::PAPER, 0)] {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.monitor(Settings { profile, ..settings() }).expect("a monitor");
        monitor.set_route(&route(&cross_sections)).expect("a route");
        let mut first = None;
        for ms in 0..1_000 {
            let asked = asked(&mut monitor, ms * MS);
            if asked > 0 && first.is_none() {
                assert_eq!(asked, 2);
                first = Some(ms);
            }
            if ms % 100 == 0 {
                look(&mut monitor, ms * MS, Some(30 * MS));
            }
        }
        assert_eq!(first, Some(first_ms), "{profile:?}");
    }
}

/// One list, at the bounds of its age; and none, however long it is waited for.
#[test]
fn a_list_counts_from_500_ms_to_1_s() {
    let cross_sections = road();
    for (age_ns, requests) in
        [(500 * MS - 1, 0), (500 * MS, 2), (1_000 * MS, 2), (1_000 * MS + 1, 0), (-500 * MS, 0)]
    {
        let mut buffers = Buffers::new(16, 40);
        let mut monitor = buffers.started_on(&cross_sections);
        look(&mut monitor, 2_000 * MS, Some(0));
        let now_ns = 2_000 * MS + age_ns;
        assert_eq!(asked(&mut monitor, now_ns), requests, "{age_ns}");
        if requests == 0 {
            assert_eq!(monitor.requester().hold_until_ns(), Some(now_ns + 1));
        }
    }
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.started_on(&cross_sections);
    for ms in (0..5_000).step_by(100) {
        assert_eq!(asked(&mut monitor, ms * MS), 0);
        look(&mut monitor, ms * MS, None);
    }
}
