//! Attacks on time: what they change on the link, and what ends them.

use mufasa::offloading::requester::Parameters;
use mufasa::services::configuration::{Group, Groups};
use mufasa_link::message::{self, Frame, Message, Payload};
use mufasa_sim::attack::{Attack, Attacker, Kind};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::cav::sensing::ego;
use mufasa_sim::ids;
use mufasa_sim::map::streets::town;
use mufasa_sim::radio::{self, Radio, To};
use mufasa_sim::run::{Cycle, Watcher};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::services::detectors::Errors;
use mufasa_sim::snapshot::Snapshot;
use mufasa_sim::station::Station;
use mufasa_sim::world::World;

use super::digest::{FROM, drive};

/// A message of the station with results: its arrival, when it says that it was generated, what it is of, all
/// ns, and the message.
type Result = (i64, i64, i64, Message);

/// What arrives of the results of a station that is asked for both groups and told nothing but the CAV's place.
fn results(kind: Option<Kind>) -> Vec<Result> {
    let town = town();
    let index = town.ego_routes().next().expect("a route");
    let world = World::new(&town, &Scenario::draw(&town, index, 4, 0), 0);
    let (route, truth) = (world.route(), world.snapshot());
    let own = ego(&truth, world.body());
    let frame = Frame::new(484_000_000, 99_500_000, [own.x, own.y]).expect("a frame");
    let mut station = Station::new((&town, route), frame, Groups::ALL, (0, Errors::default()));
    let mut radio = Radio::new(radio::Settings { loss: 0.0, ..radio::Settings::default() }, 0);
    let attack = |kind| Attack::new(kind, 0.0, 100.0, 0);
    let mut attacker = Attacker::new(kind.map(attack).into_iter().collect(), None);
    attacker.look(0, &truth);
    let detections = Payload::Detections { stamp_ns: 0, ego: own, detections: Vec::new() };
    let requests = Group::ALL.map(|group| Payload::Request { group, session: 7 });
    for payload in requests.into_iter().chain([detections]) {
        let (sender, receiver, generated_ns) = (ids::CAV, ids::STATION, 0);
        let sent = Message { sender, receiver, generated_ns, payload };
        let bytes = message::encode(&sent, &frame).expect("it can be written");
        station.take(10_000_000, &bytes, &mut attacker, &mut radio);
    }
    let mut all = Vec::new();
    while let Some((arrival_ns, to, bytes)) = radio.receive(10_000_000_000) {
        assert_eq!(to, To::Vehicle);
        let message = message::decode(&bytes, &frame).expect("it can be read");
        let (Payload::Tracks { stamp_ns, .. } | Payload::Trajectory { stamp_ns, .. }) =
            message.payload
        else {
            continue;
        };
        all.push((arrival_ns, message.generated_ns, stamp_ns, message));
    }
    all
}

#[test]
fn each_attack_on_time_changes_its_own_time_on_the_link_alone() {
    let clean = results(None);
    assert_eq!(clean.len(), 2, "tracks and a trajectory");
    let l_max_ns = Parameters::default().l_max_ns;
    assert!(clean.iter().all(|it| it.0 - it.1 < l_max_ns), "{clean:?}");
    assert_eq!(results(Some(Kind::Silent)), []);
    // How much later each arrives, is generated, and is stamped, ns.
    for (kind, late) in [
        (Kind::Delay, [30_000_000, 30_000_000, 0]),
        (Kind::HeldBack, [100_000_000, 0, 0]),
        (Kind::StampsAhead, [0, 0, 1_000_000_000]),
    ] {
        let attacked = results(Some(kind));
        assert_eq!(attacked.len(), 2, "{}", kind.name());
        for (was, is) in clean.iter().zip(&attacked) {
            assert_eq!([is.0 - was.0, is.1 - was.1, is.2 - was.2], late, "{}", kind.name());
            // The latency that is measured says nothing of a delay, and is above its limit where it is late.
            assert_eq!(is.0 - is.1 > l_max_ns, kind == Kind::HeldBack, "{}", kind.name());
            // Nothing else of the message is another.
            let mut same = is.3.clone();
            same.generated_ns = was.1;
            if let Payload::Tracks { stamp_ns, .. } | Payload::Trajectory { stamp_ns, .. } =
                &mut same.payload
            {
                *stamp_ns = was.2;
            }
            assert_eq!(same, was.3, "{}", kind.name());
        }
    }
}

#[derive(Default)]
struct Cycles(Vec<(Cycle, u64)>);

impl Watcher for Cycles {
    fn cycle(&mut self, _: &Snapshot, cav: &Cav<'_>, _: &Decided, cycle: &Cycle) {
        self.0.push((*cycle, cav.counts.ended));
    }
}

/// Of the cycles from 1 s after the attack's start: those with something remote, sessions that ended other than by a
/// verdict, and where cycles failed.
fn seen(variant: Variant, kind: Option<Kind>, scenario: (usize, u64)) -> (f64, u64, Vec<u8>) {
    let (_, Cycles(cycles)) = drive::<Cycles>(variant, kind, scenario, 20.0);
    let before = cycles.iter().rfind(|it| it.0.t < FROM).expect("a cycle").1;
    let from: Vec<_> = cycles.iter().filter(|it| it.0.t >= FROM + 1.0).collect();
    let remote = from.iter().filter(|it| it.0.remote != 0).count();
    let failed = from.iter().filter(|it| it.0.failed != 0);
    let ended = from.last().expect("a cycle").1 - before;
    (remote as f64 / from.len() as f64, ended, failed.map(|it| it.0.failed).collect())
}

/// No stage finds what is late or silent. What is stamped ahead by 1 s is current a second later, once, if its session
/// has not ended by then: stage i looks at it.
#[test]
fn quality_of_service_ends_what_is_late_or_silent_and_the_monitor_what_is_stamped_ahead() {
    for scenario in [(0, 0), (1, 1)] {
        for variant in Variant::ALL {
            let (clean, ..) = seen(variant, None, scenario);
            assert!(clean > 0.9, "{variant:?} {scenario:?}: {clean}");
            for kind in [Kind::HeldBack, Kind::Silent, Kind::StampsAhead] {
                let (remote, ended, failed) = seen(variant, Some(kind), scenario);
                let at = format!("{variant:?} {} {scenario:?}", kind.name());
                println!("{at}: {:.0} %, {ended} ended, failed {failed:?}", 100.0 * remote);
                let most: &[u8] = if kind == Kind::StampsAhead { &[1] } else { &[] };
                assert!(failed.is_empty() || failed == most, "{at}: {failed:?}");
                match (variant, kind) {
                    // SOFOF asks no stamp.
                    (Variant::Sofof, Kind::StampsAhead) => {
                        assert!(remote > 0.9 && ended == 0, "{at}");
                    }
                    // It asks again at once; the monitor waits (F-43).
                    (Variant::Sofof, _) => assert!(remote < 0.7 && ended > 50, "{at}"),
                    _ => assert!(remote < 0.11 && ended > 2, "{at}"),
                }
            }
        }
    }
}
