//! The duties of the integrator, and where a loop breaks them.

use mufasa_model::input::profile::Profile;

macro_rules! duties {
    ($($name:ident: $row:literal, $act:literal;)*) => {
        /// A row of `docs/safety-manual.md#duties-of-the-integrator`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[expect(missing_docs, reason = "the words stand below")]
        pub enum Duty {
            $($name),*
        }

        impl Duty {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// The duty as the manual has it, and what to do.
            pub const fn text(self) -> [&'static str; 2] {
                match self {
                    $(Self::$name => [$row, $act],)*
                }
            }
        }
    };
}

duties! {
    Period: "Call `tick`, then `cycle`, in each period.",
        "Let a timer of the highest priority call them, and a watchdog brake without it";
    Actions: "Take each action of each call, in its order.",
        "Go through the actions of every call, also of those that seem to have none";
    Verified: "Follow only what is `Verified`.",
        "Let control take its points out of a safe decision alone";
    BrakeBy: "Brake with at least `a_b` by `brake_by` (MON-42, MON-67, MON-68).",
        "Keep brake_by beside the trajectory, tau after the cycle beside an own plan of Local, and let control compare it with its clock";
    Late: "Take a missing or late verdict as unsafe (A-13).",
        "Throw away a decision that comes after check_time";
    Tau: "Set `tau` as A-07 asks.",
        "Add up the four times of A-07";
    CheckTime: "Lend memory and set `check_time` and `step_ps` (A-14).",
        "Lend less, or measure step_ps as docs/configuration.md says, at the slowest clock";
    Settings: "Give the settings in their units.",
        "Compare the settings with those of docs/configuration.md";
    Sessions: "Number sessions on over a restart (A-17).",
        "Store the last session, and give it as sessions_before";
    Wait: "Offer nothing for `t_wait` after a restart (A-17).",
        "Keep offers back until t_wait after the first call of the new monitor";
    Clock: "Give all times on one clock.",
        "Convert each time to ns of the vehicle's clock where it comes in";
    Gap: "Give the gap from bumper to bumper.",
        "Compare the lead's gap and speed with the detection ahead";
    Sender: "Hand over each message under the station and session that it names (A-15).",
        "Take both out of the message whose signature was checked, and log them as sender";
    OwnPlans: "Make own plans safe (A-11).",
        "Brake from a decision that says so to the first one that does not";
    Arithmetic: "Keep the target's arithmetic to IEEE 754 (A-18).",
        "See first that each call is in the log, then run the vectors on the target";
    Advice: "Ask for `advice` after each cycle, and log it (A-21).",
        "Call advice after each cycle, and log that nothing was said, too";
}

/// A duty that is broken: where first, how, and how often beside that.
#[derive(Clone, Debug)]
struct Finding {
    duty: Duty,
    line: usize,
    what: String,
    more: u64,
}

/// Duties that are broken, each once for each kind of place where it is looked at.
#[derive(Clone, Debug, Default)]
pub struct Findings(Vec<Finding>);

impl Findings {
    /// Looks whether a duty is kept; `what` is wrong if not.
    pub fn check(&mut self, line: usize, duty: Duty, is_kept: bool, what: impl FnOnce() -> String) {
        if is_kept {
            return;
        }
        match self.0.iter_mut().find(|it| it.duty == duty) {
            Some(before) => before.more += 1,
            None => self.0.push(Finding { duty, line, what: what(), more: 0 }),
        }
    }

    /// What the manual forbids and [`mufasa::monitor::Monitor::new`] accepts.
    pub(super) fn check_made(&mut self, line: usize, profile: Profile, check_time_ns: u64) {
        let is_hardened = profile == Profile::HARDENED;
        self.check(line, Duty::Settings, is_hardened, || "the profile is not hardened".to_owned());
        let ends = check_time_ns < i64::MAX.unsigned_abs();
        self.check(line, Duty::CheckTime, ends, || "a check may take any time".to_owned());
    }

    /// The duties that are broken, with the first line of each.
    pub fn broken(&self) -> Vec<(Duty, usize)> {
        self.0.iter().map(|it| (it.duty, it.line)).collect()
    }

    /// In words, for a log of this name.
    pub fn text(&self, file: &str) -> String {
        let text = |it: &Finding| {
            let [duty, act] = it.duty.text();
            let more =
                if it.more > 0 { format!(" (and {} times more)", it.more) } else { String::new() };
            format!("{file}:{}: {duty} {}{more}\n    {act}.\n", it.line, it.what)
        };
        self.0.iter().map(text).collect()
    }
}
