//! Where claims come from: each source lists its lines, and asks the engines that judge them.

mod exploration;
mod harnesses;
mod solvers;

use std::io;

use indicatif::ProgressBar;
use mufasa_mutants::Engine;

use super::claim::Claim;
use super::settings::Settings;

/// A source of claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimSource {
    /// Theorems over the reals about the model's source.
    Theorems,
    /// Every reachable state of the protocol within small bounds.
    Exploration,
    /// Harnesses of the implementation: compiled code, the stand-in for Kani.
    Harnesses,
}

impl ClaimSource {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Theorems, Self::Exploration, Self::Harnesses];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theorems => "z3",
            Self::Exploration => "exploration",
            Self::Harnesses => "harnesses",
        }
    }

    /// Its claims, of which nothing was asked yet. Errors are those of reading the lists of them.
    pub fn claims(self) -> io::Result<Vec<Claim>> {
        let (engines, mut lines): (&[Engine], _) = match self {
            Self::Theorems => (&[Engine::Z3], solvers::theorems()),
            Self::Exploration => (&[Engine::Exploration], exploration::claims()),
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

    /// Whether one of these names means the claim; all are wanted where there are none.
    pub fn is_wanted(self, names: &[String], claim: &Claim) -> bool {
        names.is_empty() || names.iter().any(|name| self.is_meant(name, claim))
    }

    /// The claims that are wanted, judged. Errors are those of talking to the engines.
    pub fn lines(
        self,
        settings: &Settings,
        is_wanted: &impl Fn(Self, &Claim) -> bool,
        bar: &ProgressBar,
    ) -> io::Result<Vec<Claim>> {
        let claims = self.wanted(is_wanted)?;
        if claims.is_empty() {
            return Ok(claims);
        }
        bar.set_length(u64::try_from(claims.len()).unwrap_or(u64::MAX));
        let lines = match self {
            Self::Theorems => solvers::judge(claims, bar),
            Self::Exploration => Ok(exploration::judge(claims, bar)),
            Self::Harnesses => harnesses::judge(claims, settings, bar),
        };
        bar.finish_and_clear();
        lines
    }

    fn wanted(self, is_wanted: &impl Fn(Self, &Claim) -> bool) -> io::Result<Vec<Claim>> {
        Ok(self.claims()?.into_iter().filter(|claim| is_wanted(self, claim)).collect())
    }
}

/// An engine that is not here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The engine.
    pub engine: &'static str,
    /// How many of the claims that are wanted nothing else proves.
    pub claims: usize,
    /// Where it comes from.
    pub package: &'static str,
}

/// The engines that are wanted and not here. Errors are those of reading the lists of claims, and what
/// `scripts/prove-wasm` wrote.
pub fn missing(
    settings: &Settings,
    is_wanted: &impl Fn(ClaimSource, &Claim) -> bool,
) -> io::Result<Vec<Missing>> {
    let mut missing = Vec::new();
    for source in ClaimSource::ALL {
        let wanted = source.wanted(is_wanted)?;
        let (claims, engine, package) = match source {
            ClaimSource::Exploration => continue,
            ClaimSource::Harnesses => {
                let claims = harnesses::not_compiled(&wanted, settings)?;
                (claims, harnesses::COMPILED, harnesses::PACKAGE)
            }
            ClaimSource::Theorems => {
                let claims = if solvers::is_here() { 0 } else { wanted.len() };
                (claims, source.name(), solvers::PACKAGE)
            }
        };
        if claims > 0 {
            missing.push(Missing { engine, claims, package });
        }
    }
    Ok(missing)
}
