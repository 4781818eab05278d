//! From the record of C to that of `mufasa`; lists are copied into the caller's scratch memory.
//!
//! A list longer than its domain is passed on with one element too many: that is enough for the
//! check to refuse it, whatever its length is, and scratch memory stays bounded.

use core::mem::size_of;

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::input::profile::Profile;
use mufasa::input::scratch::{Column, Row, Sizes};
use mufasa::services::configuration::Configuration;

use crate::cycle::{
    MufasaConfiguration, MufasaCrossSection, MufasaCycle, MufasaDetection, MufasaDetectionList,
    MufasaEgo, MufasaGrid, MufasaProfile, MufasaTrack, MufasaTrackList, MufasaTrajectory,
    MufasaTrajectoryPoint,
};
use crate::memory::{Arena, list, optional};
use crate::status::MufasaStatus;

#[cfg(test)]
mod tests;

/// The sizes of `spec/4-arithmetic.md#domain` and one.
pub(crate) const TRACKS: usize = 1025;
pub(crate) const DETECTIONS: usize = 2049;
const HISTORY: usize = 5;
pub(crate) const POINTS: usize = 1025;
pub(crate) const CROSS_SECTIONS: usize = 8193;
const BITMAP_BYTES: usize = (1 << 21) + 1;

/// How many elements of each kind scratch memory has to hold.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    points: usize,
    tracks: usize,
    /// Lists of the history, and the items of all of them.
    history: [usize; 2],
    detections: usize,
    cross_sections: usize,
    sizes: Sizes,
}

impl Counts {
    /// Of every cycle.
    pub(crate) const MAX: Self = Self {
        points: POINTS,
        tracks: TRACKS,
        history: [HISTORY, HISTORY * DETECTIONS],
        detections: DETECTIONS,
        cross_sections: CROSS_SECTIONS,
        sizes: Sizes::MAX,
    };

    /// Of this cycle.
    ///
    /// # Safety
    /// The pointers of `raw` are null or point to what they say.
    pub(crate) unsafe fn of(raw: &MufasaCycle) -> Result<Self, MufasaStatus> {
        // SAFETY: the caller's duty, here and below.
        let points = unsafe { optional(raw.trajectory) }?.map_or(0, |list| list.points_len);
        // SAFETY: as above.
        let tracks = unsafe { optional(raw.tracks) }?.map_or(0, |list| list.items_len);
        // SAFETY: as above.
        let history = unsafe { history(raw) }?;
        // SAFETY: as above.
        let detections = unsafe { optional(raw.detections) }?.map_or(0, |list| list.items_len);
        let (tracks, detections) = (tracks.min(TRACKS), detections.min(DETECTIONS));
        let spare = usize::try_from(raw.parameters.miss_budget).unwrap_or(0).min(tracks);
        let earlier = history.iter().map(items_in_domain).max().unwrap_or(0);
        let columns = detections.saturating_add(spare).max(tracks).max(earlier);
        Ok(Self {
            points: points.min(POINTS),
            tracks,
            history: [history.len(), history.iter().map(items_in_domain).sum()],
            detections,
            cross_sections: raw.route.cross_sections_len.min(CROSS_SECTIONS),
            sizes: capped(Sizes { rows: tracks, columns }),
        })
    }

    /// Bytes for all of them, wherever the memory begins.
    pub(crate) const fn bytes(&self) -> usize {
        let [lists, items] = self.history;
        Arena::bytes_of::<TrajectoryPoint>(self.points)
            .saturating_add(Arena::bytes_of::<Track>(self.tracks))
            .saturating_add(Arena::bytes_of::<DetectionList<'_>>(lists))
            .saturating_add(items.saturating_mul(size_of::<Detection>()))
            // Each list may begin anew.
            .saturating_add(Arena::bytes_of::<Detection>(0).saturating_mul(lists))
            .saturating_add(Arena::bytes_of::<Detection>(self.detections))
            .saturating_add(Arena::bytes_of::<CrossSection>(self.cross_sections))
            .saturating_add(Arena::bytes_of::<Row>(self.sizes.rows))
            .saturating_add(Arena::bytes_of::<Column>(self.sizes.columns))
    }
}

/// Sizes beyond those of the domain are never used: the check refuses such a cycle before.
pub(crate) fn capped(sizes: Sizes) -> Sizes {
    Sizes { rows: sizes.rows.min(Sizes::MAX.rows), columns: sizes.columns.min(Sizes::MAX.columns) }
}

/// The record of `mufasa`.
///
/// # Safety
/// The pointers of `raw` are null or point to what they say, and nobody writes there during `'a`.
pub(crate) unsafe fn cycle<'a>(
    raw: &MufasaCycle,
    arena: &mut Arena<'a>,
) -> Result<Cycle<'a>, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let trajectory = unsafe { trajectory(raw.trajectory, arena) }?;
    // SAFETY: as above.
    let detections = match unsafe { optional(raw.detections) }? {
        None => None,
        // SAFETY: as above.
        Some(it) => Some(unsafe { detections_of(it, arena) }?),
    };
    // SAFETY: as above.
    let cross_sections =
        unsafe { list(raw.route.cross_sections, raw.route.cross_sections_len, CROSS_SECTIONS) }?;
    let cross_sections = arena.keep(cross_sections.iter().map(cross_section))?;
    // SAFETY: as above.
    let lead = unsafe { optional(raw.lead) }?;
    Ok(Cycle {
        profile: profile(raw.profile)?,
        parameters: raw.parameters.into(),
        now_ns: raw.now.ns,
        configuration: configuration(raw.configuration)?,
        ego: ego(&raw.ego),
        trajectory,
        // SAFETY: as above.
        tracks: unsafe { tracks(raw.tracks, arena) }?,
        detections,
        lead: lead.map(|it| Lead {
            stamp_ns: it.stamp.ns,
            gap: it.gap.between_bumpers,
            speed: it.speed,
        }),
        route: Route { closed: raw.route.closed != 0, cross_sections },
        // SAFETY: as above.
        grid: unsafe { grid(raw.grid) }?,
        // SAFETY: as above.
        detection_history: unsafe { detection_history(raw, arena) }?,
    })
}

/// # Safety
/// As for [`cycle`].
unsafe fn detections_of<'a>(
    it: &MufasaDetectionList,
    arena: &mut Arena<'a>,
) -> Result<DetectionList<'a>, MufasaStatus> {
    // SAFETY: the caller's duty.
    let items = unsafe { list(it.items, it.items_len, DETECTIONS) }?;
    let items = arena.keep(items.iter().map(detection))?;
    Ok(DetectionList { stamp_ns: it.stamp.ns, items })
}

/// # Safety
/// As for [`cycle`].
unsafe fn history<'a>(raw: &MufasaCycle) -> Result<&'a [MufasaDetectionList], MufasaStatus> {
    // SAFETY: the caller's duty.
    unsafe { list(raw.detection_history, raw.detection_history_len, HISTORY) }
}

fn items_in_domain(list: &MufasaDetectionList) -> usize {
    list.items_len.min(DETECTIONS)
}

/// # Safety
/// As for [`cycle`].
unsafe fn detection_history<'a>(
    raw: &MufasaCycle,
    arena: &mut Arena<'a>,
) -> Result<&'a [DetectionList<'a>], MufasaStatus> {
    let mut lists = [DetectionList { stamp_ns: 0, items: &[] }; HISTORY];
    // SAFETY: the caller's duty, here and below.
    let history = unsafe { history(raw) }?;
    for (place, list) in lists.iter_mut().zip(history) {
        // SAFETY: as above.
        *place = unsafe { detections_of(list, arena) }?;
    }
    let kept = arena.keep(lists.into_iter().take(history.len()))?;
    Ok(kept)
}

/// # Safety
/// As for [`cycle`].
pub(crate) unsafe fn trajectory<'a>(
    raw: *const MufasaTrajectory,
    arena: &mut Arena<'a>,
) -> Result<Option<Trajectory<'a>>, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let Some(it) = unsafe { optional(raw) }? else { return Ok(None) };
    // SAFETY: as above.
    let points = unsafe { list(it.points, it.points_len, POINTS) }?;
    let points = arena.keep(points.iter().map(trajectory_point))?;
    Ok(Some(Trajectory { stamp_ns: it.stamp.ns, points }))
}

/// # Safety
/// As for [`cycle`].
pub(crate) unsafe fn tracks<'a>(
    raw: *const MufasaTrackList,
    arena: &mut Arena<'a>,
) -> Result<Option<TrackList<'a>>, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let Some(it) = unsafe { optional(raw) }? else { return Ok(None) };
    // SAFETY: as above.
    let items = unsafe { list(it.items, it.items_len, TRACKS) }?;
    let items = arena.keep(items.iter().map(track))?;
    Ok(Some(TrackList { stamp_ns: it.stamp.ns, items }))
}

/// # Safety
/// As for [`cycle`].
pub(crate) unsafe fn grid<'a>(raw: *const MufasaGrid) -> Result<Option<Grid<'a>>, MufasaStatus> {
    // SAFETY: the caller's duty, here and below.
    let Some(it) = unsafe { optional(raw) }? else { return Ok(None) };
    let unknown = if it.unknown.is_null() {
        None
    } else {
        // SAFETY: as above.
        Some(unsafe { list(it.unknown, it.unknown_len, BITMAP_BYTES) }?)
    };
    Ok(Some(Grid {
        stamp_ns: it.stamp.ns,
        x: it.x,
        y: it.y,
        cos: it.cos,
        sin: it.sin,
        resolution: it.resolution,
        width: it.width,
        height: it.height,
        // SAFETY: as above.
        occupied: unsafe { list(it.occupied, it.occupied_len, BITMAP_BYTES) }?,
        unknown,
    }))
}

/// The profile of a number.
pub(crate) fn profile(raw: u32) -> Result<Profile, MufasaStatus> {
    let choices =
        [(MufasaProfile::Paper, Profile::PAPER), (MufasaProfile::Hardened, Profile::HARDENED)];
    let found = choices.into_iter().find(|&(number, _)| number as u32 == raw);
    found.map(|(_, profile)| profile).ok_or(MufasaStatus::UnknownValue)
}

fn configuration(raw: u32) -> Result<Configuration, MufasaStatus> {
    let found = Configuration::ALL.into_iter().find(|&it| configuration_number(it) as u32 == raw);
    found.ok_or(MufasaStatus::UnknownValue)
}

/// The number of a configuration.
pub(crate) const fn configuration_number(configuration: Configuration) -> MufasaConfiguration {
    match configuration {
        Configuration::Local => MufasaConfiguration::Local,
        Configuration::MotRemote => MufasaConfiguration::MotRemote,
        Configuration::AllRemote => MufasaConfiguration::AllRemote,
        Configuration::PlanRemote => MufasaConfiguration::PlanRemote,
    }
}

pub(crate) fn ego(raw: &MufasaEgo) -> Ego {
    let MufasaEgo { x, y, cos, sin, speed, length, width, center_offset } = *raw;
    Ego { x, y, cos, sin, speed, length, width, center_offset }
}

pub(crate) fn trajectory_point(raw: &MufasaTrajectoryPoint) -> TrajectoryPoint {
    let MufasaTrajectoryPoint { t, x, y, cos, sin } = *raw;
    TrajectoryPoint { t_ns: t.ns, x, y, cos, sin }
}

pub(crate) fn track(raw: &MufasaTrack) -> Track {
    let MufasaTrack { id, x, y, cos, sin, vx, vy, length, width } = *raw;
    Track { id, x, y, cos, sin, vx, vy, length, width }
}

pub(crate) fn detection(raw: &MufasaDetection) -> Detection {
    let MufasaDetection { x, y, cos, sin, length, width } = *raw;
    Detection { x, y, cos, sin, length, width }
}

pub(crate) fn cross_section(raw: &MufasaCrossSection) -> CrossSection {
    let MufasaCrossSection { x, y, left, right } = *raw;
    CrossSection { x, y, left, right }
}
