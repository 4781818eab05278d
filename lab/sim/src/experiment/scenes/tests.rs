use super::*;

const SEED: u64 = 7;

fn options(profile: Variant) -> Options {
    Options { profile, tau_s: crate::vehicle::TAU_S, seed: SEED, only: Vec::new(), wrong: None }
}

fn made(profile: Variant, count: u64) -> Scenes {
    let mut made = Scenes::nothing(options(profile));
    made.add(count, &|| ());
    made
}

fn numbered(count: u64) -> impl Iterator<Item = Scene> {
    (0..count).map(|number| Scene::new(SEED, number))
}

#[test]
fn without_a_monitor_they_meet_where_they_are_aimed() {
    let parameters = options(Variant::Sofof).parameters();
    let is_aimed = |it: &Scene| (it.kinds.side, it.kinds.drive) == (Side::Crossing, Drive::Keeps);
    let (mut scenes, mut hits) = (0, 0);
    for scene in numbered(1500).filter(is_aimed) {
        let driven =
            drive(&scene, Profile::PAPER, parameters, Brake::ASSUMED, &mut |_: &Cycle<'_>| None);
        assert_eq!(driven.hit, driven.hit_going_on);
        scenes += 1;
        hits += usize::from(driven.hit.is_some_and(|it| (it.t_s - scene.meeting).abs() < 2.0));
    }
    assert!(scenes > 20 && 2 * hits > scenes, "{hits} of {scenes}");
}

#[test]
fn a_brake_from_the_start_avoids_what_is_avoidable() {
    let parameters = options(Variant::Sofof).parameters();
    let alarm = Alarm { stage: "all", rule: "" };
    let mut avoidable = 0;
    for scene in numbered(200) {
        let on =
            drive(&scene, Profile::PAPER, parameters, Brake::ASSUMED, &mut |_: &Cycle<'_>| None);
        let braked =
            drive(&scene, Profile::PAPER, parameters, Brake::ASSUMED, &mut |_: &Cycle<'_>| {
                Some(alarm)
            });
        assert_eq!(braked.rejected, Some((0.0, alarm)));
        assert_eq!((braked.hit, braked.failed()), (on.hit_at_once, None));
        avoidable += usize::from(on.is_avoidable() && braked.hit.is_none());
    }
    assert!(avoidable > 40, "{avoidable}");
}

#[test]
fn a_seed_gives_the_same_twice_and_another_seed_does_not() {
    let text = |of: &Scenes| serde_json::to_string(of).expect("JSON");
    let [once, again] = [(); 2].map(|()| made(Variant::Hardened, 60));
    assert_eq!(text(&once), text(&again));
    let other = Options { seed: SEED + 1, ..once.options.clone() };
    assert_ne!(once.options.run(3), other.run(3));
    assert_eq!(once.options.records(3), again.options.records(3));
}

#[test]
fn batches_go_on_where_the_last_one_ended() {
    let mut parts = Scenes::nothing(options(Variant::Paper));
    parts.add(20, &|| ());
    parts.add(20, &|| ());
    assert_eq!(parts, made(Variant::Paper, 40));
}

#[test]
fn the_paper_profile_lets_avoidable_collisions_happen_and_the_hardened_one_fewer() {
    let [paper, hardened] = [Variant::Paper, Variant::Hardened].map(|it| made(it, 200));
    let [of_paper, of_hardened] = [&paper, &hardened].map(|it| it.failures().count());
    assert!(of_paper > 10 && of_hardened < of_paper, "{of_paper}, {of_hardened}");
    let run = paper.failures().next().expect("a collision");
    let records = paper.options.records(run.scene);
    let last = run.rejected_s.or(run.collided_s).expect("an end");
    #[expect(clippy::cast_precision_loss, reason = "few cycles")]
    let cycles = records.lines().count() as f64;
    assert!((cycles * 0.1 - last).abs() < 0.11, "{cycles} cycles, {last} s");
}

#[test]
fn every_cycle_is_valid_and_only_what_is_asked_for_is_made() {
    let mut made = Scenes::nothing(Options {
        only: vec!["all-remote/old".to_owned(), "/turns".to_owned()],
        ..options(Variant::Hardened)
    });
    made.add(30, &|| ());
    let is_asked =
        |it: &Run| (it.remote, it.shift, it.motion) == (Remote::All, Shift::Old, Motion::Turns);
    assert!(made.runs.len() == 30 && made.runs.iter().all(is_asked));
    let runs = self::made(Variant::Hardened, 200).runs;
    let is_invalid =
        |it: &Run| it.rejected_by.as_ref().is_some_and(|by| by == "invalid" || by == "input");
    assert!(!runs.iter().any(is_invalid));
    assert!(runs.iter().any(|it| it.rejected_s.is_some()));
}

/// The largest error of an axis costs collisions, or alarms where lists contradict each other; no error changes nothing.
#[test]
fn an_assumption_that_does_not_hold_costs_collisions_or_alarms_and_none_costs_nothing() {
    let of = |wrong| {
        let mut made = Scenes::nothing(Options { wrong, ..options(Variant::Hardened) });
        made.add(400, &|| ());
        made.rows.swap_remove(0)
    };
    let as_assumed = of(None);
    for axis in Axis::ALL {
        assert_eq!(of(Some(Wrong { axis, size: 0.0 })), as_assumed, "{axis:?}");
        let far = of(Some(Wrong { axis, size: axis.sizes()[5] }));
        // Of these two most scenes are rejected, because lists contradict each other.
        let is_seen = matches!(axis, Axis::Pose | Axis::Clock);
        let [before, after] =
            [&as_assumed, &far].map(|it| if is_seen { it.alarms } else { it.collided });
        assert!(after > before, "{axis:?}: {far:?}");
    }
}
