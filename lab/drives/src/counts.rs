//! Counts in words, and times.

/// `1 drive`, `2 drives`; of several words the first takes the s.
pub fn counted(count: usize, what: &str) -> String {
    match what.split_once(' ') {
        _ if count == 1 => format!("1 {what}"),
        Some((first, rest)) => format!("{count} {first}s {rest}"),
        None => format!("{count} {what}s"),
    }
}

/// A time after another, s.
#[expect(clippy::cast_precision_loss, reason = "to be read, drawn, or of drives of minutes")]
pub(crate) fn seconds(from_ns: i64, to_ns: i64) -> f64 {
    (i128::from(to_ns) - i128::from(from_ns)) as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_extreme_times_do_not_overflow() {
        assert!(seconds(i64::MIN, i64::MAX) > 1.8e10);
    }

    #[test]
    fn one_is_no_plural() {
        let [none, one, two] = [0, 1, 2].map(|count| counted(count, "cycle with errors"));
        assert_eq!(
            [none, one, two],
            ["0 cycles with errors", "1 cycle with errors", "2 cycles with errors"]
        );
        assert_eq!([1, 2].map(|count| counted(count, "drive")), ["1 drive", "2 drives"]);
    }
}
