//! The emulator's host, by semihosting: its files, its console, the end.

use core::ffi::CStr;

use crate::arch::call;

const OPEN: usize = 1;
const PRINT: usize = 4;
const WRITE: usize = 5;
const READ: usize = 6;
const EXIT: usize = 0x20;
/// The application is at its end.
const AT_ITS_END: usize = 0x2_0026;

/// A file of the host.
pub struct File(usize);

impl File {
    /// Mode 1 reads, 5 writes anew.
    pub fn open(name: &CStr, mode: usize) -> Self {
        Self(semihosting(OPEN, &[name.as_ptr() as usize, mode, name.count_bytes()]))
    }

    /// All of it; false at the end of the file.
    pub fn read(&self, to: &mut [u8]) -> bool {
        semihosting(READ, &[self.0, to.as_mut_ptr() as usize, to.len()]) == 0
    }

    pub fn write(&self, bytes: &[u8]) {
        let left = semihosting(WRITE, &[self.0, bytes.as_ptr() as usize, bytes.len()]);
        assert!(left == 0, "the answers cannot be written");
    }
}

/// A text with a zero behind it.
pub fn print(text: &str) {
    // SAFETY: what is named is read as far as the zero.
    unsafe { call(PRINT, text.as_ptr() as usize) };
}

pub fn exit(status: usize) -> ! {
    semihosting(EXIT, &[AT_ITS_END, status]);
    loop {
        core::hint::spin_loop();
    }
}

fn semihosting(operation: usize, arguments: &[usize]) -> usize {
    // SAFETY: every caller gives what its operation asks for: addresses with lengths, and numbers.
    unsafe { call(operation, arguments.as_ptr() as usize) }
}
