//! What the monitor notices of a vehicle's program and says once (`spec/4-arithmetic.md#advice`).

use mufasa::monitor::{Advice, Decision, Gap, GridMap, Inputs};

use super::kit::{Buffers, MS, World, at, road};

/// From the front of the CAV to the back of the car ahead, m.
const GAP: f64 = 25.0 - 2.25 - (1.4 + 2.25);

/// What a program gives of a time.
struct Given {
    now_ns: i64,
    world: World,
    gap: f64,
    lead_speed: f64,
    /// Ages of detections, lead and grid.
    ages_ns: [i64; 3],
    is_ticked: bool,
}

impl Given {
    fn right(now_ns: i64) -> Self {
        let (world, ages_ns) = (World::at(now_ns), [20 * MS; 3]);
        Self { now_ns, world, gap: GAP, lead_speed: 5.0, ages_ns, is_ticked: true }
    }
}

/// What is told of 8 s with a cycle at each of these times, of which each is given as `slip` has it. Verdicts are those of
/// what is given, advice or not.
fn told(times: impl Iterator<Item = i64>, slip: fn(&mut Given)) -> Vec<Advice> {
    let (cross_sections, mut buffers, mut told) = (road(), Buffers::new(16, 40), Vec::new());
    let mut monitor = buffers.started_on(&cross_sections);
    let bits = [0; 8];
    for now_ns in times {
        let mut given = Given::right(now_ns);
        slip(&mut given);
        let [seen, lead, mapped] = given.ages_ns.map(|age_ns| at(given.now_ns - age_ns));
        let (x, y, cos, sin, resolution) = (given.world.ego.x, -50.0, 1.0, 0.0, 0.2);
        let (width, height, occupied, unknown) = (8, 8, &bits[..], None);
        let map = GridMap { x, y, cos, sin, resolution, width, height, occupied, unknown };
        let inputs = Inputs::new(at(now_ns), given.world.ego)
            .detections(seen, &given.world.detections)
            .lead(lead, Gap::between_bumpers(given.gap), given.lead_speed)
            .grid(mapped, map);
        if given.is_ticked {
            let _actions = monitor.tick(at(now_ns));
        }
        assert!(matches!(monitor.cycle(&inputs).0, Decision::Safe { .. }), "{now_ns}");
        told.extend(monitor.advice());
        assert_eq!(monitor.advice(), None, "one a cycle, and each once");
    }
    told
}

/// At 10 Hz, as declared.
fn drive(slip: fn(&mut Given)) -> Vec<Advice> {
    told((0..80).map(|i| 100 * i * MS), slip)
}

/// IMPL-16: nothing is said of a drive that is as it should be, with jitter, a lost cycle, a pause, and a lead that changes.
#[test]
fn a_clean_drive_gets_no_advice() {
    assert_eq!(drive(|_| {}), []);
    assert_eq!(told((0..80).map(|i| (100 * i + 30 * (i % 2)) * MS), |_| {}), []);
    let lossy =
        (0..80).filter(|i| i % 4 != 0).map(|i| (100 * i + if i > 40 { 3000 } else { 0 }) * MS);
    assert_eq!(told(lossy, |_| {}), []);
    // Cars cut in and leave, one every two seconds, 10 m nearer or farther.
    assert_eq!(drive(|it| it.gap += if it.now_ns / (2000 * MS) % 2 == 0 { 10.0 } else { 0.0 }), []);
    // A lead that gets away while no cycle comes for 0.8 s, again and again.
    let pauses = (0..50).map(|i| (1200 * (i / 5) + 100 * (i % 5)) * MS);
    assert_eq!(told(pauses, |it| it.gap += (ns(it) / 1.2e9).floor() * 4.0), []);
    // Nothing is compared with what may stand, nor with a car beside the way or one that crosses.
    let slow = |it: &mut Given| {
        (it.world.ego.speed, it.lead_speed, it.gap) = (1.0, 1.0, GAP + 4.5);
    };
    assert_eq!(drive(slow), []);
    let lead_slow = |it: &mut Given| (it.lead_speed, it.gap) = (2.0, GAP + 4.5);
    assert_eq!(drive(lead_slow), drive(|it| it.lead_speed = 2.0));
    let cav_slow = |it: &mut Given| (it.world.ego.speed, it.gap) = (2.0, GAP + 4.5);
    assert_eq!(drive(cav_slow), drive(|it| it.world.ego.speed = 2.0));
    let beside =
        |it: &mut Given| it.world.add([it.world.ego.x + 22.0, 2.0], [1.0, 0.0], [5.0, 0.0]);
    assert_eq!(drive(beside), []);
    let across =
        |it: &mut Given| it.world.add([it.world.ego.x + 22.0, 0.0], [0.0, 1.0], [5.0, 0.0]);
    assert_eq!(drive(across), []);
    // The gap is that to the nearest of those ahead: not to one beyond it, nor to one behind the CAV.
    let several = |it: &mut Given| {
        it.world.add([it.world.ego.x + 40.0, 0.0], [1.0, 0.0], [5.0, 0.0]);
        it.world.add([it.world.ego.x - 12.0, 0.0], [1.0, 0.0], [5.0, 0.0]);
    };
    assert_eq!(drive(several), []);
    // The lead is another one than the car that is detected ahead.
    let leaving = |it: &mut Given| (it.gap, it.lead_speed) = (GAP + 1.0 + 1.5e-9 * ns(it), 6.5);
    assert_eq!(drive(leaving), []);
    // It is followed at 3 m/s more, and less.
    assert_eq!(drive(|it| (it.gap, it.lead_speed) = (30.0 + 3e-9 * ns(it), 8.0)), []);
    assert_eq!(drive(|it| (it.gap, it.lead_speed) = (60.0 - 3e-9 * ns(it), 2.0)), []);
}

fn ns(given: &Given) -> f64 {
    f64::from(i32::try_from(given.now_ns / MS).expect("seconds")) * 1e6
}

/// IMPL-16, IMPL-17: a period that is not the one declared, and every second cycle left out.
#[test]
fn another_period_than_declared_is_told_once() {
    assert_eq!(told((0..400).map(|i| 1000 * i * MS / 50), |_| {}), [Advice::Period]);
    assert_eq!(
        told((0..80).filter(|i| i % 2 == 0).map(|i| 100 * i * MS), |_| {}),
        [Advice::Period]
    );
}

/// IMPL-16: long and short intervals in turn have no period; four long ones and one short one do not add up, and the first
/// cycle has no interval.
#[test]
fn intervals_that_do_not_agree_are_no_other_period() {
    let mixed = (0..80).map(|i| (200 * i - 150 * (i / 5)) * MS);
    assert_eq!(told(mixed, |_| {}), []);
    let late = |cycles: i64| (0..cycles).map(|i| (60_000 + 200 * i) * MS);
    assert_eq!(told(late(12), |_| {}), []);
    assert_eq!(told(late(13), |_| {}), [Advice::Period]);
}

/// IMPL-16, IMPL-17: stamps of another clock, for example, so that nothing is current.
#[test]
fn what_is_never_current_is_told_once() {
    assert_eq!(drive(|it| it.ages_ns[0] = 101 * MS), [Advice::DetectionsNotCurrent]);
    assert_eq!(drive(|it| it.ages_ns[1] = 101 * MS), [Advice::LeadNotCurrent]);
    assert_eq!(drive(|it| it.ages_ns[1] = -MS), [Advice::LeadNotCurrent]);
    assert_eq!(drive(|it| it.ages_ns[2] = 5000 * MS), [Advice::GridNotCurrent]);
}

/// IMPL-16, IMPL-17: a loop that never ticks; one that ticks every second cycle is told nothing.
#[test]
fn a_loop_without_ticks_is_told_once() {
    assert_eq!(drive(|it| it.is_ticked = false), [Advice::NoTick]);
    assert_eq!(drive(|it| it.is_ticked = it.now_ns % (200 * MS) == 0), []);
}

/// IMPL-16, IMPL-17, IMPL-18: km/h, and a speed relative to the CAV; each cycle stays safe.
#[test]
fn a_speed_of_the_lead_that_its_gap_contradicts_is_told_once() {
    assert_eq!(drive(|it| it.lead_speed *= 3.6), [Advice::LeadSpeed]);
    assert_eq!(drive(|it| it.lead_speed = 0.0), [Advice::LeadSpeed]);
    // Two windows are not enough: the first second of a lead agrees.
    let two = |it: &mut Given| {
        it.lead_speed = if (1050..3050).contains(&(it.now_ns / MS)) { 0.0 } else { 5.0 };
    };
    assert_eq!(drive(two), []);
    let three = |it: &mut Given| {
        it.lead_speed = if (1050..4050).contains(&(it.now_ns / MS)) { 0.0 } else { 5.0 };
    };
    assert_eq!(drive(three), [Advice::LeadSpeed]);
    // Nothing is told of a lead that touches the CAV.
    assert_eq!(drive(|it| (it.gap, it.lead_speed) = (0.0, 20.0)), []);
}

/// IMPL-16, IMPL-17: between centres, from the reference point; detections of half the size, and a `center_offset` of 0 with the
/// rear axle.
#[test]
fn a_gap_that_the_detection_ahead_contradicts_is_told_once() {
    assert_eq!(drive(|it| it.gap += 4.5), [Advice::GapTooLong]);
    assert_eq!(drive(|it| it.gap += 1.4 + 2.25), [Advice::GapTooLong]);
    assert_eq!(
        drive(|it| it.world.detections.iter_mut().for_each(|it| it.length *= 0.5)),
        [Advice::GapTooShort]
    );
    assert_eq!(drive(|it| it.world.ego.center_offset = 0.0), [Advice::GapTooShort]);
    // "By the same" is by that of the first of these cycles, not of one before a cycle that agreed.
    let anew = |it: &mut Given| {
        it.gap = match it.now_ns / (100 * MS) {
            0 => GAP + 1.2,
            1 => GAP,
            2 => GAP + 1.4,
            odd if odd % 2 == 1 => GAP + 1.15,
            _ => GAP + 1.65,
        };
    };
    assert_eq!(drive(anew), [Advice::GapTooLong]);
}
