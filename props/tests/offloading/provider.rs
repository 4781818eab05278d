//! `spec/2-offloading.md#provider`. Default lease: 1 s.

use mufasa_model::offloading::provider::{
    DEFAULT_LEASE_NS, Provider, ProviderEvent, ProviderEventKind, Reply,
};
use mufasa_model::offloading::requester::Group::{self, Mot, Plan};

/// A provider that is checked after every step.
struct Mec(Provider);

impl Mec {
    fn new(capacity: usize) -> Self {
        Self(Provider::new(capacity, DEFAULT_LEASE_NS))
    }

    fn at(&mut self, t_ns: i64, kind: ProviderEventKind) -> Option<Reply> {
        let reply = self.0.step(&ProviderEvent { t_ns, kind });
        assert!(self.0.is_valid());
        reply
    }

    /// Whether the request is confirmed.
    fn grants(&mut self, t_ns: i64, requester: i64, group: Group, session: i64) -> bool {
        let asked = ProviderEventKind::Request { requester, group, session };
        let reply = self.at(t_ns, asked).expect("every request is answered");
        let confirmed = Reply::Confirm { requester, group, session };
        assert!(reply == confirmed || reply == Reply::Reject { requester, group, session });
        reply == confirmed
    }
}

fn release(requester: i64, group: Group, session: i64) -> ProviderEventKind {
    ProviderEventKind::Release { requester, group, session }
}

fn heard(requester: i64, group: Group, session: i64) -> ProviderEventKind {
    ProviderEventKind::Heard { requester, group, session }
}

/// PROV-01
#[test]
fn a_request_is_confirmed_only_while_there_is_capacity_and_rejected_otherwise() {
    for capacity in 0..4 {
        let mut mec = Mec::new(capacity);
        let granted =
            [(1, Mot), (1, Plan), (2, Mot), (2, Plan)].map(|(r, g)| mec.grants(0, r, g, 1));
        assert_eq!(granted.iter().filter(|granted| **granted).count(), capacity);
        assert_eq!(mec.0.load(), capacity);
    }
    let mut mec = Mec::new(1);
    assert!(mec.grants(0, 1, Mot, 1) && !mec.grants(1, 2, Mot, 1));
    mec.at(2, release(1, Mot, 1));
    assert!(mec.grants(3, 2, Mot, 2), "there is capacity again");
}

/// PROV-02: also when the capacity is used up.
#[test]
fn a_repeated_request_of_a_running_session_is_confirmed_again() {
    let mut mec = Mec::new(1);
    assert!(mec.grants(0, 1, Mot, 4) && mec.grants(1, 1, Mot, 4));
    assert_eq!(mec.0.load(), 1);
}

/// PROV-03: also when the capacity is used up.
#[test]
fn a_request_with_a_higher_session_number_replaces_the_earlier_session_for_that_group() {
    let mut mec = Mec::new(2);
    assert!(mec.grants(0, 1, Mot, 4) && mec.grants(0, 1, Plan, 5));
    assert!(mec.grants(1, 1, Mot, 6));
    assert_eq!((mec.0.session(1, Mot), mec.0.session(1, Plan)), (Some(6), Some(5)));
    assert_eq!(mec.0.load(), 2);
}

/// PROV-04
#[test]
fn lower_session_numbers_are_rejected_while_a_session_runs() {
    let mut mec = Mec::new(9);
    assert!(mec.grants(0, 1, Mot, 4) && !mec.grants(0, 1, Mot, 3));
    assert_eq!(mec.0.session(1, Mot), Some(4));
    assert!(mec.grants(0, 1, Plan, 3), "lower than that of another group");
}

/// PROV-05
#[test]
fn a_session_ends_at_a_release() {
    let mut mec = Mec::new(1);
    mec.grants(0, 1, Mot, 4);
    for other in [release(1, Mot, 3), release(1, Mot, 5), release(1, Plan, 4), release(2, Mot, 4)] {
        mec.at(1, other);
        assert_eq!(mec.0.session(1, Mot), Some(4), "a release of another session");
    }
    mec.at(2, release(1, Mot, 4));
    assert_eq!(mec.0.session(1, Mot), None);
}

/// PROV-06: whatever event comes at that time.
#[test]
fn a_session_ends_when_nothing_was_heard_for_the_lease_time() {
    for event in [ProviderEventKind::Tick, heard(1, Mot, 4), heard(2, Mot, 1)] {
        let mut mec = Mec::new(1);
        mec.grants(0, 1, Mot, 4);
        mec.at(DEFAULT_LEASE_NS - 1, ProviderEventKind::Tick);
        assert_eq!(mec.0.session(1, Mot), Some(4));
        mec.at(DEFAULT_LEASE_NS, event);
        assert_eq!(mec.0.load(), 0);
    }
}

/// PROV-06, PROTO-06: data or a repeated request of the session.
#[test]
fn a_session_that_is_heard_of_keeps_running() {
    let mut mec = Mec::new(1);
    mec.grants(0, 1, Mot, 4);
    mec.at(DEFAULT_LEASE_NS - 1, heard(1, Mot, 4));
    mec.at(2 * DEFAULT_LEASE_NS - 2, ProviderEventKind::Tick);
    assert!(mec.grants(2 * DEFAULT_LEASE_NS - 2, 1, Mot, 4));
    mec.at(3 * DEFAULT_LEASE_NS - 3, ProviderEventKind::Tick);
    assert_eq!(mec.0.session(1, Mot), Some(4));
}

/// PROTO-05, PROTO-06: the requester left MOT, the release
/// was lost, and it goes on with PLAN.
#[test]
fn a_session_that_the_requester_has_left_ends_within_the_lease() {
    let mut mec = Mec::new(2);
    mec.grants(0, 1, Mot, 1);
    mec.grants(0, 1, Plan, 2);
    for t_ns in [1, DEFAULT_LEASE_NS / 2, DEFAULT_LEASE_NS] {
        mec.at(t_ns, heard(1, Plan, 2));
    }
    assert_eq!((mec.0.session(1, Mot), mec.0.session(1, Plan)), (None, Some(2)));
}

/// PROV-07
#[test]
fn one_provider_serves_several_requesters() {
    let mut mec = Mec::new(6);
    for requester in 1..=3 {
        assert!(mec.grants(0, requester, Mot, 1) && mec.grants(0, requester, Plan, 2));
    }
    assert_eq!(mec.0.load(), 6);
}

/// PROV-08: every message of requester 2, with the numbers of requester
/// 1.
#[test]
fn what_one_requester_does_does_not_change_another_ones_session() {
    let mut before = Mec::new(2);
    before.grants(0, 1, Mot, 4);
    for session in [3, 4, 5] {
        for kind in [
            ProviderEventKind::Request { requester: 2, group: Mot, session },
            release(2, Mot, session),
            heard(2, Mot, session),
        ] {
            let mut mec = Mec(before.0.clone());
            mec.at(1, kind);
            assert_eq!(mec.0.session(1, Mot), Some(4));
            mec.at(2, release(2, Mot, session));
            assert_eq!(mec.0, before.0, "requester 1 was neither heard nor released");
        }
    }
}

/// PROV-06: the lease is exact and time may run backwards.
#[test]
fn a_lease_survives_any_time() {
    let mut mec = Mec::new(1);
    mec.grants(i64::MAX, 1, Mot, 1);
    mec.at(i64::MIN, ProviderEventKind::Tick);
    assert_eq!(mec.0.load(), 1);
    mec.at(i64::MIN, heard(1, Mot, 1));
    mec.at(i64::MAX, ProviderEventKind::Tick);
    assert_eq!(mec.0.load(), 0);
}
