//! The border to memory that C owns: every pointer becomes a reference here and nowhere else.

use core::ffi::c_void;
use core::mem::{MaybeUninit, align_of, size_of, take};
use core::slice;

use crate::status::MufasaStatus;

/// What a pointer points to; `None` for null.
///
/// # Safety
/// A pointer that is not null has to point to a `T` that nobody writes during `'a`.
pub(crate) unsafe fn optional<'a, T>(pointer: *const T) -> Result<Option<&'a T>, MufasaStatus> {
    if !pointer.is_aligned() {
        return Err(MufasaStatus::Misaligned);
    }
    // SAFETY: null gives `None`; otherwise it is aligned (checked), and valid for reads and not
    // written during 'a (the caller's duty).
    Ok(unsafe { pointer.as_ref() })
}

/// As [`optional`], but null is an error.
///
/// # Safety
/// As for [`optional`].
pub(crate) unsafe fn required<'a, T>(pointer: *const T) -> Result<&'a T, MufasaStatus> {
    // SAFETY: the caller's duty is the same.
    unsafe { optional(pointer) }?.ok_or(MufasaStatus::NullPointer)
}

/// As [`required`], to be written to.
///
/// # Safety
/// A pointer that is not null has to point to a `T` that nobody else reads or writes during `'a`.
pub(crate) unsafe fn required_mut<'a, T>(pointer: *mut T) -> Result<&'a mut T, MufasaStatus> {
    if !pointer.is_aligned() {
        return Err(MufasaStatus::Misaligned);
    }
    // SAFETY: null gives `None`; otherwise it is aligned (checked), and the caller's alone.
    unsafe { pointer.as_mut() }.ok_or(MufasaStatus::NullPointer)
}

/// The first `most` elements of an array; of an empty one the pointer may be anything.
///
/// # Safety
/// The pointer has to point to `count` elements that nobody writes during `'a`; `most` of them
/// have to be smaller than half of the address space.
pub(crate) unsafe fn list<'a, T>(
    pointer: *const T,
    count: usize,
    most: usize,
) -> Result<&'a [T], MufasaStatus> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(MufasaStatus::NullPointer);
    }
    if !pointer.is_aligned() {
        return Err(MufasaStatus::Misaligned);
    }
    // SAFETY: not null and aligned (checked); readable, not written during 'a, and not too large
    // (the caller's duty).
    Ok(unsafe { slice::from_raw_parts(pointer, count.min(most)) })
}

/// Writes a result to where C wants it.
///
/// # Safety
/// A pointer that is neither null nor misaligned has to be valid for writing a `T`.
pub(crate) unsafe fn put<T>(place: *mut T, value: T) -> Result<(), MufasaStatus> {
    if place.is_null() {
        return Err(MufasaStatus::NullPointer);
    }
    if !place.is_aligned() {
        return Err(MufasaStatus::Misaligned);
    }
    // SAFETY: not null and aligned (checked), valid for writes (the caller's duty).
    unsafe { place.write(value) };
    Ok(())
}

/// Memory of the caller, handed out piece by piece from the front.
pub(crate) struct Arena<'a> {
    rest: &'a mut [MaybeUninit<u8>],
}

impl<'a> Arena<'a> {
    /// Bytes that `count` elements may take, with those lost to alignment.
    pub(crate) const fn bytes_of<T>(count: usize) -> usize {
        count.saturating_mul(size_of::<T>()).saturating_add(align_of::<T>().saturating_sub(1))
    }

    /// # Safety
    /// The memory has to be valid for writing `bytes` bytes, and nobody else may read or write it
    /// during `'a`; `bytes` has to be smaller than half of the address space.
    pub(crate) unsafe fn new(memory: *mut c_void, bytes: usize) -> Result<Self, MufasaStatus> {
        if bytes == 0 {
            return Ok(Self { rest: &mut [] });
        }
        if memory.is_null() {
            return Err(MufasaStatus::NullPointer);
        }
        // SAFETY: not null (checked), bytes need no alignment and no value; valid for writes and
        // nobody else's (the caller's duty).
        let rest = unsafe { slice::from_raw_parts_mut(memory.cast(), bytes) };
        Ok(Self { rest })
    }

    /// What was not handed out: where it begins, and its bytes.
    pub(crate) fn rest(&mut self) -> (*mut c_void, usize) {
        (self.rest.as_mut_ptr().cast(), self.rest.len())
    }

    /// Moves elements into the memory.
    pub(crate) fn keep<T: Copy>(
        &mut self,
        items: impl ExactSizeIterator<Item = T>,
    ) -> Result<&'a mut [T], MufasaStatus> {
        let too_small = MufasaStatus::MemoryTooSmall;
        let lost = self.rest.as_ptr().align_offset(align_of::<T>());
        let bytes = items.len().checked_mul(size_of::<T>()).ok_or(too_small)?;
        let rest = take(&mut self.rest).get_mut(lost..).ok_or(too_small)?;
        let (mine, rest) = rest.split_at_mut_checked(bytes).ok_or(too_small)?;
        self.rest = rest;
        let places: *mut MaybeUninit<T> = mine.as_mut_ptr().cast();
        // SAFETY: `mine` holds `bytes` = len * size_of::<T>() bytes that are this function's alone
        // for 'a; its start is aligned, as `lost` bytes were left out; any bytes are a
        // `MaybeUninit`.
        let places = unsafe { slice::from_raw_parts_mut(places, items.len()) };
        let mut written: usize = 0;
        for (place, item) in places.iter_mut().zip(items) {
            place.write(item);
            written = written.saturating_add(1);
        }
        // SAFETY: the first `written` elements were written just now, in the same memory.
        Ok(unsafe { slice::from_raw_parts_mut(places.as_mut_ptr().cast(), written) })
    }
}

#[cfg(test)]
mod tests {
    use super::{Arena, MaybeUninit, list, optional, put, required, required_mut};
    use crate::status::MufasaStatus;

    #[test]
    fn an_arena_gives_aligned_pieces_until_it_is_empty() {
        let mut memory = [MaybeUninit::<u8>::uninit(); 64];
        for start in 0..8 {
            let rest = &mut memory[start..start + Arena::bytes_of::<u64>(3)];
            // SAFETY: the slice is this test's alone.
            let mut arena = unsafe { Arena::new(rest.as_mut_ptr().cast(), rest.len()) }.unwrap();
            assert_eq!(arena.keep([1_u64, 2, 3].into_iter()).unwrap(), [1, 2, 3]);
            assert_eq!(arena.keep([4_u64].into_iter()).err(), Some(MufasaStatus::MemoryTooSmall));
        }
    }

    #[test]
    fn pieces_do_not_overlap() {
        let mut memory = [MaybeUninit::<u8>::uninit(); 64];
        // SAFETY: the array is this test's alone.
        let mut arena = unsafe { Arena::new(memory.as_mut_ptr().cast(), memory.len()) }.unwrap();
        let bytes = arena.keep([7_u8; 3].into_iter()).unwrap();
        let words = arena.keep([u32::MAX; 4].into_iter()).unwrap();
        bytes.fill(9);
        assert_eq!((&*bytes, &*words), (&[9; 3][..], &[u32::MAX; 4][..]));
    }

    #[test]
    fn null_and_misaligned_pointers_are_refused() {
        let numbers = [1_u32, 2, 3];
        let odd = (&raw const numbers).cast::<u32>().wrapping_byte_add(1);
        let null = core::ptr::null::<u32>();
        // SAFETY: null and misaligned pointers are refused before they are followed.
        unsafe {
            assert_eq!(required(null).err(), Some(MufasaStatus::NullPointer));
        }
        // SAFETY: as above.
        assert_eq!(unsafe { required(odd) }.err(), Some(MufasaStatus::Misaligned));
        // SAFETY: as above.
        assert_eq!(unsafe { required_mut(odd.cast_mut()) }.err(), Some(MufasaStatus::Misaligned));
        // SAFETY: as above.
        assert_eq!(unsafe { optional(odd) }.err(), Some(MufasaStatus::Misaligned));
        // SAFETY: as above.
        assert_eq!(unsafe { list(null, 1, 1) }.err(), Some(MufasaStatus::NullPointer));
        // SAFETY: as above.
        assert_eq!(unsafe { list(odd, 1, 1) }.err(), Some(MufasaStatus::Misaligned));
        // SAFETY: as above.
        assert_eq!(unsafe { put(odd.cast_mut(), 1) }.err(), Some(MufasaStatus::Misaligned));
        // SAFETY: an empty list is not followed.
        assert_eq!(unsafe { list(null, 0, 1) }, Ok(&[][..]));
        // SAFETY: the array holds three elements.
        assert_eq!(unsafe { list(numbers.as_ptr(), 3, 2) }, Ok(&[1, 2][..]));
    }
}
