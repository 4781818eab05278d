//! The readers of drives take any file: a drive or an error.
#![no_main]

use std::{env::temp_dir, fs, process::id};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let file = temp_dir().join(format!("mufasa-fuzz-{}", id()));
    fs::write(&file, bytes).unwrap();
    let _ = mufasa_drives::readers::read(&[file], &mufasa_drives::options::Options::default());
});
