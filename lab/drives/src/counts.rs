//! Counts in words.

/// `1 drive`, `2 drives`; of several words the first takes the s.
pub fn counted(count: usize, what: &str) -> String {
    match what.split_once(' ') {
        _ if count == 1 => format!("1 {what}"),
        Some((first, rest)) => format!("{count} {first}s {rest}"),
        None => format!("{count} {what}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
