//! What a vehicle's program seems to get wrong (`spec/4-arithmetic.md#advice`). No verdict depends on it.

use core::fmt;

use super::inputs::Inputs;
use crate::input::cycle::{Detection, Ego, Lead};
use crate::numbers::time::{elapsed_ns, seconds};
use crate::stages::order::is_current;

/// What contradicts itself, told once. Source: `spec/4-arithmetic.md#advice`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use = "an advice is for whoever integrates the monitor"]
pub enum Advice {
    /// Cycles come in another period than the one declared.
    Period,
    /// Detections are given, and none was current.
    DetectionsNotCurrent,
    /// A lead is given, and none was current: for the stages nobody is ahead.
    LeadNotCurrent,
    /// A grid is given, and none was current.
    GridNotCurrent,
    /// The gap does not change as the speeds of lead and CAV say: km/h, or a speed relative to the CAV.
    LeadSpeed,
    /// The gap is longer than the way to the detection ahead: between centres, or from the reference point.
    GapTooLong,
    /// It is shorter: detections that are too small, or a `center_offset` that is too small.
    GapTooShort,
}

impl Advice {
    const ALL: [Self; 7] = [
        Self::Period,
        Self::DetectionsNotCurrent,
        Self::LeadNotCurrent,
        Self::GridNotCurrent,
        Self::LeadSpeed,
        Self::GapTooLong,
        Self::GapTooShort,
    ];

    /// In words. Source: `spec/4-arithmetic.md#advice`.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Period => "cycles come in another period than settings.period",
            Self::DetectionsNotCurrent => "no detections are current; is their stamp right?",
            Self::LeadNotCurrent => {
                "no lead is current, as if nobody were ahead; is its stamp right?"
            }
            Self::GridNotCurrent => "no grid is current; is its stamp right?",
            Self::LeadSpeed => {
                "the gap does not change as the speeds say; are they in m/s over ground?"
            }
            Self::GapTooLong => {
                "the gap is longer than the way to the detection ahead; is it between bumpers?"
            }
            Self::GapTooShort => {
                "the gap is shorter than the way to the detection ahead; are sizes and center_offset right?"
            }
        }
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

/// Cycles in a row that have to agree.
const CYCLES: u8 = 16;
/// Of as many, those that have to be off the period in one direction.
const OFF: u8 = 12;
/// How long the gap is looked at, s; so many such times in a row that have to agree.
const WINDOW: f64 = 1.0;
const WINDOWS: i8 = 3;
/// Slower than that, lead and detection may be two things that stand, m/s.
const MOVES: f64 = 2.0;

/// What was seen in the last cycles.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// One bit for each that was found, and for each that was told.
    found: u8,
    told: u8,
    last_ns: Option<i64>,
    /// Intervals, those that were too long, and those that were too short.
    intervals: [u8; 3],
    /// Cycles in a row with something that was not current.
    not_current: [u8; 3],
    window: Option<Window>,
    /// Windows in a row in which the gap grew more (or less) than the speeds say.
    differ: i8,
    /// By how much gap and detection differ, and in how many cycles in a row.
    beside: (f64, u8),
}

/// A time in which one lead was followed.
#[derive(Clone, Copy, Debug)]
struct Window {
    gap: f64,
    last: Lead,
    speed: f64,
    time: f64,
    /// What the lead drove, and the CAV, m.
    ways: [f64; 2],
}

impl Watch {
    /// The next advice that nobody was told.
    pub(super) fn next(&mut self) -> Option<Advice> {
        let mut kinds = Advice::ALL.into_iter();
        let next = kinds.find(|it| self.found & !self.told & bit(*it) != 0)?;
        self.told |= bit(next);
        Some(next)
    }

    /// A cycle whose local input is valid.
    pub(super) fn cycle(&mut self, inputs: &Inputs<'_>, period_ns: i64, max_age_ns: i64) {
        let now_ns = inputs.now.as_nanoseconds();
        self.interval(now_ns, period_ns);
        let (detections, lead) = (inputs.detections, inputs.lead);
        let stamps = [
            detections.map(|it| it.stamp_ns),
            lead.map(|it| it.stamp_ns),
            inputs.grid.map(|it| it.stamp_ns),
        ];
        let kinds = [Advice::DetectionsNotCurrent, Advice::LeadNotCurrent, Advice::GridNotCurrent];
        let current = |stamp_ns: i64| is_current(stamp_ns, now_ns, max_age_ns);
        for ((stamp_ns, count), kind) in stamps.into_iter().zip(&mut self.not_current).zip(kinds) {
            let is_old = stamp_ns.is_some_and(|stamp_ns| !current(stamp_ns));
            *count = if is_old { count.saturating_add(1) } else { 0 };
            if *count >= CYCLES {
                self.found |= bit(kind);
            }
        }
        let lead = lead.filter(|it| current(it.stamp_ns) && it.gap > 0.0);
        self.follow(lead, inputs.ego.speed);
        let at_once = |lead: &Lead, stamp_ns: i64| {
            elapsed_ns(lead.stamp_ns, stamp_ns).unsigned_abs() <= 10_000_000
        };
        let pair = lead.zip(detections).filter(|(lead, it)| at_once(lead, it.stamp_ns));
        let differs = pair.and_then(|(lead, it)| beside(&inputs.ego, &lead, it.items));
        self.compare(differs);
    }

    fn interval(&mut self, now_ns: i64, period_ns: i64) {
        let since_ns = self.last_ns.replace(now_ns).map(|last_ns| elapsed_ns(last_ns, now_ns));
        let Some(since_ns) = since_ns.filter(|it| *it >= 0) else {
            self.intervals = [0; 3];
            return;
        };
        let (twice, thrice) = (since_ns.saturating_mul(2), since_ns.saturating_mul(3));
        let is_long = twice > period_ns.saturating_mul(3);
        let is_short = thrice < period_ns.saturating_mul(2);
        for (count, is) in self.intervals.iter_mut().zip([true, is_long, is_short]) {
            *count = count.saturating_add(u8::from(is));
        }
        let [all, long, short] = self.intervals;
        if long >= OFF || short >= OFF {
            self.found |= bit(Advice::Period);
        }
        if all >= CYCLES {
            self.intervals = [0; 3];
        }
    }

    /// Whether the gap changes as the speeds say.
    fn follow(&mut self, lead: Option<Lead>, speed: f64) {
        let Some(lead) = lead else {
            (self.window, self.differ) = (None, 0);
            return;
        };
        let begun = Window { gap: lead.gap, last: lead, speed, time: 0.0, ways: [0.0; 2] };
        let window = self.window.get_or_insert(begun);
        let time = seconds(elapsed_ns(window.last.stamp_ns, lead.stamp_ns));
        if !(0.0..=0.5 * WINDOW).contains(&time) {
            (self.window, self.differ) = (Some(begun), 0);
            return;
        }
        let [of_lead, of_cav] = &mut window.ways;
        *of_lead += 0.5 * (window.last.speed + lead.speed) * time;
        *of_cav += 0.5 * (window.speed + speed) * time;
        (window.last, window.speed, window.time) = (lead, speed, window.time + time);
        if window.time < WINDOW {
            return;
        }
        let [of_lead, of_cav] = window.ways;
        let unexplained = lead.gap - window.gap - (of_lead - of_cav);
        let limit = f64::max(1.0, 0.5 * f64::max(of_lead, of_cav));
        self.differ = if unexplained > limit {
            self.differ.max(0).saturating_add(1)
        } else if unexplained < -limit {
            self.differ.min(0).saturating_sub(1)
        } else {
            0
        };
        if self.differ.abs() >= WINDOWS {
            self.found |= bit(Advice::LeadSpeed);
        }
        self.window = Some(begun);
    }

    /// Whether gap and detection differ by the same in cycles in a row.
    fn compare(&mut self, differs: Option<f64>) {
        let Some(by) = differs.filter(|by| (-3.0..-0.75).contains(by) || (1.0..8.0).contains(by))
        else {
            self.beside = (0.0, 0);
            return;
        };
        let (first, count) = self.beside;
        let is_same = count > 0 && (-0.3..=0.3).contains(&(by - first));
        self.beside = if is_same { (first, count.saturating_add(1)) } else { (by, 1) };
        if self.beside.1 >= CYCLES {
            let kind = if by > 0.0 { Advice::GapTooLong } else { Advice::GapTooShort };
            self.found |= bit(kind);
        }
    }
}

/// How much longer the gap is than the way to the nearest detection straight ahead, m, where lead and CAV move.
fn beside(ego: &Ego, lead: &Lead, detections: &[Detection]) -> Option<f64> {
    if !(ego.speed > MOVES && lead.speed > MOVES) {
        return None;
    }
    let front = ego.center_offset + 0.5 * ego.length;
    let mut nearest = f64::INFINITY;
    for it in detections {
        let (x, y) = (it.x - ego.x, it.y - ego.y);
        let (ahead, aside) = (ego.cos * x + ego.sin * y, ego.cos * y - ego.sin * x);
        let across = ego.cos * it.sin - ego.sin * it.cos;
        let is_straight = aside.abs() < 0.5 * ego.width && across.abs() < 0.17;
        let way = ahead - 0.5 * it.length - front;
        if is_straight && ahead > front && way < nearest {
            nearest = way;
        }
    }
    (nearest < f64::INFINITY).then_some(lead.gap - nearest)
}

fn bit(kind: Advice) -> u8 {
    let place = Advice::ALL.into_iter().position(|it| it == kind).unwrap_or(0);
    1_u8.wrapping_shl(u32::try_from(place).unwrap_or(0))
}
