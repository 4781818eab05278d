//! Messages in flight, and the ranks of the sessions that they and the stations name.

use super::fit::fitted;
use super::state::{Letter, Message, State};

/// Takes a message out of flight, or a copy of it.
pub(crate) fn take(state: &mut State, message: Message, kept: bool) -> Option<Letter> {
    let place = state.flight.iter_mut().find(|place| **place == message)?;
    let letter = message.letter()?;
    if !kept {
        *place = Message::default();
    }
    Some(letter)
}

/// What was the current session of a CAV, group and station becomes the newest ended one.
pub(crate) fn end_session(state: &mut State, cav: usize, group: usize, station: usize) {
    if let Some(memory) = state.stations.get_mut(station)
        && memory.runs[cav][group] > 0
    {
        memory.runs[cav][group] += 1;
    }
    for message in &mut state.flight {
        if let Some(letter) = message.letter()
            && (letter.cav, letter.group, letter.station) == (cav, group, station)
        {
            *message = Message::new(Letter { rank: letter.rank + 1, ..letter });
        }
    }
}

/// Closes the gaps between the ranks of ended sessions, and sorts the messages.
pub(crate) fn tidy(state: &mut State) {
    const PLACES: usize = 16;
    let place = |cav: usize, group: usize, station: usize| (cav * 2 + group) * 4 + station;
    let mut known = [0_u8; PLACES];
    for (station, memory) in state.stations.iter().enumerate() {
        for cav in 0..memory.runs.len() {
            for group in 0..2 {
                if memory.runs[cav][group] > 0 {
                    known[place(cav, group, station)] |= 1 << (memory.runs[cav][group] - 1);
                }
            }
        }
    }
    for letter in state.flight.iter().filter_map(|message| message.letter()) {
        known[place(letter.cav, letter.group, letter.station)] |= 1 << letter.rank;
    }
    // The rank of an ended session is one more than the number of newer ended ones.
    let closed = |ranks: u8, rank: u8| {
        let newer = ranks & ((1 << rank) - 1) & !1;
        if rank == 0 { 0 } else { 1 + fitted::<_, u8>(newer.count_ones()) }
    };
    for (station, memory) in state.stations.iter_mut().enumerate() {
        for cav in 0..memory.runs.len() {
            for group in 0..2 {
                if let Some(rank) = memory.runs[cav][group].checked_sub(1) {
                    memory.runs[cav][group] = closed(known[place(cav, group, station)], rank) + 1;
                }
            }
        }
    }
    for message in &mut state.flight {
        if let Some(letter) = message.letter() {
            let ranks = known[place(letter.cav, letter.group, letter.station)];
            *message = Message::new(Letter { rank: closed(ranks, letter.rank), ..letter });
        }
    }
    state.flight.sort_unstable_by(|one, other| other.cmp(one));
}
