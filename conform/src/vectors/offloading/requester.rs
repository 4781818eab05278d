//! `spec/2-offloading.md#requester`

use mufasa_model::input::cycle::Profile::Paper;
use mufasa_model::offloading::requester::Group::{Mot, Plan};

use crate::vectors::book::{Book, Topic};
use crate::vectors::offloading::{LOCAL, tell};
use crate::vectors::story::{ALL, MOT, NONE, PLAN, Story};

/// Default request_timeout, ns.
const TIMEOUT: i64 = 500_000_000;

const fn must(requirement: &'static str) -> Topic {
    Topic::new("offloading/requester", requirement)
}

const OFFER: Topic = must("spec/2-offloading.md#requester.1");
const REQUEST: Topic = must("spec/2-offloading.md#requester.2");
const ORDER: Topic = must("spec/2-offloading.md#requester.3");
const CONFIRM: Topic = must("spec/2-offloading.md#requester.4");
const OVERDUE: Topic = must("spec/2-offloading.md#requester.5");
const AREA: Topic = must("spec/2-offloading.md#requester.6");
const DATA: Topic = must("spec/2-offloading.md#requester.7");
const LEAVE: Topic = must("spec/2-offloading.md#requester.8");
const SEVERAL: Topic = must("spec/2-offloading.md#requester.9");

/// Adds its vectors.
pub fn add(book: &mut Book) {
    offers(book);
    requests(book);
    stations(book);
    confirmations(book);
    deadlines(book);
    area_and_data(book);
    leaving(book);
}

fn offers(book: &mut Book) {
    let note = "An offer replaces the previous one: only PLAN is offered now.";
    let story = Story::new(Paper).offer(0, 1, MOT).offer(0, 1, PLAN).tick(1);
    let told = (["local", "requested:1"], None, ["request plan 1#1"].as_slice());
    tell(book, OFFER, ("replaced", note), &story, told);
    let note = "A running group that the new offer no longer contains is left with a release.";
    let story = Story::remote(Paper, ALL).offer(1, 1, PLAN);
    let told = (["local", "remote:1"], None, ["release mot 1#1", "activate mot"].as_slice());
    tell(book, OFFER, ("left", note), &story, told);
    let note = "A requested group, too; its local services never stopped.";
    let story = Story::requested(Paper, ALL).offer(1, 1, MOT);
    let told = (["requested:1", "local"], None, ["release plan 1#2"].as_slice());
    tell(book, OFFER, ("left-requested", note), &story, told);
    let note = "Another station's offer changes no session.";
    let story = Story::remote(Paper, ALL).offer(1, 2, NONE);
    tell(book, OFFER, ("offer-of-another", note), &story, (["remote:1", "remote:1"], None, &[]));
}

fn requests(book: &mut Book) {
    let note = "Requests are decided at ticks, MOT before PLAN, and numbered from 1.";
    let story = Story::requested(Paper, ALL);
    let both = ["request mot 1#1", "request plan 1#2"];
    tell(book, REQUEST, ("tick", note), &story, (["requested:1", "requested:1"], None, &both));
    let note = "Nothing but a tick sends a request.";
    let story = Story::new(Paper).offer(0, 1, ALL).safe(1, ALL);
    tell(book, REQUEST, ("no-tick", note), &story, (LOCAL, None, &[]));
    let note = "Groups that are requested or remote are not requested again.";
    let story = Story::requested(Paper, ALL).confirm(1, (1, Mot, 1)).offer(1, 2, ALL).tick(2);
    tell(book, REQUEST, ("in-use", note), &story, (["remote:1", "requested:1"], None, &[]));
    let note = "Nobody offers MOT.";
    let story = Story::new(Paper).offer(0, 1, PLAN).tick(1);
    let told = (["local", "requested:1"], None, ["request plan 1#1"].as_slice());
    tell(book, REQUEST, ("not-offered", note), &story, told);
    let note = "MOT is not in the area.";
    let story = Story::new(Paper).offer(0, 1, ALL).area(0, PLAN).tick(1);
    tell(book, REQUEST, ("not-in-the-area", note), &story, told);
    let hold = 10_000_000_005;
    let note = "Not before hold_until.";
    let story = Story::new(Paper).offer(0, 1, MOT).issue(5);
    let early = story.clone().tick(hold - 1);
    tell(book, REQUEST, ("held", note), &early, (LOCAL, Some(hold), &[]));
    let note = "At hold_until.";
    let told = (["requested:1", "local"], Some(hold), ["request mot 1#1"].as_slice());
    tell(book, REQUEST, ("hold-ended", note), &story.tick(hold), told);
    let note = "A group that returned at this tick waits for the next; the other does not.";
    let story = Story::requested(Paper, PLAN).offer(1, 1, ALL).tick(TIMEOUT);
    let told = (["requested:1", "local"], None, ["release plan 1#1", "request mot 1#2"].as_slice());
    tell(book, REQUEST, ("waits-a-tick", note), &story, told);
}

fn stations(book: &mut Book) {
    let three = || Story::new(Paper).offer(0, 7, MOT).offer(0, 3, MOT).offer(0, 5, MOT);
    let note = "Never asked: the smallest id first.";
    let told = (["requested:3", "local"], None, ["request mot 3#1"].as_slice());
    tell(book, ORDER, ("smallest", note), &three().tick(1), told);
    let note = "A station never asked comes before one that was.";
    let story = three().tick(1).reject(1, (3, Mot, 1)).tick(2).reject(2, (5, Mot, 2)).tick(3);
    let told = (["requested:7", "local"], None, ["request mot 7#3"].as_slice());
    tell(book, ORDER, ("never-asked", note), &story, told);
    let note = "Then the one whose last request is the oldest.";
    let told = (["requested:3", "local"], None, ["request mot 3#4"].as_slice());
    let oldest = story.reject(3, (7, Mot, 3)).tick(4);
    tell(book, ORDER, ("oldest", note), &oldest, told);
    let note = "The oldest in the order of the requests: the clock ran backwards.";
    let story = Story::new(Paper).offer(0, 1, MOT).offer(0, 2, MOT);
    let story = story.tick(900).reject(900, (1, Mot, 1)).tick(800).reject(800, (2, Mot, 2));
    let told = (["requested:1", "local"], None, ["request mot 1#3"].as_slice());
    tell(book, ORDER, ("not-of-their-times", note), &story.tick(700), told);
    let note = "A withdrawal forgets nothing: station 1 was asked, 2 never.";
    let story = Story::new(Paper).offer(0, 1, MOT).tick(1).reject(1, (1, Mot, 1)).withdraw(2, 1);
    let story = story.offer(3, 1, MOT).offer(3, 2, MOT).tick(4);
    let told = (["requested:2", "local"], None, ["request mot 2#2"].as_slice());
    tell(book, ORDER, ("withdrawal-forgets-nothing", note), &story, told);
    let note = "Asked for PLAN is not asked for MOT.";
    let story = Story::new(Paper).offer(0, 1, PLAN).offer(0, 2, MOT).tick(1);
    let story = story.reject(2, (2, Mot, 1)).offer(2, 1, ALL).tick(3);
    let told = (["requested:1", "requested:1"], None, ["request mot 1#3"].as_slice());
    tell(book, ORDER, ("per-group", note), &story, told);
}

fn confirmations(book: &mut Book) {
    let note = "Before the deadline: remote, and in the paper profile the local services stop.";
    let story = Story::requested(Paper, MOT).confirm(TIMEOUT - 1, (1, Mot, 1));
    let told = (["remote:1", "local"], None, ["deactivate mot"].as_slice());
    tell(book, CONFIRM, ("before-the-deadline", note), &story, told);
    let note = "At the deadline it is too late, and answered with a release.";
    let story = Story::requested(Paper, MOT).confirm(TIMEOUT, (1, Mot, 1));
    let told = (["requested:1", "local"], None, ["release mot 1#1"].as_slice());
    tell(book, CONFIRM, ("at-the-deadline", note), &story, told);
    let note = "A confirmation of the running session is ignored.";
    let story = Story::remote(Paper, MOT).confirm(1, (1, Mot, 1));
    tell(book, CONFIRM, ("again", note), &story, (["remote:1", "local"], None, &[]));
    for (name, station, session, action) in
        [("other-session", 1, 2, "release mot 1#2"), ("other-station", 2, 1, "release mot 2#1")]
    {
        let note = "Any other confirmation is answered with a release of what it names.";
        let story = Story::requested(Paper, MOT).confirm(1, (station, Mot, session));
        let told = (["requested:1", "local"], None, [action]);
        tell(book, CONFIRM, (name, note), &story, (told.0, told.1, &told.2));
        let story = Story::remote(Paper, MOT).confirm(1, (station, Mot, session));
        let name = format!("{name}-remote");
        tell(book, CONFIRM, (&name, note), &story, (["remote:1", "local"], None, &[action]));
    }
    let note = "Nothing was requested.";
    let story = Story::new(Paper).confirm(1, (9, Plan, 4));
    tell(book, CONFIRM, ("unasked", note), &story, (LOCAL, None, &["release plan 9#4"]));
}

fn deadlines(book: &mut Book) {
    let note = "Not confirmed, a nanosecond before the deadline.";
    let story = Story::requested(Paper, MOT).tick(TIMEOUT - 1);
    tell(book, OVERDUE, ("not-yet", note), &story, (["requested:1", "local"], None, &[]));
    let note = "At the deadline the first tick ends the request, with a release.";
    let story = Story::requested(Paper, MOT).tick(TIMEOUT);
    tell(book, OVERDUE, ("overdue", note), &story, (LOCAL, None, &["release mot 1#1"]));
    let note = "A rejection returns the group at once, without a release.";
    let story = Story::requested(Paper, MOT).reject(1, (1, Mot, 1));
    tell(book, OVERDUE, ("rejected", note), &story, (LOCAL, None, &[]));
    for (name, group, station, session) in [
        ("rejected-other-session", Mot, 1, 2),
        ("rejected-other-station", Mot, 2, 1),
        ("rejected-other-group", Plan, 1, 1),
    ] {
        let note = "Any other rejection is ignored.";
        let story = Story::requested(Paper, MOT).reject(1, (station, group, session));
        tell(book, OVERDUE, (name, note), &story, (["requested:1", "local"], None, &[]));
    }
    let note = "A rejection of the running session is ignored, too.";
    let story = Story::remote(Paper, MOT).reject(1, (1, Mot, 1));
    tell(book, OVERDUE, ("rejected-remote", note), &story, (["remote:1", "local"], None, &[]));
}

fn area_and_data(book: &mut Book) {
    let note = "A remote group no longer in the area returns with a release, without a hold.";
    let story = Story::remote(Paper, ALL).area(2, PLAN);
    let told = (["local", "remote:1"], None, ["release mot 1#1", "activate mot"].as_slice());
    tell(book, AREA, ("area-left", note), &story, told);
    let note = "All groups are in the area until the first event of an area.";
    let both = ["request mot 1#1", "request plan 1#2"];
    let story = Story::new(Paper).offer(0, 1, ALL).tick(0);
    tell(book, AREA, ("at-first", note), &story, (["requested:1", "requested:1"], None, &both));
    let note = "An area replaces the previous one.";
    let story = Story::new(Paper).offer(0, 1, ALL).area(0, PLAN).area(1, MOT).tick(2);
    let told = (["requested:1", "local"], None, ["request mot 1#1"].as_slice());
    tell(book, AREA, ("area-replaced", note), &story, told);
    let note = "Data of the running session are used: nothing is dropped.";
    let remote = ["remote:1", "local"];
    let story = Story::remote(Paper, MOT).data(1, (1, Mot, 1), 1);
    tell(book, DATA, ("used", note), &story, (remote, None, &[]));
    for (name, station, session) in [("data-other-station", 2, 1), ("data-other-session", 1, 2)] {
        let note = "Data of another station or session are dropped.";
        let story = Story::remote(Paper, MOT).data(1, (station, Mot, session), 1);
        tell(book, DATA, (name, note), &story, (remote, None, &["drop mot"]));
    }
    let note = "Data of a group that is only requested are dropped.";
    let story = Story::requested(Paper, MOT).data(1, (1, Mot, 1), 1);
    tell(book, DATA, ("requested", note), &story, (["requested:1", "local"], None, &["drop mot"]));
}

fn leaving(book: &mut Book) {
    let note = "A withdrawal returns every group of the station, with releases.";
    let story = Story::requested(Paper, ALL).confirm(1, (1, Plan, 2)).withdraw(2, 1);
    let actions = ["release mot 1#1", "release plan 1#2", "activate plan"];
    tell(book, LEAVE, ("withdrawn", note), &story, (LOCAL, None, &actions));
    let note = "No offer is left, and no hold has begun.";
    tell(book, LEAVE, ("offer-gone", note), &story.tick(3), (LOCAL, None, &[]));
    let note = "A loss does the same without releases.";
    let story = Story::requested(Paper, ALL).confirm(1, (1, Plan, 2)).lost(2, 1);
    tell(book, LEAVE, ("lost", note), &story, (LOCAL, None, &["activate plan"]));
    let note = "Another station leaves: no session changes.";
    let story = Story::remote(Paper, MOT).offer(1, 2, ALL).withdraw(2, 2);
    tell(book, LEAVE, ("another-leaves", note), &story, (["remote:1", "local"], None, &[]));
    let note = "MOT and PLAN run on different stations.";
    let story = Story::new(Paper).offer(0, 2, MOT).offer(0, 1, PLAN).tick(1);
    let story = story.confirm(2, (2, Mot, 1)).confirm(2, (1, Plan, 2));
    let told = (["remote:2", "remote:1"], None, ["deactivate plan"].as_slice());
    tell(book, SEVERAL, ("two-stations", note), &story, told);
    let note = "One of them withdraws: the other stays.";
    let told = (["remote:2", "local"], None, ["release plan 1#2", "activate plan"].as_slice());
    tell(book, SEVERAL, ("one-leaves", note), &story.withdraw(3, 1), told);
    let note = "Of three stations that offer at the same time the next is asked when one is lost.";
    let story = Story::new(Paper).offer(0, 3, MOT).offer(0, 1, MOT).offer(0, 2, MOT).tick(1);
    let told = (["requested:2", "local"], None, ["request mot 2#2"].as_slice());
    tell(book, SEVERAL, ("three-stations", note), &story.lost(2, 1).tick(3), told);
}
