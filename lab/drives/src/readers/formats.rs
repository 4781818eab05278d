//! Formats that are often given and not read, by their first bytes, and what to do with a file of each.

use std::path::Path;
use std::str::Utf8Error;

/// First bytes of a gz file, which is read.
pub(crate) const GZ: &[u8] = b"\x1f\x8b";

const UNPACK: &str =
    "a packed file, of which gz alone is read, once: unpack it and give what is in it";
const UTF_16: &str =
    "text in UTF-16, which is not read: write it as UTF-8, as `iconv -f UTF-16 -t UTF-8 FILE` does";
const ARRAY: &str = "one JSON array, which is not read: JSON Lines have every record on a line of its own, as \
                     `jq -c .[] FILE` writes it";
const KNOWN: [(&[u8], &str); 7] = [
    (GZ, UNPACK),
    (b"PK\x03\x04", UNPACK),
    (b"\x28\xb5\x2f\xfd", UNPACK),
    (b"\xfd7zXZ\x00", UNPACK),
    (b"BZh", UNPACK),
    (b"\xff\xfe", UTF_16),
    (b"\xfe\xff", UTF_16),
];
/// What `check` reads, for a file that is nothing known.
pub(crate) const READ: &str =
    "CommonRoad XML, cycles as JSON Lines and maps as .npy are read, each also as .gz";

/// Whether a file is called as one of JSON Lines is, packed or not, so that its first line may be a broken one.
pub(crate) fn is_named_lines(path: &Path) -> bool {
    let name = path.file_name().map(|it| it.to_string_lossy().to_ascii_lowercase());
    name.is_some_and(|name| {
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        [".jsonl", ".ndjson"].iter().any(|end| name.ends_with(end))
    })
}

/// What to do with a file of a format that is not read; `None` where its bytes are of no such format.
pub(crate) fn foreign(bytes: &[u8]) -> Option<&'static str> {
    let known = KNOWN.iter().find(|(mark, _)| bytes.starts_with(mark)).map(|(_, advice)| *advice);
    known.or_else(|| is_array(bytes).then_some(ARRAY))
}

/// Of records; a file of TOML may begin with a name in brackets.
fn is_array(bytes: &[u8]) -> bool {
    let items = bytes.strip_prefix(b"[").map(<[u8]>::trim_ascii_start);
    items.is_some_and(|it| it.starts_with(b"{") || it.starts_with(b"]"))
}

/// What is wrong with text that is not UTF-8, and what to do with it. `error` says where it is not.
pub(crate) fn not_utf_8(bytes: &[u8], error: &Utf8Error) -> String {
    if bytes.trim_ascii_start().starts_with(b"<") {
        format!(
            "XML that is not UTF-8 ({error}), which is not read: write it as UTF-8, as `iconv -f ENCODING -t UTF-8 \
             FILE` does; ISO-8859-1 is usual"
        )
    } else {
        format!("no format that is read, and no text ({error}); {READ}")
    }
}
