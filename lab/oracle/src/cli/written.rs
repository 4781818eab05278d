//! What is written once for other programs: completions, manual pages, schemas, vectors.

use std::io::{self, Write};
use std::path::Path;

use clap::Command;
use clap_complete::Shell;
use mufasa_conform::vectors;
use mufasa_drives::check::complain;
use mufasa_records::files;

use super::codes::{DISAGREE, refused};
use crate::schemas;

/// What a shell needs to complete a command. The exit code.
pub fn completions(shell: Shell, mut command: Command, out: &mut impl Write) -> io::Result<u8> {
    // What writes it panics where writing fails.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut command, "mufasa", &mut text);
    out.write_all(&text).map(|()| 0)
}

/// The vectors. The exit code. Errors: those of writing to `out`, of all here.
pub fn vectors(folder: &Path, out: &mut impl Write) -> io::Result<u8> {
    let files = match vectors::all() {
        Ok(files) => files,
        Err(refused) => {
            for vector in refused {
                complain(&mut io::stderr(), &vector.to_string());
            }
            return Ok(DISAGREE);
        }
    };
    let contents = vectors::contents(&files);
    if let Err(error) = vectors::write(folder, &contents) {
        return Ok(refused(&format!("{}: cannot be written: {error}", folder.display())));
    }
    let count: usize = files.values().map(Vec::len).sum();
    writeln!(out, "{}: {} files, {count} vectors", folder.display(), contents.len())?;
    Ok(0)
}

/// The manual pages of a command and those below it. The exit code.
pub fn man(folder: &Path, command: Command, out: &mut impl Write) -> io::Result<u8> {
    let written = files::prepare(folder).and_then(|()| clap_mangen::generate_to(command, folder));
    if let Err(error) = written {
        return Ok(refused(&format!("{}: cannot be written: {error}", folder.display())));
    }
    writeln!(out, "{}: the manual pages; read one by man -l", folder.display())?;
    Ok(0)
}

/// The schemas. The exit code.
pub fn schemas(folder: &Path, out: &mut impl Write) -> io::Result<u8> {
    match schemas::write(folder) {
        Ok(count) => writeln!(out, "{}: {count} schemas", folder.display()).map(|()| 0),
        Err(error) => Ok(refused(&format!("{}: cannot be written: {error}", folder.display()))),
    }
}
