//! Cortex-A53 on QEMU's board `virt`, without address translation.

use core::arch::{asm, global_asm};

// Floating point is let through to the instructions.
global_asm!(
    ".section .start, \"ax\"
    .global _start
    _start:
    mov x0, #0x300000
    msr cpacr_el1, x0
    isb
    ldr x0, =STACK
    mov sp, x0
    b start"
);

/// Of the emulator's clock, in steps of 16 (62.5 MHz).
pub fn nanoseconds() -> u64 {
    let ticks: u64;
    // SAFETY: reads the counter.
    unsafe { asm!("isb", "mrs {}, cntvct_el0", out(reg) ticks) };
    ticks * 16
}

pub fn stack_pointer() -> usize {
    let top;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) top) };
    top
}

/// Two instructions a turn.
pub fn count_down(turns: u32) {
    // SAFETY: changes its own register and the flags.
    unsafe { asm!("2: subs {0:w}, {0:w}, #1", "b.ne 2b", inout(reg) turns => _) };
}

/// # Safety
/// The argument is what the operation asks for.
pub unsafe fn call(operation: usize, argument: usize) -> usize {
    let answer;
    // SAFETY: as the caller says.
    unsafe { asm!("hlt 0xf000", inout("x0") operation => answer, in("x1") argument) };
    answer
}
