//! A story of the exploration as a message sequence chart: Markdown with a diagram of Mermaid, which many viewers of
//! Markdown draw.

use mufasa_exploration::replay::{Episode, Look, Post, What};
use mufasa_exploration::system::System;
use mufasa_exploration::words;
use mufasa_model::offloading::requester::{Action, EventKind, Group, GroupState, Groups};

/// The chart of a story: CAVs, stations and, where it forges, the attacker. A message is drawn when it arrives, or is
/// lost; the note at its sender says when it was sent.
pub fn draw(system: &System, title: &str, subtitle: &str, episodes: &[Episode]) -> String {
    let world = system.world();
    let mut teller = Teller {
        system,
        flight: Vec::new(),
        used: vec![[false; 2]; world.requesters],
        states: vec![[""; 2]; world.requesters],
        lines: Vec::new(),
    };
    let names = (0..world.requesters).map(|cav| system.cav_name(cav));
    for name in names.chain((1..=world.stations.len()).map(|id| format!("station {id}"))) {
        teller.lines.push(format!("participant {name}"));
    }
    episodes.iter().for_each(|episode| teller.tell(episode));
    // What is still on its way arrives nowhere.
    for post in std::mem::take(&mut teller.flight) {
        teller.message(post, "-x");
    }
    let diagram = teller.lines.join("\n    ");
    format!("# {title}\n\n{subtitle}.\n\n```mermaid\nsequenceDiagram\n    {diagram}\n```\n")
}

struct Teller<'s> {
    system: &'s System,
    /// Messages that have not arrived.
    flight: Vec<Post>,
    /// By CAV and group: whether a result of the running session was used.
    used: Vec<[bool; 2]>,
    /// By CAV and group: what was last said of it.
    states: Vec<[&'static str; 2]>,
    lines: Vec<String>,
}

impl Teller<'_> {
    fn tell(&mut self, episode: &Episode) {
        match episode.what {
            What::Time => {
                let last = self.system.world().stations.len();
                let ends = format!("{},station {last}", self.system.cav_name(0));
                self.note(&ends, &format!("{} ticks", episode.t_ns));
            }
            What::Lost(post) => self.message(post, "-x"),
            What::Crash { station } => {
                self.note(&format!("station {station}"), "crashes and returns");
            }
            What::Alive { .. } => {}
            What::AtCav { cav, event, post: None } => self.event(cav, event.kind),
            What::AtStation(post) | What::AtCav { post: Some(post), .. } => {
                self.message(post, "->>");
            }
        }
        if let What::AtCav { cav, event, .. } = episode.what {
            let actions: Vec<_> = episode.actions.iter().map(in_words).collect();
            if !actions.is_empty() {
                self.note(&self.system.cav_name(cav), &actions.join(", "));
            }
            if let EventKind::Data { group, .. } = event.kind {
                self.used[cav][group as usize] |= !episode.actions.contains(&Action::Drop(group));
            }
        }
        self.flight.extend(&episode.sent);
        episode.lost.iter().for_each(|post| self.message(*post, "-x"));
        episode.cavs.iter().enumerate().for_each(|(cav, look)| self.states(cav, look));
    }

    fn message(&mut self, post: Post, arrow: &str) {
        if let Some(at) = self.flight.iter().position(|it| *it == post) {
            self.flight.remove(at);
        }
        let ends = [self.system.cav_name(post.cav), format!("station {}", post.station)];
        let [from, to] = if post.kind.is_to_station() { [0, 1] } else { [1, 0] };
        let (kind, group) = (words::kind(post.kind), words::name(post.group));
        let line = format!("{}{arrow}{}: {kind} {group} {}", ends[from], ends[to], post.session);
        self.lines.push(line);
    }

    /// What comes to a CAV without the network. Results always come like this; confirmations and rejections are forged.
    fn event(&mut self, cav: usize, kind: EventKind) {
        let to = self.system.cav_name(cav);
        let answer = |what: &str, group: Group, session: i64, station: i64| {
            let name = words::name(group);
            format!("attacker-->>{to}: forged {what} {name} {session} of station {station}")
        };
        let from = |station: i64, text: String| format!("station {station}->>{to}: {text}");
        let line = match kind {
            EventKind::Offer { station, groups } => from(station, format!("offer {}", set(groups))),
            EventKind::Withdraw { station } => from(station, "withdrawal".to_owned()),
            EventKind::Confirm { station, group, session } => {
                answer("confirmation", group, session, station)
            }
            EventKind::Reject { station, group, session } => {
                answer("rejection", group, session, station)
            }
            EventKind::Data { station, group, session, generated_ns } => {
                let name = words::name(group);
                from(station, format!("result {name} {session} of {generated_ns} ticks"))
            }
            EventKind::Lost { station } => {
                return self.note(&to, &format!("station {station} is lost"));
            }
            EventKind::Area { groups } => {
                return self.note(&to, &format!("area of {}", set(groups)));
            }
            EventKind::Tick => return self.note(&to, "tick"),
            EventKind::Verdict { safe, sessions } => {
                let verdict = if safe { "safe" } else { "unsafe" };
                let used = Group::ALL.into_iter().filter(|it| sessions.of(*it).is_some());
                let used = set(used.collect());
                return self.note(&to, &format!("{verdict} cycle with {used}"));
            }
        };
        self.lines.push(line);
    }

    /// Notes in which state a CAV is, where that is new.
    fn states(&mut self, cav: usize, look: &Look) {
        for group in self.system.world().groups() {
            let at = group as usize;
            let used = &mut self.used[cav][at];
            let state = match (look.groups[at], look.computes[at]) {
                (GroupState::Local, _) => "local",
                (GroupState::Requested { .. }, _) => "requested, local services compute",
                (GroupState::Remote { .. }, true) => "remote, local services compute too",
                (GroupState::Remote { .. }, false) if *used => "remote",
                (GroupState::Remote { .. }, false) => "NO RESULT FROM ANYWHERE",
            };
            *used &= matches!(look.groups[at], GroupState::Remote { .. });
            if std::mem::replace(&mut self.states[cav][at], state) != state {
                self.note(&self.system.cav_name(cav), &format!("{}: {state}", words::name(group)));
            }
        }
    }

    fn note(&mut self, over: &str, text: &str) {
        self.lines.push(format!("Note over {over}: {text}"));
    }
}

fn in_words(action: &Action) -> String {
    match *action {
        Action::Activate(group) => format!("local {} starts", words::name(group)),
        Action::Deactivate(group) => format!("local {} stops", words::name(group)),
        Action::Drop(group) => format!("{} result dropped", words::name(group)),
        Action::Request { group, .. } => format!("requests {}", words::name(group)),
        Action::Release { group, .. } => format!("releases {}", words::name(group)),
    }
}

fn set(groups: Groups) -> String {
    let names: Vec<_> =
        Group::ALL.into_iter().filter(|group| groups.contains(*group)).map(words::name).collect();
    if names.is_empty() { String::from("nothing") } else { names.join(" and ") }
}
