//! Offloading vectors of what was found (`spec/5-interfaces.md#vectors`).

use mufasa_exploration::replay::{Episode, What};
use mufasa_model::offloading::requester::Event;

use mufasa_conform::vectors::book::{Input, Vector};
use mufasa_conform::vectors::flag;
use mufasa_records::offloading_answer::OffloadingAnswer;
use mufasa_records::record::offloading::Offloading;
use mufasa_records::{Answer, Trace};

/// The events of one CAV in a story.
pub fn events(episodes: &[Episode], cav: usize) -> Vec<Event> {
    let at_cav = |episode: &Episode| match episode.what {
        What::AtCav { cav: at, event, .. } if at == cav => Some(event),
        _ => None,
    };
    episodes.iter().filter_map(at_cav).collect()
}

/// The vector of a trace, with the model's answer. Errors: the words do not fit into JSON, which
/// cannot be.
pub fn of_trace(
    id: &str,
    requirement: &'static str,
    note: &str,
    trace: &Trace,
) -> Result<Vector, serde_json::Error> {
    Ok(Vector {
        id: id.to_owned(),
        requirement,
        flag: flag::of_trace(trace),
        note: note.to_owned(),
        input: Input::Record(serde_json::to_string(&Offloading::whole(id, trace))?),
        expect: Answer::Offloading(OffloadingAnswer::run(id.to_owned(), trace)),
    })
}
