//! `spec/2-offloading.md#properties-of-the-whole-protocol`: random walks of one CAV, two providers
//! and a network that loses, delays and duplicates, with an attacker and failing providers.

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::provider::{Provider, ProviderEvent, ProviderEventKind, Reply};
use mufasa_model::offloading::requester::{
    Action, Event, EventKind, Group, GroupState, Groups, Parameters, Requester,
};
use mufasa_model::services::configuration::{Offloadable, Source};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{PROFILES, TICK, UNSAFE, confirm, data, reject};

const LEASE_NS: i64 = 40;
const CAV: i64 = 7;

pub fn parameters() -> Parameters {
    Parameters {
        t_wait_ns: 60,
        request_timeout_ns: 15,
        l_max_ns: 12,
        dt_max_ns: 20,
        qos_hold: false,
    }
}

/// Reproducible numbers.
struct Numbers(ChaCha8Rng);

impl Numbers {
    /// A number below `bound`.
    fn below(&mut self, bound: i64) -> i64 {
        self.0.random_range(0..bound)
    }

    fn groups(&mut self) -> Groups {
        Groups { mot: self.below(2) == 0, plan: self.below(2) == 0 }
    }

    fn group(&mut self) -> Group {
        Group::ALL[usize::from(self.below(2) == 0)]
    }
}

/// A message under way.
#[derive(Clone, Copy)]
enum Message {
    ToCav(EventKind),
    ToProvider(i64, ProviderEventKind),
}

/// What an observer sees of one group from outside.
#[derive(Clone, Copy)]
struct Seen {
    local_computes: bool,
    /// A result of the running session was used.
    used: bool,
}

/// How often something happened that a property speaks of.
#[derive(Default)]
struct Count {
    remote: u64,
    used: u64,
    stopped: u64,
    fallbacks: u64,
    stale: u64,
    leases: u64,
}

struct World {
    profile: Profile,
    now_ns: i64,
    cav: Requester,
    providers: Vec<Provider>,
    under_way: Vec<Message>,
    seen: [Seen; 2],
    /// `hold_until` as the observer reckons it.
    blocked_until_ns: i64,
    /// When each provider last heard something of a session of each group.
    last_heard_ns: [[i64; 2]; 2],
    count: Count,
}

impl World {
    fn new(profile: Profile) -> Self {
        Self {
            profile,
            now_ns: 0,
            cav: Requester::new(profile, parameters()),
            providers: vec![Provider::new(1, LEASE_NS), Provider::new(2, LEASE_NS)],
            under_way: vec![],
            seen: [Seen { local_computes: true, used: false }; 2],
            blocked_until_ns: i64::MIN,
            last_heard_ns: [[i64::MIN; 2]; 2],
            count: Count::default(),
        }
    }

    /// One random thing happens.
    fn step(&mut self, numbers: &mut Numbers) {
        self.now_ns += numbers.below(4);
        match numbers.below(40) {
            0 => self.cav_event(EventKind::Withdraw { station: 1 + numbers.below(2) }),
            1 => self.cav_event(EventKind::Lost { station: 1 + numbers.below(2) }),
            2 => self.cav_event(EventKind::Area { groups: numbers.groups() }),
            3 => self.cav_event(EventKind::Area { groups: Groups::ALL }),
            4 => self.cav_event(EventKind::Verdict {
                safe: false,
                sessions: self.cav.sessions(numbers.groups()),
            }),
            5 => self.providers[usize::from(numbers.below(2) == 0)] = Provider::new(1, LEASE_NS),
            6..=8 => self.attack(numbers),
            9..=11 => self.cav_event(EventKind::Offer {
                station: 1 + numbers.below(2),
                groups: if numbers.below(4) == 0 { numbers.groups() } else { Groups::ALL },
            }),
            12..=14 => self.cav_event(EventKind::Verdict {
                safe: true,
                sessions: self.cav.sessions(numbers.groups()),
            }),
            15..=19 => self.cav_event(TICK),
            20..=24 => self.providers_work(),
            _ => self.deliver(numbers),
        }
    }

    /// The network delivers, and sometimes loses or duplicates, in any order.
    fn deliver(&mut self, numbers: &mut Numbers) {
        let Ok(count) = i64::try_from(self.under_way.len()) else { return };
        if count == 0 {
            return;
        }
        let place = usize::try_from(numbers.below(count)).expect("an index");
        let fate = numbers.below(10);
        let message =
            if fate == 0 { self.under_way[place] } else { self.under_way.swap_remove(place) };
        match message {
            _ if fate == 1 => {}
            Message::ToCav(kind) => self.cav_event(kind),
            Message::ToProvider(station, kind) => self.provider_event(station, kind),
        }
    }

    /// Forged messages of any station, with numbers in reach.
    fn attack(&mut self, numbers: &mut Numbers) {
        let (station, group) = (1 + numbers.below(2), numbers.group());
        let session = numbers.below(12);
        self.cav_event(match numbers.below(3) {
            0 => confirm(station, group, session),
            1 => reject(station, group, session),
            _ => data(station, group, session, self.now_ns - 8 + numbers.below(10)),
        });
    }

    /// Providers send results of their sessions; the CAV keeps its running sessions alive.
    fn providers_work(&mut self) {
        for (station, provider) in (1..).zip(&self.providers) {
            for group in Group::ALL {
                if let Some(session) = provider.session(CAV, group) {
                    let result = data(station, group, session, self.now_ns);
                    self.under_way.push(Message::ToCav(result));
                }
            }
        }
        for group in Group::ALL {
            if let GroupState::Remote { station, session } = self.cav.state(group) {
                let alive = ProviderEventKind::Heard { requester: CAV, group, session };
                self.under_way.push(Message::ToProvider(station, alive));
            }
        }
        for station in [1, 2] {
            self.provider_event(station, ProviderEventKind::Tick);
        }
    }

    fn provider_event(&mut self, station: i64, kind: ProviderEventKind) {
        let place = usize::try_from(station - 1).expect("station 1 or 2");
        let provider = &mut self.providers[place];
        let running = Group::ALL.map(|group| provider.session(CAV, group));
        let reply = provider.step(&ProviderEvent { t_ns: self.now_ns, kind });
        for (index, group) in Group::ALL.into_iter().enumerate() {
            let silent_ns = i128::from(self.now_ns) - i128::from(self.last_heard_ns[place][index]);
            if running[index].is_some() && silent_ns >= i128::from(LEASE_NS) {
                self.count.leases += 1;
                let asked =
                    matches!(kind, ProviderEventKind::Request { group: g, .. } if g == group);
                assert!(asked || provider.session(CAV, group).is_none(), "the lease is over");
            }
        }
        match kind {
            ProviderEventKind::Request { group, session, .. }
            | ProviderEventKind::Heard { group, session, .. } => {
                if provider.session(CAV, group) == Some(session) {
                    self.last_heard_ns[place][usize::from(group == Group::Plan)] = self.now_ns;
                }
            }
            ProviderEventKind::Release { .. } | ProviderEventKind::Tick => {}
        }
        self.under_way.extend(reply.map(|reply| match reply {
            Reply::Confirm { group, session, .. } => {
                Message::ToCav(confirm(station, group, session))
            }
            Reply::Reject { group, session, .. } => Message::ToCav(reject(station, group, session)),
        }));
    }

    fn cav_event(&mut self, kind: EventKind) {
        let before = self.cav.clone();
        let actions = self.cav.step(&Event { t_ns: self.now_ns, kind });
        assert!(self.cav.is_valid());
        self.observe(kind, &actions);
        self.message_of_an_ended_session_changes_nothing(&before, kind);
        self.each_group_has_exactly_one_source();
        for action in actions {
            self.under_way.extend(match action {
                Action::Request { station, group, session } => Some(Message::ToProvider(
                    station,
                    ProviderEventKind::Request { requester: CAV, group, session },
                )),
                Action::Release { station, group, session } => Some(Message::ToProvider(
                    station,
                    ProviderEventKind::Release { requester: CAV, group, session },
                )),
                Action::Activate(_) | Action::Deactivate(_) | Action::Drop(_) => None,
            });
        }
    }

    /// Follows from outside what is used and computed, and checks both.
    fn observe(&mut self, kind: EventKind, actions: &[Action]) {
        for (index, group) in Group::ALL.into_iter().enumerate() {
            let seen = &mut self.seen[index];
            if let EventKind::Data { group: of, .. } = kind
                && of == group
                && !actions.contains(&Action::Drop(group))
            {
                self.count.used += 1;
                seen.used = true;
                assert!(
                    self.now_ns >= self.blocked_until_ns,
                    "a result was used before hold_until"
                );
            }
            if actions.contains(&Action::Deactivate(group)) {
                self.count.stopped += 1;
                assert!(seen.local_computes, "stopped twice");
                let safe = matches!(kind, EventKind::Verdict { safe: true, .. });
                assert!(self.profile == Profile::PAPER || (seen.used && safe), "H-08");
                seen.local_computes = false;
            }
            if actions.contains(&Action::Activate(group)) {
                assert!(!seen.local_computes, "started twice");
                seen.local_computes = true;
            }
            match self.cav.state(group) {
                GroupState::Remote { .. } => self.count.remote += 1,
                GroupState::Local | GroupState::Requested { .. } => seen.used = false,
            }
        }
        if let EventKind::Verdict { safe: false, .. } = kind {
            self.count.fallbacks += 1;
            self.blocked_until_ns = self.now_ns + parameters().t_wait_ns;
        }
    }

    /// The services that compute locally and the state agree on one source, and ENV and TPL have
    /// the same.
    fn each_group_has_exactly_one_source(&self) {
        for (index, group) in Group::ALL.into_iter().enumerate() {
            let source = self.cav.source(group);
            assert!(source == Source::Local || self.now_ns >= self.blocked_until_ns, "a hold");
            match source {
                Source::Local => assert!(self.seen[index].local_computes, "no source"),
                Source::Remote { station } => {
                    assert!(!self.seen[index].local_computes, "two sources");
                    let state = self.cav.state(group);
                    assert!(
                        matches!(state, GroupState::Remote { station: on, .. } if on == station)
                    );
                }
            }
        }
        let source = |service: Offloadable| self.cav.source(service.group());
        assert_eq!(source(Offloadable::Env), source(Offloadable::Tpl));
    }

    fn message_of_an_ended_session_changes_nothing(&mut self, before: &Requester, kind: EventKind) {
        let (EventKind::Confirm { group, session, .. }
        | EventKind::Reject { group, session, .. }
        | EventKind::Data { group, session, .. }) = kind
        else {
            return;
        };
        let current = match before.state(group) {
            GroupState::Local => None,
            GroupState::Requested { session, .. } | GroupState::Remote { session, .. } => {
                Some(session)
            }
        };
        if current != Some(session) {
            self.count.stale += 1;
            assert_eq!(*before, self.cav);
        }
    }
}

/// 400 walks of 1,000 steps each in both profiles.
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.1`: each group has exactly one source.
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.2`: after a safety issue no remote
///   result is used, and no source is remote, before `hold_until`.
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.3`: ENV and TPL never differ.
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.5`: sessions end within the lease.
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.6` (H-08).
/// - `spec/2-offloading.md#properties-of-the-whole-protocol.7`: a message of an ended session
///   changes no later one.
#[test]
fn the_properties_hold_with_a_bad_network_failing_providers_and_an_attacker() {
    for profile in PROFILES {
        let mut total = Count::default();
        for seed in 0..400 {
            let mut numbers = Numbers(ChaCha8Rng::seed_from_u64(seed));
            let mut world = World::new(profile);
            for _ in 0..1_000 {
                world.step(&mut numbers);
            }
            total.remote += world.count.remote;
            total.used += world.count.used;
            total.stopped += world.count.stopped;
            total.fallbacks += world.count.fallbacks;
            total.stale += world.count.stale;
            total.leases += world.count.leases;
            the_providers_forget_a_requester_that_is_gone(&mut world);
        }
        for count in
            [total.remote, total.used, total.stopped, total.fallbacks, total.stale, total.leases]
        {
            assert!(count > 100, "the walks hardly tried it");
        }
    }
}

/// A session that a provider still holds ends within the lease, when nothing arrives any more.
fn the_providers_forget_a_requester_that_is_gone(world: &mut World) {
    world.cav_event(UNSAFE);
    for provider in &mut world.providers {
        let t_ns = world.now_ns + LEASE_NS;
        provider.step(&ProviderEvent { t_ns, kind: ProviderEventKind::Tick });
        assert_eq!(provider.load(), 0);
    }
}
