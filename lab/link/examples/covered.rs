//! Whether every remote result that the logs of vehicles (`mufasa vehicle --log FILE`) call used is covered
//! by a safe decision of its running session; told from the logs alone.
//!
//! `cargo run --release -p mufasa-link --example covered -- LOG...`

use std::process::ExitCode;

use mufasa_link::vehicle::log::{Coverage, Entry, What};

fn main() -> ExitCode {
    let mut is_covered = true;
    for file in std::env::args().skip(1) {
        let text = match std::fs::read_to_string(&file) {
            Ok(text) => text,
            Err(error) => {
                eprintln!("{file}: cannot be read: {error}");
                return ExitCode::from(2);
            }
        };
        let (mut coverage, mut used) = (Coverage::default(), 0_u64);
        // The last line of a vehicle that was killed may be cut off.
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        for (line, number) in whole.lines().zip(1..) {
            let entry: Entry = match serde_json::from_str(line) {
                Ok(entry) => entry,
                Err(error) => {
                    eprintln!("{file}:{number}: {error}");
                    return ExitCode::from(2);
                }
            };
            used += u64::from(matches!(entry.what, What::Used { .. }));
            if let Err(why) = coverage.take(&entry) {
                eprintln!("{file}:{number}: {why}");
                is_covered = false;
            }
        }
        println!("{file}: {used} remote results used");
    }
    ExitCode::from(u8::from(!is_covered))
}
