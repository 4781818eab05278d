//! A drive as it is played in real time: what the vehicle senses, and what a station answers.
//!
//! The time of a drive is moved to the shared clock. A cycle of the time T of the drive is sensed 30 ms
//! before, when the vehicle sends what it knows; that is also how old the detections of recorded drives are
//! at T. It is decided up to 30 ms after T, so that whatever the station answers within l_max is there:
//! until then the CAV drives straight on, and nothing else is changed.

use mufasa::input::cycle::{Ego, Trajectory, TrajectoryPoint};
use mufasa_drives::Drive;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::input::parameters::Parameters;
use mufasa_props::bridge;
use thiserror::Error;

use crate::message::{EncodeError, Frame};

/// How long before its time in the drive a cycle is sensed, ns.
pub const SENSED_BEFORE_NS: i64 = 30_000_000;

/// How long after it is sensed a cycle is decided, ns, where the period leaves so much time: l_max, 50 ms, and
/// 10 ms for the way to the station and its answer. All that comes until then is at most so old, which is
/// below max_age, 100 ms.
pub const DECIDED_AFTER_NS: i64 = 60_000_000;

/// What of a period is left between a decision and the next cycle, ns.
const LEFT_NS: i64 = 10_000_000;

/// How far from the drive a vehicle may be that a station still follows, m.
const ON_THE_DRIVE_M: f64 = 2.0;

/// Places of the CAV that count as the same, m: above what the messages round.
const SAME_PLACE_M: f64 = 0.03;

/// Where the drive is put on the earth, 0.1 microdegree.
const LATITUDE: i32 = 484_000_000;
const LONGITUDE: i32 = 99_900_000;

/// A drive whose cycles can be played one after the other.
#[derive(Clone, Debug)]
pub struct Played {
    cycles: Vec<Cycle>,
    period_ns: i64,
}

/// A drive that cannot be played.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PlayError {
    /// It has fewer than two cycles, and so no period.
    #[error("{cycles} cycles are too few: at least two have a period")]
    Short {
        /// How many it has.
        cycles: usize,
    },
    /// A cycle is not at least 40 ms and at most 10 s later than the one before.
    #[error(
        "cycle {index}: now_ns is not 40 ms to 10 s later than in the cycle before; give the cycles of one drive in \
         their order"
    )]
    Order {
        /// Which one.
        index: usize,
    },
    /// A cycle has another profile or other parameters than the first.
    #[error("cycle {index}: another profile or other parameters than the first cycle has")]
    Settings {
        /// Which one.
        index: usize,
    },
}

impl Played {
    /// Errors: a drive that cannot be played in real time.
    pub fn new(drive: Drive) -> Result<Self, PlayError> {
        let cycles: Vec<Cycle> = drive.cycles.into_iter().map(|it| it.cycle).collect();
        let [first, _, ..] = cycles.as_slice() else {
            return Err(PlayError::Short { cycles: cycles.len() });
        };
        let mut period_ns = i64::MAX;
        for (index, pair) in cycles.windows(2).enumerate() {
            let step_ns = pair[1].now_ns.saturating_sub(pair[0].now_ns);
            if !(40_000_000..=10_000_000_000).contains(&step_ns) {
                return Err(PlayError::Order { index: index + 1 });
            }
            period_ns = period_ns.min(step_ns);
        }
        let other = |it: &Cycle| it.profile != first.profile || it.parameters != first.parameters;
        if let Some(index) = cycles.iter().position(other) {
            return Err(PlayError::Settings { index });
        }
        Ok(Self { cycles, period_ns })
    }

    /// How many cycles it has: at least two.
    pub fn count(&self) -> usize {
        self.cycles.len()
    }

    /// A cycle, in the time of the drive.
    pub fn cycle(&self, index: usize) -> Option<&Cycle> {
        self.cycles.get(index)
    }

    /// The shortest time from one cycle to the next, ns.
    pub fn period_ns(&self) -> i64 {
        self.period_ns
    }

    /// The profile of all its cycles.
    pub fn profile(&self) -> Profile {
        self.cycles[0].profile
    }

    /// The parameters of all its cycles.
    pub fn parameters(&self) -> &Parameters {
        &self.cycles[0].parameters
    }

    /// The time of the first cycle in the drive, ns.
    pub fn begin_ns(&self) -> i64 {
        self.cycles[0].now_ns
    }

    /// The frame of its messages: its map lies where the CAV begins, at a place on the earth that is made
    /// up, since a drive does not say where its own is.
    ///
    /// Errors: a drive too far from the origin of its frame.
    pub fn frame(&self) -> Result<Frame, EncodeError> {
        let [x, y] = [self.cycles[0].ego.x, self.cycles[0].ego.y];
        Frame::new(LATITUDE, LONGITUDE, [x.round(), y.round()])
    }

    /// Pose and speed of the CAV when a cycle is sensed: it has driven straight on since then.
    pub fn sensed(cycle: &Cycle) -> Ego {
        driven_on(bridge::to_impl(cycle).borrow(&[]).ego, -SENSED_BEFORE_NS)
    }

    /// When a cycle is sensed, in the time of the drive, ns.
    pub fn sensed_ns(cycle: &Cycle) -> i64 {
        cycle.now_ns.saturating_sub(SENSED_BEFORE_NS)
    }

    /// How long after its time in the drive a cycle is decided, ns: less than `DECIDED_AFTER_NS` after it was
    /// sensed where the next one is sensed before.
    pub fn decided_late_ns(&self) -> i64 {
        let after_ns = DECIDED_AFTER_NS.min(self.period_ns.saturating_sub(LEFT_NS));
        after_ns.saturating_sub(SENSED_BEFORE_NS)
    }

    /// Pose and speed of the CAV when a cycle is decided: it has driven straight on.
    pub fn decided(&self, cycle: &Cycle) -> Ego {
        driven_on(bridge::to_impl(cycle).borrow(&[]).ego, self.decided_late_ns())
    }

    /// The cycle that a vehicle senses that is there, and about when, in the time of the drive, ns, if
    /// that is known: of the cycles in whose place it may be the one nearest to that time, else the first.
    /// `None`: it is not on this drive.
    pub fn find(&self, ego: &Ego, about_ns: Option<i64>) -> Option<usize> {
        let away_m: Vec<f64> = (self.cycles.iter().map(Self::sensed))
            .map(|it| (it.x - ego.x).hypot(it.y - ego.y))
            .collect();
        let nearest_m = away_m.iter().copied().min_by(f64::total_cmp)?;
        let places = away_m.iter().zip(&self.cycles).enumerate();
        let here = places.filter(|(_, (m, _))| **m <= nearest_m + SAME_PLACE_M);
        let early = |cycle: &Cycle| match about_ns {
            Some(about_ns) => Self::sensed_ns(cycle).abs_diff(about_ns),
            None => 0,
        };
        let found = here.min_by_key(|(_, (_, cycle))| early(cycle)).map(|(index, _)| index);
        found.filter(|_| nearest_m <= ON_THE_DRIVE_M)
    }

    /// The cycle that is sensed at a time of the drive, ns: the nearest one.
    pub fn at(&self, sensed_ns: i64) -> Option<&Cycle> {
        self.cycles.iter().min_by_key(|cycle| Self::sensed_ns(cycle).abs_diff(sensed_ns))
    }
}

/// The CAV so much later, ns, if it drives straight on.
pub(crate) fn driven_on(ego: Ego, later_ns: i64) -> Ego {
    #[allow(clippy::cast_precision_loss, reason = "some tens of milliseconds")]
    let way_m = ego.speed * later_ns as f64 * 1e-9;
    Ego { x: ego.x + way_m * ego.cos, y: ego.y + way_m * ego.sin, ..ego }
}

/// The points of a trajectory, so much later.
pub(crate) fn moved(trajectory: Trajectory<'_>, later_ns: i64) -> Vec<TrajectoryPoint> {
    let moved =
        |it: &TrajectoryPoint| TrajectoryPoint { t_ns: it.t_ns.saturating_add(later_ns), ..*it };
    trajectory.points.iter().map(moved).collect()
}

#[cfg(test)]
mod tests {
    use mufasa_drives::{Drive, Options};

    use super::*;

    fn demo() -> Drive {
        mufasa_drives::demo(&Options::default()).unwrap().collect().unwrap()
    }

    #[test]
    fn every_cycle_is_found_by_its_place_or_by_its_time() {
        let played = Played::new(demo()).unwrap();
        for index in 0..played.count() {
            let cycle = played.cycle(index).unwrap();
            let (ego, sensed_ns) = (Played::sensed(cycle), Played::sensed_ns(cycle));
            assert_eq!(played.find(&ego, Some(sensed_ns)), Some(index));
            assert_eq!(played.at(sensed_ns + 40_000_000), Some(cycle));
        }
    }

    #[test]
    fn where_the_vehicle_stands_the_time_tells_the_cycle() {
        let mut drive = demo();
        let ego = drive.cycles[10].cycle.ego.clone();
        drive.cycles[10..20].iter_mut().for_each(|it| it.cycle.ego = ego.clone());
        let played = Played::new(drive).unwrap();
        let cycle = played.cycle(15).unwrap();
        let (ego, sensed_ns) = (Played::sensed(cycle), Played::sensed_ns(cycle));
        assert_eq!(played.find(&ego, Some(sensed_ns + 40_000_000)), Some(15));
        assert_eq!(played.find(&ego, None), Some(10));
    }

    #[test]
    fn what_comes_within_l_max_is_there_when_its_cycle_is_decided() {
        let with_period = |ms: i64| {
            let mut drive = demo();
            for (i, it) in (0_i64..).zip(&mut drive.cycles) {
                it.cycle.now_ns = i * ms * 1_000_000;
            }
            Played::new(drive).unwrap()
        };
        let after = |played: &Played| SENSED_BEFORE_NS + played.decided_late_ns();
        let ms = 1_000_000;
        let shipped = mufasa::offloading::requester::Parameters::default();
        let max_age_ns = mufasa::input::parameters::Parameters::default().max_age_ns;
        assert!(after(&with_period(100)) >= shipped.l_max_ns + 10 * ms);
        assert!(after(&with_period(100)) <= max_age_ns);
        // The fastest drive that is played: as long as its period allows.
        assert_eq!([40, 70, 71].map(|it| after(&with_period(it)) / ms), [30, 60, 60]);
        let played = with_period(100);
        let cycle = played.cycle(5).unwrap();
        let (early, late) = (Played::sensed(cycle), played.decided(cycle));
        assert!(((late.x - early.x).hypot(late.y - early.y) - 0.06 * late.speed).abs() < 1e-9);
        assert!(late.speed > 1.0);
    }

    #[test]
    fn who_is_elsewhere_is_not_followed() {
        let played = Played::new(demo()).unwrap();
        let ego = Played::sensed(played.cycle(0).unwrap());
        let aside = |m| Ego { x: ego.x + m * ego.sin, y: ego.y - m * ego.cos, ..ego };
        assert_eq!(played.find(&aside(1.9), None), Some(0));
        assert_eq!(played.find(&aside(2.1), None), None);
        assert_eq!(played.find(&aside(f64::NAN), None), None);
    }

    #[test]
    fn what_has_no_period_order_or_single_profile_is_refused() {
        let refused = |change: fn(&mut Drive)| {
            let mut drive = demo();
            change(&mut drive);
            Played::new(drive).unwrap_err()
        };
        assert_eq!(refused(|it| it.cycles.truncate(1)), PlayError::Short { cycles: 1 });
        assert_eq!(refused(|it| it.cycles.swap(3, 4)), PlayError::Order { index: 4 });
        let another = |it: &mut Drive| it.cycles[5].cycle.profile = Profile::PAPER;
        assert_eq!(refused(another), PlayError::Settings { index: 5 });
    }
}
