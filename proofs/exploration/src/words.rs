//! States and moves in words.

use std::fmt::Write;

use mufasa_model::offloading::requester::{Group, Groups};

use super::cav::Use;
use super::moves::Move;
use super::state::{Kind, Letter, State};
use super::stimulus::{Named, Stimulus};
use super::system::System;

impl System {
    /// A move in words.
    pub fn words(&self, by: Move) -> String {
        match by {
            Move::TimePasses => String::from("time passes"),
            Move::Event { cav, place, rank } => {
                let stimulus = self.requesters().stimuli()[usize::from(place)];
                let whose = match rank {
                    Some(rank) => format!(" (ended session {rank})"),
                    None => String::new(),
                };
                format!("{}: {}{whose}", self.cav_name(cav.into()), words_of(stimulus))
            }
            Move::Deliver { message, kept: false } => {
                format!("arrives: {}", self.letter(message.letter()))
            }
            Move::Deliver { message, kept: true } => {
                format!("arrives, and will again: {}", self.letter(message.letter()))
            }
            Move::Refuse { message } => {
                format!("arrives and is refused: {}", self.letter(message.letter()))
            }
            Move::Lose { message } => format!("is lost: {}", self.letter(message.letter())),
            Move::Crash { station } => format!("station {} crashes and returns", station + 1),
            Move::Alive { cav, group } => {
                format!("{}: sign of life for {}", self.cav_name(cav.into()), name(group))
            }
        }
    }

    /// A state in words, one part a line.
    pub fn describe(&self, state: &State) -> String {
        let mut text = String::new();
        for cav in 0..self.world().requesters {
            let likeness = self.cav(state, cav);
            let [mot, plan] = likeness.groups.map(use_in_words);
            let _ = writeln!(text, "{}: MOT {mot}, PLAN {plan}", self.cav_name(cav));
            if let Some(left) = likeness.hold_left {
                let _ = writeln!(text, "  hold ends in {left} ticks");
            }
            for (station, offer) in (1..).zip(likeness.offers).take(self.world().stations.len()) {
                let _ = writeln!(text, "  station {station} offers {}", set(offer));
            }
            let _ = writeln!(text, "  area {}", set(likeness.area));
            let _ = writeln!(text, "  observed: {:?}", state.cavs[cav]);
        }
        for station in 0..self.world().stations.len() {
            for cav in 0..self.world().requesters {
                for group in Group::ALL {
                    let runs = state.stations[station].runs[cav][group as usize];
                    let age = self.station(state, station).ages[cav][group as usize];
                    if let (Some(rank), Some(age)) = (runs.checked_sub(1), age) {
                        let _ = writeln!(
                            text,
                            "station {} runs {} for {}, {}, heard {age} ticks ago",
                            station + 1,
                            name(group),
                            self.cav_name(cav),
                            session(rank)
                        );
                    }
                }
            }
        }
        for letter in state.flight.iter().filter_map(|message| message.letter()) {
            let _ = writeln!(text, "in flight: {}", self.letter(Some(letter)));
        }
        text
    }

    /// How the CAV is called.
    fn cav_name(&self, cav: usize) -> String {
        if self.world().requesters == 1 { String::from("CAV") } else { format!("CAV {}", cav + 1) }
    }

    fn letter(&self, letter: Option<Letter>) -> String {
        let Some(letter) = letter else { return String::from("nothing") };
        let (cav, station) = (self.cav_name(letter.cav), letter.station + 1);
        let what =
            format!("{} of {}, {}", kind(letter.kind), name(letter.group()), session(letter.rank));
        match letter.kind {
            Kind::Request | Kind::Release | Kind::Alive => {
                format!("{what}, from {cav} to station {station}")
            }
            Kind::Confirm | Kind::Reject => format!("{what}, from station {station} to {cav}"),
        }
    }
}

/// The name of a group.
fn name(group: Group) -> &'static str {
    match group {
        Group::Mot => "MOT",
        Group::Plan => "PLAN",
    }
}

/// What a message says.
fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Request => "request",
        Kind::Release => "release",
        Kind::Alive => "sign of life",
        Kind::Confirm => "confirmation",
        Kind::Reject => "rejection",
    }
}

fn set(groups: Groups) -> &'static str {
    match (groups.mot, groups.plan) {
        (false, false) => "nothing",
        (true, false) => "MOT",
        (false, true) => "PLAN",
        (true, true) => "MOT and PLAN",
    }
}

fn session(rank: u8) -> String {
    if rank == 0 { String::from("current session") } else { format!("ended session {rank}") }
}

fn named(named: Named) -> String {
    let whose = if named.current { "current" } else { "another" };
    format!("of {} from station {}, {whose} session", name(named.group), named.station)
}

fn words_of(stimulus: Stimulus) -> String {
    match stimulus {
        Stimulus::TimePasses => String::from("time passes"),
        Stimulus::Tick => String::from("tick"),
        Stimulus::Offer(station, groups) => format!("station {station} offers {}", set(groups)),
        Stimulus::Withdraw(station) => format!("station {station} withdraws"),
        Stimulus::Lost(station) => format!("station {station} is lost"),
        Stimulus::Area(groups) => format!("area of {}", set(groups)),
        Stimulus::Verdict { safe: true, groups, current: true } => {
            format!("safe cycle with {}", set(groups))
        }
        Stimulus::Verdict { safe: true, groups, current: false } => {
            format!("safe cycle with {} of other sessions", set(groups))
        }
        Stimulus::Verdict { safe: false, .. } => String::from("unsafe cycle"),
        Stimulus::Confirm(it) => format!("forged confirmation {}", named(it)),
        Stimulus::Reject(it) => format!("forged rejection {}", named(it)),
        Stimulus::Data(it, age) => format!("result {}, generated {age} ticks ago", named(it)),
    }
}

fn use_in_words(it: Use) -> String {
    match it {
        Use::Local => String::from("local"),
        Use::Requested { station, left } => {
            format!("requested from station {station}, {left} ticks left")
        }
        Use::Remote { station, silent, used, local_computes } => {
            let used = used.map_or(String::from("none used"), |age| format!("last of age {age}"));
            let beside = if local_computes { ", local services beside it" } else { "" };
            format!("remote on station {station}, silent for {silent} ticks, {used}{beside}")
        }
    }
}
