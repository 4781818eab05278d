//! The order in which a campaign, or a shard of it, asks: its vectors, then its cases.

use crate::cases::case::Case;
use crate::cases::source::Source;
use crate::cases::vectors::Given;
use crate::judge::class::Kind;

/// What is asked, by its position: the vectors whose number leaves `first` when divided by `step`, then
/// such cases.
#[derive(Clone, Copy, Debug)]
pub struct Order<'a> {
    /// Where the cases come from.
    pub source: &'a Source,
    /// All vectors, those of other shards too.
    pub vectors: &'a [Given],
    /// How many cases, those of other shards too.
    pub cases: u64,
    /// The shard.
    pub first: u64,
    /// Of so many.
    pub step: u64,
}

impl Order<'_> {
    /// How many vectors are asked here.
    pub fn vectors_here(&self) -> u64 {
        self.here(self.vectors.len() as u64)
    }

    /// How many vectors and cases are asked here.
    pub fn len(&self) -> u64 {
        self.vectors_here().saturating_add(self.here(self.cases))
    }

    /// Whether there is a vector at this position.
    pub fn is_vector(&self, position: u64) -> bool {
        position < self.vectors_here()
    }

    /// The kind of record at this position.
    pub fn kind(&self, position: u64) -> Kind {
        match self.vector(position) {
            Some((_, given)) => given.question.kind(),
            None => self.source.kind(self.number(position)),
        }
    }

    /// The vector or case at this position.
    pub fn case(&self, position: u64) -> Case {
        if let Some((at, given)) = self.vector(position) {
            return Case::of_vector(given, at);
        }
        let number = self.number(position);
        Case::of_source(self.source, number, number.saturating_add(self.vectors.len() as u64))
    }

    fn here(&self, all: u64) -> u64 {
        all.saturating_sub(self.first).div_ceil(self.step)
    }

    fn vector(&self, position: u64) -> Option<(u64, &Given)> {
        let number = self.numbered(position);
        let given = usize::try_from(number).ok().and_then(|at| self.vectors.get(at));
        given.filter(|_| self.is_vector(position)).map(|given| (number, given))
    }

    fn number(&self, position: u64) -> u64 {
        self.numbered(position.saturating_sub(self.vectors_here()))
    }

    fn numbered(&self, position: u64) -> u64 {
        position.saturating_mul(self.step).saturating_add(self.first)
    }
}
