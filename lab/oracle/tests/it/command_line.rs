//! The built program's command line: what is refused says what was meant, and the shell is helped.

use crate::kit::folder;
use std::ffi::OsStr;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn mufasa(arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mufasa"));
    command.args(arguments).stdin(Stdio::null());
    command
}

fn output(arguments: &[&str]) -> Output {
    mufasa(arguments).output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("the program writes UTF-8")
}

#[test]
fn numbers_that_are_refused_say_their_limits() {
    for (arguments, limits) in [
        (
            &["check", "x", "--horizon", "-1"][..],
            "'-1' for '--horizon <S>': must be a number from 0.1 to 60",
        ),
        (&["check", "x", "--sensor-range", "-5"], "must be a number from 0 to 10000"),
        (&["check", "x", "--track-age", "-3"], "must be a whole number from 0 to 1000"),
        (&["check", "x", "--grid-width", "1.5"], "must be a whole number from 1 to 4096"),
        (&["conform", "--cases", "abc", "--", "x"], "must be a whole number from 0 to "),
        (&["conform", "--seed", "-7", "--", "x"], "must be a whole number from 0 to "),
        (&["conform", "--time-limit", "0", "--", "x"], "must be a whole number from 1 to 3600000"),
        (&["explore", "--threads", "many"], "must be a whole number from 0 to 1024"),
        (&["evaluate", "--scenarios", "0"], "must be a whole number from 1 to 10000"),
        (&["evaluate", "stages", "--vehicles", "-1"], "must be a whole number from 0 to 200"),
        (&["evaluate", "falsify", "--rounds", "x"], "must be a whole number from 1 to 1000000"),
        (&["evaluate", "replay", "--route", "2"], "must be a whole number from 0 to 1"),
    ] {
        let output = output(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let message = text(&output.stderr);
        assert!(message.contains(limits), "{arguments:?}: {message}");
    }
}

#[test]
fn conform_says_what_a_program_reads_and_answers_and_where_it_stands() {
    let help = text(&output(&["conform", "--help"]).stdout);
    for part in
        ["one JSON record per line", "one answer", "spec/5-interfaces.md", "-- node program.mjs"]
    {
        assert!(help.contains(part), "{part}: {help}");
    }
    let tip = "the program under test stands behind `--`: mufasa conform [OPTIONS] -- COMMAND...";
    for arguments in
        [&["conform", "python3", "x.py"][..], &["conform", "--cases", "20", "./x"], &["conform"]]
    {
        let output = output(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(tip), "{arguments:?}: {}", text(&output.stderr));
    }
    for arguments in [&["conform", "--cases", "x", "--", "y"][..], &["check", "--wrong"]] {
        let message = text(&output(arguments).stderr);
        assert!(!message.contains(tip), "{arguments:?}: {message}");
    }
}

/// In a checkout with git the commit, elsewhere the version alone.
#[test]
fn the_version_says_the_commit_of_a_checkout() {
    let said = text(&output(&["--version"]).stdout);
    let version = concat!("mufasa ", env!("CARGO_PKG_VERSION"));
    let project = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let is_here = |commit: &str| {
        let object = format!("{commit}^{{commit}}");
        let done = Command::new("git").args(["-C", project, "cat-file", "-e", &object]).status();
        done.is_ok_and(|status| status.success())
    };
    if Path::new(project).join(".git").exists() && is_here("HEAD") {
        let commit = said.strip_prefix(&format!("{version} (commit ")).expect("a commit");
        let commit = commit.strip_suffix(")\n").expect("nothing else");
        assert!(commit.len() >= 10 && is_here(commit), "{said}");
    } else {
        assert_eq!(said, format!("{version}\n"));
    }
}

#[test]
fn a_misspelled_parameter_gets_the_near_one() {
    let file = folder("parameters").join("p.toml");
    fs::write(&file, "theta_tr = 0.2\ntheta_tracks_max = 2.0\n").expect("it can be written");
    let output = output(&["check", "x", "--parameters", file.to_str().expect("a plain name")]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        message.contains(":2: theta_tracks_max: is no parameter; is theta_track_max meant?"),
        "{message}"
    );
}

/// It was once taken for what somebody wanted.
#[test]
fn a_file_without_a_parameter_is_told() {
    let file = folder("no-parameters").join("p.toml");
    fs::write(&file, "# a_b = 6\n").expect("it can be written");
    let [scenario, solution] = small();
    let file = file.to_str().expect("a plain name");
    let output = output(&["check", "--summary", &scenario, &solution, "--parameters", file]);
    let message = text(&output.stderr);
    assert!(
        message.ends_with(
            "p.toml: no parameter in it; the defaults hold (a line is `name = value`)\n"
        ),
        "{message}"
    );
    assert!(text(&output.stdout).contains("1 drive, "));
}

#[test]
fn what_is_written_without_a_named_folder_is_said_first() {
    for command in ["vectors", "man", "schemas"] {
        let folder = folder(command);
        let said = |arguments: &[&str]| {
            let done = mufasa(arguments).current_dir(&folder).output();
            let done = done.expect("the program starts");
            assert_eq!(done.status.code(), Some(0), "{arguments:?}");
            text(&done.stderr)
        };
        assert_eq!(
            said(&[command]),
            format!("mufasa: writes into {command}/; --out names another folder\n")
        );
        assert!(folder.join(command).is_dir());
        assert_eq!(said(&[command, "--out", "there"]), "");
    }
}

#[test]
fn shells_complete_and_man_has_a_page_for_every_command() {
    for (shell, word) in [
        ("bash", "complete -F _mufasa"),
        ("zsh", "#compdef mufasa"),
        ("fish", "complete -c mufasa"),
    ] {
        let output = output(&["completions", shell]);
        assert_eq!(output.status.code(), Some(0), "{shell}");
        assert!(text(&output.stdout).contains(word), "{shell}");
    }
    let help = text(&output(&["--help"]).stdout);
    let list = help.split_once("Commands:\n").expect("a list of commands").1;
    let list = list.split_once("\n\n").expect("options behind it").0;
    let names = list.lines().filter_map(|line| line.split_ascii_whitespace().next());
    let commands: Vec<_> = names.filter(|it| *it != "help").collect();
    assert!(commands.contains(&"vehicle") && commands.contains(&"station"), "{commands:?}");
    let completions = text(&output(&["completions", "bash"]).stdout);
    let folder = folder("man");
    let output = output(&["man", "--out", folder.to_str().expect("a plain name")]);
    assert_eq!(output.status.code(), Some(0));
    assert!(folder.join("mufasa.1").exists());
    for command in commands {
        let page = fs::read_to_string(folder.join(format!("mufasa-{command}.1")));
        assert!(page.expect("there is a page").contains(".SH DESCRIPTION"), "{command}");
        assert!(completions.contains(&format!("mufasa__subcmd__{command}")), "{command}");
    }
}

#[test]
fn without_a_command_it_says_first_where_it_writes() {
    let folder = folder("bare");
    let none: [&str; 0] = [];
    let mut demo = mufasa(none)
        .current_dir(&folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut first = String::new();
    let stderr = demo.stderr.take().expect("it is piped");
    let read = BufReader::new(stderr).read_line(&mut first);
    demo.kill().expect("it can be ended");
    demo.wait().expect("it ends");
    read.expect("there is a line");
    assert_eq!(first.trim_end(), "mufasa: no command, so the demo, which writes into mufasa-demo/");
}

/// The small drive of the readers' tests.
fn small() -> [String; 2] {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../drives/data/readers/");
    ["small-2018b.xml", "small.KS2.solution.xml"].map(|name| format!("{data}{name}"))
}

/// What is said of progress where standard error is no terminal.
#[test]
fn verbose_shows_progress_as_lines_and_quiet_shows_none() {
    let [scenario, solution] = small();
    let said = |option: &[&str]| {
        let output = output(&[&["check", "--summary", &scenario, &solution], option].concat());
        text(&output.stderr)
    };
    assert_eq!(said(&["-q"]), "");
    assert_eq!(said(&[]), "");
    let lines = said(&["-v"]);
    assert!(lines.lines().count() > 0, "no line");
    assert!(
        lines.lines().all(|line| line.contains(" cycles, ") && line.ends_with(" left")),
        "{lines}"
    );
}

/// One range for all that the CAV sees, as long as the lead has none of its own.
#[test]
fn the_range_of_the_detectors_is_that_of_the_lead_where_none_is_said() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../drives/data/demo/");
    let files = ["urban.xml", "urban.solution.xml"].map(|name| format!("{data}{name}"));
    // The lines of cycles do not say what the ranges are.
    let answers = |ranges: &[&str]| {
        let output = output(&[&["check", "--json", &files[0], &files[1]], ranges].concat());
        let lines = text(&output.stdout);
        let of_cycles: Vec<_> = lines.lines().filter(|it| it.contains("checked_cycle")).collect();
        of_cycles.join("\n")
    };
    let [own, both, far] = [
        answers(&["--sensor-range", "5"]),
        answers(&["--sensor-range", "5", "--lead-range", "5"]),
        answers(&["--sensor-range", "5", "--lead-range", "80"]),
    ];
    assert!(!own.is_empty() && own == both && own != far);
}

#[test]
fn quiet_and_verbose_exclude_each_other() {
    let output = output(&["check", "-q", "-v", "x"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("cannot be used with"));
}

/// What options of recorded drives change nothing in is said, in every format, and not where none was given.
#[test]
fn options_that_change_nothing_are_said() {
    let folder = folder("options-ignored");
    let record = first_record();
    fs::write(folder.join("c.jsonl"), &record).expect("written");
    let file = folder.join("c.jsonl").display().to_string();
    for format in [None, Some("--summary"), Some("--json")] {
        let told = |more: &[&str]| {
            let arguments = [&["check", &file], more].concat();
            text(&output(&[&arguments[..], format.as_slice()].concat()).stdout)
        };
        let note = "options of recorded drives";
        assert!(told(&["--sensor-range", "20"]).contains(note), "{format:?}");
        assert!(told(&["--profile", "paper"]).contains(note), "{format:?}");
        assert!(!told(&["--sensor-range", "80"]).contains(note), "{format:?}");
    }
}

/// A file that is called as one of JSON Lines is read so, whatever its first line is; what is left out is counted, and
/// every line of complaint says who complains.
#[test]
fn the_first_line_may_be_the_broken_one() {
    let folder = folder("first-line");
    let record = first_record();
    fs::write(folder.join("c.jsonl"), format!("xx\n{record}\n{{}}\n")).expect("written");
    let output = output(&["check", &folder.join("c.jsonl").display().to_string()]);
    let (told, wrong) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(2), "{told}{wrong}");
    assert!(told.contains("2 lines left out, which are no cycles"), "{told}");
    assert!(told.contains("1 file with something that could not be read"), "{told}");
    assert_eq!(wrong.lines().count(), 2, "{wrong}");
    assert!(wrong.lines().all(|line| line.starts_with("mufasa: ")), "{wrong}");
    assert!(wrong.contains("c.jsonl:1") && wrong.contains("c.jsonl:3"), "{wrong}");
}

/// Whoever writes into a folder that nobody named says so before.
#[test]
fn a_folder_that_nobody_named_is_said_first() {
    let folder = folder("unnamed");
    let explore = ["explore", "--world", "nope"];
    let conform = ["conform", "--", "./not-there"];
    for (arguments, usual) in [(&explore[..], "exploration/"), (&conform, "mufasa-conform/")] {
        let output = mufasa(arguments).current_dir(&folder).output().expect("the program starts");
        let wrong = text(&output.stderr);
        let first = wrong.lines().next().unwrap_or_default();
        assert_eq!(first, format!("mufasa: writes into {usual}; --out names another folder"));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
    // Neither has begun, and nothing is left that looks like a result.
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 0);
}

/// A solution that cannot be read does not make another vehicle the CAV.
#[test]
fn a_broken_solution_is_no_reason_to_drive_another_way() {
    let folder = folder("broken-solution");
    let demo = output(&["demo", "--out", &folder.display().to_string()]);
    assert_eq!(demo.status.code(), Some(0), "{}", text(&demo.stderr));
    let [scenario, solution, cut, gone] =
        ["urban.xml", "urban.solution.xml", "cut.xml", "gone.xml"].map(|it| folder.join(it));
    let whole = fs::read_to_string(&solution).expect("the demo's");
    fs::write(&cut, &whole[..whole.len() / 2]).expect("written");
    let [scenario, solution, cut, gone] =
        [scenario, solution, cut, gone].map(|it| it.display().to_string());
    let of_cut = output(&["check", &scenario, &cut]);
    assert_eq!(of_cut.status.code(), Some(2));
    assert!(text(&of_cut.stdout).starts_with("0 drives"), "{}", text(&of_cut.stdout));
    let rows = whole[..whole.len() / 2].lines().count();
    let told = text(&of_cut.stderr);
    assert!(told.contains(&format!("cut.xml:{rows}: cut off: it ends here")), "{told}");
    // A file that is not there comes between a scenario and its solution.
    let of_gone = output(&["check", &scenario, &gone, &solution]);
    assert_eq!(of_gone.status.code(), Some(2));
    let [told, wrong] = [text(&of_gone.stdout), text(&of_gone.stderr)];
    assert!(told.contains("188 cycles") && !wrong.contains("no scenario"), "{told}{wrong}");
}

/// A document without a place for the table is refused before the work.
#[test]
fn a_document_without_the_place_is_refused_first() {
    let folder = folder("no-place");
    fs::write(folder.join("page.md"), "# A page\n").expect("written");
    for arguments in [
        &["evaluate", "failures"][..],
        &["evaluate", "falsify"],
        &["evaluate", "scenes"],
        &["explore", "--out", "tables"],
        &["prove", "--out", "prove.json"],
    ] {
        for file in ["page.md", "gone.md"] {
            let mut command = mufasa([arguments, &["--into", file]].concat());
            let output = command.current_dir(&folder).output().expect("the program starts");
            assert_eq!(output.status.code(), Some(2));
            // Nothing was made.
            assert_eq!(text(&output.stdout), "");
            let told = format!("mufasa: {file}: no table can be put there: ");
            assert!(text(&output.stderr).starts_with(&told), "{}", text(&output.stderr));
        }
    }
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
}

/// A record that `check` reads.
fn first_record() -> String {
    let vectors = fs::read_to_string("../../vectors/findings/F-06.jsonl").expect("vectors");
    let vector = vectors.lines().next().expect("a vector");
    let vector: serde_json::Value = serde_json::from_str(vector).expect("JSON");
    vector["input"].to_string()
}
