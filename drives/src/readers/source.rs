//! A file before it is understood: where it is, what it is called, its bytes, unpacked.
//!
//! Whatever is judged comes from one reading of the file. Its first bytes are looked at before, to
//! put solutions behind their scenarios: of a file on a disk by opening it once more, so that many
//! files are neither held nor kept open at once; anything else (a pipe, standard input) has its
//! bytes only once and is read whole then.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

use crate::readers::error::ReadError;
use crate::readers::formats;

/// Most bytes that a gz file may unpack to: 1 GiB. A small file can claim any size.
const UNPACKED_MAX: u64 = 1 << 30;

/// A file that was named.
pub(crate) struct Source {
    pub path: PathBuf,
    /// What was read when the first bytes were looked at.
    read: Option<io::Result<Vec<u8>>>,
}

impl Source {
    pub(crate) fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), read: None }
    }

    /// The first bytes, unpacked; fewer, or none, where the file cannot be read.
    pub(crate) fn head(&mut self, most: u64) -> Vec<u8> {
        // Opened again, /dev/stdin goes on where it is on some systems, even if it is a file.
        let is_file = fs::metadata(&self.path).is_ok_and(|it| it.is_file());
        if is_file && !self.path.starts_with("/dev") {
            return File::open(&self.path).map_or_else(|_| Vec::new(), |file| first(file, most));
        }
        let path = &self.path;
        match self.read.get_or_insert_with(|| fs::read(path)) {
            Ok(bytes) => first(bytes.as_slice(), most),
            Err(_) => Vec::new(),
        }
    }

    /// All bytes, unpacked.
    pub(crate) fn bytes(&mut self) -> Result<Vec<u8>, ReadError> {
        let bytes = self.read.take().unwrap_or_else(|| fs::read(&self.path));
        let bytes =
            bytes.map_err(|e| ReadError::file(&self.path, format!("cannot be read: {e}")))?;
        if bytes.starts_with(formats::GZ) {
            return unpacked(&self.path, &bytes, UNPACKED_MAX);
        }
        Ok(bytes)
    }
}

/// The name of a file without its last extension; `.gz` says only how it is packed.
pub(crate) fn stem(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let name = Path::new(name.strip_suffix(".gz").unwrap_or(&name));
    name.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The first bytes of what can be read, unpacked where they are packed.
fn first(mut file: impl Read, most: u64) -> Vec<u8> {
    let mut mark = Vec::new();
    let mut head = Vec::new();
    // What could be read before an error is all that can be looked at.
    let _ = (&mut file).take(2).read_to_end(&mut mark);
    let whole = mark.as_slice().chain(file);
    let _ = if mark == formats::GZ {
        MultiGzDecoder::new(whole).take(most).read_to_end(&mut head)
    } else {
        whole.take(most).read_to_end(&mut head)
    };
    head
}

fn unpacked(path: &Path, packed: &[u8], most: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    let result = MultiGzDecoder::new(packed).take(most + 1).read_to_end(&mut bytes);
    if bytes.len() as u64 > most {
        let message = format!(
            "unpacks to more than {most} bytes, the most that is read of a gz file; give it \
             unpacked if it is what it should be"
        );
        return Err(ReadError::file(path, message));
    }
    result.map_err(|e| {
        let message = format!("this gz file is cut off or broken ({e}); pack it again");
        ReadError::file(path, message)
    })?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn packed(content: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(content).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn a_gz_file_is_unpacked_up_to_the_limit() {
        let path = Path::new("x.gz");
        let whole = packed(&[7; 1000]);
        assert_eq!(unpacked(path, &whole, 1000).unwrap(), [7; 1000]);
        let error = unpacked(path, &whole, 999).unwrap_err();
        assert!(error.message.contains("more than 999 bytes"), "{error}");
        let error = unpacked(path, &whole[..whole.len() - 3], 1000).unwrap_err();
        assert!(error.message.contains("cut off or broken"), "{error}");
        assert_eq!(first(whole.as_slice(), 10), [7; 10]);
        let parts = [packed(b"ab"), packed(b"cd")].concat();
        assert_eq!(unpacked(path, &parts, 4).unwrap(), b"abcd");
    }

    #[test]
    fn the_stem_of_a_packed_file_is_that_of_the_file_in_it() {
        let stems = ["a/b.xml.gz", "b.xml", "b.gz", "b"].map(|path| stem(Path::new(path)));
        assert_eq!(stems, ["b", "b", "b", "b"]);
        assert_eq!(stem(Path::new("b.solution1.KS2.xml.gz")), "b.solution1.KS2");
    }
}
