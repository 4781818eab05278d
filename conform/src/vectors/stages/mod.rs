//! Vectors of `spec/3-stages.md`, one file per heading.

pub mod collision;
mod detections;
mod distances;
pub mod grid;
mod input;
pub mod map_validation;
pub mod schedule;
pub mod track_validation;
pub mod tracks;

use crate::vectors::book::Book;

/// Adds them.
pub fn add(book: &mut Book) {
    schedule::add(book);
    distances::add(book);
    track_validation::add(book);
    map_validation::add(book);
    collision::add(book);
    tracks::add(book);
    detections::add(book);
    grid::add(book);
    input::add(book);
}
