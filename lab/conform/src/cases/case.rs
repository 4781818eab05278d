//! One thing that is asked: a vector, or a case of the source.

use crate::cases::question::Question;
use crate::cases::source::Source;
use crate::cases::vectors::Given;

/// A vector or case.
#[derive(Debug)]
pub struct Case {
    /// Its place among all vectors and cases of all shards.
    pub at: u64,
    /// Its number; vectors have none.
    pub number: Option<u64>,
    /// Its name; a vector's id.
    pub name: String,
    /// What a vector is about; empty for a case.
    pub about: String,
    /// What is asked.
    pub question: Question,
}

impl Case {
    /// A case of the source.
    pub fn of_source(source: &Source, number: u64, at: u64) -> Self {
        let (name, question) = source.case(number);
        Self { at, number: Some(number), name, about: String::new(), question }
    }

    /// A vector.
    pub fn of_vector(vector: &Given, at: u64) -> Self {
        let Given { id, about, question } = vector.clone();
        Self { at, number: None, name: id, about, question }
    }
}
