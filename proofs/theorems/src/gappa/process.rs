//! Gappa as a process.

use std::io::{self, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time for a script.
const LIMIT: Duration = Duration::from_secs(20);

/// The version of Gappa, or nothing where there is none.
pub fn version() -> Option<String> {
    let output = Command::new("gappa").arg("--version").output().ok()?;
    let text = [output.stdout, output.stderr].concat();
    Some(String::from_utf8(text).ok()?.trim().to_owned())
}

/// Whether Gappa proves what the script claims. Errors are those of running it.
pub(super) fn is_proved(script: &str) -> io::Result<bool> {
    let mut process = Command::new("gappa")
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()?;
    // Dropped at once, so that Gappa sees the end of its input.
    process.stdin.take().map_or(Ok(()), |mut input| input.write_all(script.as_bytes()))?;
    let end = Instant::now() + LIMIT;
    loop {
        if let Some(status) = process.try_wait()? {
            return Ok(status.success());
        }
        if Instant::now() > end {
            process.kill()?;
            process.wait()?;
            return Ok(false);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
