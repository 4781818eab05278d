//! Which recorded vehicle is the CAV, and of which edition of a scenario a solution is.

use mufasa_drives::{Drive, Options, ReadError, Tail};

use super::files::{self, Scratch, lanelet, one, scenario, shared, small};

/// A vehicle with 31 states a tenth of a second apart, from x = 10 on along y = -1.75, at this
/// speed; `change` gives the x of a step.
fn vehicle(id: u32, kind: &str, speed: f64, change: impl Fn(u32, f64) -> f64) -> String {
    let x = |step| change(step, 10.0 + speed * f64::from(step) / 10.0);
    files::vehicle(id, kind, speed, (0..31).map(|step| [x(step), -1.75, 0.0]))
}

fn as_driven(_: u32, x: f64) -> f64 {
    x
}

/// The drive of a recorded one of these vehicles on a straight lane.
fn drive(vehicles: &[String], options: &Options) -> Result<Drive, ReadError> {
    let lane = lanelet(1, [&[[0.0, 0.0], [200.0, 0.0]], &[[0.0, -3.5], [200.0, -3.5]]], "");
    let text = scenario(&[&[lane], vehicles].concat());
    one(&[Scratch::new().write("s.xml", text)], options)
}

fn has(drive: &Drive, note: &str) -> bool {
    drive.notes.iter().any(|it| it.starts_with(note))
}

#[test]
fn a_vehicle_whose_recording_jumps_is_passed_over() {
    let corrupt = |step: u32, x: f64| if step == 20 { 200_865.4 } else { x };
    let vehicles = [vehicle(1, "car", 9.0, corrupt), vehicle(2, "car", 5.0, as_driven)];
    let picked = drive(&vehicles, &Options::default()).unwrap();
    assert!(has(&picked, "CAV: recorded car 2 (picked)"), "{:?}", picked.notes);
    let note = "vehicles passed over, whose recordings have a gap or jump by more than 100 m/s: 1";
    assert!(has(&picked, note), "{:?}", picked.notes);
    // Who asks for it gets it, and is told.
    let asked = drive(&vehicles, &Options { ego: Some(1), ..Options::default() }).unwrap();
    assert!(has(&asked, "its recording jumps"), "{:?}", asked.notes);
    // Below the bound, 9 m in a step, it is driving.
    let fast = |step: u32, x: f64| if step > 20 { x + 8.0 } else { x };
    let vehicles = [vehicle(1, "car", 9.0, fast), vehicle(2, "car", 5.0, as_driven)];
    let picked = drive(&vehicles, &Options::default()).unwrap();
    assert!(has(&picked, "CAV: recorded car 1 (picked)"), "{:?}", picked.notes);
}

#[test]
fn a_car_is_picked_before_any_other_vehicle() {
    let motorcycle = vehicle(1, "motorcycle", 9.0, as_driven);
    let car = vehicle(2, "car", 5.0, as_driven);
    let picked = drive(&[motorcycle.clone(), car], &Options::default()).unwrap();
    assert!(has(&picked, "CAV: recorded car 2 (picked)"), "{:?}", picked.notes);
    assert!(!has(&picked, "no car"), "{:?}", picked.notes);
    let picked = drive(&[motorcycle], &Options::default()).unwrap();
    assert!(has(&picked, "CAV: recorded motorcycle 1 (picked)"), "{:?}", picked.notes);
    assert!(has(&picked, "no car could be picked, so that the CAV is a motorcycle"));
}

#[test]
fn keeping_the_tail_does_not_change_the_vehicle() {
    // With its tail car 7 goes farther.
    for tail in [Tail::Stop, Tail::Keep] {
        let picked = small("2020a", None, &Options { tail, ..Options::default() });
        assert!(has(&picked, "CAV: recorded car 8 (picked)"), "{:?}", picked.notes);
    }
    let Some(folder) = shared("commonroad-defects") else { return };
    let file = folder.join("BEL_Zwevegem-5_2_T-1.xml");
    let [stop, keep] = [Tail::Stop, Tail::Keep].map(|tail| {
        let options = Options { tail, ..Options::default() };
        one(std::slice::from_ref(&file), &options).unwrap().notes[0].clone()
    });
    assert!(stop.starts_with("CAV: recorded car") && stop == keep, "{stop}, {keep}");
}

#[test]
fn a_refusal_names_the_option_that_helps() {
    let asked = |id, vehicles: &[String]| {
        let options = Options { ego: id, ..Options::default() };
        drive(vehicles, &options).unwrap_err().message
    };
    let beside = vehicle(1, "car", 5.0, |_, x| x + 500.0);
    assert!(asked(None, std::slice::from_ref(&beside)).contains("--ego ID"));
    assert!(asked(Some(7), &[beside]).contains("--ego ID"));
    assert!(asked(None, &[vehicle(1, "bicycle", 5.0, as_driven)]).contains("no vehicle with a"));
    assert!(asked(None, &[vehicle(1, "car", 60.0, as_driven)]).contains("--keep-tail"));
}

#[test]
fn a_solution_of_another_version_of_the_scenario_is_noted() {
    let note = "the solution is of version `2020a`, the scenario of `2018b`";
    assert!(has(&small("2018b", Some("KS2"), &Options::default()), note));
    let same = small("2020a", Some("KS2"), &Options::default());
    assert!(!has(&same, "the solution is of"), "{:?}", same.notes);
}
