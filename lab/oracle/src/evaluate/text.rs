//! Lines as text.

use serde::Serialize;

use crate::ended::said;

/// A line of names, and a line of each.
pub(super) fn csv<T: Serialize>(lines: &[T]) -> Result<String, String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    lines.iter().try_for_each(|line| writer.serialize(line)).map_err(said)?;
    String::from_utf8(writer.into_inner().map_err(said)?).map_err(said)
}

/// Spread over lines, with one at its end.
pub(super) fn json(of: &impl Serialize) -> Result<String, String> {
    Ok(serde_json::to_string_pretty(of).map_err(said)? + "\n")
}
