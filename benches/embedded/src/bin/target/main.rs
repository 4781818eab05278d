//! Reads cases from the file `cases` of the host, and writes to `answers` for each: instructions, bytes of stack, bytes
//! of scratch, the answer. For an emulator with semihosting that counts an instruction as a nanosecond.
#![no_std]
#![no_main]

extern crate alloc;

#[cfg_attr(target_arch = "arm", path = "cortex_m.rs")]
#[cfg_attr(target_arch = "aarch64", path = "aarch64.rs")]
mod arch;
mod heap;
mod host;

use alloc::format;
use alloc::vec;
use core::mem::size_of;
use core::panic::PanicInfo;

use mufasa::input::cycle::{CrossSection, Detection};
use mufasa::input::detection_index::Slot;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row};
use mufasa::monitor::{Memory, Monitor};
use mufasa::offloading::requester::StationRecord;
use mufasa_embedded::{Bytes, Case};

/// The instructions of a loop, to test the count.
const KNOWN: u32 = 2_000_000;
/// As deep as a stack is looked at, bytes.
const DEPTH: usize = 256 * 1024;
/// What an unused word of the stack holds.
const UNUSED: usize = 0x5a5a_a5a5;

/// What a call took.
struct Taken {
    instructions: u64,
    stack: usize,
}

/// Where the processor starts when it is ready.
#[unsafe(no_mangle)]
extern "C" fn start() -> ! {
    let (cases, answers) = (host::File::open(c"cases", 1), host::File::open(c"answers", 5));
    let empty = taken(&mut || ());
    let known = taken(&mut || arch::count_down(KNOWN / 2)).instructions - empty.instructions;
    answers.write(format!("{KNOWN} {known} {}\n", memory()).as_bytes());
    let mut length = [0; 8];
    while cases.read(&mut length) {
        let mut case = vec![0; usize::try_from(u64::from_le_bytes(length)).unwrap_or(0)];
        assert!(cases.read(&mut case), "a case is cut off");
        let case = Case::read(&mut &case[..]);
        let mut all = Taken { instructions: 0, stack: 0 };
        let (scratch, answer) = case.answer(&mut |call| all = taken(call));
        let instructions = all.instructions - empty.instructions;
        let stack = all.stack - empty.stack;
        answers.write(format!("{instructions} {stack} {scratch} {answer}\n").as_bytes());
        heap::empty();
    }
    host::exit(0)
}

/// What the monitor needs for 8 stations, 128 tracks, 256 detections and 640 cross sections (docs/configuration.md):
/// scratch, all that it is lent, the monitor itself; bytes.
fn memory() -> alloc::string::String {
    let scratch = 128 * size_of::<Row>() + 260 * size_of::<Column>();
    let detections = Memory::detections_for(256) * size_of::<Detection>()
        + Memory::slots_for(256) * size_of::<Slot>();
    let route = 640 * size_of::<CrossSection>() + Block::needed(640) * size_of::<Block>();
    let lent = 8 * size_of::<StationRecord>() + scratch + detections + route;
    format!("{scratch} {lent} {}", size_of::<Monitor<'_>>())
}

/// Fills the stack below, calls, and looks how much is not as it was.
#[inline(never)]
fn taken(call: &mut dyn FnMut()) -> Taken {
    let top = arch::stack_pointer();
    let words = || (top - DEPTH..top).step_by(size_of::<usize>());
    // SAFETY: the stack is larger, nothing is called here, and no interrupt is on: what is below is nobody's.
    words().for_each(|at| unsafe { (at as *mut usize).write_volatile(UNUSED) });
    let before = arch::nanoseconds();
    call();
    let instructions = arch::nanoseconds() - before;
    // SAFETY: as above.
    let used = words().find(|&at| unsafe { (at as *const usize).read_volatile() } != UNUSED);
    let stack = top - used.unwrap_or(top);
    assert!(stack < DEPTH, "a deeper stack than is looked at");
    Taken { instructions, stack }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    host::print(&format!("{info}\n\0"));
    host::exit(1)
}
