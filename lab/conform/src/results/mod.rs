//! What was found: the summary, its files, and what is printed.

pub mod advice;
pub mod found;
pub mod junit;
pub mod report;
pub mod seeded;
pub mod summary;
