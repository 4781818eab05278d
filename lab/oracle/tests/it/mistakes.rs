//! What is said of mistakes on the command line: bad files, arguments and parameters, outputs that nobody reads.

use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::net::TcpListener;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::kit::{Said, first_record, folder, lines, mufasa, said, small, with_input, write};

#[test]
fn every_kind_of_bad_file_is_named_and_the_others_are_still_checked() {
    let folder = folder("bad");
    let good = lines(&folder, "good", 2, &[1]);
    let bad = [
        folder.join("missing.xml").display().to_string(),
        folder.display().to_string(),
        write(&folder, "empty", ""),
        write(&folder, "binary", [0_u8, 255, 254, 0, 7]),
        write(&folder, "text", "hello"),
        write(&folder, "cut.xml", "<commonRoad><lanelet"),
        write(&folder, "other.xml", "<html/>"),
        write(&folder, "cut.jsonl", "{\"kind\": \"cycle\""),
        write(&folder, "other.jsonl", "{\"kind\": \"cycle\", \"id\": \"x\", \"speed\": 1}"),
        write(&folder, "cut.npy", b"\x93NUMPY\x01\x00"),
    ];
    for file in &bad {
        mufasa(&["check", file, &good]).has(2, "2 cycles, AllRemote, hardened: 1 safe", file);
    }
    let all: Vec<_> = ["check", "--summary"].into_iter().chain(bad.iter().map(|s| &**s)).collect();
    let told = mufasa(&all);
    assert_eq!((told.code, told.err.lines().count()), (Some(2), bad.len()));
    // JSON in one array is named so, names in brackets are not.
    let told = |text: &str| mufasa(&["check", &write(&folder, "brackets", text)]).err;
    assert!(told("[{}]").contains("one JSON array") && !told("[stages]\n").contains("array"));
    // Files are counted, and not their lines.
    let wrong = write(&folder, "wrong.jsonl", "{}\n".repeat(30));
    let told = mufasa(&["check", &wrong]);
    told.has(2, "1 file with something that could not be read", "and 20 more lines");
    assert_eq!(told.err.lines().count(), 11, "{}", told.err);
    // A file that is called as one of JSON Lines is read so, whatever its first line is.
    let first = write(&folder, "first.jsonl", format!("xx\n{}\n{{}}\n", first_record()));
    let told = mufasa(&["check", &first]);
    told.has(2, "2 lines left out, which are no cycles", "first.jsonl:1");
    assert!(told.err.contains("first.jsonl:3"), "{}", told.err);
    assert!(told.err.lines().all(|line| line.starts_with("mufasa: ")), "{}", told.err);
}

/// A solution that cannot be read does not make another vehicle the CAV.
#[test]
fn a_broken_solution_is_no_reason_to_drive_another_way() {
    let folder = folder("broken-solution");
    let [scenario, solution] = small();
    let whole = fs::read_to_string(&solution).expect("it is there");
    let half = &whole[..whole.len() / 2];
    let cut = write(&folder, "cut.xml", half);
    let told = mufasa(&["check", &scenario, &cut]);
    told.has(2, "", &format!("cut.xml:{}: cut off: it ends here", half.lines().count()));
    assert!(told.out.starts_with("no drive; "), "{}", told.out);
    // A file that is not there comes between a scenario and its solution.
    let told = mufasa(&["check", &scenario, "gone.xml", &solution]);
    told.has(2, "8 cycles", "");
    assert!(!told.err.contains("no scenario") && !told.err.contains("left out"), "{}", told.err);
    for other in ["gone.xml", &write(&folder, "p.toml", "tau = 0.25")] {
        let told = mufasa(&["check", &scenario, other]);
        told.has(2, "", "behind it cannot be read and may be its solution");
        assert!(told.out.starts_with("no drive; "), "{}", told.out);
    }
}

/// A picture shows a cycle that a stage fails.
#[test]
fn without_a_picture_it_is_said_why() {
    let folder = folder("no-picture");
    let [scenario, solution] = small();
    let pictures = folder.join("pictures").display().to_string();
    let told = mufasa(&["check", &scenario, &solution, "--svg", &pictures]);
    told.has(0, "8 cycles", "no picture: each shows a cycle that a stage fails");
}

#[test]
fn arguments_that_make_no_sense_are_refused_with_their_limits() {
    let behind =
        "the program under test stands behind `--`: mufasa conform [OPTIONS] -- COMMAND...";
    let two = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/services/composition.jsonl");
    let place = env!("CARGO_TARGET_TMPDIR");
    for (arguments, limits) in [
        (&["nonsense"][..], "unrecognized subcommand"),
        (&["check"], "required"),
        (&["check", "x", "--profile", "soft"], "hardened"),
        (&["check", "x", "--configuration", "Remote"], "AllRemote"),
        (
            &["check", "x", "--horizon", "-1"],
            "'-1' for '--horizon <S>': must be a number from 0.1 to 60",
        ),
        (&["check", "x", "--sensor-range", "nan"], "must be a number from 0 to 10000"),
        (&["check", "x", "--sensor-probability", "1.5"], "must be a number from 0 to 1"),
        (&["check", "x", "--track-age", "-3"], "must be a whole number from 0 to 1000"),
        (&["check", "x", "--grid-width", "1.5"], "must be a whole number from 1 to 4096"),
        (&["check", "x", "--ego", "99999999999999999999"], "must be a whole number"),
        (&["check", "x", "--inject", "nothing"], "nothing"),
        (&["check", "x", "--inject", "wrong-map@3..2"], "3"),
        (&["check", "x", "--json", "--summary"], "cannot be used with"),
        (&["check", "-q", "-v", "x"], "cannot be used with"),
        (&["check", "x", "--parameters", "gone.toml"], "gone.toml: cannot be read"),
        (&["conform", "--seed", "-7", "--", "x"], "must be a whole number from 0 to "),
        (&["conform", "--time-limit", "0", "--", "x"], "must be a whole number from 1 to 3600000"),
        (&["conform", "python3", "x.py"], behind),
        (&["conform", "--cases", "20", "./x"], behind),
        (&["conform"], behind),
        (&["evaluate", "--scenarios", "0"], "must be a whole number from 1 to 10000"),
        (&["evaluate", "replay", "--route", "2"], "must be a whole number from 0 to 1"),
        (&["compose"], "required"),
        (&["compose", "gone"], "gone: cannot be read"),
        (&["compose", two], "one record is composed"),
        // What cannot be written or read is refused before the work.
        (&["vehicle", "--json", place], "it is a folder; name a file"),
        (&["station", "--broker", "amqp://127.0.0.1:1", "--json", place], "it is a folder"),
        (&["prove", "--out", place, "z3"], "it is a folder"),
        (&["prove", "--cbmc", "gone", "z3"], "gone: is not there; scripts/prove-wasm writes"),
        (&["evaluate", "replay", "--out", place], "it is a folder"),
    ] {
        let told = mufasa(arguments);
        told.has(2, "", limits);
        assert!(told.out.is_empty(), "{arguments:?}");
    }
    for arguments in
        [&["conform", "--cases", "x", "--", "y"][..], &["check", "--wrong"], &["conform", "merge"]]
    {
        let told = mufasa(arguments).err;
        assert!(!told.contains(behind), "{arguments:?}: {told}");
    }
}

/// Nothing is made, and no file is left.
#[test]
fn a_document_without_the_place_is_refused_first() {
    let folder = folder("no-place");
    write(&folder, "page.md", "# A page\n");
    for arguments in [&["explore", "--out", "tables"][..], &["prove", "--out", "prove.json"]] {
        for file in ["page.md", "gone.md"] {
            let told = said(&folder, &[arguments, &["--into", file]].concat());
            told.has(2, "", "");
            let words = format!("mufasa: {file}: no table can be put there: ");
            assert!(told.out.is_empty() && told.err.starts_with(&words), "{}", told.err);
        }
    }
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
}

/// The file's errors are tested where it is read.
#[test]
fn parameters_are_read_and_what_is_odd_about_them_is_told() {
    let folder = folder("parameters");
    let blocked = lines(&folder, "good", 3, &[1]);
    let of = |line: &str| write(&folder, "p.toml", line);
    let file = of("t_wait_ns = 100_000_000\n");
    mufasa(&["check", &blocked, "--parameters", &file]).has(1, "wait until 0.2 s", "");
    let file = of("theta_tr = 0.2\n\ntheta_tracks_max = 2.0\n");
    let wrong = ":3: theta_tracks_max: is no parameter; is theta_track_max meant?";
    mufasa(&["check", "x", "--parameters", &file]).has(2, "", wrong);
    let given = File::open(&file).expect("written");
    with_input(&["check", "x", "--parameters", "-"], given).has(
        2,
        "",
        &format!("mufasa: -{wrong}"),
    );
    for (line, said) in [
        ("# a_b = 6", "p.toml: no parameter in it; the defaults hold (a line is `name = value`)"),
        ("t_wait_ns = 10", "t_wait_ns = 10 ns is below 1 s; is it in another unit?"),
        ("l_max_ns = 50", "l_max_ns = 50 ns is below 1 ms"),
        ("max_age_ns = 40_000_000", "max_age_ns = 40000000 is below "),
    ] {
        let told = mufasa(&["check", "--summary", &blocked, "--parameters", &of(line)]);
        told.has(1, "", said);
        let refuses = told.err.contains("p.toml: a vehicle's monitor refuses this: ");
        assert_eq!(refuses, !line.starts_with('#'), "{}", told.err);
    }
    for line in ["t_wait_ns = 1_000_000_000", "t_wait_ns = 0", "dt_max_ns = 100_000_000"] {
        let told = mufasa(&["check", "--summary", &blocked, "--parameters", &of(line)]);
        assert_eq!(told.err, "", "{line}");
    }
}

/// What the CAV needs to brake is the vehicle's, and follows from the period of its cycles.
#[test]
fn a_tau_that_the_vehicle_raises_is_told() {
    let (folder, [scenario, _]) = (folder("tau"), small());
    let told = |tau: &str, profile: &str| {
        let file = write(&folder, "p.toml", format!("tau = {tau}\ndt_max_ns = 150_000_000\n"));
        let told = mufasa(&["vehicle", &scenario, "--parameters", &file, "--profile", profile]).out;
        assert!(told.contains("checked and safe"), "{told}");
        told.lines().find(|line| line.contains("tau")).map(str::to_owned)
    };
    let raised = "tau is 0.25 s, not 0.2 s: at least 2.5 periods, of 100 ms here (A-07 of docs/assumptions.md)";
    assert_eq!(told("0.2", "hardened").as_deref(), Some(raised));
    assert_eq!(told("0.25", "hardened"), None);
    // No rule of the paper has a tau.
    assert_eq!(told("0.2", "paper"), None);
}

/// Records name the parameters of their stages; those of the requester are the file's. It is said in every format.
#[test]
fn options_that_change_nothing_are_said() {
    let folder = folder("ignored");
    let mut cycle = first_record();
    let lines = [0, 1, 2].map(|index: i64| {
        cycle["now_ns"] = (1_000_000_000 + index * 100_000_000).into();
        cycle.to_string()
    });
    let file = write(&folder, "drive.jsonl", lines.join("\n"));
    let stages = write(&folder, "stages.toml", "theta_tr = 0.3\ndt_max_ns = 150_000_000\n");
    let requester = write(&folder, "requester.toml", "dt_max_ns = 150_000_000\n");
    for format in [&[][..], &["--summary"], &["--json"]] {
        for (more, is_said) in [
            (["--sensor-range", "20"], true),
            (["--profile", "paper"], true),
            (["--sensor-range", "80"], false),
        ] {
            let told = mufasa(&[&["check", &file][..], format, &more].concat()).out;
            assert_eq!(told.contains("options of recorded drives"), is_said, "{told}");
        }
    }
    for (more, is_said) in [
        (&["--parameters", &stages][..], true),
        (&["--profile", "paper"], true),
        (&["--parameters", &requester], false),
        (&[], false),
    ] {
        let told = mufasa(&[&["vehicle", &file], more].concat());
        let words = "each cycle has its own profile, configuration and parameters";
        assert_eq!(
            (told.code == Some(2), told.err.contains(words)),
            (false, is_said),
            "{}",
            told.err
        );
    }
}

/// A reader that goes away ends the program quietly, and a full disk with a word; what writes completions would panic.
#[test]
fn outputs_that_nobody_reads_or_that_are_full_end_it() {
    let file = lines(&folder("pipe"), "a", 300, &[]);
    for arguments in [&["check", "--json", &file][..], &["completions", "bash"]] {
        let ended = |output: Stdio| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
            let command = command.args(arguments).stdin(Stdio::null()).stdout(output);
            let child = command.stderr(Stdio::piped()).spawn().expect("the program starts");
            Said::of(child.wait_with_output().expect("it ends"))
        };
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let gone = ended(writer.into());
        assert_eq!((gone.code, gone.err.as_str()), (Some(141), ""), "{arguments:?}");
        let full = OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        ended(full.into()).has(2, "", "mufasa: standard input or output: ");
    }
}

/// An oracle says by its exit code that answers were lost, whether they were to go nowhere or nobody reads on.
#[cfg(target_os = "linux")]
#[test]
fn answers_that_nobody_gets_are_an_error() {
    let oracle = env!("CARGO_BIN_EXE_mufasa");
    let bash = |line: &str| {
        let command = Command::new("bash").args(["-c", line]).output().expect("bash is there");
        Said::of(command)
    };
    let words = "standard output is closed";
    bash(&format!("echo '{{}}' | {oracle} oracle >&-")).has(2, "", words);
    bash(&format!("echo '{{}}' | {oracle} oracle >/dev/null")).has(0, "", "");
    let some = bash(&format!(
        "yes '{{}}' | head -9999 | {oracle} oracle | head -1; echo ${{PIPESTATUS[2]}}"
    ));
    assert!(some.out.ends_with("}\n141\n") && some.err.is_empty(), "{} {}", some.out, some.err);
}

/// As a full disk.
#[cfg(unix)]
#[test]
fn a_limit_of_file_sizes_is_told() {
    let command =
        format!("ulimit -f 8; exec {} vectors --out vectors", env!("CARGO_BIN_EXE_mufasa"));
    let mut shell = Command::new("sh");
    let ended = shell.args(["-c", &command]).current_dir(folder("limit")).output();
    let told = Said::of(ended.expect("a shell is there"));
    told.has(2, "", "cannot be written");
    assert!(told.err.contains("large"), "{}", told.err);
}

/// A broker that knows no user, and says so as late as RabbitMQ does. The address.
fn refusing_broker() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let mut heard = [0; 512];
            let mut refuse = || {
                stream.read_exact(&mut heard[..8])?;
                stream.write_all(b"AMQP\x03\x01\0\0")?;
                stream.write_all(b"\0\0\0\x15\x02\x01\0\0\0S@\xc0\x08\x01\xa3\x05PLAIN")?;
                let _ = stream.read(&mut heard)?;
                thread::sleep(Duration::from_millis(3_200));
                stream.write_all(b"\0\0\0\x11\x02\x01\0\0\0SD\xc0\x04\x02P\x01@")
            };
            // Who goes away is not refused.
            let _: std::io::Result<()> = refuse();
        }
    });
    format!("127.0.0.1:{port}")
}

/// A broker that is not there, or refuses, is tried again and again; who never had it did not what was asked.
#[test]
fn a_broker_that_is_never_reached_is_told() {
    let [scenario, _] = small();
    for (place, why) in [
        ("127.0.0.1:1".to_owned(), "Connection refused"),
        (refusing_broker(), "the broker refuses this user or password"),
    ] {
        let url = format!("amqp://guest:wrong@{place}");
        for arguments in [&["vehicle", &scenario][..], &["station", &scenario, "--seconds", "1"]] {
            let words = format!("the broker at {place} cannot be reached, and is tried again: ");
            let told = mufasa(&[arguments, &["--broker", &url]].concat());
            told.has(1, "", &words);
            assert!(told.err.contains(why), "{}", told.err);
        }
    }
    let tls = mufasa(&["station", &scenario, "--broker", "amqps://guest:secret@127.0.0.1:1"]);
    tls.has(2, "", "amqps: this program has no TLS; start a TLS tunnel");
    assert!(!tls.err.contains("secret"), "{}", tls.err);
}

#[test]
fn a_vehicle_says_what_changes_unless_it_is_to_be_quiet() {
    let [scenario, _] = small();
    let told = mufasa(&["vehicle", &scenario]);
    for words in ["the vehicle begins", "connected", "control follows the CAV's own plan"] {
        assert_eq!(told.err.matches(words).count(), 1, "{}", told.err);
    }
    assert!(told.err.contains("s: AllRemote: control follows station 1"), "{}", told.err);
    assert_eq!(mufasa(&["vehicle", &scenario, "--quiet"]).err, "");
}
