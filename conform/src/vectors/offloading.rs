//! Vectors of `spec/2-offloading.md`, one file per heading, and of H-08.

mod fallback;
mod quality_of_service;
mod requester;

use mufasa_model::offloading::requester::Parameters;

use crate::vectors::book::{Book, Topic};
use crate::vectors::expected::after;
use crate::vectors::story::Story;

/// Adds them.
pub fn add(book: &mut Book) {
    requester::add(book);
    quality_of_service::add(book);
    fallback::add(book);
}

/// What the author says about the last event: states of MOT and PLAN, hold, actions.
type Told<'a> = ([&'a str; 2], Option<i64>, &'a [&'a str]);

/// Both groups are local.
const LOCAL: [&str; 2] = ["local", "local"];

fn tell(book: &mut Book, topic: Topic, (name, note): (&str, &str), story: &Story, told: Told<'_>) {
    let (states, hold, actions) = told;
    let expected = after(story.len(), states, hold, actions);
    book.trace(topic, name, note, story.trace(), &expected);
}

/// The default parameters with the switch of I-09.
pub fn with_qos_hold(qos_hold: bool) -> Parameters {
    Parameters { qos_hold, ..Parameters::default() }
}
