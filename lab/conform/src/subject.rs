//! The program under test: started once, fed line by line, and started again when it breaks.

mod pipes;

use std::ffi::OsString;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, TryRecvError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::error::ConformError;
use crate::judge::class::Breach;
use pipes::{Heard, MAX_ANSWER_BYTES, keep_last, read, write};

/// Lines that wait to be read; a program that floods then waits, too.
const WAITING_LINES: usize = 16;

/// How long a line too many is waited for behind an answer that is none.
const GRACE: Duration = Duration::from_millis(20);

/// The first answer after a start may take so many times the limit: a program has to load first.
const START: u32 = 5;

/// How long an ended program is waited for, and then the end of its standard error.
const LAST_WORDS: Duration = Duration::from_secs(1);

/// No answer, or none that can be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// What the program does: one of those that `Breach::is_broken`.
    pub breach: Breach,
    /// In words.
    pub words: String,
}

impl Broken {
    /// A breach in words.
    pub fn new(breach: Breach, words: impl Into<String>) -> Self {
        Self { breach, words: words.into() }
    }
}

/// The program under test.
#[derive(Debug)]
pub struct Subject {
    command: Vec<OsString>,
    time_limit: Duration,
    running: Option<Running>,
    /// Set from elsewhere when the campaign is to end.
    stop: Arc<AtomicBool>,
    starts: u64,
    /// What the program did after its last answer, unasked.
    afterwards: Option<Broken>,
}

#[derive(Debug)]
struct Running {
    child: Child,
    heard: Receiver<Heard>,
    /// Lines on their way to the program; dropped to end its input.
    lines: Sender<Vec<u8>>,
    last_words: Arc<Mutex<Vec<u8>>>,
    /// Closed at the end of its standard error.
    speaks: Receiver<()>,
    /// Whether it was asked before.
    answered: bool,
}

impl Subject {
    /// Starts the program: its name and arguments, the time that an answer may take, and what is
    /// set when the campaign is to end. Errors: it cannot be started.
    pub fn start(
        command: &[OsString],
        time_limit: Duration,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, ConformError> {
        let command = command.to_vec();
        let mut subject = Self {
            command,
            time_limit,
            running: None,
            stop: Arc::clone(stop),
            starts: 0,
            afterwards: None,
        };
        subject.ensure()?;
        Ok(subject)
    }

    /// Whether the campaign is to end.
    pub fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// How long an answer may take from now on.
    pub fn set_time_limit(&mut self, time_limit: Duration) {
        self.time_limit = time_limit;
    }

    /// How often the program was started.
    pub fn starts(&self) -> u64 {
        self.starts
    }

    /// What the program did between its last answer and the last line sent, if it was anything.
    pub fn take_afterwards(&mut self) -> Option<Broken> {
        self.afterwards.take()
    }

    /// Sends a line, does something else, and returns its result with the line that came back.
    /// Errors: the program ended before and cannot be started again.
    pub fn ask<T>(
        &mut self,
        line: &str,
        meanwhile: impl FnOnce() -> T,
    ) -> Result<(T, Result<Vec<u8>, Broken>), ConformError> {
        let mut time_limit = self.time_limit;
        if let Err(broken) = self.ensure()?.quiet() {
            // That is no answer to this line: the program is started anew for it.
            self.stop();
            self.afterwards = Some(broken);
        }
        let running = self.ensure()?;
        if !running.answered {
            time_limit = time_limit.saturating_mul(START);
        }
        let sent = Instant::now();
        let mut bytes = line.as_bytes().to_vec();
        bytes.push(b'\n');
        // A program that ended is seen by what comes back.
        let _ = running.lines.send(bytes);
        let result = meanwhile();
        // What the model takes is not the program's time, but nearly so on a busy machine.
        let left = time_limit.saturating_sub(sent.elapsed()).max(time_limit / 4);
        let answer = running.next(left, time_limit);
        running.answered = true;
        if answer.is_err() {
            self.stop();
        }
        Ok((result, answer))
    }

    /// Ends the process, so that the next line is the first of a new one.
    pub fn restart(&mut self) {
        self.stop();
    }

    /// Judges an answer that is none: followed by another line at once, it is a flood. The
    /// program is stopped.
    pub fn broke(&mut self, broken: Broken) -> Broken {
        let more = self
            .running
            .as_ref()
            .is_some_and(|running| matches!(running.heard.recv_timeout(GRACE), Ok(Heard::Line(_))));
        self.stop();
        if more {
            let words = format!("writes line after line; the first: {}", broken.words);
            return Broken::new(Breach::Floods, words);
        }
        broken
    }

    /// Ends the input and waits for the end of the output and of the program. A line that still
    /// comes is a flood; a program that a signal ends has died; its exit code is its own affair.
    pub fn finish(&mut self) -> Result<(), Broken> {
        let Some(running) = self.running.take() else { return Ok(()) };
        let Running { mut child, heard, lines, .. } = running;
        drop(lines);
        let last = heard.recv_timeout(self.time_limit);
        drop(heard);
        let ended = matches!(last, Ok(Heard::End) | Err(RecvTimeoutError::Disconnected));
        let status = if ended { wait(&mut child, self.time_limit) } else { None };
        if status.is_none() {
            let _ = child.kill();
            let _ = child.wait();
        }
        let hangs = || Broken::new(Breach::Hangs, "does not end when its input ends");
        match (last, status) {
            (Ok(Heard::Line(line)), _) => Err(unasked(&line)),
            (Ok(Heard::TooLong), _) => Err(too_long()),
            (_, Some(status)) if status.code().is_none() => {
                let words =
                    format!("ends otherwise than by itself at the end of its input ({status})");
                Err(Broken::new(Breach::Dies, words))
            }
            (_, Some(_)) => Ok(()),
            (_, None) => Err(hangs()),
        }
    }

    fn ensure(&mut self) -> Result<&mut Running, ConformError> {
        let running = if let Some(running) = self.running.take() {
            running
        } else {
            self.starts += 1;
            Running::start(&self.command)?
        };
        Ok(self.running.insert(running))
    }

    fn stop(&mut self) {
        if let Some(mut running) = self.running.take() {
            let _ = running.child.kill();
            let _ = running.child.wait();
        }
    }
}

impl Drop for Subject {
    fn drop(&mut self) {
        self.stop();
    }
}

impl Running {
    fn start(command: &[OsString]) -> Result<Self, ConformError> {
        let (program, arguments) = match command {
            [program, arguments @ ..] => (program.clone(), arguments),
            [] => (OsString::new(), &[][..]),
        };
        let failed =
            |error| ConformError::Start { command: program.to_string_lossy().into_owned(), error };
        let mut command = Command::new(&program);
        // Ctrl-C in a terminal is for the campaign, which then ends the program.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let (say, heard) = mpsc::sync_channel(WAITING_LINES);
        let (lines, to_write) = mpsc::channel();
        let last_words = Arc::new(Mutex::new(Vec::new()));
        let (spoken, speaks) = mpsc::channel();
        // The threads end with the pipes; nobody waits for them, as a grandchild may hold those.
        if let Some(output) = child.stdout.take() {
            thread::spawn(move || read(output, &say));
        }
        if let Some(input) = child.stdin.take() {
            thread::spawn(move || write(input, &to_write));
        }
        if let Some(errors) = child.stderr.take() {
            let kept = Arc::clone(&last_words);
            thread::spawn(move || {
                keep_last(errors, &kept);
                drop(spoken);
            });
        }
        Ok(Self { child, heard, lines, last_words, speaks, answered: false })
    }

    /// Nothing has come that was not asked for.
    fn quiet(&mut self) -> Result<(), Broken> {
        match self.heard.try_recv() {
            Ok(Heard::Line(line)) => Err(unasked(&line)),
            Ok(Heard::TooLong) => Err(too_long()),
            Ok(Heard::End) | Err(TryRecvError::Disconnected) => {
                Err(self.died("after its last answer"))
            }
            Err(TryRecvError::Empty) => Ok(()),
        }
    }

    fn next(&mut self, left: Duration, time_limit: Duration) -> Result<Vec<u8>, Broken> {
        match self.heard.recv_timeout(left) {
            Ok(Heard::Line(line)) => Ok(line),
            Ok(Heard::TooLong) => Err(too_long()),
            Ok(Heard::End) | Err(RecvTimeoutError::Disconnected) => {
                Err(self.died("before it has answered"))
            }
            Err(RecvTimeoutError::Timeout) => {
                let words = format!(
                    "no answer within {} ms (does it flush its output after every line?){}",
                    time_limit.as_millis(),
                    self.said(GRACE)
                );
                Err(Broken::new(Breach::Hangs, words))
            }
        }
    }

    fn died(&mut self, when: &str) -> Broken {
        let how = wait(&mut self.child, LAST_WORDS).map_or_else(
            || format!("closes its output {when}"),
            |status| format!("ends {when} ({status})"),
        );
        Broken::new(Breach::Dies, how + &self.said(LAST_WORDS))
    }

    /// The last words on standard error, whose end is waited for so long: a grandchild may hold it open.
    fn said(&self, time: Duration) -> String {
        let _ = self.speaks.recv_timeout(time);
        let kept = self.last_words.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&kept);
        let text = text.trim();
        if text.is_empty() { String::new() } else { format!("; its standard error: {text}") }
    }
}

/// How the program ended, if it does within the time.
fn wait(child: &mut Child, time: Duration) -> Option<ExitStatus> {
    let since = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) if since.elapsed() < time => thread::sleep(Duration::from_millis(2)),
            Ok(None) | Err(_) => return None,
        }
    }
}

fn unasked(line: &[u8]) -> Broken {
    let words = format!("writes a line that nobody asked for: {}", excerpt(line));
    Broken::new(Breach::Floods, words)
}

fn too_long() -> Broken {
    Broken::new(Breach::Floods, format!("writes a line longer than {MAX_ANSWER_BYTES} bytes"))
}

/// The beginning of a line, printable.
pub fn excerpt(line: &[u8]) -> String {
    const MOST: usize = 300;
    let text = String::from_utf8_lossy(&line[..line.len().min(4 * MOST)]);
    let shown: String =
        text.chars().take(MOST).map(|c| if c.is_control() { '.' } else { c }).collect();
    if shown.len() < line.len() { shown + "..." } else { shown }
}
