//! Files that are wrong, by one place or by chance.

use mufasa_drives::{Options, ReadError, read};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::files::{Scratch, one, own};

fn text(name: &str) -> String {
    std::fs::read_to_string(own(name)).expect("a file of the crate")
}

/// The error of the small scenario with `from` replaced by `to` at its first place.
fn refused(from: &str, to: &str) -> ReadError {
    let folder = Scratch::new();
    let scenario = text("readers/small-2020a.xml");
    assert!(scenario.contains(from), "{from}");
    let path = folder.write("s.xml", scenario.replacen(from, to, 1));
    one(&[path], &Options::default()).expect_err(to)
}

#[test]
fn a_wrong_value_is_named_with_its_place() {
    let cases = [
        ("2020a\"", "2017a\"", "commonRoad", "commonRoadVersion"),
        ("timeStepSize=\"0.1\"", "timeStepSize=\"0\"", "commonRoad", "timeStepSize"),
        ("<x>60</x>", "<x>nan</x>", "commonRoad/lanelet[1]/leftBound/point/x", ""),
        ("<x>60</x>", "<x>1e12</x>", "commonRoad/lanelet[1]/leftBound/point/x", ""),
        (
            "<y>0</y></point></leftBound>",
            "</point></leftBound>",
            "commonRoad/lanelet[1]/leftBound/point",
            "y",
        ),
        ("<point><x>60</x><y>0</y></point>", "", "commonRoad/lanelet[1]", "leftBound"),
        ("lanelet id=\"2\"", "lanelet id=\"1\"", "commonRoad/lanelet[1]", "id"),
        ("lanelet id=\"2\"", "lanelet id=\"two\"", "commonRoad/lanelet[two]", "id"),
        (
            "<leftBound>",
            "<leftBound><point><x>0</x><y>9</y></point>",
            "commonRoad/lanelet[1]",
            "leftBound",
        ),
        (
            "<length>4</length>",
            "<length>-4</length>",
            "commonRoad/dynamicObstacle[7]/shape/rectangle/length",
            "",
        ),
        ("<radius>0.4</radius>", "", "commonRoad/staticObstacle[9]/shape/circle", "radius"),
        (
            "<velocity><exact>10</exact></velocity>",
            "",
            "commonRoad/dynamicObstacle[7]/initialState",
            "velocity",
        ),
        (
            "<exact>1</exact></time>",
            "<exact>0</exact></time>",
            "commonRoad/dynamicObstacle[7]/trajectory/state",
            "time",
        ),
        (
            "<exact>1</exact></time>",
            "<exact>1.5</exact></time>",
            "commonRoad/dynamicObstacle[7]/trajectory/state/time/exact",
            "",
        ),
        (
            "<exact>1</exact></time>",
            "<intervalStart>1</intervalStart></time>",
            "commonRoad/dynamicObstacle[7]/trajectory/state/time",
            "exact",
        ),
        (
            "<velocity><exact>10</exact></velocity>",
            "<velocity><exact>1.7e7</exact></velocity>",
            "commonRoad/dynamicObstacle[7]/initialState",
            "velocity",
        ),
        ("Obstacle id=\"8\"", "Obstacle id=\"7\"", "commonRoad", "id"),
    ];
    for (from, to, element, field) in cases {
        let error = refused(from, to);
        assert_eq!((error.element.as_str(), error.field.as_str()), (element, field), "{error}");
        assert!(error.line.is_some(), "{error}");
        assert!(error.to_string().contains("s.xml"), "{error}");
    }
}

#[test]
fn bounds_on_the_wrong_sides_are_refused() {
    let swapped = text("readers/small-2020a.xml")
        .replace("leftBound", "bound")
        .replace("rightBound", "leftBound")
        .replace("<bound>", "<rightBound>")
        .replace("</bound>", "</rightBound>");
    let path = Scratch::new();
    let error = one(&[path.write("s.xml", swapped)], &Options::default()).unwrap_err();
    assert!(error.message.contains("not left of"), "{error}");
}

#[test]
fn a_vehicle_or_solution_that_does_not_fit_is_refused() {
    let scenario = own("readers/small-2018b.xml");
    for (id, problem) in [(99, "not in this scenario"), (9, "no recorded trajectory")] {
        let options = Options { ego: Some(id), ..Options::default() };
        let error = one(std::slice::from_ref(&scenario), &options).unwrap_err();
        assert!(error.message.contains(problem), "{error}");
    }
    let folder = Scratch::new();
    let solution = text("readers/small.KS2.solution.xml");
    let cases = [
        ("ZAM_Small", "ZAM_Other", "benchmark_id"),
        ("KS2", "KS4", "benchmark_id"),
        ("KS2:SM1", "KS2", "benchmark_id"),
        ("<time>3</time>", "<time>4</time>", "time"),
    ];
    for (from, to, field) in cases {
        let path = folder.write("o.xml", solution.replacen(from, to, 1));
        let error = one(&[scenario.clone(), path], &Options::default()).unwrap_err();
        assert_eq!(error.field, field, "{error}");
    }
    let mut states = solution.split("<velocity>");
    let (first, second) = (states.next().unwrap(), states.next().unwrap());
    let (_, rest) = solution[first.len() + second.len()..].split_once("</velocity>").unwrap();
    let text = format!("{first}<velocity>{second}<velocity>-150.1</velocity>{rest}");
    let error = one(&[scenario.clone(), folder.write("o.xml", text)], &Options::default());
    let error = error.unwrap_err();
    assert_eq!((error.field.as_str(), error.index), ("velocity", Some(1)), "{error}");
    assert!(error.message.contains("-150.1 m/s is not within +-150 m/s"), "{error}");
    let path = folder.write("o.xml", solution.replace("ksTrajectory", "inputVector"));
    let error = one(&[scenario, path], &Options::default()).unwrap_err();
    assert!(error.message.contains("KS, ST and MB"), "{error}");
}

/// It was once called not well-formed.
#[test]
fn a_document_type_is_refused_as_such_with_what_to_do() {
    let folder = Scratch::new();
    let scenario = text("readers/small-2018b.xml");
    let (declaration, rest) = scenario.split_once("?>").expect("a declaration");
    for kind in ["<!DOCTYPE commonRoad SYSTEM 'commonRoad.dtd'>", "<!DOCTYPE a [<!ENTITY b 'c'>]>"]
    {
        let path = folder.write("s.xml", format!("{declaration}?>\n{kind}{rest}"));
        let error = one(&[path], &Options::default()).unwrap_err();
        assert_eq!(error.line, Some(2));
        assert!(!error.message.contains("well-formed"), "{error}");
        for part in ["document type (`<!DOCTYPE`)", "entities", "remove it"] {
            assert!(error.message.contains(part), "{error}");
        }
    }
}

/// Whoever wrote a value of megabytes knows it, and nobody wants it on a screen.
#[test]
fn a_long_value_is_not_repeated_by_its_refusal() {
    let long = "x7".repeat(5_000_000);
    for (from, to) in [
        ("<x>60</x>", format!("<x>{long}</x>")),
        ("2020a\"", format!("{long}\"")),
        ("timeStepSize=\"0.1\"", format!("timeStepSize=\"{long}\"")),
        ("lanelet id=\"2\"", format!("lanelet id=\"{long}\"")),
        ("<type>car</type>", format!("<type>car</{long}>")),
        ("<rectangle>", format!("<{long}/><rectangle>")),
        ("Obstacle id=\"8\"", format!("Obstacle id=\"{long}\"")),
    ] {
        let error = refused(from, &to);
        assert!(error.to_string().len() < 1200, "{from}: {} bytes", error.to_string().len());
        let text = error.to_string();
        assert!(text.contains("000000 bytes") || text.contains("bytes left out"), "{text}");
    }
    let folder = Scratch::new();
    for line in [
        format!("{{\"kind\": \"{long}\"}}"),
        format!("{{\"kind\": \"cycle\", \"id\": \"{long}\", \"now_ns\": \"{long}\"}}"),
        format!("{{\"kind\": \"cycle\", \"id\": \"x\", \"{long}\": 1}}"),
    ] {
        let path = folder.write("l.jsonl", line);
        let text = one(&[path], &Options::default()).unwrap_err().to_string();
        assert!(text.len() < 1800, "{} bytes", text.len());
    }
}

/// Changes a few bytes of a file, or cuts it off.
fn mutate(rng: &mut ChaCha8Rng, original: &[u8]) -> Vec<u8> {
    let mut bytes = original.to_vec();
    if rng.random_range(0..10) == 0 {
        bytes.truncate(rng.random_range(0..bytes.len()));
        return bytes;
    }
    for _ in 0..rng.random_range(1..6) {
        let at = rng.random_range(0..bytes.len());
        match rng.random_range(0..5) {
            0 => bytes[at] = b"0123456789.-eE<>/\"& "[rng.random_range(0..20)],
            1 => bytes[at] = b"019"[rng.random_range(0..3)],
            2 => drop(bytes.remove(at)),
            3 => {
                let end = (at + rng.random_range(1..200)).min(bytes.len());
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            _ => bytes[at] = rng.next_u32().to_le_bytes()[0],
        }
    }
    bytes
}

/// The text with some of its numbers replaced by others.
fn renumber(rng: &mut ChaCha8Rng, original: &str) -> String {
    const NUMBERS: [&str; 10] = [
        "0",
        "-1",
        "1e300",
        "nan",
        "inf",
        "1e-300",
        "9223372036854775807",
        "16777216",
        "1000000",
        "",
    ];
    let mut out = String::new();
    for (i, part) in original.split('>').enumerate() {
        if i > 0 {
            out.push('>');
        }
        let (value, rest) = part.split_at(part.find('<').unwrap_or(0));
        let replace = !value.trim().is_empty() && rng.random_range(0..60) == 0;
        out.push_str(if replace { NUMBERS[rng.random_range(0..10)] } else { value });
        out.push_str(rest);
    }
    out
}

#[test]
fn no_mutation_makes_the_readers_panic() {
    let folder = Scratch::new();
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let scenario = text("readers/small-2020a.xml");
    let solution = text("readers/small.ST1.solution.xml");
    let (mut read_in_spite, mut refused) = (0, 0);
    for i in 0..1500 {
        let (mut s, mut o) = (scenario.clone().into_bytes(), solution.clone().into_bytes());
        match i % 3 {
            0 => s = mutate(&mut rng, &s),
            1 => o = mutate(&mut rng, &o),
            _ => s = renumber(&mut rng, &scenario).into_bytes(),
        }
        let paths = [folder.write("s.xml", s), folder.write("o.xml", o)];
        let paths = if i % 2 == 0 { &paths[..] } else { &paths[..1] };
        for drive in read(paths, &Options::default()) {
            match drive {
                Ok(_) => read_in_spite += 1,
                Err(error) => {
                    assert!(!error.to_string().is_empty());
                    refused += 1;
                }
            }
        }
    }
    // Both happen, or the mutations are too weak or too strong to say anything.
    assert!(read_in_spite > 100 && refused > 100, "{read_in_spite} read, {refused} refused");
}

#[test]
fn no_mutation_of_a_map_makes_the_reader_panic() {
    let folder = Scratch::new();
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let original = map(40, |i| [f64::from(i) * 3.0, 0.0, 2.0, 2.0, 10.0, 0.0]);
    let (mut read_in_spite, mut refused) = (0, 0);
    for _ in 0..1000 {
        let path = folder.write("m.npy", mutate(&mut rng, &original));
        match one(&[path], &Options::default()) {
            Ok(_) => read_in_spite += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(read_in_spite > 50 && refused > 50, "{read_in_spite} read, {refused} refused");
}

/// A file of control points.
pub fn map(rows: u32, row: impl Fn(u32) -> [f64; 6]) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, 6), }}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).expect("a short header").to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend((0..rows).flat_map(row).flat_map(f64::to_le_bytes));
    bytes
}

#[test]
fn a_wrong_row_of_a_map_is_named() {
    let folder = Scratch::new();
    let path = folder.write(
        "m.npy",
        map(9, |i| {
            let left = if i == 4 { f64::NAN } else { 2.0 };
            [f64::from(i), 0.0, left, 2.0, 10.0, 0.0]
        }),
    );
    let error = one(&[path], &Options::default()).unwrap_err();
    assert_eq!((error.field.as_str(), error.index), ("d_left", Some(4)));
    let point = folder.write("p.npy", map(5, |_| [1.0, 1.0, 2.0, 2.0, 10.0, 0.0]));
    assert!(one(&[point], &Options::default()).unwrap_err().message.contains("two different"));
}

/// A drive too short for a cycle is one error, be it recorded or made up along a map.
#[test]
fn a_drive_without_a_cycle_is_refused() {
    let folder = Scratch::new();
    let row = |i: u32| [f64::from(i) * 1e-9, 0.0, 2.0, 2.0, 10.0, 0.0];
    let tiny = folder.write("tiny.npy", map(2, row));
    let of_map = one(std::slice::from_ref(&tiny), &Options::default()).unwrap_err();
    let fast = text("readers/small-2020a.xml")
        .replace("<velocity><exact>10</exact>", "<velocity><exact>100</exact>");
    let fast = folder.write("fast.xml", fast);
    let options = Options { ego: Some(7), ..Options::default() };
    let recorded = one(std::slice::from_ref(&fast), &options).unwrap_err();
    assert_eq!((&*of_map.file, &*recorded.file), (&*tiny, &*fast));
    assert!(of_map.message.contains("shorter than braking takes"), "{of_map}");
    assert_eq!(of_map.message, recorded.message);
}
