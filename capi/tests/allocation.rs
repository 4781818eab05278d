//! No call of the interface allocates: an allocator that counts, and calls beside it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::null;

use mufasa_capi::check::{
    MUFASA_SCRATCH_BYTES_MAX, mufasa_check, mufasa_parameters_default, mufasa_scratch_bytes,
};
use mufasa_capi::cycle::{
    MufasaConfiguration, MufasaCrossSection, MufasaCycle, MufasaDetection, MufasaDetectionList,
    MufasaEgo, MufasaProfile, MufasaRoute, MufasaTrack, MufasaTrackList, MufasaTrajectory,
    MufasaTrajectoryPoint,
};
use mufasa_capi::event::{MUFASA_MAX_ACTIONS, MufasaAction, MufasaEvent, MufasaEventType};
use mufasa_capi::report::{MufasaFailedStage, MufasaReport};
use mufasa_capi::requester::{
    mufasa_requester_bytes, mufasa_requester_init, mufasa_requester_parameters_default,
    mufasa_requester_step,
};
use mufasa_capi::status::MufasaStatus;
use mufasa_capi::time::MufasaTime;

const EPOCH: MufasaTime = MufasaTime { ns: 0 };

struct Counting;

thread_local! {
    /// Allocations of this thread; others belong to the test harness.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: everything is passed on to the allocator of the system; counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's duty is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's duty is the same.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How many allocations `call` makes.
fn allocations(call: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    call();
    ALLOCATIONS.get() - before
}

#[test]
fn the_counter_counts() {
    assert!(allocations(|| drop(std::hint::black_box(Box::new(1)))) > 0);
}

/// As many tracks, detections and points as the domain allows; a witness that is found late.
#[test]
fn a_check_allocates_nothing() {
    let place = |i: usize| f64::from(u16::try_from(i).expect("a small index"));
    let track = |i: usize| MufasaTrack {
        id: i64::try_from(i).expect("a small index"),
        x: 50.0 + place(i),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        vx: 0.0,
        vy: 0.0,
        length: 4.0,
        width: 2.0,
    };
    let detection = |i: usize| MufasaDetection {
        x: 50.1 + place(i),
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        length: 4.0,
        width: 2.0,
    };
    let point = |i: usize| MufasaTrajectoryPoint {
        t: EPOCH,
        x: place(i) / 10.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
    };
    let tracks: Vec<_> = (0..200).map(track).collect();
    let detections: Vec<_> = (0..200).map(detection).collect();
    let points: Vec<_> = (0..1024)
        .map(|i| MufasaTrajectoryPoint {
            t: MufasaTime { ns: i64::try_from(i).expect("small") },
            ..point(i)
        })
        .collect();
    let side = |y| [[-10.0, y], [2000.0, y]];
    let cross_section =
        |i: usize, x| MufasaCrossSection { x, y: 0.0, left: side(3.0)[i], right: side(-3.0)[i] };
    let cross_sections = [cross_section(0, -10.0), cross_section(1, 2000.0)];
    let trajectory = MufasaTrajectory { stamp: EPOCH, points: points.as_ptr(), points_len: 1024 };
    let tracks = MufasaTrackList { stamp: EPOCH, items: tracks.as_ptr(), items_len: 200 };
    let detections =
        MufasaDetectionList { stamp: EPOCH, items: detections.as_ptr(), items_len: 200 };
    let ego = MufasaEgo {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 30.0,
        length: 4.8,
        width: 1.9,
        center_offset: 1.4,
    };
    let cycle = MufasaCycle {
        profile: MufasaProfile::Paper as u32,
        configuration: MufasaConfiguration::AllRemote as u32,
        now: EPOCH,
        parameters: mufasa_parameters_default(),
        ego,
        route: MufasaRoute {
            closed: 0,
            cross_sections: cross_sections.as_ptr(),
            cross_sections_len: 2,
        },
        trajectory: &raw const trajectory,
        tracks: &raw const tracks,
        detections: &raw const detections,
        lead: null(),
        grid: null(),
        detection_history: null(),
        detection_history_len: 0,
    };
    let mut scratch = vec![0_u8; MUFASA_SCRATCH_BYTES_MAX];
    let mut report = std::mem::MaybeUninit::<MufasaReport>::uninit();
    let mut status = MufasaStatus::TableFull;
    let count = allocations(|| {
        // SAFETY: everything that the cycle points to lives to the end of the test.
        let bytes = unsafe { mufasa_scratch_bytes(&raw const cycle) };
        let memory = scratch.as_mut_ptr().cast();
        // SAFETY: as above; the vector is at least as long as any cycle needs.
        status = unsafe { mufasa_check(&raw const cycle, memory, bytes, report.as_mut_ptr()) };
    });
    assert_eq!((count, status), (0, MufasaStatus::Ok));
    // SAFETY: the report was written, as its pointer was neither null nor misaligned.
    let report = unsafe { report.assume_init() };
    assert_eq!(report.failed_stage, MufasaFailedStage::Iii);
}

#[test]
fn a_requester_allocates_nothing() {
    let mut memory = vec![0_u64; mufasa_requester_bytes(4).div_ceil(8)];
    let bytes = memory.len() * 8;
    let parameters = mufasa_requester_parameters_default();
    let mut actions =
        [const { std::mem::MaybeUninit::<MufasaAction>::uninit() }; MUFASA_MAX_ACTIONS];
    let (mut requester, mut requests) = (std::ptr::null_mut(), 0);
    let count = allocations(|| {
        let profile = MufasaProfile::Paper as u32;
        let place = memory.as_mut_ptr().cast();
        let made = &raw mut requester;
        // SAFETY: the memory is this test's alone and lives to its end.
        let status =
            unsafe { mufasa_requester_init(profile, &raw const parameters, 4, place, bytes, made) };
        assert_eq!(status, MufasaStatus::Ok);
        for (event_type, station) in
            [(MufasaEventType::Offer, 3), (MufasaEventType::Offer, 5), (MufasaEventType::Tick, 0)]
        {
            let event = MufasaEvent {
                t: EPOCH,
                event_type: event_type as u32,
                group: 0,
                groups: 3,
                safe: 0,
                station,
                session: 0,
                sessions: [1, 2],
                generated: EPOCH,
            };
            let places = actions.as_mut_ptr().cast();
            let len = &raw mut requests;
            // SAFETY: the requester was just made; the array has as many places as is said.
            let status = unsafe {
                mufasa_requester_step(requester, &raw const event, places, MUFASA_MAX_ACTIONS, len)
            };
            assert_eq!(status, MufasaStatus::Ok);
        }
    });
    assert_eq!((count, requests), (0, 2));
}
