//! Counterexamples that are drives, as tables.

/// What a row has after its event.
pub const COLUMNS: [&str; 5] = ["time, s", "place, m", "speed, m/s", "gap, m", "speed ahead, m/s"];

/// Name of the variable in this column of a row.
pub fn cell(number: usize, event: &str, column: &str) -> String {
    format!("{number} {event}: {column}")
}

/// The drive among what the solver found, as a table; none where there is no drive.
pub fn table(values: &[(String, f64)]) -> Option<String> {
    let cells = values.iter().filter_map(|(name, value)| {
        let (row, column) = name.rsplit_once(": ")?;
        let event = row.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
        Some((event, column, format!("{value:.2}")))
    });
    let cells: Vec<_> = cells.collect();
    let columns = COLUMNS.join(" | ");
    let mut lines =
        vec![format!("| | {columns} |"), format!("|---|{}", "--:|".repeat(COLUMNS.len()))];
    lines.extend(cells.chunks(COLUMNS.len()).map(|row| {
        let numbers: Vec<&str> = row.iter().map(|(.., number)| number.as_str()).collect();
        format!("| {} | {} |", row[0].0, numbers.join(" | "))
    }));
    (!cells.is_empty()).then(|| lines.join("\n"))
}
