//! A group whose station sends nothing that a cycle can use is treated as silent
//! (`spec/monitor.md`, elements that no cycle can use).

/// Whether a group is starved after a cycle that has no current element of it; `since_ns` is the time that
/// silence counts from. [MON-31] [MON-33] [MON-63]
pub fn is_starved(was_starved: bool, since_ns: i64, t_ns: i64, dt_max_ns: i64) -> bool {
    let without = i128::from(t_ns) - i128::from(since_ns);
    let is_set_back = without < 0;
    !is_set_back && (was_starved || without > i128::from(dt_max_ns))
}
