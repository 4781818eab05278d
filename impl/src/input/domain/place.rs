//! Single values against their domains (`spec/4-arithmetic.md#domain`).

use core::cmp::Ordering;

use crate::numbers::exact::{Product, compare};
use crate::numbers::time::elapsed_ns;
use crate::report::{InvalidInput, Problem};

pub(super) type Check = Result<(), InvalidInput>;

/// 60 s, beyond which a stamp is out of the domain.
// DOM-01
pub(super) const HORIZON_NS: i64 = 60_000_000_000;

pub(super) const POSITION: [f64; 2] = [-16_777_216.0, 16_777_216.0];
pub(super) const SPEED: [f64; 2] = [0.0, 150.0];
pub(super) const VELOCITY: [f64; 2] = [-150.0, 150.0];
pub(super) const SIZE: [f64; 2] = [0.01, 100.0];
pub(super) const ANY: [f64; 2] = [f64::MIN, f64::MAX];

/// Where in a list a value stands.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) index: Option<usize>,
}

impl Place {
    pub(super) fn problem(self, field: &'static str, problem: Problem) -> Check {
        Err(InvalidInput { field, index: self.index, problem })
    }

    /// NaN is not finite; every other value is compared with both ends of its domain.
    pub(super) fn f64(self, field: &'static str, value: f64, [least, most]: [f64; 2]) -> Check {
        // IMPL-05, INPUT-04
        if !value.is_finite() {
            return self.problem(field, Problem::NotFinite);
        }
        if least <= value && value <= most {
            return Ok(());
        }
        self.problem(field, Problem::OutOfDomain)
    }

    pub(super) fn i64(self, field: &'static str, value: i64, [least, most]: [i64; 2]) -> Check {
        if least <= value && value <= most {
            return Ok(());
        }
        self.problem(field, Problem::OutOfDomain)
    }

    pub(super) fn size(
        self,
        field: &'static str,
        items: usize,
        [least, most]: [usize; 2],
    ) -> Check {
        if items < least {
            return self.problem(field, Problem::TooFew);
        }
        if items > most {
            return self.problem(field, Problem::TooMany);
        }
        Ok(())
    }

    /// Whether the time is not older than 60 s; older remote times and later ones are refused.
    pub(super) fn stamp(
        self,
        field: &'static str,
        stamp_ns: i64,
        now_ns: i64,
        remote: bool,
    ) -> Result<bool, InvalidInput> {
        let age_ns = elapsed_ns(stamp_ns, now_ns);
        if age_ns < -HORIZON_NS || (remote && age_ns > HORIZON_NS) {
            self.problem(field, Problem::TimeOutOfRange)?;
        }
        Ok(age_ns <= HORIZON_NS)
    }

    /// The norm check is exact: abs(cos^2 + sin^2 - 1) <= 1e-6 in real numbers.
    pub(super) fn direction(self, field: &'static str, cos: f64, sin: f64) -> Check {
        if is_clearly_a_direction(cos, sin) {
            return Ok(());
        }
        let near = |value: f64| (-2.0..=2.0).contains(&value);
        let square = [Product([cos, 0.0], [cos, 0.0]), Product([sin, 0.0], [sin, 0.0])];
        let one = Product([1.0, 0.0], [1.0, 0.0]);
        let most = [one, Product([1e-6, 0.0], [1.0, 0.0])];
        let least = [one, Product([-1e-6, 0.0], [1.0, 0.0])];
        let within = near(cos)
            && near(sin)
            && compare(&square, &most) != Ordering::Greater
            && compare(&square, &least) != Ordering::Less;
        if within { Ok(()) } else { self.problem(field, Problem::NotADirection) }
    }
}

/// abs(cos^2 + sin^2 - 1) <= 1e-6, by more than the rounding of this sum.
pub(super) fn is_clearly_a_direction(cos: f64, sin: f64) -> bool {
    (cos * cos + sin * sin - 1.0).abs() <= 0.999_999e-6
}
