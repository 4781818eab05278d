//! Files that can be read only once, and packed files.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use flate2::Compression;
use flate2::write::GzEncoder;
use mufasa_drives::{Drive, Options, read};
use mufasa_records::cycle_to_line;
use mufasa_records::lines::MAX_LINE_BYTES;

use super::broken::map;
use super::files::{Scratch, one, own, small};

/// A named pipe that gives the content to whoever opens it first.
fn pipe(folder: &Scratch, name: &str, content: Vec<u8>) -> PathBuf {
    let path = folder.write(name, "");
    fs::remove_file(&path).expect("the file is ours");
    let made = Command::new("mkfifo").arg(&path).status().expect("mkfifo is there");
    assert!(made.success());
    let end = path.clone();
    // The writing ends early, and the test fails, where the reader goes away before the end.
    thread::spawn(move || fs::write(end, content));
    path
}

fn packed(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(content).expect("memory can be written");
    encoder.finish().expect("memory can be written")
}

/// The small drive as JSON Lines; the first ends with the byte of that number.
fn lines(first_end: usize) -> (Drive, Vec<u8>) {
    let drive = small("2018b", Some("KS2"), &Options::default());
    let mut drive = Drive { cycles: drive.cycles[..3].to_vec(), ..drive };
    for cycle in &mut drive.cycles {
        cycle.cycle.grid = None;
        cycle.cycle.route.cross_sections.truncate(4);
        cycle.cycle.trajectory.as_mut().expect("a trajectory").points.truncate(4);
        cycle.cycle.detection_history.clear();
    }
    let line = |index: usize| cycle_to_line(&drive.cycles[index].id, &drive.cycles[index].cycle);
    let missing = first_end.checked_sub(line(0).len() + 1).expect("a longer first line");
    drive.cycles[0].id.push_str(&"x".repeat(missing));
    let line = |index: usize| cycle_to_line(&drive.cycles[index].id, &drive.cycles[index].cycle);
    let text = [line(0), line(1), line(2)].join("\n") + "\n";
    assert_eq!(text.find('\n'), Some(first_end - 1));
    (drive, text.into_bytes())
}

/// The first bytes of a pipe were once read to put files in order, and then gone.
#[test]
fn a_pipe_is_read_whole_even_where_its_first_line_ends_at_byte_4096() {
    let folder = Scratch::new();
    for end in [4000, 4095, 4096, 4097] {
        let (drive, text) = lines(end);
        let alone = pipe(&folder, &format!("alone-{end}"), text.clone());
        assert_eq!(one(&[alone], &Options::default()).unwrap().cycles, drive.cycles, "{end}");
        let among = pipe(&folder, &format!("among-{end}"), text);
        let drives = read(&[own("demo/urban.xml"), among], &Options::default());
        assert_eq!(drives[1].as_ref().unwrap().cycles, drive.cycles, "{end}");
    }
}

#[test]
fn a_solution_finds_its_scenario_through_pipes() {
    let folder = Scratch::new();
    let from = |name: &str, file: &str| {
        pipe(&folder, name, fs::read(own(file)).expect("a file of the crate"))
    };
    let scenario = from("scenario", "readers/small-2018b.xml");
    let solution = from("solution", "readers/small.KS2.solution.xml");
    let through = one(&[solution, scenario], &Options::default()).unwrap();
    let plain = small("2018b", Some("KS2"), &Options::default());
    assert!(through.cycles.iter().map(|c| &c.cycle).eq(plain.cycles.iter().map(|c| &c.cycle)));
}

#[test]
fn packed_files_give_the_drives_of_what_is_in_them() {
    let folder = Scratch::new();
    let gz = |name: &str, content: &[u8]| folder.write(name, packed(content));
    let own = |name: &str| fs::read(own(name)).expect("a file of the crate");
    let scenario = gz("small-2018b.xml.gz", &own("readers/small-2018b.xml"));
    let solution = gz("small.KS2.solution.xml.gz", &own("readers/small.KS2.solution.xml"));
    let drive = one(&[solution, scenario], &Options::default()).unwrap();
    let plain = small("2018b", Some("KS2"), &Options::default());
    assert_eq!((&drive.name, &drive.cycles), (&plain.name, &plain.cycles));
    let (recorded, text) = lines(4096);
    let drive = one(&[gz("cycles.jsonl.gz", &text)], &Options::default()).unwrap();
    assert_eq!((drive.name.as_str(), drive.cycles), ("cycles", recorded.cycles));
    let road = map(40, |i| [f64::from(i) * 3.0, 0.0, 2.0, 2.0, 10.0, 0.0]);
    let drive = one(&[gz("m.control_points.npy.gz", &road)], &Options::default()).unwrap();
    assert_eq!(drive.name, "m");
    let piped = pipe(&folder, "packed", packed(&text));
    assert_eq!(one(&[piped], &Options::default()).unwrap().cycles.len(), 3);
}

/// Each was once the end of the whole file.
#[test]
fn a_line_that_is_too_long_or_no_text_is_named_and_the_others_are_read() {
    let folder = Scratch::new();
    let (drive, text) = lines(4096);
    let mut lines: Vec<&[u8]> = text.split(|byte| *byte == b'\n').collect();
    let long = b"{".repeat(MAX_LINE_BYTES + 1);
    lines.insert(1, &long);
    lines.insert(3, b"{\"id\": \"\xff\"}");
    let content = lines.join(&b'\n');
    for path in [folder.write("plain", &content), pipe(&folder, "piped", content.clone())] {
        let mut drives = read(&[path], &Options::default());
        assert_eq!(drives.pop().unwrap().unwrap().cycles, drive.cycles);
        let error = drives.pop().unwrap().unwrap_err();
        assert_eq!(error.line, Some(2));
        let said = "is longer than 67108864 bytes; a record of a cycle is shorter: if the line holds several, \
                    write each on a line of its own";
        assert_eq!(error.message, said);
        let other = &error.others.unwrap().errors[0];
        assert_eq!(
            (other.line, other.message.contains("is not UTF-8")),
            (Some(4), true),
            "{other}"
        );
    }
}

/// What is in a file of that content, as far as its refusal says.
fn refused(folder: &Scratch, content: &[u8]) -> String {
    let path: &Path = &folder.write("f", content);
    let error = one(&[path.to_owned()], &Options::default()).unwrap_err();
    assert_eq!(&*error.file, path);
    error.message
}

#[test]
fn other_formats_are_told_what_to_do() {
    let folder = Scratch::new();
    let utf_16: Vec<u8> = "\u{feff}<a/>".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let scenario = fs::read_to_string(own("readers/small-2018b.xml")).unwrap();
    let latin = [scenario.as_bytes(), b"<!-- J\xfcrgen -->"].concat();
    let cases: [(&[u8], &str); 10] = [
        (b"", "neither XML nor JSON Lines"),
        (b"hello", "neither XML nor JSON Lines"),
        (b"<svg/>", "is neither `commonRoad` nor `CommonRoadSolution`"),
        (b"<commonRoad", "cut off"),
        (b"PK\x03\x04\x14\x00", "unpack it"),
        (&packed(&packed(b"<a/>")), "unpack it"),
        (&utf_16, "iconv -f UTF-16"),
        (b"[{\"kind\": \"cycle\"}]", "jq -c"),
        (b"\x80\x81\x82", "no format that is read"),
        (&latin, "XML that is not UTF-8"),
    ];
    for (content, advice) in cases {
        let message = refused(&folder, content);
        assert!(message.contains(advice), "{advice}: {message}");
    }
    // Records behind a byte order mark or a blank.
    let (drive, text) = lines(4096);
    for before in ["\u{feff}", " "] {
        let path = folder.write("marked", [before.as_bytes(), &text].concat());
        assert_eq!(one(&[path], &Options::default()).unwrap().cycles, drive.cycles);
    }
}

#[test]
fn a_folder_is_refused_with_what_to_name() {
    assert!(one(&[own("no such file")], &Options::default()).is_err());
    let message = one(&[own("readers")], &Options::default()).unwrap_err().message;
    assert!(message.ends_with("name the files in it, such as FOLDER/*.xml"), "{message}");
}

#[test]
fn a_vehicle_that_is_named_beside_a_solution_is_noted() {
    let ego = |ego| {
        let notes = small("2018b", Some("KS2"), &Options { ego, ..Options::default() }).notes;
        notes.iter().filter(|note| note.contains("--ego 7 is not used")).count()
    };
    assert_eq!([ego(None), ego(Some(7))], [0, 1]);
}
