//! Memory for what is read: it grows until it is emptied as a whole.

use core::alloc::{GlobalAlloc, Layout};
use core::ptr::null_mut;
use core::sync::atomic::{AtomicUsize, Ordering::Relaxed};

unsafe extern "C" {
    /// A place of the linker's.
    static HEAP: u8;
}

/// As much as is there.
const BYTES: usize = 16 << 20;

struct Heap {
    used: AtomicUsize,
}

#[global_allocator]
static ALL: Heap = Heap { used: AtomicUsize::new(0) };

// SAFETY: each call gets memory behind that of all before, and there is one processor.
unsafe impl GlobalAlloc for Heap {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let start = &raw const HEAP as usize;
        let from = (start + self.used.load(Relaxed)).next_multiple_of(layout.align());
        let used = from + layout.size() - start;
        if used > BYTES {
            return null_mut();
        }
        self.used.store(used, Relaxed);
        from as *mut u8
    }

    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

/// Nothing that was allocated is used any more.
pub fn empty() {
    ALL.used.store(0, Relaxed);
}
