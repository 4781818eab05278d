//! Corridors: all of a change of lane is in them, nothing that is off the lanelets is.

use std::fmt::Write as _;

use mufasa_drives::{Drive, Options, Tail};
use mufasa_model::input::cycle::{CrossSection, Profile};
use mufasa_model::report::FailedStage;
use mufasa_model::report::Stage;

use super::files::{Scratch, judged, lanelet, one, scenario, shared, vehicle};

type Point = [f64; 2];

/// The right lane: straight along x, 3.5 m to the right of it.
const RIGHT_LANE: [[Point; 3]; 2] =
    [[[0.0, 0.0], [60.0, 0.0], [160.0, 0.0]], [[0.0, -3.5], [60.0, -3.5], [160.0, -3.5]]];

/// The left lane beside it, which leads away from x = 60 on by so much a metre.
fn left_lane(slope: f64) -> [[Point; 3]; 2] {
    let away = 100.0 * slope;
    [[[0.0, 3.5], [60.0, 3.5], [160.0, 3.5 + away]], [[0.0, 0.0], [60.0, 0.0], [160.0, away]]]
}

/// The drive of a car along x at 10 m/s, in these places across the road every metre from x = 31.
fn drive(slope: f64, across: &[f64]) -> Drive {
    on_lanes([RIGHT_LANE, left_lane(slope)], across)
}

fn on_lanes([right, left]: [[[Point; 3]; 2]; 2], across: &[f64]) -> Drive {
    let lane = |id, [left, right]: [[Point; 3]; 2], side: &str, other: u32| {
        let links = format!("<adjacent{side} ref=\"{other}\" drivingDir=\"same\"/>");
        lanelet(id, [&left, &right], &links)
    };
    let places = (31_u32..).zip(across).map(|(x, y)| [f64::from(x), *y, 0.0]);
    let text = scenario(&[
        lane(1, right, "Left", 2),
        lane(2, left, "Right", 1),
        vehicle(7, "car", 10.0, places),
    ]);
    let options = Options { ego: Some(7), tail: Tail::Keep, ..Options::default() };
    one(&[Scratch::new().write("lanes.xml", text)], &options).unwrap()
}

fn sections(drive: &Drive) -> &[CrossSection] {
    &drive.cycles[0].cycle.route.cross_sections
}

/// Points all over the triangles of a corridor, their corners and sides with them; not of those
/// without an area, which join legs that do not connect.
fn corridor(drive: &Drive) -> impl Iterator<Item = Point> + '_ {
    let triangles = sections(drive)
        .windows(2)
        .flat_map(|w| [[w[0].left, w[0].right, w[1].right], [w[0].left, w[1].right, w[1].left]]);
    let area =
        |[a, b, c]: &[Point; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    triangles.filter(move |it| area(it).abs() > 1e-9).flat_map(|[a, b, c]| {
        let shares = (0..=8).flat_map(|i| (0..=8 - i).map(move |j| [i, j, 8 - i - j]));
        shares.map(move |w| {
            let [u, v, w] = w.map(|k: i32| f64::from(k) / 8.0);
            [0, 1].map(|i| u * a[i] + v * b[i] + w * c[i])
        })
    })
}

/// The sharpest turn of a reference path, degrees, and how long its shorter side is there, m.
fn sharpest_turn(drive: &Drive) -> (f64, f64) {
    let ways = sections(drive).windows(2).map(|w| [w[1].x - w[0].x, w[1].y - w[0].y]);
    let ways: Vec<Point> = ways.collect();
    let turn = |w: &[Point]| {
        let (a, b) = (w[0], w[1]);
        let angle = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs();
        (angle.to_degrees(), a[0].hypot(a[1]).min(b[0].hypot(b[1])))
    };
    ways.windows(2).map(turn).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

/// Lines across lanes need not be square to them: then both legs of a change put its middle elsewhere.
#[test]
fn over_a_change_of_lane_the_reference_path_never_turns_back() {
    let across: Vec<f64> =
        (0..60).map(|i| f64::from((i - 19).clamp(0, 15)) * 3.5 / 15.0 - 1.75).collect();
    for skew in [-3.0, -1.0, 0.0, 1.0, 3.0] {
        let skewed = |[left, right]: [[Point; 3]; 2], by: f64| {
            [left.map(|[x, y]| [if x == 60.0 { x + by } else { x }, y]), right]
        };
        let drive = on_lanes([skewed(RIGHT_LANE, skew), skewed(left_lane(0.0), skew)], &across);
        assert!(drive.notes.iter().any(|note| note.contains("1 | lane change | 2")));
        let (turn, side) = sharpest_turn(&drive);
        assert!(turn < 45.0, "{turn:.0} degrees beside {side:.2} m, {skew}");
        no_place_is_outside(&drive);
    }
}

fn no_place_is_outside(drive: &Drive) {
    assert!(!drive.notes.iter().any(|note| note.contains("outside")), "{:?}", drive.notes);
}

#[test]
fn a_state_in_the_next_lane_is_in_the_corridor_though_it_is_the_only_one() {
    // The last one, as where a change of lane begins; then one on the way, and two.
    for (first, last) in [(39, 39), (20, 20), (20, 21), (0, 0)] {
        let mut across = [-1.75; 40];
        across[first..=last].fill(0.02);
        let drive = drive(0.0, &across);
        no_place_is_outside(&drive);
        // In the lane all the time but for that.
        let far = sections(&drive).iter().filter(|it| it.left[1] > 0.1).count();
        assert!(far < sections(&drive).len(), "{far}");
    }
    // A look aside is no change of lane to the reference path.
    let mut across = [-1.75; 40];
    across[20] = 0.02;
    let drive = drive(0.0, &across);
    assert!(sections(&drive).iter().all(|it| (it.y + 1.75).abs() < 1e-9));
}

#[test]
fn between_lanes_that_part_there_is_no_corridor() {
    let slope = 0.2;
    let on_road = |[x, y]: Point| {
        let left = (x - 60.0).max(0.0) * slope;
        let skin = 2e-3;
        (-3.5 - skin..=skin).contains(&y) || (left - skin..=left + 3.5 + skin).contains(&y)
    };
    // Over the gore into the other lane, which is 2 m and more away there.
    let late: Vec<f64> = (0..60).map(|i| f64::from(i - 35).clamp(0.0, 15.0) * 0.5 - 1.75).collect();
    // Into it before the lanes part, and along it.
    let in_time: Vec<f64> = (0..60)
        .map(|i| f64::from(i).min(15.0) * 3.5 / 15.0 - 1.75 + f64::from((i - 29).max(0)) * slope)
        .collect();
    for across in [&late, &in_time] {
        let drive = drive(slope, across);
        assert!(drive.notes.iter().any(|note| note.contains("1 | lane change | 2")));
        if let Some(off) = corridor(&drive).find(|p| !on_road(*p)) {
            panic!("{off:?} is off the road");
        }
        for it in sections(&drive) {
            assert!(
                on_road([it.x, it.y]),
                "the reference path is off the road at {} {}",
                it.x,
                it.y
            );
        }
    }
    no_place_is_outside(&drive(slope, &in_time));
    let note = drive(slope, &late).notes.into_iter().find(|note| note.contains("outside")).unwrap();
    let count: usize = note.split(' ').next().unwrap().parse().unwrap();
    assert!(count >= 3, "{note}");
}

/// Cycles of the paper profile that fail stage ii, of all.
fn off_the_map(scenario: &str, solution: &str) -> [usize; 2] {
    let folder = Scratch::new();
    let options = Options { profile: Profile::PAPER, ..Options::default() };
    let files = [folder.write("scenario.xml", scenario), folder.write("solution.xml", solution)];
    let (checked, all) = judged(one(&files, &options).unwrap());
    assert_eq!(checked.disagreements(), 0);
    let failed = all.iter().map(|it| it.model.as_ref().unwrap().failed_stage);
    let off = failed.clone().filter(|it| *it == Some(FailedStage::Stage(Stage::Ii))).count();
    [off, failed.count()]
}

/// A scenario of the shared recordings and its solution.
fn defect(name: &str) -> Option<[String; 2]> {
    let folder = shared("commonroad-defects")?;
    let text = |end: &str| std::fs::read_to_string(folder.join(format!("{name}{end}"))).unwrap();
    Some([text(".xml"), text(".solution1.KS2.xml")])
}

#[test]
fn recorded_changes_of_lane_are_on_the_map() {
    for name in ["DEU_A9-2_1_T-1", "DEU_Guetersloh-39_5_T-1", "USA_US101-29_1_T-1@2018b"] {
        let Some([scenario, solution]) = defect(name) else { return };
        let [off, all] = off_the_map(&scenario, &solution);
        assert!(off == 0 && all >= 20, "{name}: {off} of {all} cycles fail stage ii");
    }
}

#[test]
fn a_recorded_drive_moved_into_the_gore_is_not_on_the_map() {
    let Some([scenario, solution]) = defect("DEU_Hennigsdorf-13_2_T-1") else { return };
    assert_eq!(off_the_map(&scenario, &solution)[0], 0);
    // 2 m to the left of where it was, with its centre up to 0.44 m off the road.
    let value = |state: &str, name: &str| -> f64 {
        let (_, rest) = state.split_once(&format!("<{name}>")).unwrap();
        rest.split_once('<').unwrap().0.parse().unwrap()
    };
    let mut parts = solution.split("<ksState>");
    let mut moved = parts.next().unwrap().to_owned();
    for state in parts {
        let [x, y, heading] = ["x", "y", "orientation"].map(|name| value(state, name));
        let [x, y] = [x - 2.0 * heading.sin(), y + 2.0 * heading.cos()];
        // Of a value named again the first is read, so the old ones are renamed.
        let old = state.replace("<x>", "<u>").replace("</x>", "</u>");
        let old = old.replace("<y>", "<v>").replace("</y>", "</v>");
        let _ = write!(moved, "<ksState><x>{x}</x><y>{y}</y>{old}");
    }
    let [off, all] = off_the_map(&scenario, &moved);
    assert!(off == all && all == 24, "{off} of {all} cycles fail stage ii");
}
#[test]
fn zz_measure() {
    for folder in
        ["/work/shared/data/commonroad", "/work/shared/data/commonroad-defects", "/tmp/t/scenarios"]
    {
        let mut files: Vec<_> =
            std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
        files.retain(|it| it.extension().is_some_and(|it| it == "xml"));
        files.sort();
        let mut all = mufasa_drives::streams(&files, &Options::default());
        for file in &files {
            let text = std::fs::read_to_string(file).unwrap();
            let ids = text
                .split("<dynamicObstacle id=\"")
                .skip(1)
                .chain(text.split("<obstacle id=\"").skip(1));
            for id in ids.take(60) {
                let ego = id.split('"').next().unwrap().parse().ok();
                let options = Options { ego, tail: Tail::Keep, ..Options::default() };
                all.extend(mufasa_drives::streams(std::slice::from_ref(file), &options));
            }
        }
        for drive in all {
            let Ok(drive) = drive else { continue };
            let changes = drive.notes.iter().any(|it| it.contains("lane change"));
            let ego = drive.notes.iter().find(|it| it.contains("CAV")).cloned().unwrap_or_default();
            let Ok(cycle) = drive.cycle(0) else { continue };
            let name = drive.name.clone();
            let drive = Drive {
                name,
                source: String::new(),
                lead_range_m: 0.0,
                cycles: vec![cycle],
                notes: drive.notes,
            };
            let (turn, side) = sharpest_turn(&drive);
            println!("TURN {} {} {turn:.1} {side:.3} {ego}", drive.name, changes);
        }
    }
}
