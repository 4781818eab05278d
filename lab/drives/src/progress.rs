//! Progress on standard error: a bar on a terminal, lines in a log, or nothing.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle, TermLike};

/// How progress is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Not at all.
    Quiet,
    /// A bar, where standard error is a terminal.
    #[default]
    Bar,
    /// A line every few seconds, wherever standard error goes.
    Lines,
}

/// Of the process.
static MODE: OnceLock<Mode> = OnceLock::new();

/// Between two lines.
const PAUSE: Duration = Duration::from_secs(5);
/// Before that much is done, the time that is left is not known.
const SETTLED: Duration = Duration::from_secs(5);

/// Says for the whole process how progress is shown; the first call counts.
pub fn set(mode: Mode) {
    // Nobody sets it twice but tests, which all want the same.
    let _ = MODE.set(mode);
}

/// Whether the process says nothing of what it does.
pub fn is_quiet() -> bool {
    MODE.get() == Some(&Mode::Quiet)
}

/// A bar of so many steps; 0 where they are not known. The template is indicatif's, with `{left}` for
/// the time that is left once that can be told, and `?` for a `{len}` that is not known.
pub fn bar(steps: u64, template: &str) -> ProgressBar {
    let target = match MODE.get().copied().unwrap_or_default() {
        Mode::Quiet => ProgressDrawTarget::hidden(),
        Mode::Bar => ProgressDrawTarget::stderr(),
        Mode::Lines => ProgressDrawTarget::term_like_with_hz(Box::new(Lines::default()), 1),
    };
    bar_on(target, steps, template)
}

fn bar_on(target: ProgressDrawTarget, steps: u64, template: &str) -> ProgressBar {
    // With 0 of 0 steps a bar would be full.
    let bar = ProgressBar::with_draw_target((steps > 0).then_some(steps), target);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.with_key("left", left).with_key("len", len));
    }
    bar
}

fn len(state: &ProgressState, to: &mut dyn fmt::Write) {
    let steps = state.len().map_or_else(|| String::from("?"), |steps| steps.to_string());
    // A bar that cannot be drawn is none.
    let _ = to.write_str(&steps);
}

fn left(state: &ProgressState, to: &mut dyn fmt::Write) {
    // A bar that cannot be drawn is none.
    let _ = to.write_str(&in_words_once_known(state.elapsed(), state.pos(), state.eta()));
}

/// Of the first steps it was once 12 h, for work of a minute.
fn in_words_once_known(elapsed: Duration, done: u64, left: Duration) -> String {
    if elapsed >= SETTLED && done > 0 { in_words(left) } else { String::from("?") }
}

/// A time, rounded.
pub fn in_words(time: Duration) -> String {
    match time.as_secs() {
        seconds @ 0..60 => format!("{seconds} s"),
        seconds @ 60..3600 => format!("{} min", seconds.div_ceil(60)),
        seconds => format!("{} h {} min", seconds / 3600, seconds % 3600 / 60),
    }
}

/// A terminal that keeps every line.
#[derive(Clone, Debug, Default)]
struct Lines(Arc<Mutex<Written>>);

#[derive(Debug, Default)]
struct Written {
    text: String,
    last: Option<(String, Instant)>,
}

impl TermLike for Lines {
    fn width(&self) -> u16 {
        120
    }

    fn move_cursor_up(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_down(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_right(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn move_cursor_left(&self, _: usize) -> io::Result<()> {
        Ok(())
    }

    fn write_line(&self, text: &str) -> io::Result<()> {
        self.write_str(text)
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).text.push_str(text);
        Ok(())
    }

    fn clear_line(&self) -> io::Result<()> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).text.clear();
        Ok(())
    }

    fn flush(&self) -> io::Result<()> {
        let mut written = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let text = std::mem::take(&mut written.text).trim().to_owned();
        let is_due =
            written.last.as_ref().is_none_or(|(last, at)| *last != text && at.elapsed() >= PAUSE);
        if text.is_empty() || !is_due {
            return Ok(());
        }
        written.last = Some((text.clone(), Instant::now()));
        writeln!(io::stderr(), "{text}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_short_words() {
        let words = [0, 59, 60, 61, 3599, 3600, 43_260].map(|s| in_words(Duration::from_secs(s)));
        assert_eq!(words, ["0 s", "59 s", "1 min", "2 min", "60 min", "1 h 0 min", "12 h 1 min"]);
    }

    #[test]
    fn a_bar_of_unknown_length_is_not_full() {
        let shown = |steps| {
            let lines = Lines::default();
            let target = ProgressDrawTarget::term_like(Box::new(lines.clone()));
            bar_on(target, steps, "{bar:3} {pos}/{len}").tick();
            lines.0.lock().unwrap().last.as_ref().map(|(last, _)| last.clone())
        };
        let [unknown, known] = [0, 3].map(|steps| shown(steps).unwrap_or_default());
        assert!(unknown.ends_with(" 0/?") && !unknown.contains('█'), "{unknown}");
        assert!(known.ends_with(" 0/3"), "{known}");
    }

    #[test]
    fn in_the_first_seconds_it_is_not_known_what_is_left() {
        let said = |elapsed, done| {
            in_words_once_known(Duration::from_secs(elapsed), done, Duration::from_secs(9))
        };
        assert_eq!([said(4, 3), said(60, 0), said(5, 1)], ["?", "?", "9 s"]);
    }

    #[test]
    fn a_log_gets_a_line_now_and_then_and_none_twice() {
        let lines = Lines::default();
        let shown = |text: &str| {
            lines.clear_line().unwrap();
            lines.write_str(text).unwrap();
            lines.flush().unwrap();
            lines.0.lock().unwrap().last.as_ref().map(|(last, _)| last.clone())
        };
        assert_eq!(shown(""), None);
        assert_eq!(shown("1 of 9"), Some(String::from("1 of 9")));
        // Too soon after it.
        assert_eq!(shown("2 of 9"), Some(String::from("1 of 9")));
    }
}
