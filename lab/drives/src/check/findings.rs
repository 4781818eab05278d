//! What a run found, and the exit code for it.

use super::checked::Checked;
use super::tally::Tally;
use crate::counted;

/// What a run found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    /// Drives checked.
    pub drives: usize,
    /// Drives that could not be read, or pictures that could not be written.
    pub unreadable: usize,
    /// The model's counts over all drives.
    pub tally: Tally,
    /// Breaches of conformance.
    pub disagreements: usize,
    /// Fallbacks that the model's requester started.
    pub fallbacks: usize,
    /// Cycles whose remote data the model's requester used.
    pub offloaded: usize,
    /// Elements too late and silences that ended offloading without an unsafe cycle.
    pub lost: usize,
    /// Pictures written.
    pub pictures: usize,
    /// What limits of the quality of service the first drive that lost offloading exceeds.
    pub note: Option<String>,
    /// How many drives exceed one.
    pub noted: usize,
}

impl Findings {
    /// 0 all safe, 1 some cycle unsafe or offloading lost to late data or silence, 2 bad input,
    /// 3 model and implementation disagree; the highest that applies.
    pub fn exit_code(&self) -> u8 {
        if self.disagreements > 0 {
            3
        } else if self.unreadable > 0 || self.tally.errors > 0 {
            2
        } else {
            u8::from(self.tally.unsafe_cycles() > 0 || self.lost > 0)
        }
    }

    /// Adds what was found on a drive.
    pub fn add(&mut self, checked: &Checked) {
        self.drives += 1;
        self.tally.merge(&checked.tallies[0]);
        self.disagreements += checked.disagreements();
        let run = &checked.requesters[0];
        self.fallbacks += run.fallbacks;
        self.offloaded += run.offloaded;
        self.lost += checked.lost();
        if let Some(note) = checked.notes.first() {
            self.noted += 1;
            self.note.get_or_insert_with(|| format!("{}: {note}", checked.drive.name));
        }
    }

    /// One sentence over the run.
    pub fn summary(&self) -> String {
        let Self {
            drives,
            unreadable,
            tally,
            disagreements,
            fallbacks,
            offloaded,
            lost,
            pictures,
            ..
        } = self;
        let agreement = match disagreements {
            // Of nothing there is nothing to agree on.
            0 if tally.cycles == 0 => String::new(),
            0 => "; model and implementation agree".to_owned(),
            count => format!("; model and implementation DISAGREE {}", counted(*count, "time")),
        };
        let cycles = || {
            format!(
                "{}, {}: {} safe, {} unsafe, {}, {offloaded} offloaded{agreement}",
                counted(*drives, "drive"),
                counted(tally.cycles, "cycle"),
                tally.safe,
                tally.unsafe_cycles(),
                counted(*fallbacks, "fallback"),
            )
        };
        let mut text = if *drives == 0 { "no drive".to_owned() } else { cycles() };
        for (count, what) in [
            (*lost, "time tracking or planning went back to local for late data or silence"),
            (tally.errors, "cycle with invalid local input"),
            (*unreadable, "file with something that could not be read or written"),
            (*pictures, "picture"),
        ] {
            if count > 0 {
                text.push_str("; ");
                text.push_str(&counted(count, what));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_finding_decides_the_exit_code() {
        let mut findings = Findings::default();
        assert_eq!(findings.exit_code(), 0);
        (findings.tally.cycles, findings.tally.safe) = (3, 2);
        assert_eq!(findings.exit_code(), 1);
        (findings.tally.safe, findings.lost) = (3, 1);
        assert_eq!(findings.exit_code(), 1);
        findings.unreadable = 1;
        assert_eq!(findings.exit_code(), 2);
        findings.unreadable = 0;
        (findings.tally.errors, findings.tally.cycles) = (1, 4);
        assert_eq!(findings.exit_code(), 2);
        findings.disagreements = 1;
        assert_eq!(findings.exit_code(), 3);
    }

    #[test]
    fn the_summary_counts() {
        let findings = Findings { drives: 1, unreadable: 2, ..Findings::default() };
        let text = findings.summary();
        assert!(
            text.starts_with("1 drive, 0 cycles: 0 safe, 0 unsafe, 0 fallbacks, 0 offloaded; "),
            "{text}"
        );
        assert!(
            text.ends_with("offloaded; 2 files with something that could not be read or written"),
            "{text}"
        );
        // And has no zeros where there was no drive.
        let text = Findings { unreadable: 1, ..Findings::default() }.summary();
        assert_eq!(text, "no drive; 1 file with something that could not be read or written");
    }
}
