//! A check in C: numbers of any bits, or such as a cycle has; lists of any length, and scratch memory of any size.
#![no_main]

use mufasa_capi::check::{mufasa_check, mufasa_parameters_default, mufasa_scratch_bytes};
use mufasa_capi::cycle::*;
use mufasa_capi::{report::MufasaReport, status::MufasaStatus};

/// A list behind a word, with at most as many items as there are.
fn list<T>(words: &[u64], [from, count]: [u8; 2]) -> (*const T, usize) {
    let rest = &words[usize::from(from) % words.len()..];
    (rest.as_ptr().cast(), usize::from(count).min(size_of_val(rest) / size_of::<T>()))
}

/// The words as items of so many, in each a direction at a place, if they are to be plain; else as they are.
fn items(words: &[u64], is_plain: bool, size: usize, direction: usize) -> Vec<u64> {
    let mut words = words.to_vec();
    let directed = words.chunks_exact_mut(size).filter(|_| is_plain);
    directed
        .for_each(|it| it[direction..direction + 2].copy_from_slice(&[1.0, 0.0].map(f64::to_bits)));
    words
}

libfuzzer_sys::fuzz_target!(|input: (u8, u16, [[u8; 2]; 7], &[u8])| {
    let (kind, given, places, bytes) = input;
    let mut words: Vec<u64> = bytes.as_chunks().0.iter().copied().map(u64::from_le_bytes).collect();
    words.resize(words.len().max(size_of::<MufasaCycle>()), 0);
    let is_plain = kind & 1 == 0;
    if is_plain {
        // Else few of these numbers are in the domain.
        words.iter_mut().for_each(|it| *it = (f64::from(*it as u16 % 640) / 16.0).to_bits());
    }
    // SAFETY: of these numbers all bits are values, and its pointers are replaced.
    let mut cycle: MufasaCycle = unsafe { words.as_ptr().cast::<MufasaCycle>().read() };
    (cycle.profile, cycle.configuration) =
        (1 + u32::from(kind >> 1 & 1), 1 + u32::from(kind >> 2 & 3));
    if kind & 16 == 0 {
        cycle.parameters = mufasa_parameters_default();
    }
    if is_plain {
        (cycle.ego.cos, cycle.ego.sin) = (1.0, 0.0);
    }
    (cycle.route.cross_sections, cycle.route.cross_sections_len) = list(&words, places[0]);
    let mut kept = items(&words, is_plain, 5, 3);
    if is_plain {
        let times = (cycle.now.ns as u64..).step_by(100_000_000);
        kept.chunks_mut(5).zip(times).for_each(|(it, t_ns)| it[0] = t_ns);
    }
    let (points, points_len) = list(&kept, [0, places[1][1]]);
    let trajectory = MufasaTrajectory { stamp: cycle.now, points, points_len };
    let kept = items(&words, is_plain, 9, 3);
    let (first, items_len) = list(&kept, [0, places[2][1]]);
    let tracks = MufasaTrackList { stamp: cycle.now, items: first, items_len };
    let kept = items(&words, is_plain, 6, 2);
    let (first, items_len) = list(&kept, [0, places[3][1]]);
    let detections = MufasaDetectionList { stamp: cycle.now, items: first, items_len };
    (cycle.detections, cycle.detection_history, cycle.detection_history_len) =
        (&detections, &detections, 1);
    let (lead, lead_len) = list(&words, places[4]);
    cycle.lead = if lead_len > 0 { lead } else { std::ptr::null() };
    let (occupied, occupied_len) = list(&words, places[5]);
    let (unknown, unknown_len) = list(&words, places[6]);
    // SAFETY: as above.
    let mut grid: MufasaGrid = unsafe { words.as_ptr().cast::<MufasaGrid>().read() };
    if is_plain {
        (grid.cos, grid.sin, grid.width, grid.height) = (1.0, 0.0, given.into(), 4);
    }
    let grid = MufasaGrid { occupied, occupied_len, unknown, unknown_len, ..grid };
    (cycle.trajectory, cycle.tracks, cycle.grid) = (&trajectory, &tracks, &grid);

    let mut report = std::mem::MaybeUninit::<MufasaReport>::uninit();
    // SAFETY: each list is as long as it says.
    let needed = unsafe { mufasa_scratch_bytes(&cycle) };
    let mut scratch = vec![0_u8; needed.min(32 * usize::from(given))];
    // SAFETY: as above.
    let status = unsafe {
        mufasa_check(&cycle, scratch.as_mut_ptr().cast(), scratch.len(), report.as_mut_ptr())
    };
    assert!(scratch.len() < needed || status == MufasaStatus::Ok, "{status:?}");
    // SAFETY: it is always written.
    assert!(status == MufasaStatus::Ok || unsafe { report.assume_init() }.safe == 0);
});
