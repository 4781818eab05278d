//! A first look at lists of numbers without any branch: whatever is not clearly within its domain
//! (`spec/4-arithmetic.md#domain`) is looked at again, one value after another, by `input`.
//!
//! The bits of doubles >= 0 are ordered as the numbers, and those of infinities and NaNs are
//! above all others. So "at most" is the sign of a difference of bits, and signs are collected by
//! "or": three simple instructions for a pair of numbers, which stand beside each other in memory
//! and go through one register: a third of the instructions of the checks in `input`.

/// The sign bit of a lane is set once a value was not clearly within its domain.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Screen([u64; 2]);

const SIGN: u64 = 1 << 63;

impl Screen {
    /// abs(value) <= most, of both.
    pub(crate) fn sizes(&mut self, values: [f64; 2], most: f64) {
        for (lane, value) in self.0.iter_mut().zip(values) {
            *lane |= most.to_bits().wrapping_sub(value.to_bits() & !SIGN);
        }
    }

    /// 0 < least <= value <= most, of both. A value with the sign bit set makes one of the two
    /// differences negative: the second one up to a size of `least`, the first one from there on.
    pub(crate) fn ranges(&mut self, values: [f64; 2], [least, most]: [f64; 2]) {
        for (lane, value) in self.0.iter_mut().zip(values) {
            let bits = value.to_bits();
            *lane |= bits.wrapping_sub(least.to_bits()) | most.to_bits().wrapping_sub(bits);
        }
    }

    /// abs(cos^2 + sin^2 - 1) <= 1e-6, by more than the rounding of this sum.
    pub(crate) fn direction(&mut self, [cos, sin]: [f64; 2]) {
        let [lane, _] = &mut self.0;
        let off = cos * cos + sin * sin - 1.0;
        *lane |= 0.999_999e-6_f64.to_bits().wrapping_sub(off.to_bits() & !SIGN);
    }

    /// The condition holds.
    pub(crate) fn holds(&mut self, condition: bool) {
        let [_, lane] = &mut self.0;
        *lane |= u64::from(!condition) << 63;
    }

    /// Whether everything was clearly within its domain.
    pub(crate) fn passes(self) -> bool {
        let [a, b] = self.0;
        (a | b) & SIGN == 0
    }
}

#[cfg(test)]
mod tests {
    use super::Screen;

    /// In either lane.
    fn both(check: impl Fn(&mut Screen, [f64; 2]), value: f64) -> bool {
        let [one, other] = [[value, 1.0], [1.0, value]].map(|values| {
            let mut screen = Screen::default();
            check(&mut screen, values);
            screen.passes()
        });
        assert_eq!(one, other, "{value}");
        one
    }

    fn size(value: f64) -> bool {
        both(|screen, values| screen.sizes(values, 100.0), value)
    }

    fn range(value: f64) -> bool {
        both(|screen, values| screen.ranges(values, [0.01, 100.0]), value)
    }

    fn direction(cos: f64, sin: f64) -> bool {
        let mut screen = Screen::default();
        screen.direction([cos, sin]);
        screen.passes()
    }

    /// Both ends of a domain with their neighbours, and what is no number.
    #[test]
    fn a_screen_compares_as_numbers_compare() {
        let up = |value: f64| f64::from_bits(value.to_bits() + 1);
        let down = |value: f64| f64::from_bits(value.to_bits() - 1);
        let special = [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN];
        let small = [0.0, -0.0, f64::from_bits(1), -f64::from_bits(1), f64::MIN_POSITIVE];
        let ends = [0.01, down(0.01), up(0.01), 100.0, down(100.0), up(100.0), 1.0, 1e9];
        for value in special.into_iter().chain(small).chain(ends) {
            for value in [value, -value] {
                assert_eq!(size(value), (-100.0..=100.0).contains(&value), "{value}");
                assert_eq!(range(value), (0.01..=100.0).contains(&value), "{value}");
            }
        }
    }

    #[test]
    fn a_screen_keeps_what_it_saw() {
        let mut screen = Screen::default();
        screen.sizes([101.0, 1.0], 100.0);
        screen.sizes([1.0, 1.0], 100.0);
        screen.holds(true);
        assert!(!screen.passes());
        let mut screen = Screen::default();
        screen.holds(false);
        assert!(!screen.passes());
    }

    #[test]
    fn only_clear_directions_pass() {
        assert!(direction(0.6, -0.8) && direction(1.0, 0.0));
        assert!(!direction(1.000_000_5, 0.0), "on the border: left to the exact check");
        assert!(
            !direction(f64::NAN, 0.0) && !direction(f64::INFINITY, 0.0) && !direction(0.0, 0.0)
        );
    }
}
