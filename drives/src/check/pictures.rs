//! A picture of every cycle that the model finds unsafe.

use std::io;
use std::path::{Path, PathBuf};

use super::checked::Checked;
use super::words;
use crate::pictures::{Content, picture};
use mufasa_records::files;
use mufasa_records::names;

/// Writes the pictures of the cycles that are wanted, by their index in the drive, into a folder
/// that exists; returns their paths. An error names the file.
pub fn write(
    folder: &Path,
    checked: &Checked,
    wanted: impl Fn(usize) -> bool,
) -> Result<Vec<PathBuf>, (PathBuf, io::Error)> {
    let mut written = Vec::new();
    for (index, judged) in checked.judged.iter().enumerate().filter(|(index, _)| wanted(*index)) {
        let Some(report) = judged.unsafe_report() else { continue };
        let cycle = &checked.drive.cycle(index).cycle;
        let setting = format!(
            "{}, {}",
            names::configuration(cycle.configuration),
            names::profile(cycle.profile)
        );
        let at = checked.seconds(index);
        let content = Content {
            title: format!("{} at {at:.2} s ({setting})", checked.drive.name),
            subtitle: words::answer(&judged.model),
            cycle,
            report,
        };
        let stage = report.failed_stage.map_or("", names::failed_stage);
        let name = files::name(&checked.drive.name);
        let file = folder.join(format!("{name}-{index:04}-{stage}.svg"));
        files::write(&file, &picture(&content)).map_err(|error| (file.clone(), error))?;
        written.push(file);
    }
    Ok(written)
}
