//! Solvers as processes that answer one question each.

use std::io::{self, Write};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// What the program writes that was given this input; none when it takes longer, and is ended. Errors are
/// those of running it.
pub fn run(command: &mut Command, input: &str, limit: Duration) -> io::Result<Option<Output>> {
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut process = command.spawn()?;
    // Dropped at once, so that it sees the end of its input. Its answer is a few lines.
    process.stdin.take().map_or(Ok(()), |mut stdin| stdin.write_all(input.as_bytes()))?;
    let end = Instant::now() + limit;
    while process.try_wait()?.is_none() {
        if Instant::now() > end {
            process.kill()?;
            process.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    process.wait_with_output().map(Some)
}
