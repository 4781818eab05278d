//! A monitor in the memory of the caller, its parts right behind it.

use core::ffi::c_void;
use core::mem::{align_of, size_of};

use mufasa::input::cycle::{CrossSection, Detection, Track, TrajectoryPoint};
use mufasa::input::detection_index::Slot;
use mufasa::input::profile::Profile;
use mufasa::input::route_index::Block;
use mufasa::input::scratch::{Column, Row};
use mufasa::monitor::{Memory, Monitor};
use mufasa::offloading::requester::StationRecord;
use mufasa::report::InvalidInput;

use super::decision::{NO_LIST, NO_TRAJECTORY, Verdicts};
use super::element::{NO_POINT, NO_TRACK, Received};
use super::settings::{MufasaMonitorSettings, refused};
use crate::cycle::{
    MufasaDetectionList, MufasaEgo, MufasaGrid, MufasaLead, MufasaTrack, MufasaTrackList,
    MufasaTrajectory, MufasaTrajectoryPoint,
};
use crate::memory::{Arena, put, required};
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// What the CAV knows when a cycle begins. Profile, parameters, configuration, route, the station's data and
/// earlier detections are not among it: the monitor has them.
///
/// All places, those of the route and of stations' messages, too, are in one right-handed frame of the road plane that
/// stands still (UTM, or any other); lengths in m, speeds in m/s. A direction (cos, sin) is that of an angle from x towards
/// y; to the left of it is (-sin, cos). Times are of the CAV's monotonic clock.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaMonitorInputs {
    /// The CAV.
    pub ego: MufasaEgo,
    /// The detections of all local detectors, of which the monitor keeps a copy; may be null.
    pub detections: *const MufasaDetectionList,
    /// The leading vehicle, its gap bumper to bumper; may be null.
    pub lead: *const MufasaLead,
    /// The occupancy grid map; may be null.
    pub grid: *const MufasaGrid,
    /// Tracks of the CAV's own MOT, used while MOT is not remote; may be null.
    pub local_tracks: *const MufasaTrackList,
    /// The trajectory of the CAV's own planner, used while PLAN is not remote; may be null.
    pub local_trajectory: *const MufasaTrajectory,
}

/// A monitor in the memory of the caller; its content may change from version to version.
pub struct MufasaMonitor {
    pub(super) monitor: Monitor<'static>,
    pub(super) tracks: Received<Track>,
    pub(super) trajectory: Received<TrajectoryPoint>,
    pub(super) verdicts: Verdicts,
    /// Of detections and cross sections; for tracks and points see `Received`.
    pub(super) most_detections: usize,
    pub(super) most_cross_sections: usize,
    /// What was wrong with the last route.
    pub(super) route_problem: Option<InvalidInput>,
    /// For lists of the call that goes on.
    pub(super) scratch: *mut c_void,
    pub(super) scratch_bytes: usize,
}

/// A monitor needs memory aligned to this many bytes, as `malloc` gives it.
pub const MUFASA_MONITOR_ALIGN: usize = 8;

const _: () = assert!(align_of::<MufasaMonitor>() <= MUFASA_MONITOR_ALIGN);

/// How many elements of each kind a monitor has.
pub(super) struct Sizes {
    stations: usize,
    tracks: usize,
    points: usize,
    detections: usize,
    kept_detections: usize,
    slots: usize,
    columns: usize,
    cross_sections: usize,
    blocks: usize,
}

impl Sizes {
    pub(super) fn of(settings: &MufasaMonitorSettings) -> Self {
        let &MufasaMonitorSettings {
            most_stations: stations,
            most_tracks: tracks,
            most_points: points,
            most_detections: detections,
            most_cross_sections: cross_sections,
            ..
        } = settings;
        let spare = usize::try_from(settings.stages.miss_budget).unwrap_or(0).min(tracks);
        Self {
            stations,
            tracks,
            points,
            detections,
            kept_detections: Memory::detections_for(detections),
            slots: Memory::slots_for(detections),
            columns: detections.saturating_add(spare).max(tracks),
            cross_sections,
            blocks: Block::needed(cross_sections),
        }
    }

    /// Tracks, detections, cross sections and stations, of which a monitor says whether they are checked in time.
    pub(super) fn lists(&self, profile: Profile) -> [usize; 4] {
        let detections = if profile.looks_back() { self.detections } else { self.columns };
        [self.tracks, detections, self.cross_sections, self.stations]
    }

    /// For the lists of one call.
    fn scratch_bytes(&self) -> usize {
        let lists = Arena::bytes_of::<Track>(self.tracks)
            .saturating_add(Arena::bytes_of::<TrajectoryPoint>(self.points))
            .saturating_add(Arena::bytes_of::<Detection>(self.detections));
        lists.max(Arena::bytes_of::<CrossSection>(self.cross_sections))
    }

    fn bytes(&self) -> usize {
        size_of::<MufasaMonitor>()
            .saturating_add(Arena::bytes_of::<StationRecord>(self.stations))
            .saturating_add(Arena::bytes_of::<Row>(self.tracks))
            .saturating_add(Arena::bytes_of::<Column>(self.columns))
            .saturating_add(Arena::bytes_of::<Detection>(self.kept_detections))
            .saturating_add(Arena::bytes_of::<Slot>(self.slots))
            .saturating_add(Arena::bytes_of::<CrossSection>(self.cross_sections))
            .saturating_add(Arena::bytes_of::<Block>(self.blocks))
            .saturating_add(Arena::bytes_of::<Track>(self.tracks).saturating_mul(2))
            .saturating_add(Arena::bytes_of::<TrajectoryPoint>(self.points).saturating_mul(2))
            .saturating_add(Arena::bytes_of::<MufasaTrack>(self.tracks))
            .saturating_add(Arena::bytes_of::<MufasaTrajectoryPoint>(self.points))
            .saturating_add(self.scratch_bytes())
    }
}

/// Bytes of memory for a monitor with these settings; SIZE_MAX when they cannot be read.
///
/// # Safety
/// `settings` is null or points to settings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mufasa_monitor_bytes(settings: *const MufasaMonitorSettings) -> usize {
    // SAFETY: the caller's duty.
    unsafe { required(settings) }.map_or(usize::MAX, |settings| Sizes::of(settings).bytes())
}

/// # Safety
/// As for `mufasa_monitor_init`.
pub(super) unsafe fn init(
    settings: *const MufasaMonitorSettings,
    memory: *mut c_void,
    bytes: usize,
) -> Result<*mut MufasaMonitor, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let settings = unsafe { required(settings) }?;
    let sizes = Sizes::of(settings);
    if memory.is_null() {
        return Err(MufasaStatus::NullPointer);
    }
    if memory.align_offset(MUFASA_MONITOR_ALIGN) != 0 {
        return Err(MufasaStatus::Misaligned);
    }
    // More than half of the address space is no memory.
    let rest = bytes.min(isize::MAX.unsigned_abs()).checked_sub(size_of::<MufasaMonitor>());
    let rest = rest.filter(|_| sizes.bytes() <= bytes).ok_or(MufasaStatus::MemoryTooSmall)?;
    // SAFETY: the monitor itself fits (checked).
    let behind = unsafe { memory.byte_add(size_of::<MufasaMonitor>()) };
    // SAFETY: what is behind the monitor is the caller's memory, too, and the monitor's as long as it is
    // used.
    let arena: &mut Arena<'static> = &mut unsafe { Arena::new(behind, rest) }?;
    // IMPL-08
    let parts = Memory {
        stations: arena.keep((0..sizes.stations).map(|_| StationRecord::FREE))?,
        rows: arena.keep((0..sizes.tracks).map(|_| Row::default()))?,
        columns: arena.keep((0..sizes.columns).map(|_| Column::default()))?,
        detections: arena.keep((0..sizes.kept_detections).map(|_| Detection::default()))?,
        slots: arena.keep((0..sizes.slots).map(|_| Slot::default()))?,
        cross_sections: arena.keep((0..sizes.cross_sections).map(|_| CrossSection::default()))?,
        blocks: arena.keep((0..sizes.blocks).map(|_| Block::default()))?,
    };
    let mut tracks = || arena.keep((0..sizes.tracks).map(|_| NO_TRACK));
    let tracks = Received::new(tracks()?, tracks()?);
    let mut points = || arena.keep((0..sizes.points).map(|_| NO_POINT));
    let trajectory = Received::new(points()?, points()?);
    let verdicts = Verdicts {
        tracks: arena.keep((0..sizes.tracks).map(|_| c_track()))?,
        points: arena.keep((0..sizes.points).map(|_| c_point()))?,
        track_list: NO_LIST,
        trajectory: NO_TRAJECTORY,
    };
    let monitor = Monitor::new(settings.of_monitor()?, parts).map_err(refused)?;
    let (scratch, scratch_bytes) = arena.rest();
    let place: *mut MufasaMonitor = memory.cast();
    let made = MufasaMonitor {
        monitor,
        tracks,
        trajectory,
        verdicts,
        most_detections: sizes.detections,
        most_cross_sections: sizes.cross_sections,
        route_problem: None,
        scratch,
        scratch_bytes,
    };
    // SAFETY: not null, aligned and large enough (checked); the caller's memory.
    unsafe { put(place, made) }?;
    Ok(place)
}

const fn c_track() -> MufasaTrack {
    let (cos, length) = (1.0, 1.0);
    let (x, y, sin, vx, vy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    MufasaTrack { id: 0, x, y, cos, sin, vx, vy, length, width: length }
}

const fn c_point() -> MufasaTrajectoryPoint {
    MufasaTrajectoryPoint { t: MufasaTime::EPOCH, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }
}
