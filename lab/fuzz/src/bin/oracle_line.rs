//! Any line is answered, and where it is a cycle the implementation conforms.
#![no_main]

use mufasa_model::{cycle::check, report::Reading};
use mufasa_props::differential::conforming;

libfuzzer_sys::fuzz_target!(|line: &[u8]| {
    let _ = mufasa_records::answer(line, 1);
    if let Ok((_, cycle)) = mufasa_records::cycle_from_line(line, 1) {
        let of = |reading| check(&cycle, reading);
        conforming(&cycle, &of(Reading::Exact), &of(Reading::Strict)).unwrap();
    }
});
