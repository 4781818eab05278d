//! Which of the CAV's earlier scans a cycle comes with (`spec/hardened/what-the-cav-saw.md`).

/// Ages that the keeper of the history looks for, ns.
const WANTED_NS: [i64; 3] = [300_000_000, 500_000_000, 800_000_000];
/// Ages of a usable list, ns.
const USABLE_NS: std::ops::RangeInclusive<i64> = 200_000_000..=1_000_000_000;

/// How many steps of `dt_ns` ago the lists of a history were scanned, the youngest first: of the
/// last `kept` scans those whose ages are nearest to 300, 500 and 800 ms and usable.
pub(crate) fn steps_ago(dt_ns: i64, kept: i64) -> Vec<i64> {
    let usable = |ago: &i64| USABLE_NS.contains(&ago.saturating_mul(dt_ns));
    let scans: Vec<i64> = (1..=kept.min(USABLE_NS.end() / dt_ns.max(1))).filter(usable).collect();
    let nearest = |wanted: &i64| {
        scans.iter().copied().min_by_key(|ago| ago.saturating_mul(dt_ns).abs_diff(*wanted))
    };
    let mut ago: Vec<i64> = WANTED_NS.iter().filter_map(nearest).collect();
    ago.dedup();
    ago
}

#[cfg(test)]
mod tests {
    use super::steps_ago;

    #[test]
    fn the_scans_nearest_to_the_wanted_ages_are_given_once_each() {
        let tenth = |kept| steps_ago(100_000_000, kept);
        assert_eq!(tenth(50), [3, 5, 8]);
        assert_eq!((tenth(1), tenth(2), tenth(4)), (vec![], vec![2], vec![3, 4]));
        // Of two at the same distance the younger.
        assert_eq!(steps_ago(200_000_000, 50), [1, 2, 4]);
        assert_eq!(steps_ago(40_000_000, 50), [7, 12, 20]);
        assert_eq!(steps_ago(1_000_000_000, 50), [1]);
        assert!(steps_ago(1_500_000_000, 50).is_empty());
        assert!(steps_ago(100_000_000, -3).is_empty());
    }
}
