//! Quality of service of one remote group (`spec/2-offloading.md#quality-of-service`).
//!
//! All times are signed 64-bit nanoseconds of the CAV's monotonic clock. Differences are taken
//! in 128 bits, so they are exact for every pair of times.

/// The limits of the quality of service. Source: `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Limits {
    /// Largest latency that is no violation, in ns, >= 0.
    pub l_max_ns: i64,
    /// Largest inter-arrival time that is no violation, in ns, >= 0.
    pub dt_max_ns: i64,
}

/// What breaks the quality of service; with several, the first in this order. Source:
/// `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Violation {
    /// The generation time is later than the arrival: the clocks cannot be trusted.
    FromTheFuture,
    /// `l > l_max`
    Latency,
    /// `dt > dt_max`, found by an arrival or by a tick.
    InterArrival,
}

/// What becomes of an element of the running session. Source:
/// `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    /// It is used.
    Used,
    /// It is dropped: not later generated than the last one used since the activation.
    Stale,
    /// It is dropped, and its group returns to local.
    Violating(Violation),
}

/// The arrivals of one session. Source: `spec/2-offloading.md#quality-of-service`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Arrivals {
    last_arrival_ns: i64,
    last_used_ns: Option<i64>,
}

impl Arrivals {
    /// No element yet. `now_ns`: the activation, from which the first inter-arrival time runs.
    /// Source: `spec/2-offloading.md#quality-of-service`.
    pub const fn since_activation(now_ns: i64) -> Self {
        Self { last_arrival_ns: now_ns, last_used_ns: None }
    }

    /// The arrivals of a session that was stored. Times in ns: of the last arrival (or of the
    /// activation), and of generation of the last element used since the activation. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub const fn from_parts(last_arrival_ns: i64, last_used_ns: Option<i64>) -> Self {
        Self { last_arrival_ns, last_used_ns }
    }

    /// Time of the last arrival, or of the activation, in ns. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub const fn last_arrival_ns(&self) -> i64 {
        self.last_arrival_ns
    }

    /// Generation time of the last element used since the activation, in ns. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub const fn last_used_ns(&self) -> Option<i64> {
        self.last_used_ns
    }

    /// Whether an element was used since the activation. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub const fn has_used(&self) -> bool {
        self.last_used_ns.is_some()
    }

    /// An element of the running session arrives: latency and inter-arrival time first, then its
    /// order. `now_ns`: arrival time; `generated_ns`: generation time. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub fn arrive(&mut self, now_ns: i64, generated_ns: i64, limits: Limits) -> Element {
        // QOS-02
        if let Some(violation) = latency_violation(now_ns, generated_ns, limits) {
            return Element::Violating(violation);
        }
        if let Some(violation) = self.silence(now_ns, limits) {
            return Element::Violating(violation);
        }
        // QOS-01
        self.last_arrival_ns = now_ns;
        // QOS-08
        if self.last_used_ns.is_some_and(|last_ns| generated_ns <= last_ns) {
            return Element::Stale;
        }
        self.last_used_ns = Some(generated_ns);
        Element::Used
    }

    /// The violation, if the time since the last arrival (or the activation) is longer than
    /// `dt_max`. `now_ns`: time of the tick or of the arrival. Source:
    /// `spec/2-offloading.md#quality-of-service`.
    pub fn silence(&self, now_ns: i64, limits: Limits) -> Option<Violation> {
        // QOS-03, QOS-04
        (difference(now_ns, self.last_arrival_ns) > i128::from(limits.dt_max_ns))
            .then_some(Violation::InterArrival)
    }
}

/// The violation, if an element that was generated at `generated_ns` and arrives at `now_ns` is
/// too old or from the future. Source: `spec/2-offloading.md#quality-of-service`.
pub fn latency_violation(now_ns: i64, generated_ns: i64, limits: Limits) -> Option<Violation> {
    // QOS-05; A-05
    if generated_ns > now_ns {
        Some(Violation::FromTheFuture)
    } else if difference(now_ns, generated_ns) > i128::from(limits.l_max_ns) {
        // QOS-03
        Some(Violation::Latency)
    } else {
        None
    }
}

/// `later - earlier`, exact: the difference of two 64-bit times fits in 65 bits.
fn difference(later_ns: i64, earlier_ns: i64) -> i128 {
    // FALL-10
    i128::from(later_ns).saturating_sub(i128::from(earlier_ns))
}

#[cfg(test)]
mod tests {
    use super::{Arrivals, Element, Limits, Violation, latency_violation};

    const LIMITS: Limits = Limits { l_max_ns: 50, dt_max_ns: 100 };

    /// QOS-03, QOS-04
    #[test]
    fn beyond_l_max_or_dt_max_is_a_violation_and_equality_is_not() {
        assert_eq!(latency_violation(50, 0, LIMITS), None);
        assert_eq!(latency_violation(51, 0, LIMITS), Some(Violation::Latency));
        let arrivals = Arrivals::since_activation(0);
        assert_eq!(arrivals.silence(100, LIMITS), None);
        assert_eq!(arrivals.silence(101, LIMITS), Some(Violation::InterArrival));
    }

    /// QOS-05: equal times are not later.
    #[test]
    fn generated_later_than_arrived_is_a_violation() {
        assert_eq!(latency_violation(7, 8, LIMITS), Some(Violation::FromTheFuture));
        assert_eq!(latency_violation(7, 7, LIMITS), None);
    }

    /// QOS-01, QOS-02
    #[test]
    fn an_element_out_of_order_is_an_arrival_but_is_checked_for_latency_first() {
        let mut arrivals = Arrivals::since_activation(0);
        assert_eq!(arrivals.arrive(60, 40, LIMITS), Element::Used);
        assert_eq!(arrivals.arrive(80, 40, LIMITS), Element::Stale, "equal is not later");
        assert_eq!(arrivals.silence(180, LIMITS), None, "the stale element was an arrival");
        assert_eq!(arrivals.arrive(95, 40, LIMITS), Element::Violating(Violation::Latency));
        assert_eq!(arrivals.arrive(181, 180, LIMITS), Element::Violating(Violation::InterArrival));
    }

    /// QOS-08: the last one that arrived does not matter.
    #[test]
    fn order_is_that_of_the_last_element_used() {
        let mut arrivals = Arrivals::since_activation(0);
        assert!(!arrivals.has_used());
        assert_eq!(arrivals.arrive(20, 10, LIMITS), Element::Used);
        assert!(arrivals.has_used());
        assert_eq!(arrivals.arrive(21, 5, LIMITS), Element::Stale);
        assert_eq!(arrivals.arrive(22, 6, LIMITS), Element::Stale, "later than 5, not than 10");
        assert_eq!(arrivals.arrive(23, 11, LIMITS), Element::Used);
        assert_eq!(Arrivals::since_activation(30).arrive(31, 0, LIMITS), Element::Used);
    }

    /// FALL-10
    #[test]
    fn differences_are_exact_at_the_limits_of_64_bits() {
        let widest = Limits { l_max_ns: i64::MAX, dt_max_ns: i64::MAX };
        assert_eq!(latency_violation(i64::MAX, 0, widest), None);
        assert_eq!(latency_violation(i64::MAX, -1, widest), Some(Violation::Latency));
        assert_eq!(latency_violation(i64::MAX, i64::MIN, widest), Some(Violation::Latency));
        let arrivals = Arrivals::since_activation(i64::MIN);
        assert_eq!(arrivals.silence(-1, widest), None);
        assert_eq!(arrivals.silence(0, widest), Some(Violation::InterArrival));
    }

    /// Time that runs backwards between two arrivals is no silence.
    #[test]
    fn an_arrival_before_the_last_one_is_no_silence() {
        let mut arrivals = Arrivals::since_activation(100);
        assert_eq!(arrivals.arrive(50, 40, LIMITS), Element::Used);
        assert_eq!(arrivals.silence(151, LIMITS), Some(Violation::InterArrival));
    }
}
