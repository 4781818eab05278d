//! The states of a group at the requester, with arrows that the exact model takes.

use mufasa_model::input::profile::Profile;
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester, Sessions,
};

use crate::sheet::{Look, Pen, Sheet};

/// Height of the panel and of a row, px.
const HEIGHT: f64 = 648.0;
const ROW: f64 = 44.0;
/// Left and right edges of what is drawn, px.
const LOCAL: [f64; 2] = [10.0, 100.0];
const IN_USE: [f64; 2] = [470.0, 870.0];
const REQUESTED: [f64; 2] = [483.0, 579.0];
const REMOTE: [f64; 2] = [765.0, 855.0];

/// States before, state after, events (ms, word, ms of generation), words, requirements. Held: Local before hold_until.
const ARROWS: &str = "\
Local Held|Requested|10000 tick|tick: offered, in the area, not before hold_until|REQ-03, REQ-06
Requested|Remote|499 confirm|confirm before deadline|REQ-10
Requested|Local|2 reject|reject|REQ-15
Requested|Local|500 tick|tick, not before the deadline (request_timeout)|REQ-14
Remote|Remote|51 data 1,101 data 51|data in time and order|REQ-20, QOS-08
Remote|Local|52 data 1,102 data 102,2 data 3|data: l > l_max, or dt > dt_max, or l < 0|QOS-03, QOS-05 to QOS-07
Remote|Local|102 tick|tick: silence longer than dt_max|QOS-04, QOS-06
Requested Remote|Local|2 withdraw,2 offer-nothing|withdraw, or an offer without the group|REQ-02, REQ-23
Requested Remote|Local|2 lost|lost|REQ-24
Requested Remote|Local|2 area-without|area without the group|REQ-19
Requested Remote|Local|2 unsafe|verdict: unsafe|FALL-01 to FALL-04
Local|Local|2 unsafe|verdict: unsafe|FALL-04
Held|Local|9999 tick|tick before hold_until: no request|REQ-03, FALL-05
Local Held|Local|2 confirm|confirm that no request waits for|REQ-12
Local Held|Local|2 data 1|data of a session that does not run|REQ-21";

/// An event of the one station and a group.
fn event(group: Group, text: &str) -> Event {
    let mut parts = text.split(' ');
    let word = |part: Option<&str>| part.map_or(0, |ms| 1_000_000 * ms.parse::<i64>().expect("ms"));
    let (t_ns, station, session) = (word(parts.next()), 1, 1);
    let groups = Groups { mot: group == Group::Mot, plan: group == Group::Plan };
    let kind = match parts.next().expect("a word") {
        "offer" => EventKind::Offer { station, groups },
        "offer-nothing" => EventKind::Offer { station, groups: Groups::NONE },
        "withdraw" => EventKind::Withdraw { station },
        "lost" => EventKind::Lost { station },
        "area-without" => EventKind::Area { groups: Groups::NONE },
        "confirm" => EventKind::Confirm { station, group, session },
        "reject" => EventKind::Reject { station, group, session },
        "data" => EventKind::Data { station, group, session, generated_ns: word(parts.next()) },
        "unsafe" => EventKind::Verdict { safe: false, sessions: Sessions::NONE },
        _ => EventKind::Tick,
    };
    Event { t_ns, kind }
}

/// What the requester does at an event, and the state behind it.
fn answer(profile: Profile, group: Group, from: &str, at: &str) -> (&'static str, String) {
    let mut requester = Requester::new(profile, Parameters::default());
    let before: &[&str] = match from {
        "Local" => &["0 offer"],
        "Held" => &["0 offer", "0 unsafe"],
        "Requested" => &["0 offer", "0 tick"],
        _ => &["0 offer", "0 tick", "1 confirm"],
    };
    before.iter().for_each(|step| drop(requester.step(&event(group, step))));
    let hold = requester.hold_until_ns();
    let at = event(group, at);
    let actions = requester.step(&at);
    let word = |action: &Action| match action {
        Action::Drop(_) => Some("drop"),
        Action::Release { .. } => Some("release"),
        Action::Request { .. } => Some("request"),
        Action::Activate(_) | Action::Deactivate(_) => None,
    };
    let held = (requester.hold_until_ns() != hold).then_some("hold_until = now + t_wait");
    let waits = Some(at.t_ns + Parameters::default().t_wait_ns);
    assert!(held.is_none() || requester.hold_until_ns() == waits, "{requester:?}");
    let to = match requester.state(group) {
        GroupState::Local => "Local",
        GroupState::Requested { .. } => "Requested",
        GroupState::Remote { .. } => "Remote",
    };
    (to, actions.iter().filter_map(word).chain(held).collect::<Vec<_>>().join(", "))
}

/// The states and the arrows.
pub fn states() -> String {
    let words = "For each of the groups MOT and PLAN. Above an arrow: the event. Below: what the requester does, and the requirements. \
                 The exact model takes every arrow, in both profiles. Of these events only an unsafe verdict starts the waiting time t_wait (10 s). A violation of \
                 quality of service does where qos_hold is set (FALL-06, FALL-07). hold_until never becomes earlier (FALL-04, FALL-08).";
    let title = "The requester: states of a group";
    let mut sheet = Sheet::new(1, [880.0, HEIGHT], 3);
    sheet.panel(&Look { title, words, low: [0.0; 2], scale: [1.0; 2] }, |pen| {
        state(pen, IN_USE, [0.35, 10.65], "limit", "");
        state(pen, LOCAL, [0.35, 14.4], "cav", "Local");
        state(pen, REQUESTED, [0.6, 3.5], "det", "Requested");
        state(pen, REMOTE, [0.6, 6.5], "track", "Remote");
        pen.words([670.0, y(8.5)], [0.0, 0.0], "m", "Requested or Remote: in use");
        for (arrow, row) in ARROWS.lines().zip([1].into_iter().chain(1..)) {
            draw(pen, f64::from(row), &arrow.split('|').collect::<Vec<_>>());
        }
    });
    sheet.finish()
}

fn y(row: f64) -> f64 {
    HEIGHT - ROW * row
}

fn state(pen: &mut Pen<'_>, [left, right]: [f64; 2], rows: [f64; 2], class: &str, name: &str) {
    let [top, bottom] = rows.map(y);
    pen.area(&[[left, bottom], [right, bottom], [right, top], [left, top]], class);
    pen.words([left.midpoint(right), top.midpoint(bottom)], [0.0, 4.0], "h m", name);
}

fn draw(pen: &mut Pen<'_>, row: f64, arrow: &[&str]) {
    let [before, after, events, words, ids] = arrow else { panic!("five columns: {arrow:?}") };
    let mut does = Vec::new();
    for profile in [Profile::PAPER, Profile::HARDENED] {
        for (group, from) in
            Group::ALL.iter().flat_map(|group| before.split(' ').map(move |from| (*group, from)))
        {
            does.extend(events.split(',').map(|at| answer(profile, group, from, at)));
        }
    }
    assert!(does.iter().all(|it| it.0 == *after && it.1 == does[0].1), "{words}: {does:?}");
    let does = match (does[0].1.as_str(), *before, *after) {
        ("", "Remote", "Remote") => "used ",
        ("", "Requested" | "Requested Remote", "Local") => "no release ",
        ("", ..) => "",
        (does, ..) => &format!("{does} "),
    };
    let [from, to, left] = match (*before, *after) {
        (_, "Requested") => [LOCAL[1], REQUESTED[0], 112.0],
        ("Requested", "Remote") => [REQUESTED[1], REMOTE[0], 590.0],
        ("Requested", _) => [REQUESTED[0], LOCAL[1], 112.0],
        ("Requested Remote", _) => [IN_USE[0], LOCAL[1], 112.0],
        ("Remote", "Local") => [REMOTE[0], LOCAL[1], 112.0],
        ("Remote", _) => [REMOTE[0], REMOTE[0] - 24.0, 590.0],
        _ => [LOCAL[1], LOCAL[1] + 24.0, 142.0],
    };
    let at = y(row);
    if before.contains(after) || *before == "Held" {
        pen.line(&[[from, at + 9.0], [to, at + 9.0], [to, at - 9.0]], "line");
        pen.arrow([to, at - 9.0], [from, at - 9.0]);
    } else {
        pen.arrow([from, at], [to, at]);
    }
    pen.words([left, at], [0.0, -5.0], "", words);
    pen.words([left, at], [0.0, 15.0], "", &format!("{does}({ids})"));
}
