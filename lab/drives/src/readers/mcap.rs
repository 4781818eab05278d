//! Cycles in an MCAP log, as `mufasa evaluate replay --mcap` writes it.

use std::path::Path;

use ::mcap::{McapError, MessageStream};

use crate::readers::error::ReadError;

/// The schema of a channel whose messages are records of cycles (`spec/5-interfaces.md#cycle`).
pub const CYCLE: &str = "mufasa.Cycle";
/// The encoding of their messages.
pub const JSON: &str = "json";
/// First bytes of an MCAP log.
pub(crate) const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// The cycles of the log in its order, each on a line: the messages of every channel with their schema.
///
/// Errors: no MCAP log, or one that is compressed; no such message.
pub(crate) fn lines(path: &Path, bytes: &[u8]) -> Result<Vec<u8>, ReadError> {
    let failed = |error: McapError| ReadError::file(path, message(&error));
    let mut text = Vec::new();
    for message in MessageStream::new(bytes).map_err(failed)? {
        let message = message.map_err(failed)?;
        let schema = message.channel.schema.as_ref();
        if message.channel.message_encoding != JSON || schema.is_none_or(|it| it.name != CYCLE) {
            continue;
        }
        // A line break within a record is a blank there, and nowhere else.
        let blank = |byte: &u8| if matches!(byte, b'\n' | b'\r') { b' ' } else { *byte };
        text.extend(message.data.iter().map(blank));
        text.push(b'\n');
    }
    if text.is_empty() {
        let message = format!(
            "an MCAP log without cycles: no channel has messages in {JSON} of the schema {CYCLE}, records of \
             spec/5-interfaces.md#cycle"
        );
        return Err(ReadError::file(path, message));
    }
    Ok(text)
}

fn message(error: &McapError) -> String {
    match error {
        McapError::UnsupportedCompression(name) => format!(
            "an MCAP log compressed by {name}, which is not read: write it without compression, as `mcap \
             decompress` does"
        ),
        error => format!("this MCAP log is cut off or broken ({error}); write it again"),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::io::Cursor;

    use ::mcap::WriteOptions;
    use ::mcap::records::MessageHeader;

    use super::*;

    /// A log with a channel for each schema and encoding, and one message in each.
    fn log(channels: &[(&str, &str, &str)]) -> Vec<u8> {
        let mut writer = WriteOptions::new().create(Cursor::new(Vec::new())).unwrap();
        for (schema, encoding, message) in channels {
            let schema = writer.add_schema(schema, "jsonschema", b"{}").unwrap();
            let topic = format!("/{schema}");
            let channel_id = writer.add_channel(schema, &topic, encoding, &BTreeMap::new());
            let channel_id = channel_id.unwrap();
            let header = MessageHeader { channel_id, sequence: 0, log_time: 0, publish_time: 0 };
            writer.write_to_known_channel(&header, message.as_bytes()).unwrap();
        }
        writer.finish().unwrap();
        writer.into_inner().into_inner()
    }

    fn read(bytes: &[u8]) -> Result<String, String> {
        let read = lines(Path::new("f"), bytes).map_err(|error| error.message);
        read.map(|text| String::from_utf8(text).unwrap())
    }

    #[test]
    fn messages_of_the_schema_are_lines_and_no_others() {
        let other = ("foxglove.Log", JSON, "{\"a\": 1}");
        let bytes = log(&[other, (CYCLE, JSON, "{\n\"b\": 2}\r\n"), (CYCLE, "cbor", "{\"c\": 3}")]);
        assert_eq!(read(&bytes), Ok(String::from("{ \"b\": 2}  \n")));
        assert!(read(&log(&[other])).unwrap_err().contains("without cycles"));
        assert!(read(&bytes[..bytes.len() / 2]).unwrap_err().contains("cut off or broken"));
        assert_eq!(&bytes[..MAGIC.len()], MAGIC);
    }

    #[test]
    fn a_compressed_log_is_refused_by_the_name_of_its_compression() {
        let message = message(&McapError::UnsupportedCompression(String::from("zstd")));
        assert!(message.contains("zstd") && message.contains("mcap decompress"), "{message}");
    }
}
