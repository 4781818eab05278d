//! A story of the exploration as a message sequence chart.

use mufasa_exploration::replay::{Episode, Look, Post, What};
use mufasa_exploration::system::System;
use mufasa_exploration::words;
use mufasa_model::offloading::requester::{Action, EventKind, Group, GroupState, Groups};

use mufasa_drives::pictures::sequence::{self, Arrow, Chart, Fate, Note, Partner, Span, State};

/// The chart of a story as an SVG document: CAVs, stations and, where there is one, the attacker.
pub fn draw(system: &System, title: &str, subtitle: &str, episodes: &[Episode]) -> String {
    let world = system.world();
    let bars: Vec<_> = world.groups().map(words::name).collect();
    let cavs =
        (0..world.requesters).map(|cav| Partner { name: system.cav_name(cav), bars: bars.clone() });
    let stations = (1..=world.stations.len())
        .map(|station| Partner { name: format!("station {station}"), bars: vec![] });
    let attacker = Partner { name: String::from("attacker"), bars: vec![] };
    let forged = world.attacker && episodes.iter().any(is_forged);
    let mut teller = Teller {
        cavs: world.requesters,
        attacker: forged.then_some(world.requesters + world.stations.len()),
        groups: world.groups().collect(),
        flight: Vec::new(),
        used: vec![[false; 2]; world.requesters],
        chart: Chart {
            title: title.to_owned(),
            subtitle: subtitle.to_owned(),
            partners: cavs.chain(stations).chain(forged.then_some(attacker)).collect(),
            rows: episodes.len(),
            ..Chart::default()
        },
    };
    for (row, episode) in episodes.iter().enumerate() {
        teller.tell(row, episode);
    }
    teller.end();
    sequence::draw(&teller.chart)
}

/// Messages to a CAV that nobody sent through the network. Results always come like this; they
/// are drawn as the station's.
fn is_forged(episode: &Episode) -> bool {
    let What::AtCav { event, post: None, .. } = episode.what else { return false };
    matches!(event.kind, EventKind::Confirm { .. } | EventKind::Reject { .. })
}

struct Teller {
    cavs: usize,
    /// The attacker's place, when there is one.
    attacker: Option<usize>,
    groups: Vec<Group>,
    /// Messages with the row in which they were sent, and whether they have arrived.
    flight: Vec<(Post, usize, bool)>,
    /// By CAV and group: whether a result of the running session was used.
    used: Vec<[bool; 2]>,
    chart: Chart,
}

impl Teller {
    fn tell(&mut self, row: usize, episode: &Episode) {
        match episode.what {
            What::Time => self.chart.times.push((row, format!("{} ticks", episode.t_ns))),
            What::Lost(post) => {
                self.arrive(post, row, Fate::Lost);
                self.flight.retain(|(sent, ..)| *sent != post);
            }
            What::Crash { station } => {
                self.note(self.station(station), row, String::from("crashes and returns"));
            }
            What::Alive { .. } => {}
            What::AtCav { cav, event, post: None } => self.event(cav, row, event.kind),
            What::AtStation(post) | What::AtCav { post: Some(post), .. } => {
                self.arrive(post, row, Fate::Arrives);
            }
        }
        if let What::AtCav { cav, event, .. } = episode.what {
            self.actions(cav, row, &episode.actions);
            if let EventKind::Data { group, .. } = event.kind {
                self.used[cav][group as usize] |= !episode.actions.contains(&Action::Drop(group));
            }
        }
        for post in &episode.sent {
            self.flight.push((*post, row, false));
        }
        for post in &episode.lost {
            self.arrow(*post, (row, row), Fate::Lost);
        }
        for (cav, look) in episode.cavs.iter().enumerate() {
            self.states(cav, row, look);
        }
    }

    /// Messages that are still in flight end nowhere.
    fn end(&mut self) {
        let last = self.chart.rows.saturating_sub(1);
        for (post, row, arrived) in std::mem::take(&mut self.flight) {
            if !arrived {
                self.arrow(post, (row, last.max(row)), Fate::Lost);
            }
        }
    }

    fn arrive(&mut self, post: Post, row: usize, fate: Fate) {
        let sent = self.flight.iter_mut().find(|(it, ..)| *it == post);
        let from = sent.map_or(row, |(_, from, arrived)| {
            *arrived = true;
            *from
        });
        self.arrow(post, (from, row), fate);
    }

    fn arrow(&mut self, post: Post, (from, to): (usize, usize), fate: Fate) {
        let (cav, station) = (post.cav, self.station(post.station));
        if station >= self.chart.partners.len() {
            return;
        }
        let text =
            format!("{} {} #{}", words::kind(post.kind), words::name(post.group), post.session);
        let (from, to) = if post.kind.is_to_station() {
            ((cav, from), (station, to))
        } else {
            ((station, from), (cav, to))
        };
        self.chart.arrows.push(Arrow { from, to, text, fate });
    }

    /// What comes to a CAV without the network.
    fn event(&mut self, cav: usize, row: usize, kind: EventKind) {
        let (station, text) = match kind {
            EventKind::Offer { station, groups } => (station, format!("offer {}", set(groups))),
            EventKind::Withdraw { station } => (station, String::from("withdrawal")),
            EventKind::Confirm { station, group, session } => {
                (station, format!("confirmation {} #{session}", words::name(group)))
            }
            EventKind::Reject { station, group, session } => {
                (station, format!("rejection {} #{session}", words::name(group)))
            }
            EventKind::Data { station, group, session, generated_ns } => (
                station,
                format!("result {} #{session} of {generated_ns} ticks", words::name(group)),
            ),
            EventKind::Lost { station } => {
                return self.note(cav, row, format!("station {station} is lost"));
            }
            EventKind::Area { groups } => {
                return self.note(cav, row, format!("area of {}", set(groups)));
            }
            EventKind::Tick => return self.note(cav, row, String::from("tick")),
            EventKind::Verdict { safe, sessions } => {
                let verdict = if safe { "safe" } else { "unsafe" };
                let used = Group::ALL.into_iter().filter(|it| sessions.of(*it).is_some());
                return self.note(
                    cav,
                    row,
                    format!("{verdict} cycle with {}", set(used.collect())),
                );
            }
        };
        let forged = matches!(kind, EventKind::Confirm { .. } | EventKind::Reject { .. });
        let (from, fate, text) = match self.attacker {
            Some(attacker) if forged => {
                (attacker, Fate::Forged, format!("{text} as station {station}"))
            }
            _ => (self.station(station), Fate::Arrives, text),
        };
        let from = (from.min(self.chart.partners.len() - 1), row);
        self.chart.arrows.push(Arrow { from, to: (cav, row), text, fate });
    }

    fn actions(&mut self, cav: usize, row: usize, actions: &[Action]) {
        let words: Vec<_> = actions
            .iter()
            .filter_map(|action| match *action {
                Action::Activate(group) => Some(format!("local {} starts", words::name(group))),
                Action::Deactivate(group) => Some(format!("local {} stops", words::name(group))),
                Action::Drop(group) => Some(format!("{} result dropped", words::name(group))),
                Action::Request { .. } | Action::Release { .. } => None,
            })
            .collect();
        if !words.is_empty() {
            self.note(cav, row, words.join(", "));
        }
    }

    fn states(&mut self, cav: usize, row: usize, look: &Look) {
        for (bar, group) in self.groups.iter().enumerate() {
            let used = &mut self.used[cav][*group as usize];
            let state = match (look.groups[*group as usize], look.computes[*group as usize]) {
                (GroupState::Local, _) => State::Local,
                (GroupState::Requested { .. }, _) => State::Requested,
                (GroupState::Remote { .. }, true) => State::Both,
                (GroupState::Remote { .. }, false) if *used => State::Remote,
                (GroupState::Remote { .. }, false) => State::Gap,
            };
            *used &= matches!(look.groups[*group as usize], GroupState::Remote { .. });
            let goes_on = |span: &&mut Span| {
                (span.partner, span.bar, span.to + 1, span.state) == (cav, bar, row, state)
            };
            if let Some(span) = self.chart.spans.iter_mut().find(goes_on) {
                span.to = row;
            } else {
                self.chart.spans.push(Span { partner: cav, bar, from: row, to: row, state });
            }
        }
    }

    fn note(&mut self, partner: usize, row: usize, text: String) {
        // A row that says two things says them on one line.
        let notes = &mut self.chart.notes;
        match notes.iter_mut().find(|note| (note.partner, note.row) == (partner, row)) {
            Some(note) => note.text = format!("{}: {text}", note.text),
            None => notes.push(Note { partner, row, text }),
        }
    }

    /// The place of a station; of one that is not drawn it is out of range.
    fn station(&self, station: i64) -> usize {
        self.cavs + usize::try_from(station - 1).unwrap_or(usize::MAX - self.cavs)
    }
}

fn set(groups: Groups) -> String {
    let names: Vec<_> =
        Group::ALL.into_iter().filter(|group| groups.contains(*group)).map(words::name).collect();
    if names.is_empty() { String::from("nothing") } else { names.join(" and ") }
}
