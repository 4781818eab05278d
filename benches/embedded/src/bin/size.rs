//! What a call of `check_with` links, and nothing else: to be measured, not run.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use mufasa::cycle::check_with;
use mufasa::input::cycle::Cycle;
use mufasa::input::indexes::Indexes;
use mufasa::input::scratch::Scratch;
use mufasa::report::{InvalidInput, Report};

/// Both profiles: which of them is known only when it runs.
#[unsafe(no_mangle)]
extern "Rust" fn _start(
    cycle: &Cycle<'_>,
    indexes: &Indexes<'_, '_>,
    scratch: &mut Scratch<'_>,
) -> Result<Report, InvalidInput> {
    check_with(cycle, indexes, scratch)
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
