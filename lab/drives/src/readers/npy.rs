//! The one form of NumPy file that maps come in: a table of little-endian doubles, row by row.
//! The header is matched, not evaluated, so that no file can make the reader recurse or
//! allocate more than it holds.

use std::path::Path;

use crate::readers::error::{ReadError, quoted};

/// First bytes of every such file.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";

/// Reads a table of `N` columns with these names; the rows are not copied, a map of 100 MB is there once.
///
/// Errors: no such table; the field of its header.
pub fn table<'a, const N: usize>(
    file: &Path,
    bytes: &'a [u8],
    names: [&str; N],
) -> Result<impl ExactSizeIterator<Item = [f64; N]> + Clone + use<'a, N>, ReadError> {
    let error = |field: &str, message: String| ReadError::file(file, message).at("header", field);
    let broken = || error("", String::from("the header is cut off or broken"));
    let version = bytes.get(MAGIC.len()).copied().ok_or_else(broken)?;
    // Version 1 has a length of two bytes, 2 and 3 of four.
    let start = if version == 1 { 10 } else { 12 };
    let length = bytes.get(8..start).ok_or_else(broken)?;
    let length = length.iter().rev().fold(0_usize, |n, b| n << 8 | usize::from(*b));
    let end = start.checked_add(length).ok_or_else(broken)?;
    let header = bytes.get(start..end).and_then(|h| std::str::from_utf8(h).ok());
    let header: String =
        header.ok_or_else(broken)?.chars().filter(|c| !c.is_whitespace()).collect();
    if !header.contains("'descr':'<f8'") {
        return Err(error("descr", format!("`<f8` is needed: {}", quoted(&header))));
    }
    if !header.contains("'fortran_order':False") {
        return Err(error(
            "fortran_order",
            format!("rows one after the other are needed: {}", quoted(&header)),
        ));
    }
    let shape = header.split("'shape':(").nth(1).and_then(|rest| rest.split(')').next());
    let sizes: Vec<Option<usize>> = shape
        .unwrap_or("")
        .split(',')
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().ok())
        .collect();
    let [Some(rows), Some(columns)] = sizes[..] else {
        return Err(error("shape", format!("two sizes are needed: {}", quoted(&header))));
    };
    if columns != N {
        return Err(error(
            "shape",
            format!("{columns} columns; {N} are needed: {}", names.join(", ")),
        ));
    }
    let body = &bytes[end..];
    let (cells, rest) = body.as_chunks::<8>();
    if !rest.is_empty() || rows.checked_mul(N) != Some(cells.len()) {
        let message = format!("{rows} rows of {N} announced, {} bytes follow", body.len());
        return Err(error("shape", message));
    }
    let (table, _) = cells.as_chunks::<N>();
    Ok(table.iter().map(|row| row.map(f64::from_le_bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 3] = ["x", "y", "z"];

    fn file(header: &str, cells: &[f64]) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend([1, 0, u8::try_from(header.len()).unwrap(), 0]);
        bytes.extend(header.as_bytes());
        bytes.extend(cells.iter().flat_map(|c| c.to_le_bytes()));
        bytes
    }

    #[test]
    fn a_table_is_read_row_by_row() {
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n";
        let bytes = file(header, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let rows = table(Path::new("m.npy"), &bytes, NAMES).unwrap();
        assert_eq!(rows.collect::<Vec<_>>(), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    }

    #[test]
    fn a_header_that_does_not_fit_the_file_is_refused() {
        let of = |shape: &str, descr: &str, order: &str| {
            let h = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}");
            table(Path::new("m.npy"), &file(&h, &[0.0; 6]), NAMES).err().unwrap().field
        };
        assert_eq!(of("(3, 3)", "<f8", "False"), "shape");
        assert_eq!(of("(6148914691236517206, 3)", "<f8", "False"), "shape");
        assert_eq!(of("(1, 6)", "<f8", "False"), "shape");
        let six = file("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 6), }", &[0.0; 6]);
        let error = table(Path::new("m.npy"), &six, NAMES).err().unwrap();
        assert!(error.to_string().ends_with("6 columns; 3 are needed: x, y, z"), "{error}");
        assert_eq!(of("(6,)", "<f8", "False"), "shape");
        assert_eq!(of("(2, 3)", "<f4", "False"), "descr");
        assert_eq!(of("(2, 3)", "<f8", "True"), "fortran_order");
        for cut in 0..60 {
            let whole = file("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", &[]);
            assert!(table(Path::new("m.npy"), &whole[..cut], NAMES).is_err());
        }
    }
}
