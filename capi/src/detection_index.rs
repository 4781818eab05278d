//! `mufasa::input::detection_index` for C: a list of detections that is checked and sorted once, and
//! then used in every cycle in which it is current or history. An index lives in memory of the
//! caller, a copy of the detections and the working memory right behind it.

use core::ffi::c_void;
use core::mem::{align_of, size_of};
use core::ptr::null;

use mufasa::input::cycle::{Detection, DetectionList};
use mufasa::input::detection_index::{DetectionIndex, Slot};

use crate::cycle::{MufasaDetection, MufasaDetectionList};
use crate::memory::{Arena, list, put, required};
use crate::status::MufasaStatus;

/// A list of detections with its index in the memory of the caller; its content may change from
/// version to version.
pub struct MufasaDetectionIndex {
    /// The list that it is of.
    list: MufasaDetectionList,
    index: DetectionIndex<'static>,
}

/// An index needs memory aligned to this many bytes, as `malloc` gives it.
pub const MUFASA_DETECTION_INDEX_ALIGN: usize = 8;

/// No more indexes are looked at.
pub const MUFASA_MAX_DETECTION_INDEXES: usize = 64;

/// The most of `spec/4-arithmetic.md#domain` and one.
pub(crate) const DETECTIONS: usize = 2049;

const _: () = assert!(align_of::<MufasaDetectionIndex>() <= MUFASA_DETECTION_INDEX_ALIGN);

/// Bytes of memory for the index of a list of so many detections; 2048 are enough for every list.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_detection_index_bytes(items_len: usize) -> usize {
    let items = items_len.min(DETECTIONS);
    size_of::<MufasaDetectionIndex>()
        .saturating_add(Arena::bytes_of::<Detection>(items))
        .saturating_add(Arena::bytes_of::<Slot>(items))
}

/// Checks a list of detections, copies and sorts it in `memory`, whose content means nothing before:
/// once for the cycle in which it is `detections` and for those in which it is a list of
/// `detection_history`. `*index` is where the index is; it needs no end, and may not be moved.
/// When the status is not OK there is none, and `*index`, if it can be written to, is null.
/// INVALID_LIST when the detections are not valid: `mufasa_check` says which one.
///
/// An index is used for the list of a cycle with the same stamp, the same pointer to the items and
/// the same number of them; the items themselves are then not read again. So write no new detections
/// where `list.items` points as long as a cycle names that list, and when you do, make its index
/// anew. What is not indexed is copied, checked and sorted in every cycle: no verdict depends on
/// it, only time.
///
/// # Safety
/// `list` is null or points to a list, whose items are as many as it says; `memory` points to
/// `bytes` bytes that nobody else uses as long as the index is used; `index` is null or can be
/// written to.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_detection_index_init(
    list: *const MufasaDetectionList,
    memory: *mut c_void,
    bytes: usize,
    index: *mut *const MufasaDetectionIndex,
) -> MufasaStatus {
    // SAFETY: the caller's duty.
    let (made, status) = match unsafe { init(list, memory, bytes) } {
        Ok(made) => (made, MufasaStatus::Ok),
        Err(status) => (null(), status),
    };
    // SAFETY: the caller's duty.
    match unsafe { put(index, made) } {
        Ok(()) => status,
        Err(status) => status,
    }
}

/// # Safety
/// As for [`mufasa_detection_index_init`].
unsafe fn init(
    raw: *const MufasaDetectionList,
    memory: *mut c_void,
    bytes: usize,
) -> Result<*const MufasaDetectionIndex, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let raw = unsafe { required(raw) }?;
    if memory.is_null() {
        return Err(MufasaStatus::NullPointer);
    }
    if !memory.cast::<MufasaDetectionIndex>().is_aligned() {
        return Err(MufasaStatus::Misaligned);
    }
    let own = size_of::<MufasaDetectionIndex>();
    let rest = bytes.checked_sub(own).ok_or(MufasaStatus::MemoryTooSmall)?;
    // SAFETY: `own` bytes are there (checked).
    let behind = unsafe { memory.byte_add(own) };
    // SAFETY: what is behind the index is the caller's memory, too.
    let mut arena = unsafe { Arena::new(behind, rest) }?;
    // SAFETY: as above.
    let items = unsafe { list(raw.items, raw.items_len, DETECTIONS) }?;
    let items: &'static [Detection] = arena.keep(items.iter().map(detection))?;
    let slots = arena.keep(items.iter().map(|_| Slot::default()))?;
    let list = DetectionList { stamp_ns: raw.stamp.ns, items };
    let index = DetectionIndex::new(&list, slots).map_err(|_| MufasaStatus::InvalidList)?;
    let place: *mut MufasaDetectionIndex = memory.cast();
    // SAFETY: not null, aligned and large enough (checked); the caller's memory.
    unsafe { put(place, MufasaDetectionIndex { list: *raw, index }) }?;
    Ok(place)
}

/// The indexes that C gives with a cycle.
#[derive(Clone, Copy)]
pub(crate) struct Kept<'a> {
    pointers: &'a [*const MufasaDetectionIndex],
}

impl<'a> Kept<'a> {
    /// # Safety
    /// `pointers` points to `count` pointers, each of which is null or comes from
    /// `mufasa_detection_index_init`, in memory that nobody else writes to during `'a`.
    pub(crate) unsafe fn new(
        pointers: *const *const MufasaDetectionIndex,
        count: usize,
    ) -> Result<Self, MufasaStatus> {
        // SAFETY: the caller's duty.
        Ok(Self { pointers: unsafe { list(pointers, count, MUFASA_MAX_DETECTION_INDEXES) }? })
    }

    /// The index of this very list.
    ///
    /// # Safety
    /// As for `new`.
    pub(crate) unsafe fn of(
        &self,
        list: &MufasaDetectionList,
    ) -> Result<Option<DetectionIndex<'a>>, MufasaStatus> {
        for &pointer in self.pointers {
            if pointer.is_null() {
                continue;
            }
            // SAFETY: the caller's duty.
            let kept: &'a MufasaDetectionIndex = unsafe { required(pointer) }?;
            let MufasaDetectionList { stamp, items, items_len } = kept.list;
            if (stamp, items, items_len) == (list.stamp, list.items, list.items_len) {
                return Ok(Some(kept.index));
            }
        }
        Ok(None)
    }
}

/// The record of `mufasa`.
pub(crate) fn detection(raw: &MufasaDetection) -> Detection {
    let MufasaDetection { x, y, cos, sin, length, width } = *raw;
    Detection { x, y, cos, sin, length, width }
}
