//! The laws run over complete finite domains of natively compiled code, which proves them of these
//! domains. `laws.toml` beside `src` says what each claims.

pub mod requester;
pub mod schedule;

use std::collections::BTreeMap;
use std::string::String;
use std::vec::Vec;

use crate::caught::catch;

/// Laws that are judged by the same run.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Its module of `law`.
    pub name: &'static str,
    /// Of what every case is run, and what is not covered.
    pub domain: &'static str,
    /// Names of its laws.
    laws: fn() -> Vec<&'static str>,
    /// Runs every case.
    run: fn() -> Run,
}

impl Topic {
    /// Names of its laws.
    pub fn laws(&self) -> impl Iterator<Item = &'static str> + use<> {
        (self.laws)().into_iter()
    }

    /// Runs every case. Errors are panics: nothing is known of any law then.
    pub fn run(&self) -> Result<Run, String> {
        catch(self.run)
    }
}

/// All topics.
pub const TOPICS: [Topic; 2] = [requester::TOPIC, schedule::TOPIC];

/// What a complete run found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Cases run.
    pub cases: u64,
    /// Every law, with the first case that breaks it.
    pub laws: BTreeMap<&'static str, Option<String>>,
    /// What has to occur, or the laws would hold of too little; and how often it did.
    pub reached: BTreeMap<&'static str, u64>,
}

impl Run {
    /// What has to occur and never did.
    pub fn missed(&self) -> Vec<&'static str> {
        let never = self.reached.iter().filter(|&(_, &count)| count == 0);
        never.map(|(&what, _)| what).collect()
    }

    fn note(&mut self, law: &'static str, holds: bool, case: impl FnOnce() -> String) {
        let broken = self.laws.entry(law).or_default();
        if !holds && broken.is_none() {
            *broken = Some(case());
        }
    }

    fn reach(&mut self, what: &'static str, seen: bool) {
        *self.reached.entry(what).or_default() += u64::from(seen);
    }
}
