//! Files that are complete or not there: written under another name, then renamed.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Creates the folder and makes sure that a file can be written there.
pub fn prepare(folder: &Path) -> io::Result<()> {
    if folder.exists() && !folder.is_dir() {
        return Err(io::Error::new(io::ErrorKind::NotADirectory, "it is no folder; name one"));
    }
    fs::create_dir_all(folder)?;
    let probe = folder.join(".mufasa.svg.tmp");
    fs::write(&probe, [])?;
    match fs::remove_file(&probe) {
        // Another shard that writes to the same folder was faster.
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}

/// Whether `write` can write a file there, which is asked before long work. Nothing is left behind, and the file stays.
pub fn prepare_file(file: &Path) -> io::Result<()> {
    match fs::symlink_metadata(file) {
        Ok(there) if there.is_symlink() => prepare_file(&fs::canonicalize(file)?),
        Ok(there) if there.is_dir() => {
            Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder; name a file"))
        }
        Ok(there) if !there.is_file() => Ok(()),
        Ok(_) | Err(_) => {
            let temporary = beside(file);
            fs::write(&temporary, [])?;
            fs::remove_file(&temporary)
        }
    }
}

/// The name under which a file is written.
fn beside(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".tmp");
    PathBuf::from(name)
}

/// Writes a file of text at once. What a link points to is written in its place, and what is no file, such as a device or a
/// pipe, is written to: neither is replaced.
pub fn write(file: &Path, content: &str) -> io::Result<()> {
    match fs::symlink_metadata(file) {
        Ok(there) if there.is_symlink() => {
            let target = fs::canonicalize(file)?;
            return write(&target, content);
        }
        Ok(there) if !there.is_file() && !there.is_dir() => {
            return fs::OpenOptions::new().write(true).open(file)?.write_all(content.as_bytes());
        }
        Ok(_) | Err(_) => {}
    }
    let temporary = beside(file);
    let written = fs::write(&temporary, content).and_then(|()| fs::rename(&temporary, file));
    if written.is_err() {
        // What is left of it must not stay; that it cannot be removed is no news.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// A name for a file from any text: letters, digits, and `-_.+()` stay.
pub fn name(text: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.+()".contains(c) { c } else { '_' };
    let name: String = text.chars().take(150).map(plain).collect();
    if name.trim_start_matches('.').is_empty() { "drive".to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain() {
        assert_eq!(name("USA_US101-3_3.xml#4"), "USA_US101-3_3.xml_4");
        assert_eq!(name("../../etc/x y"), ".._.._etc_x_y");
        assert_eq!(name(""), "drive");
        assert_eq!(name(".."), "drive");
    }

    #[test]
    fn many_prepare_one_folder_at_once() {
        let folder = std::env::temp_dir().join(format!("mufasa-prepare-{}", std::process::id()));
        let many = || (0..500).map(|_| prepare(&folder)).find(Result::is_err);
        let failed: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(many)).collect();
            threads.into_iter().filter_map(|it| it.join().unwrap()).collect()
        });
        assert!(failed.is_empty(), "{failed:?}");
        fs::remove_dir_all(&folder).unwrap();
    }

    /// A link stays a link, and a device a device, whoever writes.
    #[cfg(unix)]
    #[test]
    fn links_and_devices_are_written_to_and_not_replaced() {
        let folder = std::env::temp_dir().join(format!("mufasa-links-{}", std::process::id()));
        prepare(&folder).unwrap();
        let [file, link, gone] = ["file", "link", "gone"].map(|name| folder.join(name));
        fs::write(&file, "longer than what comes").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        std::os::unix::fs::symlink(folder.join("nowhere"), &gone).unwrap();
        write(&link, "new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        write(&gone, "new").unwrap_err();
        prepare_file(&gone).unwrap_err();
        prepare_file(&folder).unwrap_err();
        prepare_file(&folder.join("none/file")).unwrap_err();
        for fine in [&link, &file, &folder.join("another")] {
            prepare_file(fine).unwrap();
        }
        assert!(!folder.join("another").exists());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        let device = Path::new("/dev/null");
        write(device, "new").unwrap();
        assert!(!fs::symlink_metadata(device).unwrap().is_file());
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_that_cannot_be_written_leaves_nothing_behind() {
        let folder = std::env::temp_dir().join(format!("mufasa-files-{}", std::process::id()));
        prepare(&folder).unwrap();
        write(&folder.join("a.svg"), "<svg/>").unwrap();
        fs::create_dir(folder.join("b.svg")).unwrap();
        write(&folder.join("b.svg"), "<svg/>").unwrap_err();
        let mut names: Vec<_> =
            fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["a.svg", "b.svg"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
