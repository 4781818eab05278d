//! Tables of doubles as NumPy writes them (`.npy`): little-endian, row by row.

/// What is wrong with the bytes, and in which field of the header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// Field of the header, or `header` itself.
    pub field: &'static str,
    /// What would be right.
    pub message: String,
}

/// Reads a table of `N` columns.
pub fn table<const N: usize>(bytes: &[u8]) -> Result<Vec<[f64; N]>, Broken> {
    let broken = |field, message: &str| Broken { field, message: message.to_owned() };
    let cut = || broken("header", "cut off or broken");
    let version = bytes.strip_prefix(b"\x93NUMPY").and_then(|rest| rest.first()).ok_or_else(cut)?;
    // Version 1 has a length of two bytes, later ones of four.
    let start = if *version == 1 { 10 } else { 12 };
    let length =
        bytes.get(8..start).ok_or_else(cut)?.iter().rev().fold(0, |n, b| n << 8 | usize::from(*b));
    let end = start + length;
    let header =
        bytes.get(start..end).and_then(|h| core::str::from_utf8(h).ok()).ok_or_else(cut)?;
    let header: String = header.chars().filter(|c| !c.is_whitespace()).collect();
    if !header.contains("'descr':'<f8'") {
        return Err(broken("descr", "`<f8` is needed"));
    }
    if !header.contains("'fortran_order':False") {
        return Err(broken("fortran_order", "rows one after the other are needed"));
    }
    let shape =
        header.split("'shape':(").nth(1).and_then(|rest| rest.split(')').next()).unwrap_or("");
    let rows: Option<usize> =
        shape.strip_suffix(&format!(",{N}")).and_then(|rows| rows.parse().ok());
    let (cells, rest) = bytes[end..].as_chunks::<8>();
    let (table, left) = cells.as_chunks::<N>();
    if rows != Some(table.len()) || !rest.is_empty() || !left.is_empty() {
        let message =
            format!("rows of {N} doubles, as many as follow, are needed; it says ({shape})");
        return Err(Broken { field: "shape", message });
    }
    Ok(table.iter().map(|row| row.map(f64::from_le_bytes)).collect())
}
