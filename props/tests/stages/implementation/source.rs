//! What the sources of the implementation say and do not say; tests are left out.
//!
//! `no_std` without `alloc` has no heap and no clock, so that much is proven by compiling. Panics
//! are kept out by lints and by the absence of what panics without being a lint; whether that is
//! all is tried by `arbitrary` and `limits`.

use std::fs;
use std::path::{Path, PathBuf};

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    fs::read_to_string(path).expect("the file is there")
}

/// Files of a folder and of its folders, without tests.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("folders are readable") {
        let path = entry.expect("a directory entry").path();
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// Source text that is compiled into the crate, by file: no comments, nothing under `cfg(test)`.
fn shipped() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../impl/src");
    let mut paths = Vec::new();
    files(&folder, &mut paths);
    let mut kept = Vec::new();
    let mut tests = Vec::new();
    for path in paths {
        let text = fs::read_to_string(&path).expect("sources are readable");
        let (text, modules) = without_tests(&text);
        let stem = path.with_extension("");
        let home = match stem.file_name().and_then(|name| name.to_str()) {
            Some("lib" | "mod") => stem.parent().expect("in a folder").to_owned(),
            _ => stem,
        };
        tests.extend(modules.iter().map(|module| home.join(module)));
        kept.push((path, text));
    }
    let is_test = |path: &Path| tests.iter().any(|test| path.with_extension("").starts_with(test));
    kept.retain(|(path, _)| !is_test(path));
    let name = |path: &Path| path.strip_prefix(&folder).expect("below").display().to_string();
    kept.into_iter().map(|(path, text)| (name(&path), text)).collect()
}

/// The text without comments and without items under `#[cfg(test)]`, and the modules of their own
/// files that are such items. Formatted sources: an item ends at a `}` or `;` in its own column.
fn without_tests(text: &str) -> (String, Vec<String>) {
    let mut kept = String::new();
    let mut modules = Vec::new();
    let mut lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    while let Some(line) = lines.next() {
        if line.trim() != "#[cfg(test)]" {
            kept.push_str(line);
            kept.push('\n');
            continue;
        }
        let item = lines.next().expect("an item after its attribute");
        let indent = &line[..line.len() - line.trim_start().len()];
        let item = item.trim().trim_start_matches("pub(super) ");
        if let Some(module) = item.strip_prefix("mod ").and_then(|m| m.strip_suffix(';')) {
            modules.push(module.to_owned());
        } else if !item.ends_with(';') {
            let end = format!("{indent}}}");
            lines.by_ref().find(|line| line.trim_end() == end).expect("the end of the item");
        }
    }
    (kept, modules)
}

/// File and line wherever one of the words stands alone in the shipped sources.
fn uses(words: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for (file, text) in shipped() {
        for line in text.lines() {
            for word in words {
                let is_part = |c: char| c.is_alphanumeric() || c == '_';
                let alone = |(start, _): (usize, &str)| {
                    !line[..start].ends_with(is_part)
                        && !line[start + word.len()..].starts_with(is_part)
                };
                if line.match_indices(word).any(alone) {
                    found.push(format!("{file}: {}", line.trim()));
                }
            }
        }
    }
    found
}

/// The lines of one table of a Cargo.toml.
fn table(text: &str, name: &str) -> Vec<String> {
    let lines = text.lines().skip_while(|line| line.trim() != format!("[{name}]")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    lines.map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned).collect()
}

#[test]
fn tests_are_told_from_what_is_shipped() {
    let text = "use a;\n#[cfg(test)]\nmod more;\nfn f() {} // g\n#[cfg(test)]\nextern crate std;\n\
                #[cfg(test)]\npub(super) mod others;\n\
                #[cfg(test)]\nmod tests {\n    fn g() {\n    }\n}\nfn h() {}\n";
    let (kept, modules) = without_tests(text);
    assert_eq!(kept, "use a;\nfn f() {} \nfn h() {}\n");
    assert_eq!(modules, ["more", "others"]);
    let shipped = shipped();
    let has = |name: &str| shipped.iter().any(|(file, _)| file == name);
    assert!(has("lib.rs") && has("stages/mod.rs") && has("offloading/requester/steps.rs"));
    assert!(!shipped.iter().any(|(file, text)| file.contains("tests") || text.contains("#[test]")));
}

/// IMPL-07: neither heap nor clock are within
/// reach of a crate without `std` and `alloc`; `dependencies` sees to it that it needs no other.
#[test]
fn there_is_no_heap_and_no_clock() {
    let lib = read("impl/src/lib.rs");
    assert!(lib.lines().any(|line| line == "#![no_std]"));
    assert_eq!(uses(&["std", "alloc", "extern"]), [""; 0]);
    assert!(!Path::new(env!("CARGO_MANIFEST_DIR")).join("../impl/build.rs").exists());
}

/// IMPL-07: `forbid` cannot be lifted below.
#[test]
fn unsafe_is_forbidden() {
    let forbidden = "unsafe_code = \"forbid\"".to_owned();
    assert!(table(&read("Cargo.toml"), "workspace.lints.rust").contains(&forbidden));
    assert_eq!(table(&read("impl/Cargo.toml"), "lints"), ["workspace = true"]);
}

/// IMPL-07: overflow, division by zero, indices
/// and unwrapping are lints that are denied and nowhere allowed; other ways to panic are not used.
#[test]
fn what_panics_is_denied_or_absent() {
    let lib = read("impl/src/lib.rs");
    let denied = lib.split("not(test),").nth(1).and_then(|rest| rest.split(")]").next());
    let denied = denied.expect("lints are denied outside of tests");
    assert!(denied.trim_start().starts_with("deny("), "{denied}");
    let lints =
        ["unwrap_used", "expect_used", "indexing_slicing", "panic", "arithmetic_side_effects"];
    for lint in lints {
        assert!(denied.contains(&format!("clippy::{lint}")), "{lint} is not denied");
        let lifted: Vec<_> =
            uses(&[lint]).into_iter().filter(|u| !u.starts_with("lib.rs")).collect();
        assert_eq!(lifted, [""; 0], "{lint} is denied in lib.rs and lifted nowhere");
    }
    // What the lint `panic` does not find.
    let macros = ["unreachable", "todo", "unimplemented", "assert", "assert_eq", "assert_ne"];
    assert_eq!(uses(&macros), [""; 0]);
    assert_eq!(uses(&["debug_assert", "debug_assert_eq"]), [""; 0]);
    let methods = [
        "split_at",
        "split_at_mut",
        "copy_from_slice",
        "clone_from_slice",
        "copy_within",
        "swap",
        "rotate_left",
        "rotate_right",
        "chunks",
        "chunks_mut",
        "chunks_exact",
        "rchunks",
        "step_by",
        "clamp",
        "sort_unstable",
        "sort_unstable_by",
        "sort_unstable_by_key",
        "select_nth_unstable",
        "RefCell",
        "unwrap_unchecked",
        "ilog",
        "ilog2",
        "ilog10",
        "strict",
    ];
    assert_eq!(uses(&methods), [""; 0]);
}

/// IMPL-06: floating point is the arithmetic of
/// Rust, which is that of IEEE 754, and `sqrt` and `floor`, which are exact or correctly rounded on
/// every platform; no code depends on the platform, and nothing is remembered between calls.
#[test]
fn nothing_depends_on_the_platform_or_on_earlier_calls() {
    for line in uses(&["libm"]) {
        for (start, name) in line.match_indices("libm::") {
            let function = &line[start + name.len()..];
            assert!(function.starts_with("sqrt(") || function.starts_with("floor("), "{line}");
        }
        assert!(line.contains("libm::"), "{line}");
    }
    // The feature for the proofs adds functions and changes none; `arbitrary` is set by the proofs
    // alone, which take any answer of `exact` for one.
    let platform = uses(&["cfg", "asm", "core_arch", "mul_add", "algebraic"]);
    let for_proofs = [
        r#"lib.rs: #[cfg(feature = "parts")]"#,
        r#"numbers/mod.rs: #[cfg(not(arbitrary = "exact"))]"#,
        r#"numbers/mod.rs: #[cfg(arbitrary = "exact")]"#,
    ];
    assert_eq!(platform, for_proofs);
    // Within a call: steps are counted where two closures borrow the counter; and for the proofs.
    let counted = uses(&["Cell", "OnceCell", "AtomicBool", "AtomicU64", "AtomicUsize"]);
    let counters = ["hardened/h14_fail_safe/work.rs: ", "parts/steps.rs: "];
    let is_counter = |line: &String| counters.iter().any(|it| line.starts_with(it));
    assert!(counted.iter().all(is_counter), "{counted:?}");
    let statics = uses(&["static"]);
    assert_eq!(statics.iter().filter(|line| !line.contains("&'static")).count(), 0, "{statics:?}");
}
