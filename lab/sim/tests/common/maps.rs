//! Where the maps of Ulm lie.

use std::io::Write;
use std::path::{Path, PathBuf};

/// The folder of the maps, below `MUFASA_DATA` or `shared/data` beside the workspace.
pub fn maps() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    // A checkout may lie one folder deeper.
    let deeper = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data");
    let named = std::env::var_os("MUFASA_DATA").map(PathBuf::from);
    let places = named.map_or(vec![beside, deeper], |named| vec![named]);
    let found = places.iter().map(|place| place.join("ulm")).find(|place| place.is_dir());
    if found.is_none() {
        let line = format!(
            "NOT RUN: {}: no maps of Ulm in {}; set MUFASA_DATA\n",
            std::thread::current().name().unwrap_or("a test"),
            places[0].display()
        );
        std::io::stderr().write_all(line.as_bytes()).expect("standard error can be written");
    }
    found
}
