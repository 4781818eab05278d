//! A file before it is understood: where it is, what it is called, its bytes, unpacked.
//!
//! Whatever is judged comes from one reading of the file. Its first bytes are looked at before, to
//! put solutions behind their scenarios: of a file on a disk by opening it once more, so that many
//! files are not kept open at once; anything else (a pipe, standard input) has its bytes only once
//! and is kept open then.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Cursor, ErrorKind, Read};
use std::path::{Path, PathBuf};

use flate2::bufread::MultiGzDecoder;

use crate::readers::error::ReadError;
use crate::readers::formats;

/// Most bytes that a gz file may unpack to: 1 GiB. A small file can claim any size.
const UNPACKED_MAX: u64 = 1 << 30;
/// Most bytes of a file that is read as a whole, as all but lines are: 1 GiB. A device may have no end.
const WHOLE_MAX: u64 = 1 << 30;
/// Standard input, as programs are told to read it.
const STDIN: &str = "-";
const DEV_STDIN: &str = "/dev/stdin";
const AGAIN: &str =
    "`-` stands here a second time, and standard input comes once; name a file in its place";
/// Bytes that are looked at to recognise a format.
const HEAD: usize = 4096;
/// Of which no more than this are blanks.
const BLANKS_MAX: usize = 1 << 26;

/// A file that was named.
pub(crate) struct Source {
    pub path: PathBuf,
    is_stdin: bool,
    /// Where the first bytes were looked at and come only once.
    opened: Option<io::Result<Unpacked>>,
}

impl Source {
    /// The files named; standard input has its bytes for the first of those that are it.
    pub(crate) fn all(paths: &[PathBuf]) -> Vec<Self> {
        let mut sources: Vec<Self> = paths.iter().map(|path| Self::new(path)).collect();
        for again in sources.iter_mut().filter(|it| it.path == Path::new(DEV_STDIN)).skip(1) {
            again.opened = Some(Err(io::Error::other(AGAIN)));
        }
        sources
    }

    fn new(path: &Path) -> Self {
        let is_stdin = path == Path::new(STDIN);
        let path = if is_stdin { Path::new(DEV_STDIN) } else { path };
        Self { path: path.to_owned(), is_stdin, opened: None }
    }

    /// The first bytes, unpacked; fewer, or none, where the file cannot be read.
    pub(crate) fn head(&mut self, most: usize) -> Vec<u8> {
        // Opened again, /dev/stdin goes on where it is on some systems, even if it is a file.
        let is_file = fs::metadata(&self.path).is_ok_and(|it| it.is_file());
        let comes_again = is_file && !self.path.starts_with("/dev");
        let mut opened = self.opened.take().unwrap_or_else(|| self.unpacked());
        let head = opened.as_mut().map_or_else(|_| Vec::new(), |file| file.peek(most).to_vec());
        self.opened = (!comes_again).then_some(opened);
        head
    }

    /// All bytes, unpacked.
    pub(crate) fn open(&mut self) -> Result<Unpacked, ReadError> {
        let opened = self.opened.take().unwrap_or_else(|| self.unpacked());
        opened.map_err(|error| ReadError::file(&self.path, error.to_string()))
    }

    fn unpacked(&self) -> io::Result<Unpacked> {
        if self.is_stdin {
            return Unpacked::of(io::stdin(), 0, UNPACKED_MAX);
        }
        let file = File::open(&self.path).map_err(|error| unread(&error))?;
        let length = file.metadata().map_or(0, |it| it.len());
        Unpacked::of(file, length, UNPACKED_MAX)
    }
}

/// The bytes of a file, unpacked as they are read. Its errors say what is wrong with the file.
pub(crate) struct Unpacked {
    /// What was looked at.
    head: Vec<u8>,
    rest: BufReader<Box<dyn Read>>,
    /// As far as it is known; 0 where it is not.
    length: usize,
}

impl Unpacked {
    fn of(file: impl Read + 'static, length: u64, most: u64) -> io::Result<Self> {
        let mut file = BufReader::with_capacity(1 << 16, file);
        let mut mark = Vec::new();
        let read = (&mut file).take(2).read_to_end(&mut mark);
        read.map_err(|error| unread(&error))?;
        let is_packed = mark == formats::GZ;
        let whole = Cursor::new(mark).chain(file);
        let rest: Box<dyn Read> = if is_packed {
            Box::new(Guard { inner: MultiGzDecoder::new(whole), left: most, failure: broken })
        } else {
            Box::new(Guard { inner: whole, left: u64::MAX, failure: unread })
        };
        let rest = BufReader::with_capacity(1 << 16, rest);
        let length = if is_packed { 0 } else { usize::try_from(length).unwrap_or(0) };
        Ok(Self { head: Vec::new(), rest, length })
    }

    /// The first bytes, `most` where there are as many.
    fn peek(&mut self, most: usize) -> &[u8] {
        let missing = most.saturating_sub(self.head.len()) as u64;
        if let Err(error) = (&mut self.rest).take(missing).read_to_end(&mut self.head) {
            // Who reads on gets it behind what could be read.
            self.rest = BufReader::new(Box::new(Broken(Some(error))));
        }
        &self.head
    }

    /// The first bytes, so many that one is no blank where there is one within the first 32 MiB.
    pub(crate) fn peek_text(&mut self) -> &[u8] {
        let mut most = HEAD;
        while most < BLANKS_MAX
            && self.peek(most).len() == most
            && self.head.trim_ascii().is_empty()
        {
            most *= 2;
        }
        &self.head
    }

    /// All bytes from the first on.
    pub(crate) fn reader(self) -> impl BufRead {
        Cursor::new(self.head).chain(self.rest)
    }

    /// All bytes at once.
    pub(crate) fn bytes(self) -> io::Result<Vec<u8>> {
        self.bytes_up_to(WHOLE_MAX)
    }

    fn bytes_up_to(self, most: u64) -> io::Result<Vec<u8>> {
        let mut bytes = self.head;
        let length = self.length.min(usize::try_from(most).unwrap_or(usize::MAX));
        bytes.reserve_exact(length.saturating_sub(bytes.len()));
        let rest = most.saturating_sub(bytes.len() as u64);
        self.rest.take(rest.saturating_add(1)).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > most {
            return Err(io::Error::other(format!(
                "has more than {most} bytes, the most that is read of a file that is no JSON Lines"
            )));
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

/// Says of errors what they mean for the file, and ends what is too long.
struct Guard<R> {
    inner: R,
    left: u64,
    failure: fn(&io::Error) -> io::Error,
}

impl<R: Read> Read for Guard<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = match self.inner.read(buffer) {
            Err(error) if error.kind() != ErrorKind::Interrupted => Err((self.failure)(&error)),
            read => read,
        }?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(too_long)?;
        Ok(read)
    }
}

/// What is left where reading failed before.
struct Broken(Option<io::Error>);

impl Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        self.0.take().map_or(Ok(0), Err)
    }
}

fn unread(error: &io::Error) -> io::Error {
    let advice = match error.kind() {
        ErrorKind::IsADirectory => "; name the files in it, such as FOLDER/*.xml",
        _ => "",
    };
    io::Error::other(format!("cannot be read: {error}{advice}"))
}

fn broken(error: &io::Error) -> io::Error {
    io::Error::other(format!("this gz file is cut off or broken ({error}); pack it again"))
}

fn too_long() -> io::Error {
    io::Error::other(format!(
        "unpacks to more than {UNPACKED_MAX} bytes, the most that is read of a gz file; give it \
         unpacked if it is what it should be"
    ))
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
        let unpacked =
            |bytes: &[u8], most: u64| Unpacked::of(Cursor::new(bytes.to_vec()), 0, most).unwrap();
        let bytes = |packed: &[u8], most: u64| unpacked(packed, most).bytes();
        let whole = packed(&[7; 1000]);
        assert_eq!(bytes(&whole, 1000).unwrap(), [7; 1000]);
        let error = bytes(&whole, 999).unwrap_err().to_string();
        assert!(error.contains("unpacks to more than"), "{error}");
        let error = bytes(&whole[..whole.len() - 3], 1000).unwrap_err().to_string();
        assert!(error.contains("cut off or broken"), "{error}");
        assert_eq!(unpacked(&whole, 1000).peek(10), [7; 10]);
        let parts = [packed(b"ab"), packed(b"cd")].concat();
        assert_eq!(bytes(&parts, 4).unwrap(), b"abcd");
    }

    #[test]
    fn what_was_looked_at_is_read_again_and_so_is_an_error() {
        let text = b"  some text".repeat(1000);
        let mut plain = Unpacked::of(Cursor::new(text.clone()), 3, 0).unwrap();
        assert_eq!((plain.peek(3).len(), plain.peek(9)), (3, &text[..9]));
        assert_eq!(plain.bytes().unwrap(), text);
        let whole = packed(&text);
        let mut cut =
            Unpacked::of(Cursor::new(whole[..whole.len() - 3].to_vec()), 0, 1 << 20).unwrap();
        assert_eq!(cut.peek(1 << 20), text);
        let error = cut.bytes().unwrap_err().to_string();
        assert!(error.contains("cut off or broken"), "{error}");
    }

    #[test]
    fn a_file_without_an_end_is_read_up_to_the_limit() {
        let endless = || Unpacked::of(io::repeat(1), 0, 0).unwrap();
        let error = endless().bytes_up_to(1000).unwrap_err().to_string();
        assert!(error.contains("has more than 1000 bytes"), "{error}");
        let mut looked_at = endless();
        looked_at.peek(2000);
        assert!(looked_at.bytes_up_to(1000).is_err());
        let whole = Unpacked::of(io::repeat(1).take(1000), 1 << 60, 0).unwrap();
        assert_eq!(whole.bytes_up_to(1000).unwrap(), [1; 1000]);
        let mut blanks = Unpacked::of(io::repeat(b' '), 0, 0).unwrap();
        assert!((BLANKS_MAX / 2..=BLANKS_MAX).contains(&blanks.peek_text().len()));
    }

    #[test]
    fn blanks_do_not_hide_a_text() {
        let text = [&b" ".repeat(3 * HEAD)[..], b"{"].concat();
        let mut blank = Unpacked::of(Cursor::new(text.clone()), 0, 0).unwrap();
        assert_eq!(blank.peek_text(), text);
        let mut nothing = Unpacked::of(Cursor::new(b" ".repeat(HEAD)), 0, 0).unwrap();
        assert_eq!(nothing.peek_text().len(), HEAD);
    }

    #[test]
    fn the_stem_of_a_packed_file_is_that_of_the_file_in_it() {
        let stems = ["a/b.xml.gz", "b.xml", "b.gz", "b"].map(|path| stem(Path::new(path)));
        assert_eq!(stems, ["b", "b", "b", "b"]);
        assert_eq!(stem(Path::new("b.solution1.KS2.xml.gz")), "b.solution1.KS2");
    }
}
