//! Numbers as the formats count them, and back (`spec/6-link.md#rounding`).

use std::f64::consts::TAU;

use super::error::{DecodeError, EncodeError, Place, Problem};

/// A number of a format: how many counts a unit has, and which counts there are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quantity {
    part: &'static str,
    field: &'static str,
    per_unit: f64,
    least: i64,
    most: i64,
}

impl Quantity {
    /// `per_unit`: counts in a unit of the value, a power of ten.
    pub(super) const fn new(
        part: &'static str,
        field: &'static str,
        per_unit: f64,
        [least, most]: [i64; 2],
    ) -> Self {
        Self { part, field, per_unit, least, most }
    }

    /// The value of a count.
    #[allow(clippy::cast_precision_loss, reason = "counts of all formats are below 2^53")]
    pub(super) fn value(&self, count: impl Into<i64>) -> f64 {
        count.into() as f64 / self.per_unit
    }

    /// The value of a count that was received.
    pub(super) fn read(&self, count: impl Into<i64>) -> Result<f64, DecodeError> {
        let count = count.into();
        let is_inside = (self.least..=self.most).contains(&count);
        let place = Place::of(self.part, self.field);
        is_inside.then(|| self.value(count)).ok_or(DecodeError::OutOfRange(place))
    }

    /// The count nearest to a value.
    pub(super) fn nearest<T: TryFrom<i64>>(&self, value: f64) -> Result<T, EncodeError> {
        if !value.is_finite() {
            return Err(self.error(Problem::NotFinite));
        }
        self.count(saturated(libm::round(value * self.per_unit)))
    }

    /// The least count whose value is not below this one.
    pub(super) fn not_below<T: TryFrom<i64>>(&self, value: f64) -> Result<T, EncodeError> {
        let nearest: i64 = self.nearest(value).or_else(|error| {
            // What is rounded up comes from below the range, too.
            if value > 0.0 && value < self.value(self.least) { Ok(self.least) } else { Err(error) }
        })?;
        self.count(if self.value(nearest) < value { nearest + 1 } else { nearest })
    }

    /// A count as the format holds it.
    pub(super) fn count<T: TryFrom<i64>>(&self, count: i64) -> Result<T, EncodeError> {
        let fits = (self.least..=self.most).contains(&count).then(|| T::try_from(count).ok());
        fits.flatten().ok_or_else(|| {
            let (least, most) = (self.value(self.least), self.value(self.most));
            self.error(Problem::OutOfRange { least, most })
        })
    }

    fn error(&self, problem: Problem) -> EncodeError {
        EncodeError { place: Place::of(self.part, self.field), problem }
    }
}

#[allow(clippy::cast_possible_truncation, reason = "the cast saturates, and no range ends there")]
fn saturated(value: f64) -> i64 {
    value as i64
}

/// The direction (cos, sin) as counts of a turn, from x towards y: 0 to `per_turn` - 1.
pub(super) fn angle(
    part: &'static str,
    [cos, sin]: [f64; 2],
    per_turn: i32,
) -> Result<i64, EncodeError> {
    let norm_is_one = (cos * cos + sin * sin - 1.0).abs() <= 1e-6;
    if !norm_is_one {
        let place = Place::of(part, "(cos, sin)");
        return Err(EncodeError { place, problem: Problem::NoDirection });
    }
    let turns = libm::atan2(sin, cos) / TAU;
    Ok(saturated(libm::round(turns * f64::from(per_turn))).rem_euclid(per_turn.into()))
}

/// The direction (cos, sin) of so many counts of a turn; right angles are exact. `per_turn` is a multiple
/// of four.
#[allow(clippy::cast_precision_loss, reason = "below a quarter of a turn")]
pub(super) fn direction(counts: i64, per_turn: i32) -> [f64; 2] {
    let counts = counts.rem_euclid(per_turn.into());
    let quarter = i64::from(per_turn / 4);
    let (sin, cos) = libm::sincos((counts % quarter) as f64 / f64::from(per_turn) * TAU);
    match counts / quarter {
        0 => [cos, sin],
        1 => [0.0 - sin, cos],
        2 => [0.0 - cos, 0.0 - sin],
        _ => [sin, 0.0 - cos],
    }
}
