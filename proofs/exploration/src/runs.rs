//! The endless runs of which the "eventually" properties speak, and what they have to come to.
//!
//! * A **calm** run is one without faults (PROTO-04):
//!   offers and areas stay, every message arrives once, in any order and before time passes, no
//!   cycle is unsafe, running sessions deliver in time. Each station keeps to one [`Manner`].
//!   It may start in every reachable state, with whatever network, attacker and crashes left.
//! * A **quiet** run is one in which stations hear what is still in flight once or never, and
//!   time passes when nothing is in flight; CAVs tick or do not.

use mufasa_model::offloading::requester::Group;

use super::fit::fitted;
use super::lasso::{Aim, Leap};
use super::moves::Move;
use super::state::{Kind, Message, State};
use super::stimulus::{Named, Stimulus};
use super::system::System;

/// What a station does with requests, for ever.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// It confirms when it has capacity.
    Confirms,
    /// It rejects.
    Rejects,
    /// It does not answer.
    Silent,
}

/// Every choice of manners for the stations of a system in which somebody confirms.
pub fn manners(system: &System) -> Vec<Vec<Manner>> {
    let all = [Manner::Confirms, Manner::Rejects, Manner::Silent];
    let mut choices = vec![Vec::new()];
    for _ in system.world().stations {
        choices = choices
            .iter()
            .flat_map(|choice| all.map(|manner| [choice.as_slice(), &[manner]].concat()))
            .collect();
    }
    choices.retain(|choice| choice.contains(&Manner::Confirms));
    choices
}

/// Steps of calm runs from a state.
pub fn calm(system: &System, manners: &[Manner], packed: u128, out: &mut Vec<Leap>) {
    let state = system.layout().unpack(packed);
    for message in in_flight(&state) {
        let Some(letter) = message.letter() else { continue };
        let by = match (letter.kind, manners[letter.station]) {
            (Kind::Request, Manner::Rejects) => Move::Refuse { message },
            (Kind::Request, Manner::Silent) => Move::Lose { message },
            _ => Move::Deliver { message, kept: false },
        };
        out.extend(leap(system, &state, &mut |walk| walk.go(by)));
    }
    if out.is_empty() {
        out.extend(leap(system, &state, &mut |walk| {
            walk.go(Move::TimePasses)?;
            for cav in 0..system.world().requesters {
                for group in Group::ALL {
                    walk.session_works(cav, group)?;
                }
            }
            walk.tick()
        }));
    }
}

/// In calm runs: a group that somebody who confirms offers here has to become remote, on a
/// station that does run it. That the CAV believes so is not enough.
pub fn offloaded(
    system: &System,
    manners: &[Manner],
    (place, group): (usize, Group),
    packed: u128,
) -> Aim {
    let state = system.layout().unpack(packed);
    let cav = system.cav(&state, place);
    let offered = cav.offers.iter().zip(manners);
    let offered = offered
        .into_iter()
        .any(|(offer, manner)| offer.contains(group) && *manner == Manner::Confirms);
    if cav.groups[group as usize].remote().is_some_and(|it| runs(&state, it, place, group)) {
        Aim::Reached
    } else if offered && cav.area.contains(group) {
        Aim::Ahead
    } else {
        Aim::Elsewhere
    }
}

/// Steps of quiet runs from a state.
pub fn quiet(system: &System, packed: u128, out: &mut Vec<Leap>) {
    let state = system.layout().unpack(packed);
    for message in in_flight(&state) {
        for by in [Move::Deliver { message, kept: false }, Move::Lose { message }] {
            out.extend(leap(system, &state, &mut |walk| walk.go(by)));
        }
    }
    if out.is_empty() {
        out.extend(leap(system, &state, &mut |walk| walk.go(Move::TimePasses)));
        out.extend(leap(system, &state, &mut |walk| {
            walk.go(Move::TimePasses)?;
            walk.tick()
        }));
    }
}

/// In quiet runs: a session that a station runs and the CAV has left has to end.
pub fn left_session_ended(
    system: &System,
    station: usize,
    cav: usize,
    group: Group,
    packed: u128,
) -> Aim {
    let state = system.layout().unpack(packed);
    match state.stations[station].runs[cav][group as usize] {
        0 | 1 => Aim::Reached,
        _ => Aim::Ahead,
    }
}

/// Whether a station runs the current session of a CAV and group.
fn runs(state: &State, station: u8, cav: usize, group: Group) -> bool {
    let station = state.stations.get(usize::from(station) - 1);
    station.is_some_and(|it| it.runs[cav][group as usize] == 1)
}

fn in_flight(state: &State) -> impl Iterator<Item = Message> {
    state.flight.into_iter().filter(|message| message.letter().is_some())
}

/// The moves that `go` makes, as one step.
fn leap(
    system: &System,
    state: &State,
    go: &mut dyn FnMut(&mut Walk<'_>) -> Option<()>,
) -> Option<Leap> {
    let mut walk = Walk { system, state: *state, moves: Vec::new() };
    go(&mut walk)?;
    Some(Leap { moves: walk.moves, to: system.layout().pack(&walk.state) })
}

/// Some moves one after the other.
struct Walk<'a> {
    system: &'a System,
    state: State,
    moves: Vec<Move>,
}

impl Walk<'_> {
    fn go(&mut self, by: Move) -> Option<()> {
        self.state = self.system.apply(&self.state, by)?.state;
        self.moves.push(by);
        Some(())
    }

    fn event(&mut self, cav: usize, stimulus: Stimulus) -> Option<()> {
        let place = self.system.requesters().place(&stimulus)?;
        self.go(Move::Event { cav: fitted(cav), place: fitted(place), rank: None })
    }

    fn tick(&mut self) -> Option<()> {
        (0..self.system.world().requesters).try_for_each(|cav| self.event(cav, Stimulus::Tick))
    }

    /// The CAV gives a sign of life to the station of a session, which delivers a result at once
    /// if it runs the session at all.
    fn session_works(&mut self, cav: usize, group: Group) -> Option<()> {
        let running = self.system.cav(&self.state, cav).groups[group as usize].remote();
        let Some(station) = running else { return Some(()) };
        self.go(Move::Alive { cav: fitted(cav), group })?;
        let alive = in_flight(&self.state).next()?;
        self.go(Move::Deliver { message: alive, kept: false })?;
        if !runs(&self.state, station, cav, group) {
            return Some(());
        }
        self.event(cav, Stimulus::Data(Named { station, group, current: true }, 0))
    }
}
