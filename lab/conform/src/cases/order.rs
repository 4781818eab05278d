//! The order in which a campaign asks: its vectors, then its cases.

use crate::cases::case::Case;
use crate::cases::source::Source;
use crate::cases::vectors::Given;
use crate::judge::class::Kind;

/// What is asked, by its position: the vectors, then the cases.
#[derive(Clone, Copy, Debug)]
pub struct Order<'a> {
    /// Where the cases come from.
    pub source: &'a Source,
    /// The vectors.
    pub vectors: &'a [Given],
    /// How many cases.
    pub cases: u64,
}

impl Order<'_> {
    /// How many vectors are asked.
    pub const fn vectors(&self) -> u64 {
        self.vectors.len() as u64
    }

    /// How many vectors and cases are asked.
    pub const fn len(&self) -> u64 {
        self.vectors().saturating_add(self.cases)
    }

    /// Whether there is a vector at this position.
    pub const fn is_vector(&self, position: u64) -> bool {
        position < self.vectors()
    }

    /// The kind of record at this position.
    pub fn kind(&self, position: u64) -> Kind {
        match self.vector(position) {
            Some(given) => given.question.kind(),
            None => self.source.kind(self.number(position)),
        }
    }

    /// The vector or case at this position.
    pub fn case(&self, position: u64) -> Case {
        match self.vector(position) {
            Some(given) => Case::of_vector(given, position),
            None => Case::of_source(self.source, self.number(position), position),
        }
    }

    fn vector(&self, position: u64) -> Option<&Given> {
        usize::try_from(position).ok().and_then(|at| self.vectors.get(at))
    }

    const fn number(&self, position: u64) -> u64 {
        position.saturating_sub(self.vectors())
    }
}
