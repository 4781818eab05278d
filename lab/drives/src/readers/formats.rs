//! Formats that are not read, by their first bytes, and what to do with a file of each.

use std::path::Path;
use std::str::Utf8Error;

/// First bytes of a gz file, which is read.
pub(crate) const GZ: &[u8] = b"\x1f\x8b";

const UNPACK: &str = "unpack it and give what is in it; of packed files only gz is read";
/// What stands at this byte of a tar archive.
const TAR: (usize, &[u8]) = (257, b"ustar");
const RECORDS: &str =
    "write its cycles as JSON Lines, a record of spec/5-interfaces.md#cycle on every line";
const UTF_16: &str = "write it as UTF-8, as `iconv -f UTF-16 -t UTF-8 FILE` does";
const UTF_32: &str = "write it as UTF-8, as `iconv -f UTF-32 -t UTF-8 FILE` does";
const XML: &str = "write it as XML, as CommonRoadFileWriter of commonroad-io does";

/// First bytes, what they are of, and what to do; the longer ones of two that start alike come first.
const KNOWN: [(&[u8], &str, &str); 25] = [
    (GZ, "a gz file within a gz file", UNPACK),
    (b"PK\x03\x04", "a zip archive", UNPACK),
    (b"PK\x05\x06", "an empty zip archive", UNPACK),
    (b"\x28\xb5\x2f\xfd", "a zstd file", UNPACK),
    (b"\xfd7zXZ\x00", "an xz file", UNPACK),
    (b"BZh", "a bzip2 file", UNPACK),
    (b"#ROSBAG", "a rosbag of ROS 1", RECORDS),
    (b"SQLite format 3\x00", "an SQLite database, such as a rosbag of ROS 2", RECORDS),
    (b"\x89HDF\r\n", "an HDF5 file", RECORDS),
    (b"PAR1", "a Parquet file", RECORDS),
    (b"\x89PNG\r\n\x1a\n", "a picture (PNG)", READ),
    (b"\xff\xd8\xff", "a picture (JPEG)", READ),
    (b"%PDF-", "a PDF", READ),
    (b"\xff\xfe\x00\x00", "text in UTF-32", UTF_32),
    (b"\x00\x00\xfe\xff", "text in UTF-32", UTF_32),
    (b"<\x00\x00\x00", "text in UTF-32", UTF_32),
    (b"{\x00\x00\x00", "text in UTF-32", UTF_32),
    (b"\x00\x00\x00<", "text in UTF-32", UTF_32),
    (b"\x00\x00\x00{", "text in UTF-32", UTF_32),
    (b"\xff\xfe", "text in UTF-16", UTF_16),
    (b"\xfe\xff", "text in UTF-16", UTF_16),
    (b"<\x00", "text in UTF-16", UTF_16),
    (b"{\x00", "text in UTF-16", UTF_16),
    (b"\x00<", "text in UTF-16", UTF_16),
    (b"\x00{", "text in UTF-16", UTF_16),
];
/// What `check` reads, for a file that is nothing known.
pub(crate) const READ: &str = "CommonRoad XML, cycles as JSON Lines or in MCAP logs and maps as .npy \
                               are read, each also as .gz";

/// Whether a file is called as one of JSON Lines is, packed or not, so that its first line may be a broken one.
pub(crate) fn is_named_lines(path: &Path) -> bool {
    let name = path.file_name().map(|it| it.to_string_lossy().to_ascii_lowercase());
    name.is_some_and(|name| {
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        [".jsonl", ".ndjson"].iter().any(|end| name.ends_with(end))
    })
}

/// What a file of a format that is not read is, and what to do with it; `None` where its bytes are
/// of no such format.
pub(crate) fn foreign(bytes: &[u8]) -> Option<String> {
    let known = KNOWN.iter().find(|(mark, _, _)| bytes.starts_with(mark));
    let (name, advice) = match known {
        Some((_, name, advice)) => (*name, *advice),
        None if bytes.is_empty() => ("an empty file", READ),
        None if bytes.get(TAR.0..).is_some_and(|it| it.starts_with(TAR.1)) => {
            ("a tar archive", UNPACK)
        }
        None if is_html(bytes) => (
            "an HTML page",
            "it may be what a server answered in place of the file; get the file itself",
        ),
        None if is_protobuf(bytes) => ("a CommonRoad scenario as protobuf", XML),
        None if bytes.starts_with(b"[") => (
            "one JSON array",
            "JSON Lines have every record on a line of its own, as `jq -c .[] FILE` writes it",
        ),
        None if is_csv(bytes) => ("a table of values (CSV)", RECORDS),
        None => return None,
    };
    Some(format!("{name}, which is not read: {advice}"))
}

/// What is wrong with text that is not UTF-8, and what to do with it. `error` says where it is not.
pub(crate) fn not_utf_8(bytes: &[u8], error: &Utf8Error) -> String {
    if !bytes.trim_ascii_start().starts_with(b"<") {
        return format!("no format that is read, and no text ({error}); {READ}");
    }
    let declared = declared_encoding(bytes).filter(|name| !name.eq_ignore_ascii_case("UTF-8"));
    let (what, from) = match declared {
        Some(name) => (format!("in {name}, as it declares"), name),
        None => (String::from("that should be UTF-8 and is not"), "ISO-8859-1"),
    };
    let guess = if declared.is_none() { ", if it is ISO-8859-1," } else { "" };
    format!(
        "XML {what} ({error}), which is not read: write it as UTF-8, as `iconv -f {from} -t UTF-8 \
         FILE`{guess} does"
    )
}

/// The encoding that an XML declaration names, as far as it is a name.
fn declared_encoding(bytes: &[u8]) -> Option<&str> {
    let head = bytes.trim_ascii_start().strip_prefix(b"<?xml")?;
    let end = head.windows(2).take(256).position(|it| it == b"?>")?;
    let (_, value) = std::str::from_utf8(&head[..end]).ok()?.split_once("encoding")?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|it| "\"'".contains(*it))?;
    let (name, _) = value[1..].split_once(quote)?;
    let is_name = |c: char| c.is_ascii_alphanumeric() || "._:-".contains(c);
    (!name.is_empty() && name.chars().all(is_name)).then_some(name)
}

/// Whether a text begins as HTML or XHTML does, whatever its encoding.
fn is_html(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let declared = text.strip_prefix(b"<?xml").and_then(|it| {
        let end = it.windows(2).take(256).position(|it| it == b"?>")?;
        Some(it[end + 2..].trim_ascii_start())
    });
    let text = declared.unwrap_or(text);
    [&b"<!doctype html"[..], b"<html"].iter().any(|start| {
        let head = text.get(..start.len());
        let ends = text.get(start.len()).is_none_or(|it| !it.is_ascii_alphanumeric());
        head.is_some_and(|head| head.eq_ignore_ascii_case(start)) && ends
    })
}

/// Whether a message begins with another one that holds the version of `CommonRoad`.
fn is_protobuf(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(64)];
    let holds = |version: &[u8]| head.windows(version.len()).any(|it| it == version);
    bytes.starts_with(b"\n") && (holds(b"\n\x052020a") || holds(b"\n\x052018b"))
}

/// Whether the first two lines have equally many values, two at least.
fn is_csv(bytes: &[u8]) -> bool {
    // A byte order mark is no content.
    let content = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if content.starts_with(b"<") || content.starts_with(b"{") {
        return false;
    }
    let mut lines = content.splitn(3, |b| *b == b'\n');
    let (Some(first), Some(second)) = (lines.next(), lines.next()) else { return false };
    [b',', b';', b'\t'].iter().any(|separator| {
        let [n, m] = [first, second].map(|line| line.split(|b| b == separator).count());
        n > 1 && n == m && std::str::from_utf8(first).is_ok()
    })
}
