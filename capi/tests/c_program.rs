//! Compiles and runs C programs against the header and the static library, and compiles the header as
//! C++.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// What Rust's standard library needs, on Linux.
const SYSTEM_LIBRARIES: [&str; 4] = ["-lpthread", "-ldl", "-lm", "-lc"];
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wmissing-braces"];

fn here() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of this test is that of the libraries that were built with it.
fn libraries() -> PathBuf {
    let test = env::current_exe().expect("the path of this test");
    test.parent().expect("a folder").to_owned()
}

fn run(program: impl AsRef<OsStr>, arguments: &[&OsStr]) -> Option<Output> {
    Command::new(program).args(arguments).output().ok()
}

fn text(output: &Output) -> String {
    let both = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    String::from_utf8_lossy(&both).into_owned()
}

/// The first of the compilers that is there, or a loud word that nothing was tested.
fn compiler(names: &[&'static str]) -> Option<&'static str> {
    let found = names.iter().find(|name| run(name, &["--version".as_ref()]).is_some());
    if found.is_none() {
        println!("NOT RUN: none of {names:?} is here, so the C interface was not tried");
        eprintln!("NOT RUN: none of {names:?} is here, so the C interface was not tried");
    }
    found.copied()
}

fn compile(compiler: &str, arguments: &[&OsStr]) {
    let warnings = WARNINGS.map(OsStr::new);
    let output = run(compiler, &[&warnings, arguments].concat()).expect("a compiler that starts");
    assert!(output.status.success(), "{compiler}: {}", text(&output));
}

/// Compiles a program of this crate with the library, runs it, and gives what it says.
fn says(compiler: &str, language: [&str; 3], source: &str) -> String {
    let output = ran(compiler, language, &here().join(source), &[]);
    assert!(output.status.success(), "{}", text(&output));
    text(&output)
}

/// Compiles a program with the library and these flags, and runs it.
fn ran(compiler: &str, language: [&str; 3], source: &Path, flags: &[&str]) -> Output {
    let library = libraries().join("libmufasa_capi.a");
    assert!(library.exists(), "{} was not built", library.display());
    let [standard, option, name] = language;
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let include = here().join("include");
    let mut arguments: Vec<&OsStr> = flags.iter().map(OsStr::new).collect();
    arguments.extend([standard, "-g", "-I"].map(OsStr::new));
    arguments.extend([include.as_os_str(), "-x".as_ref(), option.as_ref(), source.as_os_str()]);
    arguments.extend(["-x".as_ref(), "none".as_ref(), library.as_os_str()]);
    arguments.extend(SYSTEM_LIBRARIES.map(OsStr::new));
    arguments.extend(["-o".as_ref(), program.as_os_str()]);
    compile(compiler, &arguments);
    run(&program, &[]).expect("the program that was just built")
}

#[test]
fn a_c_program_gets_what_the_header_promises() {
    let Some(cc) = compiler(&["cc", "gcc", "clang"]) else { return };
    assert!(says(cc, ["-std=c11", "c", "check"], "tests/check.c").contains("all holds"));
    assert!(says(cc, ["-std=c11", "c", "monitor"], "tests/monitor.c").contains("all holds"));
}

#[test]
fn the_vehicle_loop_offloads_in_c_and_in_cpp() {
    let Some(cc) = compiler(&["cc", "gcc", "clang"]) else { return };
    let Some(cxx) = compiler(&["c++", "g++", "clang++"]) else { return };
    let in_c = says(cc, ["-std=c11", "c", "vehicle_c"], "examples/vehicle.c");
    assert!(in_c.ends_with("188 of 400 cycles offloaded, 1 fallback\n"), "{in_c}");
    assert_eq!(in_c, says(cxx, ["-std=c++17", "c++", "vehicle_cpp"], "examples/vehicle.c"));
}

const SANITIZERS: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

/// What the library writes into memory of C is within its bounds: the sanitizers see each access of the programs, and each
/// call of `memcpy` and the like. They end a program that reads one point too far.
#[test]
fn sanitizers_find_nothing_in_the_c_programs() {
    let Some(cc) = compiler(&["cc", "gcc", "clang"]) else { return };
    let wrong = Path::new(env!("CARGO_TARGET_TMPDIR")).join("beyond.c");
    let lines = "#include <stdlib.h>\n#include \"mufasa.h\"\nint main(void) {\n\
                 struct MufasaTrajectoryPoint *points = calloc(2, sizeof *points);\n\
                 volatile int last = 2;\n double x = points[last].x;\n free(points);\n return x > 1.0;\n}\n";
    fs::write(&wrong, lines).expect("a source can be written");
    let empty = wrong.with_file_name("empty.c");
    fs::write(&empty, "int main(void) { return 0; }\n").expect("a source can be written");
    let linked = wrong.with_file_name("empty");
    let [one, other] = SANITIZERS.map(OsStr::new);
    let tried = run(cc, &[one, other, empty.as_os_str(), "-o".as_ref(), linked.as_os_str()]);
    if !tried.is_some_and(|it| it.status.success()) {
        println!("NOT RUN: sanitizers_find_nothing_in_the_c_programs: {cc} has no sanitizers");
        return;
    }
    let sources = ["tests/check.c", "tests/monitor.c", "examples/vehicle.c"];
    for (name, source) in ["check_s", "monitor_s", "vehicle_s"].into_iter().zip(sources) {
        let output = ran(cc, ["-std=c11", "c", name], &here().join(source), &SANITIZERS);
        assert!(output.status.success(), "{source}: {}", text(&output));
    }
    let output = ran(cc, ["-std=c11", "c", "beyond_s"], &wrong, &SANITIZERS);
    assert!(!output.status.success(), "it read beyond its points");
    assert!(text(&output).contains("heap-buffer-overflow"), "{}", text(&output));
}

/// The same lines compile when each status is looked at.
#[test]
fn a_status_that_is_not_looked_at_does_not_compile() {
    let Some(cc) = compiler(&["cc", "gcc", "clang"]) else { return };
    let calls = |[before, after]: [&str; 2]| {
        format!(
            "#include \"mufasa.h\"\nint main(void) {{\n\
             struct MufasaDecision decision; struct MufasaActions actions;\n\
             struct MufasaTime now = mufasa_time_from_nanoseconds(0);\n\
             {before}mufasa_monitor_cycle(NULL, now, NULL, &decision){after};\n\
             {before}mufasa_monitor_step(NULL, NULL, &actions){after};\n\
             {before}mufasa_check(NULL, NULL, 0, NULL){after};\n return 0;\n}}\n"
        )
    };
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("status.c");
    let assembly = source.with_extension("s");
    let include = here().join("include");
    for (lines, complaints) in [(calls(["", ""]), 3), (calls(["if (", ") return 1"]), 0)] {
        fs::write(&source, lines).expect("a source can be written");
        let mut arguments = ["-std=c11", "-S", "-Wall", "-I"].map(OsStr::new).to_vec();
        arguments.extend([include.as_os_str(), source.as_os_str()]);
        arguments.extend(["-o".as_ref(), assembly.as_os_str()]);
        let said = text(&run(cc, &arguments).expect("a compiler that starts"));
        assert_eq!(said.matches("-Wunused-result").count(), complaints, "{said}");
    }
}

/// Compiles these lines as C and as C++, and gives for either what the compiler says against them.
fn complaints(name: &str, lines: &str, flags: &[&str]) -> Vec<Option<String>> {
    let c = (["cc", "gcc", "clang"], ["-std=c11", "-xc"]);
    let cpp = (["c++", "g++", "clang++"], ["-std=c++17", "-xc++"]);
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&source, lines).expect("a source can be written");
    let include = here().join("include");
    let mut all = Vec::new();
    for (names, language) in [c, cpp] {
        let Some(compiler) = compiler(&names) else { continue };
        let mut arguments: Vec<&OsStr> = language.iter().chain(flags).map(OsStr::new).collect();
        arguments.extend(["-fsyntax-only", "-I"].map(OsStr::new));
        arguments.extend([include.as_os_str(), source.as_os_str()]);
        let output = run(compiler, &arguments).expect("a compiler that starts");
        all.push((!output.status.success()).then(|| text(&output)));
    }
    all
}

/// The same lines compile when each number says what it counts.
#[test]
fn a_bare_number_assigned_or_given_is_no_time_and_no_gap() {
    let program = |[now, stamp, gap]: [&str; 3]| {
        format!(
            "#include \"mufasa.h\"\nint main(void) {{\n\
             struct MufasaDecision decision; struct MufasaLead lead;\n\
             lead.stamp = {stamp};\n lead.gap = {gap};\n lead.speed = 0;\n\
             return mufasa_monitor_cycle(NULL, {now}, NULL, &decision) == 0 && lead.speed > 0;\n}}\n"
        )
    };
    let good = ["mufasa_time_from_microseconds(5)"; 2];
    let good = [good[0], good[1], "mufasa_gap_between_bumpers(5)"];
    for said in complaints("bare", &program(good), &[]) {
        assert_eq!(said, None);
    }
    for (i, bad) in [(0, "5000"), (1, "5000"), (2, "5.0")] {
        let mut lines = good;
        lines[i] = bad;
        for said in complaints("bare", &program(lines), &[]) {
            let said = said.expect("an error");
            let words = ["incompatible type", "could not convert", "no match for", "no viable"];
            assert!(words.iter().any(|word| said.contains(word)), "{said}");
        }
    }
}

/// In an initialiser, too, with inner braces or without; a bare gap there is found by the flag that README.md advises.
#[test]
fn a_bare_number_in_an_initialiser_does_not_compile() {
    const FLAG: [&str; 1] = ["-Werror=missing-braces"];
    let program = |line: &str| {
        format!(
            "#include \"mufasa.h\"\nvoid f(int64_t now_us);\nvoid f(int64_t now_us) {{\n\
             struct MufasaTime now = mufasa_time_from_microseconds(now_us);\n\
             struct MufasaGap gap = mufasa_gap_between_bumpers(25.0);\n\
             {line}\n (void)now, (void)gap, (void)m;\n}}\n"
        )
    };
    let none: &[&str] = &[];
    for (bad, flags) in [
        ("struct MufasaTime m = {50};", none),
        ("struct MufasaTime m = {now_us};", none),
        ("struct MufasaTrackMessage m = {1, 2, now_us, {now, NULL, 0}};", none),
        ("struct MufasaTrackMessage m = {1, 2, now, {{50}, NULL, 0}};", none),
        ("struct MufasaLead m = {now_us, {25.0}, 10.0};", none),
        ("struct MufasaLead m = {now, 25.0, 10.0};", &FLAG),
    ] {
        for said in complaints("braces", &program(bad), flags) {
            let said = said.unwrap_or_else(|| panic!("{bad} compiles"));
            let words = ["missing-braces", "invalid conversion", "int-conversion"];
            assert!(words.iter().any(|word| said.contains(word)), "{bad}: {said}");
        }
    }
    for good in [
        "struct MufasaTime m = {0};",
        "struct MufasaTrackMessage m = {1, 2, now, {now, NULL, 0}};",
        "struct MufasaLead m = {now, gap, 10.0};",
        "struct MufasaLead m = {now, {25.0}, 10.0};",
    ] {
        for said in complaints("braces", &program(good), &[]) {
            assert_eq!(said, None, "{good}");
        }
    }
}

#[test]
fn the_header_is_cpp_too() {
    let Some(cxx) = compiler(&["c++", "g++", "clang++"]) else { return };
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("header.cpp");
    let program = "#include \"mufasa.h\"\nint main() { return MUFASA_STATUS_OK; }\n";
    fs::write(&source, program).expect("a source can be written");
    let include = here().join("include");
    let mut arguments: Vec<&OsStr> = ["-std=c++17", "-fsyntax-only", "-I"].map(OsStr::new).to_vec();
    arguments.extend([include.as_os_str(), source.as_os_str()]);
    compile(cxx, &arguments);
}
