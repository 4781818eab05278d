//! Compiles and runs `tests/check.c` against the header and the static library, and compiles the
//! header as C++.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// What Rust's standard library needs, on Linux.
const SYSTEM_LIBRARIES: [&str; 4] = ["-lpthread", "-ldl", "-lm", "-lc"];
const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];

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

#[test]
fn a_c_program_gets_what_the_header_promises() {
    let Some(cc) = compiler(&["cc", "gcc", "clang"]) else { return };
    let library = libraries().join("libmufasa_capi.a");
    assert!(library.exists(), "{} was not built", library.display());
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("check");
    let (include, source) = (here().join("include"), here().join("tests/check.c"));
    let mut arguments: Vec<&OsStr> = ["-std=c11", "-g", "-I"].map(OsStr::new).to_vec();
    arguments.extend([include.as_os_str(), source.as_os_str(), library.as_os_str()]);
    arguments.extend(SYSTEM_LIBRARIES.map(OsStr::new));
    arguments.extend(["-o".as_ref(), program.as_os_str()]);
    compile(cc, &arguments);
    let output = run(&program, &[]).expect("the program that was just built");
    assert!(output.status.success(), "{}", text(&output));
    assert!(text(&output).contains("all holds"), "{}", text(&output));
}

#[test]
fn the_header_is_cpp_too() {
    let Some(cxx) = compiler(&["c++", "g++", "clang++"]) else { return };
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("header.cpp");
    let program = "#include \"mufasa.h\"\nint main() { return MUFASA_VERDICT_SAFE == 0; }\n";
    fs::write(&source, program).expect("a source can be written");
    let include = here().join("include");
    let mut arguments: Vec<&OsStr> = ["-std=c++17", "-fsyntax-only", "-I"].map(OsStr::new).to_vec();
    arguments.extend([include.as_os_str(), source.as_os_str()]);
    compile(cxx, &arguments);
}
