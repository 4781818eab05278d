//! Tracks that nothing was compared with do not come out (MON-02, finding F-18).

use mufasa::input::profile::Profile;
use mufasa::monitor::{Decision, Inputs, Settings};
use mufasa::offloading::requester::{Action, Actions, Group, Source};
use mufasa::report::{Input, Outcome};
use mufasa::services::configuration::Groups;

use super::kit::{Buffers, MS, Station, World, at, look_around, road, route, settings};

/// A cycle every 100 ms with tracking remote, of which some have detections. Whether tracks come out of each; and in
/// which the CAV's own tracking is stopped.
fn tracks_out(profile: Profile, sees: &[Option<i64>]) -> Vec<(bool, bool)> {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, cross_sections.len());
    let mut monitor = buffers.monitor(Settings { profile, ..settings() }).expect("a monitor");
    monitor.set_route(&route(&cross_sections)).expect("a route");
    look_around(&mut monitor, 0, World::at);
    let mut station = Station::default();
    let _none = monitor.area(at(0), Groups::from(Group::Mot));
    let mut ends = Vec::new();
    let stops = |actions: &Actions| actions.contains(&Action::Deactivate(Group::Mot));
    for (i, age_ns) in (0..).zip(sees) {
        let world = World::at(i * 100 * MS);
        let (tracks, _none) = station.period(&mut monitor, &world);
        let now = at(world.now_ns);
        let seen = age_ns.map(|age_ns| World::at(world.now_ns - age_ns));
        let mut inputs = Inputs::new(now, world.ego);
        if let Some(seen) = &seen {
            inputs = inputs.detections(at(seen.now_ns), &seen.detections);
        }
        if let Some(tracks) = &tracks {
            inputs = inputs.remote_tracks(tracks);
        }
        let (decision, actions) = monitor.cycle(&inputs);
        let Decision::Safe { tracks: out, report, .. } = decision else {
            panic!("{i}: {decision:?}");
        };
        let ran = matches!(report.stages, [Outcome::Passed, ..]);
        let blind = matches!(report.stages, [Outcome::NotApplicable(Input::Detections), ..]);
        assert_eq!(
            (ran, blind),
            (tracks.is_some() && out.is_some(), tracks.is_some() && out.is_none())
        );
        assert!(out.is_none_or(|it| it.source() == Source::Remote { station: 1 }));
        ends.push((ran, stops(&actions)));
        station.take(&actions);
    }
    assert_eq!(station.released, 0);
    ends
}

/// MON-02.
#[test]
fn tracks_come_out_only_of_cycles_in_which_they_were_compared() {
    let (now, old, none) = (Some(0), Some(101 * MS), None);
    for profile in [Profile::PAPER, Profile::HARDENED] {
        let ends = tracks_out(profile, &[now, none, old, none, now, none, now]);
        let out: Vec<bool> = ends.iter().map(|it| it.0).collect();
        assert_eq!(out, [false, false, false, false, true, false, true], "{profile:?}");
        // The paper stops them at the confirmation.
        let stopped: Vec<usize> = (0..7).filter(|i| ends[*i].1).collect();
        let hardened: &[usize] = &[4];
        assert_eq!(stopped, if profile == Profile::HARDENED { hardened } else { &[] }, "{ends:?}");
    }
}
