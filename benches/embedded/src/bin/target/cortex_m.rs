//! Cortex-M4 and M7 on Arm's MPS2 boards, as QEMU has them.

use core::arch::{asm, global_asm};

// Stack and start come first; the coprocessors 10 and 11 are the floating point unit; timer 0 runs down from the top.
global_asm!(
    ".section .start, \"a\"
    .word STACK
    .word _start
    .text
    .thumb_func
    .global _start
    _start:
    ldr r0, =0xe000ed88
    mov r1, #0xf00000
    str r1, [r0]
    dsb
    isb
    ldr r0, =0x40000000
    mov r1, #-1
    str r1, [r0, #4]
    str r1, [r0, #8]
    mov r1, #1
    str r1, [r0]
    b start"
);

/// Of the emulator's clock, in steps of 40 (25 MHz).
pub fn nanoseconds() -> u64 {
    // SAFETY: the value of timer 0, a register of 32 bits.
    let left = unsafe { (0x4000_0004 as *const u32).read_volatile() };
    u64::from(u32::MAX - left) * 40
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
    unsafe { asm!("2: subs {0}, {0}, #1", "bne 2b", inout(reg) turns => _) };
}

/// # Safety
/// The argument is what the operation asks for.
pub unsafe fn call(operation: usize, argument: usize) -> usize {
    let answer;
    // SAFETY: as the caller says.
    unsafe { asm!("bkpt 0xab", inout("r0") operation => answer, in("r1") argument) };
    answer
}
