//! What is written once for other programs: completions, manual pages, schemas, vectors.

use std::io::Write;
use std::path::Path;

use clap::Command;
use clap_complete::Shell;
use mufasa_conform::vectors;
use mufasa_records::files;

use crate::ended::{DISAGREES, Ended, cannot, complain};
use crate::schemas;

/// What a shell needs to complete a command. The exit code.
pub fn completions(shell: Shell, mut command: Command, out: &mut impl Write) -> Ended {
    // What writes it panics where writing fails.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut command, "mufasa", &mut text);
    out.write_all(&text)?;
    Ok(0)
}

/// The vectors. The exit code.
pub fn vectors(folder: &Path, out: &mut impl Write) -> Ended {
    let files = match vectors::all() {
        Ok(files) => files,
        Err(refused) => {
            refused.iter().for_each(|vector| complain(&vector.to_string()));
            return Ok(DISAGREES);
        }
    };
    let contents = vectors::contents(&files);
    vectors::write(folder, &contents).map_err(cannot(folder, "written"))?;
    let count: usize = files.values().map(Vec::len).sum();
    writeln!(out, "{}: {} files, {count} vectors", folder.display(), contents.len())?;
    Ok(0)
}

/// The manual pages of a command and those below it. The exit code.
pub fn man(folder: &Path, command: Command, out: &mut impl Write) -> Ended {
    let written = files::prepare(folder).and_then(|()| clap_mangen::generate_to(command, folder));
    written.map_err(cannot(folder, "written"))?;
    writeln!(out, "{}: the manual pages; read one by man -l", folder.display())?;
    Ok(0)
}

/// The schemas. The exit code.
pub fn schemas(folder: &Path, out: &mut impl Write) -> Ended {
    let count = schemas::write(folder).map_err(cannot(folder, "written"))?;
    writeln!(out, "{}: {count} schemas", folder.display())?;
    Ok(0)
}
