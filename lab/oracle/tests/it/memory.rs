//! How much memory the program takes for large files, as the system says: see `NOT RUN` where it does not.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::kit::folder;
use flate2::Compression;
use flate2::write::GzEncoder;
use mufasa_model::input::cycle::Profile;
use mufasa_records::cycle_to_line;

/// Bytes of a line; the cycle takes a few of them, and blanks the rest.
const LINE: usize = 200_000;
/// What ten times as many lines may take more, bytes; they are 36 MB longer.
const MORE: u64 = 4_000_000;

/// Bytes of memory at the highest, of `mufasa check` with these arguments, all of whose cycles can be judged;
/// `None` where the system has no `/proc`. `input` is what standard input is.
fn peak(arguments: &[&OsStr], input: Stdio) -> Option<u64> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.arg("check").args(arguments);
    let mut child = command.stdin(input).stdout(Stdio::null()).spawn().expect("the program starts");
    let status = format!("/proc/{}/status", child.id());
    let mut peak = None;
    let code = loop {
        // Of the highest so far, so that the last look counts.
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<u64>().ok());
        peak = kilobytes.map(|it| it * 1024).or(peak);
        if let Some(code) = child.try_wait().expect("it can be waited for") {
            break code;
        }
        thread::sleep(Duration::from_millis(1));
    };
    assert!(matches!(code.code(), Some(0 | 1)), "{code}: {arguments:?}");
    if peak.is_none() {
        // The macros' output is captured, and nobody would see it.
        let line = b"NOT RUN: peaks of memory: there is no VmHWM in /proc\n";
        std::io::stderr().write_all(line).expect("standard error can be written");
    }
    peak
}

/// Cycles as JSON Lines.
fn lines(count: u32) -> Vec<u8> {
    let line = |index| {
        let line = cycle_to_line(&format!("c-{index}"), &crate::common::cycle(index % 100, false));
        format!("{line}{}\n", " ".repeat(LINE - line.len()))
    };
    (0..count).map(line).collect::<String>().into_bytes()
}

fn packed(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(content).expect("memory can be written");
    encoder.finish().expect("memory can be written")
}

#[test]
fn ten_times_as_many_cycles_take_no_more_memory() {
    let folder = folder("cycles");
    for (kind, pack) in [("jsonl", <[u8]>::to_vec as fn(&[u8]) -> Vec<u8>), ("gz", packed)] {
        let [few, many] = [20, 200].map(|count| {
            let file = folder.join(format!("{count}.{kind}"));
            fs::write(&file, pack(&lines(count))).expect("it can be written");
            file
        });
        let pipe = |file: &Path| Stdio::from(File::open(file).expect("it was written"));
        let summary = OsStr::new("--summary");
        let from_file = |file: &Path| peak(&[summary, file.as_os_str()], Stdio::null());
        let from_stdin = |file: &Path| peak(&[summary, OsStr::new("-")], pipe(file));
        for way in [&from_file as &dyn Fn(&Path) -> Option<u64>, &from_stdin] {
            let (Some(few), Some(many)) = (way(&few), way(&many)) else { return };
            assert!(many < few + MORE, "{kind}: {few} and {many} bytes");
        }
    }
}

/// As [`crate::common::cycle`], later and later, and quick to judge: every third is unsafe.
fn small(index: u32) -> String {
    let mut cycle = crate::common::cycle(index, index.is_multiple_of(3));
    cycle.profile = Profile::PAPER;
    cycle.route.cross_sections.truncate(6);
    cycle.trajectory.iter_mut().for_each(|it| it.points.truncate(8));
    cycle_to_line(&format!("c-{index}"), &cycle) + "\n"
}

/// Every cycle without wait starts the next, so that each unsafe one has a line of its own in the report.
const NO_WAIT: &str = "t_wait_ns = 0\nmax_age_ns = 100000000\n";

/// What is kept of a cycle was once 2.7 kB, which large lines do not show.
#[test]
fn thirty_times_as_many_small_cycles_take_no_more_memory() {
    let folder = folder("small");
    let parameters = folder.join("no-wait.toml");
    fs::write(&parameters, NO_WAIT).expect("it can be written");
    let [few, many] = [1_000, 30_000].map(|count| {
        let file = folder.join(format!("{count}.jsonl"));
        fs::write(&file, (0..count).map(small).collect::<String>()).expect("it can be written");
        file
    });
    let given = [OsStr::new("--parameters"), parameters.as_os_str()];
    for format in [&["--json"][..], &[], &["--summary", "--inject", "late@0.."]] {
        let of = |file: &Path| {
            let format = format.iter().map(OsStr::new);
            let arguments: Vec<_> =
                given.into_iter().chain(format).chain([file.as_os_str()]).collect();
            peak(&arguments, Stdio::null())
        };
        let (Some(few), Some(many)) = (of(&few), of(&many)) else { return };
        assert!(many < few + MORE, "{format:?}: {few} and {many} bytes");
    }
}

/// A road of short lanelets, each between four points.
fn scenario(lanelets: usize) -> String {
    let points = |x: usize, y: &str| {
        let point = |x| format!("<point><x>{x}.25</x><y>{y}</y></point>");
        format!("{}{}", point(x), point(x + 1))
    };
    let lanelet = |id: usize| {
        let (left, right) = (points(id, "0.0"), points(id, "-3.5"));
        format!(
            "<lanelet id=\"{id}\"><leftBound>{left}</leftBound><rightBound>{right}</rightBound>\
             <predecessor ref=\"{}\"/><successor ref=\"{}\"/></lanelet>\n",
            id.wrapping_sub(1),
            id + 1
        )
    };
    let head = "<commonRoad benchmarkID=\"ZAM_Small-1_1_T-1\" commonRoadVersion=\"2020a\" \
                timeStepSize=\"0.1\">\n";
    let all: String = (1..=lanelets).map(lanelet).collect();
    format!("{head}{all}</commonRoad>\n")
}

#[test]
fn a_map_takes_three_times_its_file_at_most() {
    let folder = folder("map");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../drives/data/readers");
    let solution = data.join("small.KS2.solution.xml");
    let of = |lanelets| {
        let file = folder.join(format!("{lanelets}.xml"));
        fs::write(&file, scenario(lanelets)).expect("it can be written");
        let size = fs::metadata(&file).expect("it was written").len();
        let arguments = [OsStr::new("--summary"), file.as_os_str(), solution.as_os_str()];
        peak(&arguments, Stdio::null()).map(|peak| (peak, size))
    };
    let (Some((base, _)), Some((peak, size))) = (of(200), of(60_000)) else { return };
    assert!(peak - base < 3 * size, "{peak} bytes, {base} without, for {size}");
}
