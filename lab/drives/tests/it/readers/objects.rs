//! Attacks on single objects, on detectors and on steps: each changes what it says, nothing else.

use mufasa_drives::{Attack, Drive, InjectError, Injection, Options};
use mufasa_model::input::cycle::{Cycle, Track};

use super::files::{crossed, demo, inject};

/// A cycle of the drive, clean and half a second into the attack.
fn both(drive: &Drive, attack: Attack) -> [Cycle; 2] {
    let injection = Injection { attack, from_s: 3.0, to_s: 4.0 };
    let attacked = inject(drive, &injection).expect("the attack changes something");
    [drive, &attacked].map(|it| it.cycles[35].cycle.clone())
}

fn tracks(cycle: &Cycle) -> &[Track] {
    &cycle.tracks.as_ref().expect("tracks").items
}

/// The tracks that differ, clean and attacked; the lists have the same ids in the same order.
fn changed([clean, attacked]: &[Cycle; 2]) -> Vec<[Track; 2]> {
    let ids = |cycle: &Cycle| tracks(cycle).iter().map(|it| it.id).collect::<Vec<_>>();
    assert_eq!(ids(clean), ids(attacked));
    let pairs = tracks(clean).iter().cloned().zip(tracks(attacked).iter().cloned());
    pairs.filter(|(a, b)| a != b).map(|(a, b)| [a, b]).collect()
}

/// Both with the velocity of the first.
fn without_velocity([clean, attacked]: &[Track; 2]) -> [Track; 2] {
    [clean.clone(), Track { vx: clean.vx, vy: clean.vy, ..attacked.clone() }]
}

fn near(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9
}

fn past(track: &Track, velocity: [f64; 2]) -> [f64; 2] {
    [track.x - velocity[0] / 2.0, track.y - velocity[1] / 2.0]
}

#[test]
fn a_missing_track_is_the_same_one_in_every_cycle() {
    let clean = demo(&Options::default());
    let injection = Injection { attack: Attack::MissingTrack, from_s: 3.0, to_s: 4.0 };
    let attacked = inject(&clean, &injection).unwrap();
    for i in 30..=40 {
        let [kept, all] = [&attacked, &clean].map(|it| tracks(&it.cycles[i].cycle).to_vec());
        // The car ahead, of six.
        let expected: Vec<_> = all.iter().filter(|it| it.id != 30).cloned().collect();
        assert_eq!((kept.len() + 1, &kept), (all.len(), &expected), "{i}");
    }
}

#[test]
fn crossing_traffic_stands_and_other_traffic_drives_on() {
    let pair = both(&crossed(demo(&Options::default())), Attack::CrossingStands);
    let changed = changed(&pair);
    let [one] = &changed[..] else { panic!("{changed:?}") };
    let [clean, attacked] = one;
    assert_eq!((clean.id, attacked.vx.abs() + attacked.vy.abs()), (50, 0.0));
    let [clean, attacked] = without_velocity(one);
    assert_eq!(clean, attacked);
    // Without any there is nothing to change, and the CAV keeps to its recording.
    let injection = Injection { attack: Attack::CrossingStands, from_s: 3.0, to_s: 4.0 };
    let none = inject(&demo(&Options::default()), &injection).unwrap_err();
    assert!(matches!(none, InjectError::Unchanged { .. }), "{none}");
}

#[test]
fn exchanged_pasts_are_those_of_the_other() {
    let changed = changed(&both(&demo(&Options::default()), Attack::ExchangedPasts));
    let [one, other] = &changed[..] else { panic!("{changed:?}") };
    for (this, that) in [(one, other), (other, one)] {
        assert!(near(
            past(&this[1], [this[1].vx, this[1].vy]),
            past(&that[0], [that[0].vx, that[0].vy])
        ));
        let [clean, attacked] = without_velocity(this);
        assert_eq!(clean, attacked);
    }
}

#[test]
fn a_taken_past_is_that_of_one_left_out() {
    let [clean, attacked] = both(&demo(&Options::default()), Attack::TakenPast);
    let left: Vec<_> = tracks(&attacked).iter().map(|it| it.id).collect();
    let out: Vec<_> = tracks(&clean).iter().filter(|it| !left.contains(&it.id)).collect();
    let [other] = &out[..] else { panic!("{out:?}") };
    let kept: Vec<Track> = tracks(&clean).iter().filter(|it| it.id != other.id).cloned().collect();
    let lies: Vec<_> = kept.iter().zip(tracks(&attacked)).filter(|(a, b)| a != b).collect();
    let [(truth, lie)] = &lies[..] else { panic!("{lies:?}") };
    let [clean, attacked] = without_velocity(&[(*truth).clone(), (*lie).clone()]);
    assert_eq!(clean, attacked);
    assert!(near(past(lie, [lie.vx, lie.vy]), past(other, [other.vx, other.vy])));
}

#[test]
fn a_velocity_bias_is_along_the_velocity() {
    let pair = both(&demo(&Options::default()), Attack::VelocityBias);
    let moves = |it: &&Track| it.vx.hypot(it.vy) >= 1.0;
    assert_eq!(changed(&pair).len(), tracks(&pair[0]).iter().filter(moves).count());
    for pair in changed(&pair) {
        let [clean, attacked] = &pair;
        let added = [attacked.vx - clean.vx, attacked.vy - clean.vy];
        assert!((added[0].hypot(added[1]) - 3.0).abs() < 1e-9, "{added:?}");
        assert!((added[0] * clean.vy - added[1] * clean.vx).abs() < 1e-9);
        assert!(added[0] * clean.vx + added[1] * clean.vy > 0.0);
        let [clean, attacked] = without_velocity(&pair);
        assert_eq!(clean, attacked);
    }
}

#[test]
fn a_past_ghost_stands_where_another_was() {
    let [clean, attacked] = both(&demo(&Options::default()), Attack::PastGhost);
    let (ghost, rest) = tracks(&attacked).split_last().unwrap();
    assert_eq!(rest, tracks(&clean));
    assert_eq!((ghost.id, ghost.vx.abs() + ghost.vy.abs()), (-4, 0.0));
    let left = |it: &&Track| near(past(it, [it.vx, it.vy]), [ghost.x, ghost.y]);
    assert_eq!(rest.iter().find(left).map(|it| it.id), Some(30));
    assert_eq!(Cycle { tracks: clean.tracks.clone(), ..attacked }, clean);
}

#[test]
fn blind_detectors_saw_what_they_saw_before() {
    let [clean, attacked] = both(&demo(&Options::default()), Attack::BlindDetectors);
    assert!(tracks(&attacked).is_empty());
    let scans = |cycle: &Cycle| {
        let lists = cycle.detections.iter().chain(&cycle.detection_history);
        lists.map(|it| (it.stamp_ns, it.items.is_empty())).collect::<Vec<_>>()
    };
    // 0.5 s into the attack: the present scan and those of 0.3 and 0.5 s ago.
    let expected = scans(&clean).into_iter().zip([true, true, true, false]);
    assert_eq!(scans(&attacked), expected.map(|((at, _), blind)| (at, blind)).collect::<Vec<_>>());
    assert!(scans(&clean).iter().all(|(_, is_empty)| !is_empty));
    assert_eq!(attacked.detection_history[2], clean.detection_history[2]);
}

#[test]
fn a_slide_keeps_times_and_headings() {
    let [clean, attacked] = both(&demo(&Options::default()), Attack::Slide);
    let [c, a] = [&clean, &attacked].map(|it| &it.trajectory.as_ref().unwrap().points);
    assert_eq!((a.len(), &a[0]), (c.len(), &c[0]));
    let mut last = 0.0;
    for (a, c) in a.iter().zip(c).skip(1) {
        let [x, y] = [a.x - c.x, a.y - c.y];
        let left = y * c.cos - x * c.sin;
        assert!((x.hypot(y) - left).abs() < 1e-9 && left < 1.4 + 1e-9, "{left}");
        assert!(left > last - 1e-9 && left - last <= clean.ego.width / 2.0, "{left}");
        assert_eq!(
            (a.t_ns, a.cos.to_bits(), a.sin.to_bits()),
            (c.t_ns, c.cos.to_bits(), c.sin.to_bits())
        );
        last = left;
    }
    assert!((last - 1.4).abs() < 1e-9);
    assert_eq!(Cycle { trajectory: clean.trajectory.clone(), ..attacked }, clean);
}

#[test]
fn the_notes_say_what_the_cav_would_drive_into() {
    let note = |drive: &Drive| drive.notes.iter().find(|it| it.contains("the CAV meets")).cloned();
    let clean = demo(&Options::default());
    let attacked = |text: &str| inject(&clean, &text.parse().unwrap()).unwrap();
    let found = note(&attacked("empty-tracks@2..")).expect("a collision with the car ahead");
    assert!(found.starts_with("the CAV meets object 30 at 1"), "{found}");
    assert_eq!((note(&clean), note(&attacked("ghost-tracks@2.."))), (None, None));
}
