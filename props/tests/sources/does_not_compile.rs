//! What the documentation of `impl` says does not compile fails for the reason that it names: rustdoc on stable
//! Rust takes any error for the right one. Compiled by `rustc` itself, so that `impl` needs nothing for it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A piece of code in a comment, and the code of its error; without one it is the lint that it denies.
struct Snippet {
    place: String,
    error: Option<String>,
    code: String,
}

/// MON-03.
#[test]
fn each_snippet_fails_for_the_reason_that_it_names() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("does_not_compile");
    fs::create_dir_all(&folder).expect("a folder");
    library(&folder);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../impl/src");
    let mut snippets = Vec::new();
    collect(&source, &mut snippets);
    assert!(snippets.len() >= 14, "{}", snippets.len());
    let mut kinds = BTreeSet::new();
    for Snippet { place, error, code } in &snippets {
        let file = folder.join("snippet.rs");
        fs::write(&file, in_a_function(code)).expect("a file");
        let output = rustc(&folder, &["--crate-name", "snippet", "--error-format=short"], &file);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success(), "{place} compiles");
        let wanted = match error {
            Some(code) => format!("error[{code}]"),
            // With `deny` in the snippet.
            None => "error: unused".to_owned(),
        };
        let errors: Vec<&str> = text
            .lines()
            .filter(|line| line.contains(": error") && !line.contains("aborting"))
            .collect();
        assert!(!errors.is_empty(), "{place}: {text}");
        for line in errors {
            assert!(line.contains(&wanted), "{place} is to fail with {wanted}: {line}");
        }
        kinds.insert(wanted);
    }
    assert!(kinds.len() >= 6, "{kinds:?}");
}

/// As rustdoc has it: the attributes of the file, then a function with the rest.
fn in_a_function(code: &str) -> String {
    let (attributes, rest): (Vec<&str>, Vec<&str>) =
        code.lines().partition(|line| line.starts_with("#!["));
    format!("{}\npub fn snippet() {{\n{}\n}}\n", attributes.join("\n"), rest.join("\n"))
}

/// The platform of this compiler.
fn host() -> String {
    let output = Command::new("rustc").arg("-vV").output().expect("rustc");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.lines().find_map(|it| it.strip_prefix("host: ")).expect("a host").to_owned()
}

/// Compiles `libm` and `mufasa`, as far as who uses them has to know.
fn library(folder: &Path) {
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        // What other platforms need does not have to be downloaded.
        .args(["--filter-platform", &host()])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo");
    let metadata: serde_json::Value = serde_json::from_slice(&metadata.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    for (name, more) in [("libm", "--cap-lints=allow"), ("mufasa", "--cap-lints=warn")] {
        let package = packages.iter().find(|it| it["name"] == name).expect(name);
        let manifest = Path::new(package["manifest_path"].as_str().expect("a path"));
        let file = manifest.with_file_name("src/lib.rs");
        let output = rustc(folder, &["--crate-name", name, more], &file);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// Of edition 2024; what was compiled into the folder before is there.
fn rustc(folder: &Path, arguments: &[&str], file: &Path) -> Output {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(rustc);
    command.args(["--edition", "2024", "--crate-type", "lib", "--emit", "metadata"]);
    command.arg("--out-dir").arg(folder).arg("-L").arg(folder).args(arguments);
    for name in ["libm", "mufasa"] {
        let built = folder.join(format!("lib{name}.rmeta"));
        if !arguments.contains(&name) && built.exists() {
            command.arg("--extern").arg(format!("{name}={}", built.display()));
        }
    }
    command.arg(file).output().expect("rustc")
}

/// The blocks of comments that begin with "compile_fail", in the files of a folder.
fn collect(folder: &Path, snippets: &mut Vec<Snippet>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, snippets);
            continue;
        }
        let text = fs::read_to_string(&path).expect("a text");
        let mut open: Option<Snippet> = None;
        for (number, line) in text.lines().enumerate() {
            let line = line.trim_start();
            let Some(line) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
                continue;
            };
            let line = line.strip_prefix(' ').unwrap_or(line);
            if let Some(kind) = line.strip_prefix("```compile_fail") {
                let place = format!("{}:{}", path.display(), number + 1);
                let error = kind.strip_prefix(',').map(str::to_owned);
                open = Some(Snippet { place, error, code: String::new() });
            } else if line.starts_with("```") {
                snippets.extend(open.take());
            } else if let Some(snippet) = &mut open {
                // Lines that the documentation hides.
                snippet.code += line.strip_prefix("# ").unwrap_or(line);
                snippet.code.push('\n');
            }
        }
    }
}
