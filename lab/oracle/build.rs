//! Says which commit `mufasa --version` was built from, where this is the project's own checkout and git is
//! here; from a package or an archive it says the version alone.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let commit = commit().map_or(String::new(), |it| format!(" (commit {it})"));
    println!("cargo::rustc-env=MUFASA_VERSION={}{commit}", env!("CARGO_PKG_VERSION"));
}

/// The commit, when the folder above this package is a checkout of its own.
fn commit() -> Option<String> {
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?.parent()?;
    let top = git(project, &["rev-parse", "--show-toplevel"])?;
    if Path::new(&top).canonicalize().ok()? != project.canonicalize().ok()? {
        return None;
    }
    // Each commit and each checkout of another one adds a line to it.
    let log = project.join(git(project, &["rev-parse", "--git-path", "logs/HEAD"])?);
    if log.exists() {
        println!("cargo::rerun-if-changed={}", log.display());
    }
    git(project, &["rev-parse", "--short=10", "HEAD"])
}

fn git(folder: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(folder).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (output.status.success() && !text.is_empty()).then_some(text)
}
