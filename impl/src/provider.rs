//! What an honest station asks before it sends, and a CAV's own planner before it hands a plan over
//! (`spec/5-interfaces.md#precheck`).
//!
//! A station has the CAV's detections of the same stamp, so that it can run the stages that the CAV will run.
//! [`Precheck`] asks them, and has no rule of its own: tracks that stage i would fail for are left out, and of
//! the planner's candidates the first that passes is the one to be sent. What the CAV checks stays as it is.

use crate::cycle::check;
use crate::input::cycle::{Cycle, Track, TrackList, Trajectory, TrajectoryPoint};
use crate::input::scratch::{Column, Row, Scratch};
use crate::report::{FailedStage, InvalidInput, Outcome, Report, Witness};
use crate::stages::i_track_validation::gate::apart_squared;

/// Why something is not to be sent: what the CAV would answer. Source: `spec/5-interfaces.md#precheck`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// What makes the cycle unsafe.
    pub failed: FailedStage,
    /// The comparison that decides, if it is a stage that fails.
    pub witness: Option<Witness>,
    /// The problem, if the data are invalid.
    pub input: Option<InvalidInput>,
}

impl Failure {
    /// That of a report; `None`: the cycle is safe. Source: `spec/5-interfaces.md#precheck`.
    pub fn of(report: &Report) -> Option<Self> {
        let failed = report.failed_stage?;
        let witness = report.stages.iter().find_map(|outcome| match outcome {
            Outcome::Failed(witness) => Some(*witness),
            Outcome::Passed
            | Outcome::Skipped(_)
            | Outcome::NotApplicable(_)
            | Outcome::NotScheduled => None,
        });
        Some(Self { failed, witness, input: report.input })
    }
}

/// Asks the stages before something is sent. It needs no heap, and of memory what it is lent.
///
/// Cycles are those that the CAV is expected to decide: its profile, parameters, route, detections with their
/// history, own position, and the configuration in which the results will be used. What the station does not
/// know (grid, lead) is missing, and the stages take it as missing: the CAV may still find something there.
///
/// A parked car is tracked, and beside it something that nobody detects:
///
/// ```
/// use mufasa::input::cycle::{
///     CrossSection, Cycle, Detection, DetectionList, Ego, Route, Track, TrajectoryPoint,
/// };
/// use mufasa::input::parameters::Parameters;
/// use mufasa::input::profile::Profile;
/// use mufasa::input::scratch::{Column, Row};
/// use mufasa::provider::Precheck;
/// use mufasa::report::{FailedStage, Stage};
/// use mufasa::services::configuration::Configuration;
///
/// let detections = [Detection { x: 12.0, y: 3.5, cos: 1.0, sin: 0.0, length: 4.5, width: 1.9 }];
/// let at = |x| CrossSection { x, y: 0.0, left: [x, 2.0], right: [x, -2.0] };
/// let ego = Ego {
///     x: 0.0, y: 0.0, cos: 1.0, sin: 0.0, speed: 0.0, length: 4.5, width: 1.9, center_offset: 1.4,
/// };
/// let mut cycle = Cycle {
///     profile: Profile::HARDENED,
///     parameters: Parameters::default(),
///     now_ns: 0,
///     configuration: Configuration::AllRemote,
///     ego,
///     trajectory: None,
///     tracks: None,
///     detections: Some(DetectionList { stamp_ns: 0, items: &detections }),
///     lead: None,
///     route: Route { closed: false, cross_sections: &[at(-10.0), at(90.0)] },
///     grid: None,
///     detection_history: &[],
/// };
/// let track = |id, x| Track {
///     id, x, y: 3.5, cos: 1.0, sin: 0.0, vx: 0.0, vy: 0.0, length: 4.5, width: 1.9,
/// };
/// let (mut rows, mut columns) = ([Row::EMPTY; 8], [Column::EMPTY; 16]);
/// let mut precheck = Precheck::new(&mut rows, &mut columns);
///
/// let (mut tracks, mut left_out) = ([track(1, 2.0), track(2, 12.1)], vec![]);
/// let kept = precheck.tracks(&cycle, 0, &mut tracks, |track, _why| left_out.push(track.id))?;
/// assert_eq!(kept.map(|kept| kept.tracks.items), Some(&[track(2, 12.1)][..]));
/// assert_eq!(left_out, [1]);
///
/// cycle.tracks = kept.map(|kept| kept.tracks);
/// let stays = [TrajectoryPoint { t_ns: 0, x: 0.0, y: 0.0, cos: 1.0, sin: 0.0 }];
/// let aside = [TrajectoryPoint { y: 3.0, ..stays[0] }];
/// let mut rejected = vec![];
/// let first = precheck.first(&cycle, 0, [aside, stays], |_index, why| rejected.push(why.failed))?;
/// assert_eq!(first, Some((1, stays)));
/// assert_eq!(rejected, [FailedStage::Stage(Stage::Ii)]);
/// # Ok::<(), mufasa::report::InvalidInput>(())
/// ```
///
/// Source: `spec/5-interfaces.md#precheck`.
#[derive(Debug)]
pub struct Precheck<'s> {
    rows: &'s mut [Row],
    columns: &'s mut [Column],
}

/// What is to be sent, and how many were left out. Source: `spec/5-interfaces.md#precheck`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept<'t> {
    /// The list to be sent.
    pub tracks: TrackList<'t>,
    /// How many tracks are not in it.
    pub left_out: usize,
}

impl<'s> Precheck<'s> {
    /// With memory as for `cycle::check`: `Sizes` of the largest cycle. Source:
    /// `spec/4-arithmetic.md#conformance-of-an-implementation`.
    pub const fn new(rows: &'s mut [Row], columns: &'s mut [Column]) -> Self {
        Self { rows, columns }
    }

    /// Which of the tracks of this stamp to send in this cycle, whose own tracks and trajectory do not matter:
    /// those that pass alone, so that none depends on what else is in the list; and if they do not pass
    /// together, one after the other is added, the nearest to a detection first, and left out when the
    /// cycle would fail with it. Of T tracks the stages are asked at most 2 T + 2 times.
    /// `None`: not even an empty list passes. The tracks that are left out are told with the reason, and stand
    /// behind the others afterwards.
    ///
    /// Errors: invalid local input; less memory than the cycle needs. Source: `spec/5-interfaces.md#precheck`.
    pub fn tracks<'t>(
        &mut self,
        cycle: &Cycle<'_>,
        stamp_ns: i64,
        tracks: &'t mut [Track],
        mut left_out: impl FnMut(&Track, Failure),
    ) -> Result<Option<Kept<'t>>, InvalidInput> {
        // PRE-08: the memory has to hold all of them, whichever are kept.
        Scratch::new(self.rows, self.columns)
            .fits(&Cycle { tracks: Some(TrackList { stamp_ns, items: tracks }), ..*cycle })?;
        // PRE-03
        if let Some(why) = self.tracks_failure(cycle, stamp_ns, &[])? {
            tracks.iter().for_each(|track| left_out(track, why));
            return Ok(None);
        }
        let mut kept = 0_usize;
        for index in 0..tracks.len() {
            let alone = tracks.get(index..=index).unwrap_or_default();
            if let (Some(why), [track]) = (self.tracks_failure(cycle, stamp_ns, alone)?, alone) {
                // PRE-02, PRE-04
                left_out(track, why);
            } else {
                exchange(tracks, kept, index);
                kept = kept.saturating_add(1);
            }
        }
        let pass_alone = tracks.get_mut(..kept).unwrap_or_default();
        if self.tracks_failure(cycle, stamp_ns, pass_alone)?.is_some() {
            kept = self.together(cycle, stamp_ns, pass_alone, left_out)?;
        }
        let items = tracks.get(..kept).unwrap_or_default();
        let left_out = tracks.len().saturating_sub(items.len());
        Ok(Some(Kept { tracks: TrackList { stamp_ns, items }, left_out }))
    }

    /// How many of the tracks pass together when the nearest to a detection are taken first; they come to the
    /// front.
    fn together(
        &mut self,
        cycle: &Cycle<'_>,
        stamp_ns: i64,
        tracks: &mut [Track],
        mut left_out: impl FnMut(&Track, Failure),
    ) -> Result<usize, InvalidInput> {
        let detections = cycle.detections.map_or(&[][..], |list| list.items);
        let nearest = |track: &Track| {
            let away = detections.iter().map(|it| apart_squared([track.x, track.y], [it.x, it.y]));
            away.min_by(f64::total_cmp).unwrap_or(f64::INFINITY)
        };
        let mut kept = 0_usize;
        for index in 0..tracks.len() {
            let rest = (index..).zip(tracks.get(index..).unwrap_or_default());
            let keys = rest.map(|(place, track)| (place, nearest(track), track.id));
            let next = keys.min_by(|a, b| a.1.total_cmp(&b.1).then_with(|| a.2.cmp(&b.2)));
            exchange(tracks, index, next.map_or(index, |(place, ..)| place));
            exchange(tracks, kept, index);
            let now = tracks.get(..=kept).unwrap_or_default();
            match (self.tracks_failure(cycle, stamp_ns, now)?, now.last()) {
                // PRE-02, PRE-04
                (Some(why), Some(track)) => left_out(track, why),
                (None, _) | (_, None) => kept = kept.saturating_add(1),
            }
        }
        Ok(kept)
    }

    /// The first of the candidates of this stamp with which this cycle is safe, and which it is; the cycle has the
    /// tracks that it will have, its own trajectory does not matter. Those before it are told with the reason;
    /// those behind it are not asked for. `None`: none is to be sent.
    ///
    /// Errors: invalid local input; less memory than the cycle needs. Source: `spec/5-interfaces.md#precheck`.
    pub fn first<P: AsRef<[TrajectoryPoint]>>(
        &mut self,
        cycle: &Cycle<'_>,
        stamp_ns: i64,
        candidates: impl IntoIterator<Item = P>,
        mut rejected: impl FnMut(usize, Failure),
    ) -> Result<Option<(usize, P)>, InvalidInput> {
        for (index, candidate) in candidates.into_iter().enumerate() {
            let trajectory = Trajectory { stamp_ns, points: candidate.as_ref() };
            match self.failure(cycle, Some(trajectory), cycle.tracks)? {
                // PRE-05
                None => return Ok(Some((index, candidate))),
                // PRE-06
                Some(why) => rejected(index, why),
            }
        }
        // PRE-07
        Ok(None)
    }

    /// What the CAV would answer to these tracks alone.
    fn tracks_failure(
        &mut self,
        cycle: &Cycle<'_>,
        stamp_ns: i64,
        items: &[Track],
    ) -> Result<Option<Failure>, InvalidInput> {
        self.failure(cycle, None, Some(TrackList { stamp_ns, items }))
    }

    /// What the CAV would answer.
    fn failure<'c>(
        &mut self,
        cycle: &Cycle<'c>,
        trajectory: Option<Trajectory<'c>>,
        tracks: Option<TrackList<'c>>,
    ) -> Result<Option<Failure>, InvalidInput> {
        let cycle = Cycle { trajectory, tracks, ..*cycle };
        // PRE-01
        let report = check(&cycle, &mut Scratch::new(self.rows, self.columns))?;
        Ok(Failure::of(&report))
    }
}

/// Two tracks take each other's place; without one of them nothing happens.
fn exchange(tracks: &mut [Track], one: usize, other: usize) {
    if let (Some(&first), Some(&second)) = (tracks.get(one), tracks.get(other)) {
        for (place, track) in [(one, second), (other, first)] {
            if let Some(slot) = tracks.get_mut(place) {
                *slot = track;
            }
        }
    }
}
