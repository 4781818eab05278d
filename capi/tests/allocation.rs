//! No call of the interface allocates: an allocator that counts, and calls beside it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use mufasa_capi::check::{
    MUFASA_SCRATCH_BYTES_MAX, mufasa_check, mufasa_parameters_default, mufasa_scratch_bytes,
};
use mufasa_capi::cycle::{
    MufasaConfiguration, MufasaCrossSection, MufasaCycle, MufasaDetection, MufasaDetectionList,
    MufasaEgo, MufasaProfile, MufasaRoute, MufasaTrack, MufasaTrackList, MufasaTrajectory,
    MufasaTrajectoryPoint,
};
use mufasa_capi::event::{MufasaEvent, MufasaEventType};
use mufasa_capi::monitor::{
    MufasaActions, MufasaDecision, MufasaMonitorInputs, MufasaMonitorSettings, MufasaTrackMessage,
    mufasa_monitor_bytes, mufasa_monitor_cycle, mufasa_monitor_init, mufasa_monitor_set_route,
    mufasa_monitor_settings_default, mufasa_monitor_step, mufasa_monitor_tracks,
};
use mufasa_capi::report::{MufasaFailedStage, MufasaReport};
use mufasa_capi::status::MufasaStatus;
use mufasa_capi::time::MufasaTime;

const EPOCH: MufasaTime = MufasaTime { ns: 0 };
const EGO: MufasaEgo = MufasaEgo {
    x: 0.0,
    y: 0.0,
    cos: 1.0,
    sin: 0.0,
    speed: 30.0,
    length: 4.8,
    width: 1.9,
    center_offset: 1.4,
};

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

/// A car that stands ahead.
fn track(id: i64, x: f64) -> MufasaTrack {
    let MufasaDetection { y, cos, sin, length, width, .. } = detection(x);
    MufasaTrack { id, x, y, cos, sin, vx: 0.0, vy: 0.0, length, width }
}

/// The same as the detectors see it.
fn detection(x: f64) -> MufasaDetection {
    MufasaDetection { x, y: 0.0, cos: 1.0, sin: 0.0, length: 4.0, width: 2.0 }
}

/// As many tracks, detections and points as the domain allows; a witness that is found late.
#[test]
fn a_check_allocates_nothing() {
    let place = |i: usize| f64::from(u16::try_from(i).expect("a small index"));
    let track = |i: usize| track(i64::try_from(i).expect("a small index"), 50.0 + place(i));
    let detection = |i: usize| detection(50.1 + place(i));
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
    let cycle = MufasaCycle {
        profile: MufasaProfile::Paper as u32,
        configuration: MufasaConfiguration::AllRemote as u32,
        now: EPOCH,
        parameters: mufasa_parameters_default(),
        ego: EGO,
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
    let mut report = MaybeUninit::<MufasaReport>::uninit();
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

/// A station offers, confirms and sends tracks, and a cycle checks them.
#[test]
fn a_monitor_allocates_nothing() {
    let settings = MufasaMonitorSettings {
        profile: MufasaProfile::Paper as u32,
        most_tracks: 2,
        most_detections: 2,
        ..mufasa_monitor_settings_default(20_000_000)
    };
    // SAFETY: the settings live to the end of the test.
    let bytes = unsafe { mufasa_monitor_bytes(&raw const settings) };
    let mut memory = vec![0_u64; bytes.div_ceil(8)];
    let sections =
        [-10.0, 200.0].map(|x| MufasaCrossSection { x, y: 0.0, left: [x, 3.0], right: [x, -3.0] });
    let route = MufasaRoute { closed: 0, cross_sections: sections.as_ptr(), cross_sections_len: 2 };
    let (track, detection) = (track(1, 50.0), detection(50.0));
    let tracks = MufasaTrackList { stamp: EPOCH, items: &raw const track, items_len: 1 };
    let message = MufasaTrackMessage { station: 3, session: 1, generated: EPOCH, tracks };
    let detections =
        MufasaDetectionList { stamp: EPOCH, items: &raw const detection, items_len: 1 };
    let inputs = MufasaMonitorInputs {
        ego: EGO,
        detections: &raw const detections,
        lead: null(),
        grid: null(),
        local_tracks: null(),
        local_trajectory: null(),
    };
    let event = |kind: MufasaEventType| MufasaEvent {
        t: EPOCH,
        event_type: kind as u32,
        group: 1,
        groups: 3,
        station: 3,
        session: 1,
    };
    let events =
        [MufasaEventType::Offer, MufasaEventType::Tick, MufasaEventType::Confirm].map(event);
    let mut monitor = null_mut();
    let mut actions = MaybeUninit::<MufasaActions>::uninit();
    let mut decision = MaybeUninit::<MufasaDecision>::uninit();
    let count = allocations(|| {
        let (place, made) = (memory.as_mut_ptr().cast(), &raw mut monitor);
        // SAFETY: the memory is this test's alone and lives to its end.
        let status = unsafe { mufasa_monitor_init(&raw const settings, place, bytes, made) };
        assert_eq!(status, MufasaStatus::Ok);
        // SAFETY: the monitor was just made; all that is pointed to lives to the end of the test, here and below.
        let status = unsafe { mufasa_monitor_set_route(monitor, &raw const route) };
        assert_eq!(status, MufasaStatus::Ok);
        let to = actions.as_mut_ptr();
        for event in &events {
            // SAFETY: as above.
            let status = unsafe { mufasa_monitor_step(monitor, event, to) };
            assert_eq!(status, MufasaStatus::Ok);
        }
        // SAFETY: as above.
        let status = unsafe { mufasa_monitor_tracks(monitor, EPOCH, &raw const message, to) };
        assert_eq!(status, MufasaStatus::Ok);
        let to = decision.as_mut_ptr();
        // SAFETY: as above.
        let status = unsafe { mufasa_monitor_cycle(monitor, EPOCH, &raw const inputs, to) };
        assert_eq!(status, MufasaStatus::Ok);
    });
    // SAFETY: it was written, as its pointer was neither null nor misaligned.
    let decision = unsafe { decision.assume_init() };
    assert_eq!((count, decision.report.safe), (0, 1));
    assert!(!decision.tracks.is_null(), "the station's tracks were not checked");
}
