//! Which sources a proof was about.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What decides about the compiled code and what is claimed of it; `scripts/prove-wasm` lists the same.
const PARTS: [&str; 5] =
    ["impl/src", "proofs/expected.toml", "proofs/src", "proofs/wasm", "scripts/prove-wasm"];

/// What else decides about the answers of the other engines.
const OTHERS: [&str; 4] =
    ["model/src", "proofs/exploration/src", "proofs/theorems/src", "lab/oracle/src/prove/engines"];

/// A number of the sources in this checkout that proofs on compiled code are about. Errors are
/// those of reading them.
pub fn hash(checkout: &Path) -> io::Result<String> {
    hash_of(checkout, &PARTS)
}

/// The same of those of all claims.
pub fn hash_of_all(checkout: &Path) -> io::Result<String> {
    hash_of(checkout, &[PARTS.as_slice(), &OTHERS].concat())
}

/// FNV-1a of 64 bits of the paths and contents, in hex.
fn hash_of(checkout: &Path, parts: &[&str]) -> io::Result<String> {
    let mut files = Vec::new();
    for part in parts {
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
