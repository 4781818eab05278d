//! The groups of the requester (`spec/2-offloading.md`), law by law, from any state at all, even one
//! that no events lead to. What is done is taken kind by kind; `actions` has the list.
//!
//! Domain: all states, valid or not, a table of one station, all times of 64 bits. Not covered: larger
//! tables. A harness with another one says so.

use mufasa::offloading::requester::{Action, Event, EventKind, GroupRecord, Parts, StationRecord};

use super::any::{groups, time_ns};
use super::seen::{
    DROPS, GROUPS, RELEASES, SERVICES, Seen, after, after_in, any_verdict, area, confirm, data,
    data_of, each, in_use, reject, same, tick, verdict,
};
use super::states::{any_group, any_record_of, any_state, any_station, withdrawal};
#[cfg(not(kani))]
use crate::kani;

/// A change of the area keeps every law of a step: see `keeps_every_law` [REQ-04, REQ-18, REQ-19, FALL-13, PROTO-08,
/// H-08.2, H-08.3].
#[cfg_attr(kani, kani::proof)]
pub fn verify_every_law_at_areas() {
    area(&|step: &Seen| {
        assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
        kani::cover!(step.starts(0), "local services start");
        kani::cover!(step.done[RELEASES][1].is_some(), "a release");
    });
}

/// A verdict keeps every law of a step: see `keeps_every_law` [CONF-03, REQ-04, FALL-04, FALL-08, FALL-09, FALL-13,
/// PROTO-08, PROTO-09, H-08.1, H-08.2, H-08.3].
#[cfg_attr(kani, kani::proof)]
pub fn verify_every_law_at_verdicts() {
    verdict(&|step: &Seen| {
        assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
        let was_valid = step.is_hardened() && step.is_valid(step.before.groups[1]);
        kani::cover!(step.starts(0), "local services start");
        kani::cover!(was_valid && step.stops(1), "local services stop");
        kani::cover!(step.is_unsafe() && step.has_hold(), "a hold");
    });
}

/// A confirmation keeps every law of a step: see `keeps_every_law` [CONF-02, REQ-04, REQ-11, REQ-13, FALL-13, PROTO-08,
/// H-08.2].
#[cfg_attr(kani, kani::proof)]
pub fn verify_every_law_at_confirmations() {
    confirm(&|step: &Seen, _, _| {
        assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
        kani::cover!(!step.is_hardened() && step.stops(0), "local services stop");
        kani::cover!(step.is_remote_now(1), "it becomes remote");
    });
}

/// A rejection keeps every law of a step: see `keeps_every_law` [REQ-04, REQ-16, FALL-13, PROTO-08, H-08.2, H-08.3].
#[cfg_attr(kani, kani::proof)]
pub fn verify_every_law_at_rejections() {
    reject(&|step: &Seen, _, _| {
        assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
        kani::cover!(step.leaves(0), "MOT");
        kani::cover!(step.leaves(1), "PLAN");
    });
}

/// Data keep every law of a step: see `keeps_every_law` [REQ-04, FALL-06, FALL-07, FALL-08, FALL-09, FALL-13, PROTO-08,
/// H-08.2, H-08.3].
#[cfg_attr(kani, kani::proof)]
pub fn verify_every_law_at_data() {
    data_of(&|step: &Seen, _, _| {
        assert!(step.keeps_every_law() && each(|at| step.lists_actions_by_kind(at)));
        kani::cover!(step.starts(0), "local services start");
        kani::cover!(step.has_hold(), "a hold");
    });
}

/// A change of the area leaves exactly the groups outside it: each gets one release of its
/// session, and nobody else any [REQ-19].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_session_left_is_released_at_areas() {
    area(&|step: &Seen| {
        assert!(each(|at| step.releases_what_it_leaves(at)));
        let outside = [!step.after.area.mot, !step.after.area.plan];
        assert!(each(
            |at| step.leaves(at) == (outside[at] && in_use(step.before.groups[at]).is_some())
        ));
        kani::cover!(step.done[RELEASES][0].is_some(), "outside the area");
        kani::cover!(step.done[RELEASES][0].is_none(), "a group that stays");
    });
}

/// A tick leaves exactly the groups that are overdue or silent, with one release of the session;
/// nobody else gets any [REQ-14, QOS-04, QOS-06, FALL-10].
///
/// Domain: all states, valid or not, all times of 64 bits. Not covered: tables: nobody offers
/// anything.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_session_left_is_released_at_ticks() {
    tick(&|step: &Seen| {
        assert!(each(|at| step.releases_what_it_leaves(at)));
        assert!(each(|at| step.leaves(at) == step.is_due(at)));
        kani::cover!(step.done[RELEASES][0].is_some(), "overdue or silent");
        kani::cover!(step.done[RELEASES][0].is_none(), "a group that stays");
    });
}

/// Data leave a group only with one release of its session [QOS-06].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_session_left_is_released_at_data() {
    data(&|step: &Seen| {
        assert!(each(|at| step.releases_what_it_leaves(at)));
        kani::cover!(step.done[RELEASES][0].is_some(), "a violation");
        kani::cover!(step.done[RELEASES][0].is_none(), "a group that stays");
    });
}

/// A safety issue leaves every group, a safe verdict none, with one release of the session for
/// each; after a safety issue all groups are local [FALL-01, FALL-02, PROTO-10].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_session_left_is_released_at_verdicts() {
    verdict(&|step: &Seen| {
        assert!(each(|at| step.releases_what_it_leaves(at)));
        let is_unsafe = step.is_unsafe();
        assert!(each(
            |at| step.leaves(at) == (is_unsafe && in_use(step.before.groups[at]).is_some())
        ));
        assert!(!is_unsafe || each(|at| matches!(step.after.groups[at], GroupRecord::Local)));
        kani::cover!(step.done[RELEASES][0].is_some(), "a safety issue");
        kani::cover!(step.done[RELEASES][0].is_none(), "a group that stays");
    });
}

/// A confirmation of the requested session before its deadline makes the group remote; any other
/// but that of the running session is answered with a release of what it names [REQ-10, REQ-11, REQ-12, REQ-13,
/// PROTO-11].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_group_becomes_remote_by_confirmation() {
    confirm(&|step: &Seen, at: usize, named: (i64, i64)| {
        let before = step.before.groups[at];
        let names_it = in_use(before) == Some(named);
        let confirmed = match before {
            GroupRecord::Requested { deadline_ns, .. } => names_it && step.event.t_ns < deadline_ns,
            GroupRecord::Local | GroupRecord::Remote(_) => false,
        };
        let runs = matches!(before, GroupRecord::Remote(_)) && names_it;
        if confirmed {
            let GroupRecord::Remote(running) = step.after.groups[at] else {
                unreachable!("remote")
            };
            assert!((running.station, running.session) == named);
            assert!(running.last_arrival_ns == step.event.t_ns && running.last_used_ns.is_none());
        } else {
            assert!(same(step.after.groups[at], before));
        }
        let release = step.done[RELEASES][at];
        let answered = matches!(release, Some(Action::Release { station, session, .. })
            if (station, session) == named);
        assert!(answered == (!confirmed && !runs) && release.is_some() == answered);
        kani::cover!(confirmed, "confirmed");
        kani::cover!(answered && names_it, "too late");
        kani::cover!(runs, "again");
    });
}

/// The frame: a confirmation of one group leaves the other group, the area, the times and the table as they
/// are, and nothing is done about the other group [REQ-11, REQ-13].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_other_group_is_untouched_at_confirmations() {
    confirm(&|step: &Seen, at: usize, _| {
        assert!(step.leaves_alone(1 - at) && step.keeps_the_rest());
        kani::cover!(step.is_remote_now(at), "its own group changes");
    });
}

/// The frame: a rejection of one group leaves the other group, the area, the times and the table as they
/// are, and nothing is done about the other group [REQ-16].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_other_group_is_untouched_at_rejections() {
    reject(&|step: &Seen, at: usize, _| {
        assert!(step.leaves_alone(1 - at) && step.keeps_the_rest());
        kani::cover!(step.leaves(at), "its own group changes");
    });
}

/// The frame: data of one group leave the other group, the area, the times and the table as they are, and
/// nothing is done about the other group [QOS-06].
#[cfg_attr(kani, kani::proof)]
pub fn verify_the_other_group_is_untouched_at_data() {
    data_of(&|step: &Seen, at: usize, _| {
        assert!(step.leaves_alone(1 - at) && step.keeps_the_rest());
        kani::cover!(step.leaves(at), "its own group changes");
    });
}

/// A rejection of the requested session makes the group local; any other changes nothing; nobody
/// hears of it [REQ-15, REQ-16, PROTO-11].
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_rejection_ends_a_request() {
    reject(&|step: &Seen, at: usize, named: (i64, i64)| {
        let before = step.before.groups[at];
        let is_meant =
            matches!(before, GroupRecord::Requested { .. }) && in_use(before) == Some(named);
        let expected = if is_meant { GroupRecord::Local } else { before };
        assert!(same(step.after.groups[at], expected));
        assert!(step.done[RELEASES][at].is_none() && step.done[SERVICES][at].is_none());
        kani::cover!(is_meant, "rejected");
        kani::cover!(!is_meant && in_use(before).is_some(), "another session");
    });
}

/// Data of any but the running session are dropped and counted, and change nothing else [REQ-20, REQ-21, QOS-01,
/// PROTO-11].
#[cfg_attr(kani, kani::proof)]
pub fn verify_data_of_another_session_are_dropped() {
    data_of(&|step: &Seen, at: usize, named: (i64, i64)| {
        let before = step.before.groups[at];
        let runs = matches!(before, GroupRecord::Remote(_)) && in_use(before) == Some(named);
        if !runs {
            assert!(same(step.after.groups[at], before));
            assert!(step.done[DROPS][at] == Some(Action::Drop(GROUPS[at])));
            assert!(step.done[RELEASES][at].is_none());
            assert!(step.after.hold_until_ns == step.before.hold_until_ns);
        }
        let counted = step.before.dropped[at].saturating_add(u64::from(!runs));
        assert!(step.after.dropped[at] == counted);
        kani::cover!(!runs, "dropped");
        kani::cover!(runs && step.done[DROPS][at].is_none(), "used");
        kani::cover!(runs && step.done[RELEASES][at].is_some(), "violating");
    });
}

/// The composition of the two groups: what a change of the area does to one does not depend on the
/// other.
///
/// Domain: all pairs of states, valid or not, that differ in one group alone, all times of 64 bits. Not
/// covered: tables: nobody offers anything.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_group_depends_on_itself_alone_at_areas() {
    depends_on_itself_alone(EventKind::Area { groups: groups() }, []);
}

/// The composition of the two groups: what a verdict does to one does not depend on the other.
///
/// Domain: all pairs of states, valid or not, that differ in one group alone, all times of 64 bits. Not
/// covered: tables: nobody offers anything.
#[cfg_attr(kani, kani::proof)]
pub fn verify_a_group_depends_on_itself_alone_at_verdicts() {
    depends_on_itself_alone(any_verdict(), []);
}

/// The composition of the two groups: what an offer or a withdrawal does to one does not depend on the other.
///
/// Domain: all pairs of states, valid or not, that differ in one group alone, a table of one place, free or the
/// station's, all times of 64 bits. Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_group_depends_on_itself_alone_at_offers() {
    let station = any_station();
    let kind = EventKind::Offer { station, groups: groups() };
    depends_on_itself_alone(kind, [any_record_of(station)]);
}

/// The composition of the two groups: which of them is left at a tick, and how, does not depend on the other [QOS-06].
///
/// Domain: all pairs of states, valid or not, that differ in one group alone, all times of 64 bits. Not
/// covered: tables; where somebody offers, a violation of one bars requests for the other (`ticks`).
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_group_depends_on_itself_alone_at_ticks() {
    depends_on_itself_alone(EventKind::Tick, []);
}

fn depends_on_itself_alone<const N: usize>(kind: EventKind, table: [StationRecord; N]) {
    // The group is a constant in each of the two branches.
    if kani::any() {
        depends_on_itself(0, kind, table);
    } else {
        depends_on_itself(1, kind, table);
    }
}

fn depends_on_itself<const N: usize>(at: usize, kind: EventKind, table: [StationRecord; N]) {
    let (one, t_ns) = (any_state(), time_ns());
    let mut groups = one.groups;
    groups[1 - at] = any_group();
    let (other, event) = (Parts { groups, ..one }, Event { t_ns, kind });
    let [one, other] = [one, other].map(|before| after_in(before, event, &mut table.clone()));
    assert!(same(one.after.groups[at], other.after.groups[at]));
    assert!(one.done[DROPS][at] == other.done[DROPS][at]);
    assert!(one.done[RELEASES][at] == other.done[RELEASES][at]);
    assert!(one.done[SERVICES][at] == other.done[SERVICES][at]);
    // A violation of either holds.
    let holds_alike = one.after.hold_until_ns == other.after.hold_until_ns;
    assert!(holds_alike || matches!(kind, EventKind::Tick));
    let differs = one.done[RELEASES][1 - at].is_some() && other.done[RELEASES][1 - at].is_none();
    let is_left = one.done[RELEASES][at].is_some();
    kani::cover!(at == 0 && differs, "PLAN differs");
    kani::cover!(at == 1 && differs, "MOT differs");
    kani::cover!(at == 0 && is_left, "MOT is left");
    kani::cover!(at == 1 && is_left, "PLAN is left");
}

/// A withdrawal and a loss leave exactly the groups that use the station, each with one release of
/// the session after a withdrawal and none after a loss [REQ-23, REQ-24].
///
/// Domain: all states, valid or not, a table of one place, free or the station's, all times of 64 bits.
/// Not covered: larger tables.
#[cfg_attr(kani, kani::proof)]
#[cfg_attr(kani, kani::unwind(10))]
pub fn verify_a_session_left_is_released_at_withdrawals() {
    let is_loss = kani::any();
    let (kind, station) = withdrawal(is_loss);
    let place = any_record_of(station);
    let step = after(kind, &mut [place]);
    let uses = |at: usize| in_use(step.before.groups[at]).is_some_and(|(used, _)| used == station);
    assert!(each(|at| step.leaves(at) == uses(at)));
    assert!(each(|at| if is_loss {
        step.done[RELEASES][at].is_none()
    } else {
        step.releases_what_it_leaves(at)
    }));
    let is_known = place.station().is_some();
    kani::cover!(is_loss && uses(0) && is_known, "a loss");
    kani::cover!(!is_loss && uses(1) && is_known, "a withdrawal");
}
