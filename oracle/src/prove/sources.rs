//! Which sources a proof on compiled code was about.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What decides about the compiled code and what is claimed of it; `scripts/prove-wasm` lists the same.
const PARTS: [&str; 7] = [
    "impl/src",
    "proofs/expected.toml",
    "proofs/src",
    "proofs/wasm",
    "scripts/prove-wasm",
    "proofs/compiled/src",
    "proofs/z3/src",
];

/// A number of the paths and contents of the sources in this checkout: FNV-1a of 64 bits, in hex.
/// Errors are those of reading them.
pub fn hash(checkout: &Path) -> io::Result<String> {
    let mut files = Vec::new();
    for part in PARTS {
        list(&checkout.join(part), &mut files)?;
    }
    let mut named = Vec::new();
    for file in files {
        let path = file.strip_prefix(checkout).unwrap_or(&file);
        named.push((path.to_string_lossy().replace('\\', "/"), fs::read(&file)?));
    }
    named.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for (path, content) in named {
        // The length of each keeps one file's end from being another's start.
        for part in [path.as_bytes(), &content] {
            for byte in (part.len() as u64).to_le_bytes().iter().chain(part) {
                hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    Ok(format!("{hash:016x}"))
}

/// The file, or all files of the folder.
fn list(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            list(&entry?.path(), files)?;
        }
    } else {
        files.push(path.to_owned());
    }
    Ok(())
}
