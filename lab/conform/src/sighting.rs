//! What is kept of a class of disagreements while the campaign goes on; its records are made small at the end.

use crate::judge::examine::Examined;

/// A disagreement: where it was seen, and what came.
#[derive(Debug)]
pub struct Sighting {
    /// Its position in the order of the campaign.
    pub position: u64,
    /// The position of the first line that the same process was asked.
    pub begin: u64,
    /// What was answered, and what is right.
    pub examined: Examined,
}

/// The disagreements of a class.
#[derive(Debug, Default)]
pub struct Sightings {
    /// How many.
    pub count: u64,
    /// The vectors among them.
    pub vectors: Vec<String>,
    /// Number of the first case among them.
    pub first: Option<u64>,
    /// The first of them, at least one.
    pub earliest: Vec<Sighting>,
}
