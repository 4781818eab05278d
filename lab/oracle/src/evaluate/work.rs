//! What it works with: the folder of its files, and its threads.

use std::path::Path;

use mufasa_records::files;

use crate::ended::{cannot, said};

/// Whether files can be written into this folder in the folder.
pub fn prepared(folder: Option<&Path>, within: &str) -> Result<(), String> {
    let Some(folder) = folder else { return Ok(()) };
    files::prepare(&folder.join(within)).map_err(cannot(folder, "written to"))
}

/// A pool of so many threads; of one for each processor, if nothing is said.
pub fn pool(threads: Option<u16>) -> Result<rayon::ThreadPool, String> {
    let threads = usize::from(threads.unwrap_or(0));
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(said)
}
