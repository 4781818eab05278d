//! What a station sends, and the last element of it that the requester used.

use core::mem::swap;
use core::slice;

use mufasa::input::cycle::{Track, TrajectoryPoint};
use mufasa::monitor::{Accepted, Arrival, Inputs, Message};
use mufasa::offloading::requester::Actions;

use super::decision::{MufasaActions, MufasaDropReason, actions_of};
use crate::cycle::{MufasaTrackList, MufasaTrajectory};
use crate::status::MufasaStatus;
use crate::time::MufasaTime;

/// Sessions are numbered from 1.
const NO_SESSION: i64 = 0;

/// A message of a station with tracks.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrackMessage {
    /// Id of the station, at least 1.
    pub station: i64,
    /// The session that it names.
    pub session: i64,
    /// When the station made it, on the CAV's clock.
    pub generated: MufasaTime,
    /// The tracks; they are copied.
    pub tracks: MufasaTrackList,
}

/// A message of a station with a trajectory.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MufasaTrajectoryMessage {
    /// Id of the station, at least 1.
    pub station: i64,
    /// The session that it names.
    pub session: i64,
    /// When the station made it, on the CAV's clock.
    pub generated: MufasaTime,
    /// The trajectory; it is copied.
    pub trajectory: MufasaTrajectory,
}

/// Elements in one of the two places of a `Received`.
pub(super) struct Stored<T> {
    items: *const T,
    len: usize,
}

impl<T> AsRef<[T]> for Stored<T> {
    fn as_ref(&self) -> &[T] {
        // SAFETY: only `Received::store` makes one, of so many elements that it wrote; the place is
        // written to again only after the element in it was given up (`Received::take`), and it is in
        // memory of the monitor, which lives longer.
        unsafe { slice::from_raw_parts(self.items, self.len) }
    }
}

/// Two places for elements of a group: the last one that the requester used stays while another one
/// arrives, because that may be dropped.
pub(super) struct Received<T> {
    spare: *mut T,
    other: *mut T,
    capacity: usize,
    accepted: Option<Accepted<Stored<T>>>,
}

impl<T> Received<T> {
    /// Nothing received. Both places are of one length, the monitor's alone, and valid as long as it.
    pub(super) fn new(spare: &'static mut [T], other: &'static mut [T]) -> Self {
        let capacity = spare.len().min(other.len());
        Self { spare: spare.as_mut_ptr(), other: other.as_mut_ptr(), capacity, accepted: None }
    }

    /// Writes elements to the spare place; `None`: they do not fit.
    fn store(&mut self, items: impl ExactSizeIterator<Item = T>) -> Option<Stored<T>> {
        let len = items.len();
        if len > self.capacity {
            return None;
        }
        let mut written: usize = 0;
        for item in items.take(len) {
            // SAFETY: fewer than `capacity` elements were written before, and the place has so many.
            let place = unsafe { self.spare.add(written) };
            // SAFETY: as above; nothing reads the spare place: no accepted element is in it.
            unsafe { place.write(item) };
            written = written.saturating_add(1);
        }
        Some(Stored { items: self.spare, len: written })
    }

    /// Elements arrive, in the session that they name, which runs or does not: stored where it runs, and given to the
    /// monitor; so what anybody forges costs no copy. A list too long for its place is told to the monitor as an empty
    /// one of no session: that is no arrival, as the monitor itself treats tracks that are too many.
    pub(super) fn arrive(
        &mut self,
        items: impl ExactSizeIterator<Item = T>,
        session: i64,
        is_running: bool,
        tell: impl FnOnce(i64, Stored<T>) -> Result<(Arrival<Stored<T>>, Actions), MufasaStatus>,
    ) -> Result<MufasaActions, MufasaStatus> {
        let stored = if is_running { self.store(items) } else { Some(self.nothing()) };
        if let Some(stored) = stored {
            return Ok(self.take(tell(session, stored)?));
        }
        // MON-20
        let actions = self.take(tell(NO_SESSION, self.nothing())?);
        Ok(MufasaActions { dropped: MufasaDropReason::TooLong, ..actions })
    }

    fn nothing(&self) -> Stored<T> {
        Stored { items: self.spare.cast_const(), len: 0 }
    }

    /// What has to be done about it. An element that was accepted is the last one from now on; the place of
    /// the one before is spare.
    fn take(&mut self, (arrival, actions): (Arrival<Stored<T>>, Actions)) -> MufasaActions {
        match arrival {
            Arrival::Accepted(element) => {
                self.accepted = Some(element);
                swap(&mut self.spare, &mut self.other);
                actions_of(&actions)
            }
            Arrival::Dropped { why } => {
                MufasaActions { dropped: why.into(), ..actions_of(&actions) }
            }
        }
    }

    /// How long an element may be.
    pub(super) const fn capacity(&self) -> usize {
        self.capacity
    }

    pub(super) const fn accepted(&self) -> Option<&Accepted<Stored<T>>> {
        self.accepted.as_ref()
    }
}

/// The message of `mufasa` with stored elements.
pub(super) fn message<T>(
    (station, session, generated): (i64, i64, MufasaTime),
    stamp: MufasaTime,
    items: Stored<T>,
) -> Message<Stored<T>> {
    let (generated, stamp) = (generated.time(), stamp.time());
    Message { station, session, generated, stamp, items }
}

/// Inputs with the last elements that were used.
pub(super) fn with_remote<'c>(
    mut inputs: Inputs<'c>,
    tracks: &'c Received<Track>,
    trajectory: &'c Received<TrajectoryPoint>,
) -> Inputs<'c> {
    if let Some(element) = tracks.accepted() {
        inputs = inputs.remote_tracks::<Stored<Track>>(element);
    }
    if let Some(element) = trajectory.accepted() {
        inputs = inputs.remote_trajectory::<Stored<TrajectoryPoint>>(element);
    }
    inputs
}

/// A track in a place that nothing was written to yet.
pub(super) const NO_TRACK: Track =
    Track { id: 0, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 1.0, width: 1.0 };

/// As [`NO_TRACK`].
pub(super) const NO_POINT: TrajectoryPoint =
    TrajectoryPoint { t_ns: 0, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 };
