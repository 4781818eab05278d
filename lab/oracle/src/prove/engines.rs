//! Where claims come from: each source lists its lines, and asks the engines that judge them.

mod doubles;
mod exploration;
mod gappa;
mod harnesses;
mod laws;
mod theorems;

use std::collections::BTreeMap;
use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::ProgressBar;
use mufasa_mutants::Engine;

use super::claim::Claim;
use super::settings::Settings;

/// A source of claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimSource {
    /// Theorems over the reals about the model's source.
    Theorems,
    /// Rounding errors.
    Gappa,
    /// Ranges of what is computed in doubles.
    Doubles,
    /// Every reachable state of the protocol within small bounds.
    Exploration,
    /// Laws of the implementation over complete finite domains.
    Laws,
    /// Harnesses of the implementation: compiled code, the stand-in for Kani.
    Harnesses,
}

impl ClaimSource {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Theorems,
        Self::Gappa,
        Self::Doubles,
        Self::Exploration,
        Self::Laws,
        Self::Harnesses,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theorems => "z3",
            Self::Gappa => "gappa",
            Self::Doubles => "bitwuzla",
            Self::Exploration => "exploration",
            Self::Laws => "laws",
            Self::Harnesses => "harnesses",
        }
    }

    /// Its claims, of which nothing was asked yet. Errors are those of reading the lists of them.
    pub fn claims(self) -> io::Result<Vec<Claim>> {
        let (engines, mut lines): (&[Engine], _) = match self {
            Self::Theorems => (&[Engine::Z3], theorems::claims()),
            Self::Gappa => (&[Engine::Gappa], gappa::claims()),
            Self::Doubles => (&[Engine::Bitwuzla], doubles::claims()),
            Self::Exploration => (&[Engine::Exploration], exploration::claims()),
            Self::Laws => (&[Engine::Laws], laws::claims()?),
            Self::Harnesses => (&[Engine::Harnesses, Engine::Cbmc], harnesses::claims()?),
        };
        let mutants = mufasa_mutants::all().map_err(io::Error::other)?;
        for line in &mut lines {
            let changes = mufasa_mutants::changes(&mutants, engines, &line.id);
            line.mutants = changes.into_iter().map(|mutant| mutant.change.clone()).collect();
        }
        Ok(lines)
    }

    /// Whether a name means this claim: it is that of its source or engine, or in its id, with blanks as
    /// the table prints it or without.
    pub fn is_meant(self, name: &str, claim: &Claim) -> bool {
        [self.name(), claim.answer.engine].contains(&name)
            || claim.id.contains(&name.replace(' ', "_"))
    }

    /// The claims that are wanted, judged. Errors are those of talking to the engines.
    pub fn lines(self, settings: &Settings, bar: &ProgressBar) -> io::Result<Vec<Claim>> {
        let names = &settings.names;
        let is_wanted =
            |line: &Claim| names.is_empty() || names.iter().any(|name| self.is_meant(name, line));
        let claims: Vec<Claim> = self.claims()?.into_iter().filter(is_wanted).collect();
        if claims.is_empty() {
            return Ok(claims);
        }
        bar.set_length(u64::try_from(claims.len()).unwrap_or(u64::MAX));
        let lines = match self {
            Self::Theorems => theorems::judge(claims, bar),
            Self::Gappa => gappa::judge(claims, bar),
            Self::Doubles => doubles::judge(claims, bar),
            Self::Exploration => Ok(exploration::judge(claims, bar)),
            Self::Laws => Ok(laws::judge(claims, bar)),
            Self::Harnesses => harnesses::judge(claims, settings, bar),
        };
        bar.finish_and_clear();
        lines
    }
}

/// Applies `f` to every item, in as many threads as there are processors; results in order.
fn side_by_side<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (next, results) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((place, item)) = {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    items.get(place).map(|item| (place, item))
                } {
                    let result = f(item);
                    results.lock().expect("no thread panics with the lock").insert(place, result);
                }
            });
        }
    });
    results.into_inner().expect("no thread panics with the lock").into_values().collect()
}
