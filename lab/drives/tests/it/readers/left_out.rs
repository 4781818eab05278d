//! Lanelets whose bounds are on the wrong sides: a drive that goes elsewhere does without them.

use mufasa_drives::{Drive, Options, ReadError};

use super::files::{self, Scratch, one, own, scenario, shared};

/// A lanelet between two values of x and of y, with what else is in it.
fn lanelet(id: u32, x: [f64; 2], y: [f64; 2], links: &str) -> String {
    let [left, right] = y.map(|y| x.map(|x| [x, y]));
    files::lanelet(id, [&left, &right], links)
}

/// The drive of the small solution, along y = -1.75 from x = 10 to 30, on these lanelets.
fn solved(lanelets: &[String]) -> Result<Drive, ReadError> {
    let folder = Scratch::new();
    let scenario = folder.write("s.xml", scenario(lanelets));
    one(&[scenario, own("readers/small.KS2.solution.xml")], &Options::default())
}

#[test]
fn a_lanelet_on_the_wrong_sides_or_without_area_is_left_out_with_a_note() {
    let road = lanelet(1, [0.0, 120.0], [0.0, -3.5], "");
    let plain = solved(std::slice::from_ref(&road)).unwrap();
    assert!(!plain.notes.iter().any(|note| note.contains("left out")));
    let inverted = lanelet(2, [0.0, 120.0], [3.5, 7.0], "");
    let point = lanelet(3, [60.0, 60.0], [0.0, -3.5], "");
    let drive = solved(&[inverted, point, road]).unwrap();
    assert_eq!(drive.cycles, plain.cycles);
    let note = "2 lanelets left out, whose left bound is not left of the right one: 2 3";
    assert!(drive.notes.iter().any(|it| it == note), "{:?}", drive.notes);
}

/// A lane left of that of the drive, whose bounds are at these y every 20 m.
fn beside(left: &[f64], right: &[f64]) -> String {
    let [left, right] = [left, right].map(|line| {
        let point = |(i, y): (u32, &f64)| [20.0 * f64::from(i), *y];
        (0..).zip(line).map(point).collect::<Vec<_>>()
    });
    files::lanelet(2, [&left, &right], "")
}

/// Bounds that cross and cross back were once taken for those of a road.
#[test]
fn a_lanelet_whose_bounds_swap_on_the_way_is_left_out_from_there() {
    let road = lanelet(1, [0.0, 120.0], [0.0, -3.5], "");
    let notes = |beside: String| {
        let drive = solved(&[road.clone(), beside]).unwrap();
        drive.notes.into_iter().filter(|it| it.contains("left out")).collect::<Vec<_>>()
    };
    let (left, right) = ([3.5, 3.5, 3.5, 0.0, 3.5, 3.5], [0.0, 0.0, 0.0, 3.5, 0.0, 0.0]);
    let swapped = notes(beside(&left, &right));
    let note = "1 lanelet left out, whose left bound is not left of the right one: 2 (segment 2)";
    assert_eq!(swapped, [note]);
    // A lane that begins and ends at a point, with one of its points twice.
    let (left, right) = ([0.0, 3.5, 3.5, 3.5, 0.0, 0.0], [0.0; 6]);
    assert_eq!(notes(beside(&left, &right)), [""; 0]);
}

/// A network with holes is read, and the holes are told.
#[test]
fn a_lanelet_that_leads_to_none_or_to_itself_is_noted() {
    let links = |refs: &[u32]| -> String {
        let link = |it| format!("<successor ref=\"{it}\"/>");
        refs.iter().map(link).collect::<Vec<_>>().concat()
    };
    let inverted = lanelet(2, [0.0, 120.0], [3.5, 7.0], "");
    let of = |refs: &[u32]| {
        let road = lanelet(1, [0.0, 120.0], [0.0, -3.5], &links(refs));
        let behind = lanelet(3, [120.0, 130.0], [0.0, -3.5], &links(&[1]));
        solved(&[road, behind, inverted.clone()]).unwrap()
    };
    let notes = |refs: &[u32]| {
        let all = of(refs).notes.into_iter();
        all.filter(|it| it.contains("successor")).collect::<Vec<_>>()
    };
    assert_eq!(notes(&[3, 2]), [""; 0]);
    let said = "2 successors of lanelets not in this file, or the lanelet itself: 1 -> 99, 1 -> 1";
    assert_eq!(notes(&[3, 99, 1]), [said]);
    assert_eq!(of(&[3, 99, 1]).cycles, of(&[3]).cycles);
}

#[test]
fn a_lanelet_that_the_route_needs_is_refused() {
    let next = "<successor ref=\"3\"/>";
    let before = lanelet(1, [0.0, 20.0], [0.0, -3.5], next);
    let behind = lanelet(4, [20.0, 120.0], [0.0, -3.5], "");
    let needed = |lanelets: &[String]| {
        let error = solved(lanelets).unwrap_err();
        assert_eq!(error.element, "commonRoad/lanelet[3]");
        assert!(error.message.contains("the route leads over this lanelet"), "{error}");
    };
    // The drive is on it and on no other.
    needed(&[before.clone(), lanelet(3, [20.0, 120.0], [-3.5, 0.0], "")]);
    let crossed = beside(&[0.0, 0.0, -3.5, 0.0], &[-3.5, -3.5, 0.0, -3.5]);
    let elsewhere = lanelet(4, [0.0, 120.0], [7.0, 3.5], "");
    let error = solved(&[crossed, elsewhere]).unwrap_err();
    assert_eq!((error.element.as_str(), error.index), ("commonRoad/lanelet[2]", Some(1)));
    // It alone connects the two that the drive is on.
    let point = lanelet(3, [20.0, 20.0], [0.0, -3.5], "<successor ref=\"4\"/>");
    needed(&[before, point.clone(), behind.clone()]);
    // Without it there is another way.
    let both = format!("{next}<successor ref=\"4\"/>");
    let before = lanelet(1, [0.0, 20.0], [0.0, -3.5], &both);
    assert!(solved(&[before, point, behind]).is_ok());
}

#[test]
fn scenarios_with_one_such_lanelet_give_drives() {
    let Some(folder) = shared("commonroad-defects") else { return };
    for name in ["ITA_Foggia-7_2_T-1", "RUS_Bicycle-14_1_T-1@2018b"] {
        let file = |end: &str| folder.join(format!("{name}{end}"));
        let alone = one(&[file(".xml")], &Options::default()).unwrap();
        let solved = one(&[file(".xml"), file(".solution1.KS2.xml")], &Options::default()).unwrap();
        for drive in [alone, solved] {
            assert!(drive.notes[0].starts_with("1 lanelet left out"), "{:?}", drive.notes);
        }
    }
}
