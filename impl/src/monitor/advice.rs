//! What a vehicle's program seems to get wrong (`spec/4-arithmetic.md#advice`). No verdict depends on it.

use core::fmt;

use super::inputs::Inputs;
use super::settings::Settings;
use crate::input::cycle::{Detection, Ego, Lead};
use crate::numbers::time::elapsed_ns;
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
    /// No tick comes: nothing is offloaded, and nobody looks for silence.
    NoTick,
}

impl Advice {
    /// Each of them.
    pub const ALL: [Self; 8] = [
        Self::Period,
        Self::DetectionsNotCurrent,
        Self::LeadNotCurrent,
        Self::GridNotCurrent,
        Self::LeadSpeed,
        Self::GapTooLong,
        Self::GapTooShort,
        Self::NoTick,
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
            Self::NoTick => "no tick comes before the cycles; nothing is offloaded without it",
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
/// By how many the intervals off the period have to prevail, and what one that is not takes from them.
const OFF: i8 = 12;
const BACK: i8 = 3;
/// How long the gap is looked at, and the longest time between two cycles with a lead, in units of time.
const WINDOW: u16 = 15_259;
const PAUSE: u16 = 7_630;
/// So many such times in a row have to agree.
const WINDOWS: i8 = 3;
/// Slower than that, lead and detection may be two things that stand, m/s.
const MOVES: f64 = 2.0;
/// 2^16 ns in s, the unit of time.
const UNIT: f32 = 65.536e-6;

/// What was seen in the last cycles, in few bytes, as a monitor is small.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// The last cycle, in units of time, of which the upper ones are left out.
    last: u32,
    /// Since when a lead is followed, in units of time; 0: none is.
    time: u16,
    /// By how much gap and detection differed first, mm, and in how many cycles in a row.
    first: i16,
    alike: u8,
    /// The gap as the speeds make it, m.
    gap: f32,
    /// What the faster one drove meanwhile, m.
    way: f32,
    /// Windows in a row in which the gap grew more (or less) than the speeds say.
    differ: i8,
    /// By how many the intervals prevail that are too long (or too short).
    off: i8,
    /// Cycles in a row with detections, lead or grid that were not current, and without a tick.
    missing: [u8; 4],
    /// One bit for each that was found, and for each that was told.
    found: u8,
    told: u8,
}

impl Watch {
    /// The next advice that nobody was told.
    pub(super) fn next(&mut self) -> Option<Advice> {
        let mut kinds = Advice::ALL.into_iter();
        let next = kinds.find(|it| self.found & !self.told & bit(*it) != 0)?;
        // IMPL-17
        self.told |= bit(next);
        Some(next)
    }

    /// A cycle whose local input is valid.
    pub(super) fn cycle(&mut self, inputs: &Inputs<'_>, settings: &Settings, is_ticked: bool) {
        // IMPL-16
        let (period_ns, max_age_ns) = (settings.period_ns(), settings.stages.max_age_ns);
        let now_ns = inputs.now.as_nanoseconds();
        let units = self.interval(now_ns, period_ns);
        let (detections, lead) = (inputs.detections, inputs.lead);
        let stamps = [
            detections.map(|it| it.stamp_ns),
            lead.map(|it| it.stamp_ns),
            inputs.grid.map(|it| it.stamp_ns),
        ];
        let kinds = [
            Advice::DetectionsNotCurrent,
            Advice::LeadNotCurrent,
            Advice::GridNotCurrent,
            Advice::NoTick,
        ];
        let current = |stamp_ns: i64| is_current(stamp_ns, now_ns, max_age_ns);
        let is_old = stamps.map(|stamp_ns| stamp_ns.is_some_and(|it| !current(it)));
        let is_missing = is_old.into_iter().chain([!is_ticked]);
        for ((is_missing, count), kind) in is_missing.zip(&mut self.missing).zip(kinds) {
            *count = if is_missing { count.saturating_add(1) } else { 0 };
            if *count >= CYCLES {
                self.found |= bit(kind);
            }
        }
        let lead = lead.filter(|it| current(it.stamp_ns) && it.gap > 0.0);
        self.follow(lead, inputs.ego.speed, units);
        let at_once = |lead: &Lead, stamp_ns: i64| {
            elapsed_ns(lead.stamp_ns, stamp_ns).unsigned_abs() <= 10_000_000
        };
        let pair = lead.zip(detections).filter(|(lead, it)| at_once(lead, it.stamp_ns));
        let differs = pair.and_then(|(lead, it)| beside(&inputs.ego, &lead, it.items));
        self.compare(differs);
    }

    /// The time since the last cycle, in units; below 0 where the clock was set back.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "lower bits"
    )]
    fn interval(&mut self, now_ns: i64, period_ns: i64) -> i32 {
        let now = (now_ns >> 16) as u32;
        let last = core::mem::replace(&mut self.last, now);
        // The first cycle has none before it.
        if last == 0 {
            return 0;
        }
        let units = now.wrapping_sub(last) as i32;
        let since_ns = i64::from(units) << 16;
        self.off = if since_ns.saturating_mul(2) > period_ns.saturating_mul(3) {
            self.off.max(0).saturating_add(1)
        } else if since_ns.saturating_mul(3) < period_ns.saturating_mul(2) {
            self.off.min(0).saturating_sub(1)
        } else {
            let less = self.off.saturating_abs().saturating_sub(BACK).max(0);
            less.saturating_mul(self.off.signum())
        };
        if self.off.saturating_abs() >= OFF {
            self.found |= bit(Advice::Period);
        }
        units
    }

    /// Whether the gap changes as the speeds say.
    #[allow(clippy::cast_possible_truncation, reason = "cm do not matter")]
    fn follow(&mut self, lead: Option<Lead>, speed: f64, units: i32) {
        let Some(Lead { gap, speed: of_lead, .. }) = lead else {
            (self.time, self.differ) = (0, 0);
            return;
        };
        let (gap, of_lead, of_cav) = (gap as f32, of_lead as f32, speed as f32);
        let since = u16::try_from(units).ok().filter(|it| self.time > 0 && *it <= PAUSE);
        let Some(since) = since else {
            (self.time, self.gap, self.way, self.differ) = (1, gap, 0.0, 0);
            return;
        };
        let seconds = f32::from(since) * UNIT;
        self.time = self.time.saturating_add(since);
        self.gap += (of_lead - of_cav) * seconds;
        self.way += of_lead.max(of_cav) * seconds;
        if self.time < WINDOW {
            return;
        }
        let (more, limit) = (gap - self.gap, f32::max(1.0, 0.5 * self.way));
        self.differ = if more > limit {
            self.differ.max(0).saturating_add(1)
        } else if more < -limit {
            self.differ.min(0).saturating_sub(1)
        } else {
            0
        };
        if self.differ.saturating_abs() >= WINDOWS {
            self.found |= bit(Advice::LeadSpeed);
        }
        (self.time, self.gap, self.way) = (1, gap, 0.0);
    }

    /// Whether gap and detection differ by the same in cycles in a row.
    #[allow(clippy::cast_possible_truncation, reason = "mm within 8 m")]
    fn compare(&mut self, differs: Option<f64>) {
        let Some(by) = differs.filter(|by| (-3.0..-0.75).contains(by) || (1.0..8.0).contains(by))
        else {
            self.alike = 0;
            return;
        };
        let by = (by * 1000.0) as i16;
        let is_same = self.alike > 0 && self.first.abs_diff(by) <= 300;
        (self.first, self.alike) =
            if is_same { (self.first, self.alike.saturating_add(1)) } else { (by, 1) };
        if self.alike >= CYCLES {
            let kind = if by > 0 { Advice::GapTooLong } else { Advice::GapTooShort };
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
