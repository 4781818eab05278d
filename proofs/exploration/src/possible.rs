//! What may happen next in a state of the system.

use mufasa_model::offloading::requester::Group;

use super::fit::fitted;
use super::moves::Move;
use super::state::{Kind, State};
use super::stimulus::{Named, Stimulus};
use super::system::System;

impl System {
    /// Everything that may happen in a state, in a fixed order: what people look for first comes
    /// first, so that it is what shortest traces show.
    pub fn moves(&self, state: &State, out: &mut Vec<Move>) {
        out.push(Move::TimePasses);
        let letters = || state.flight.iter().filter_map(|it| it.letter().map(|l| (*it, l)));
        for (message, _) in letters() {
            out.push(Move::Deliver { message, kept: false });
        }
        for cav in 0..self.world().requesters {
            self.events(state, cav, out);
            for group in Group::ALL {
                let running = self.cav(state, cav).groups[group as usize].remote();
                if running.is_some() && self.world().has_network() {
                    out.push(Move::Alive { cav: fitted(cav), group });
                }
            }
        }
        for (message, letter) in letters() {
            out.push(Move::Deliver { message, kept: true });
            if letter.kind == Kind::Request {
                out.push(Move::Refuse { message });
            }
            out.push(Move::Lose { message });
        }
        for (station, memory) in state.stations.iter().enumerate() {
            if memory.runs.iter().flatten().any(|session| *session > 0) {
                out.push(Move::Crash { station: fitted(station) });
            }
        }
    }

    /// The events at one CAV that are no messages from flight.
    fn events(&self, state: &State, cav: usize, out: &mut Vec<Move>) {
        let id = state.cavs[cav].id;
        for (place, stimulus) in self.requesters().stimuli().iter().enumerate() {
            let possible = || self.requesters().react(id, place).is_some();
            let may = match *stimulus {
                Stimulus::TimePasses => false,
                Stimulus::Confirm(_) | Stimulus::Reject(_) => self.world().attacker,
                Stimulus::Data(named, age) => {
                    self.world().attacker || (age >= 0 && self.is_run(state, cav, named))
                }
                _ => true,
            };
            if !may || !possible() {
                continue;
            }
            let event = |rank| Move::Event { cav: fitted(cav), place: fitted(place), rank };
            out.push(event(None));
            if let Stimulus::Confirm(named @ Named { current: false, .. }) = *stimulus {
                out.extend(ended(state, cav, named).map(|rank| event(Some(rank))));
            }
        }
    }

    /// Whether the station runs the current session of the CAV.
    fn is_run(&self, state: &State, cav: usize, named: Named) -> bool {
        let station = state.stations.get(usize::from(named.station) - 1);
        let runs = station.map_or(0, |it| it.runs[cav][named.group as usize]);
        let partner = self.cav(state, cav).groups[named.group as usize].partner();
        named.current && runs == 1 && partner == Some(named.station)
    }
}

/// Ranks of the ended sessions that the station or a message to or from it remembers.
fn ended(state: &State, cav: usize, named: Named) -> impl Iterator<Item = u8> {
    let group = named.group as usize;
    let station = usize::from(named.station) - 1;
    let mut ranks = 0_u8;
    if let Some(runs) = state.stations.get(station).map(|it| it.runs[cav][group]) {
        ranks |= 1 << runs >> 1;
    }
    for letter in state.flight.iter().filter_map(|message| message.letter()) {
        if (letter.cav, letter.group, letter.station) == (cav, group, station) {
            ranks |= 1 << letter.rank;
        }
    }
    (1..8).filter(move |rank| ranks >> rank & 1 == 1)
}
