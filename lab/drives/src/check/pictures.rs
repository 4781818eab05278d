//! A picture of every cycle that the model finds unsafe.

use std::io;
use std::path::{Path, PathBuf};

use super::checked::Seen;
use super::words;
use crate::drive::DriveCycle;
use crate::pictures::{Content, picture};
use mufasa_records::files;
use mufasa_records::names;

/// Writes the picture of a cycle of that drive, if the model finds it unsafe, into a folder that
/// exists; returns its path. An error names the file.
pub fn write(
    folder: &Path,
    drive: &str,
    seen: &Seen<'_>,
) -> Result<Option<PathBuf>, (PathBuf, io::Error)> {
    let Some(report) = seen.judged.unsafe_report() else { return Ok(None) };
    let DriveCycle { cycle, .. } = seen.made;
    let setting =
        format!("{}, {}", names::configuration(cycle.configuration), names::profile(cycle.profile));
    let content = Content {
        title: format!("{drive} at {:.2} s ({setting})", seen.seconds()),
        subtitle: words::answer(&seen.judged.model),
        cycle,
        report,
    };
    let stage = report.failed_stage.map_or("", names::failed_stage);
    let file = folder.join(format!("{}-{:04}-{stage}.svg", files::name(drive), seen.index));
    match files::write(&file, &picture(&content)) {
        Ok(()) => Ok(Some(file)),
        Err(error) => Err((file, error)),
    }
}
