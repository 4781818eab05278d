//! Why a message is of no use (MON-09, `.5`, `.8`).

use mufasa::input::cycle::Track;
use mufasa::monitor::{Arrival, DropReason, Inputs, Message, Monitor, Time};
use mufasa::offloading::requester::{Actions, Group, Source};

use crate::kit::{Buffers, MS, World, at, message, road};
use crate::misuse::driven;

/// What is wrong with a message that comes at a time.
type Change = fn(&mut Message<Vec<Track>>, Time);

fn why<L>((arrival, _): &(Arrival<L>, Actions)) -> Option<DropReason> {
    match arrival {
        Arrival::Accepted(_) => None,
        Arrival::Dropped { why } => Some(*why),
    }
}

/// A monitor with both groups remote, and what a station then sends at `now`.
fn answer(
    change: impl FnOnce(&mut Message<Vec<Track>>, Time),
    now: Time,
) -> (Option<DropReason>, bool) {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let station = driven(&mut monitor, 3);
    let session = station.sessions[0].expect("MOT is remote");
    let mut sent = message(session, now, World::at(now.as_nanoseconds()).tracks);
    change(&mut sent, now);
    let arrival = monitor.tracks(now, sent).expect("a station");
    (why(&arrival), monitor.source(Group::Mot) != Source::Local)
}

/// Each reason, and whether MOT stays remote; the last cycle and the last message were at 200 ms. MON-09, MON-30.
#[test]
fn a_message_that_is_dropped_says_why() {
    let earlier = |now: Time, ms: i64| at(now.as_nanoseconds() - ms * MS);
    let now = at(300 * MS);
    let cases: [(&str, Change); 6] = [
        ("as it should be", |_, _| ()),
        ("of another session", |it, _| it.session += 7),
        ("of another station", |it, _| it.station += 1),
        ("from the future", |it, now| {
            it.generated = now.checked_add(std::time::Duration::from_nanos(1)).expect("a time");
        }),
        ("as the last", |it, _| it.generated = at(200 * MS)),
        ("the same, in time", |it, _| it.generated = at(260 * MS)),
    ];
    let found: Vec<_> = cases.iter().map(|(_, change)| answer(change, now)).collect();
    // 100 ms of latency are more than l_max; so it is late before it is not newer.
    let wanted = [
        (None, true),
        (Some(DropReason::OtherSession), true),
        (Some(DropReason::OtherSession), true),
        (Some(DropReason::FromTheFuture), false),
        (Some(DropReason::Late), false),
        (None, true),
    ];
    assert_eq!(found, wanted, "{:?}", cases.map(|(name, _)| name));
    let too_old = answer(|it, now| it.stamp = earlier(now, 101), now);
    assert_eq!(too_old, (Some(DropReason::TooOld), true));
    let late_and_old =
        answer(|it, now| (it.stamp, it.generated) = (earlier(now, 101), earlier(now, 51)), now);
    assert_eq!(late_and_old, (Some(DropReason::Late), false));
    let silent = answer(|_, _| (), at(351 * MS));
    assert_eq!(silent, (Some(DropReason::AfterSilence), false));
    // At 240 ms what was generated at 200 ms is in time.
    let twice = answer(|it, _| it.generated = at(200 * MS), at(240 * MS));
    assert_eq!(twice, (Some(DropReason::NotNewer), true));
}

/// What is stamped ahead of every cycle is accepted until a cycle has found nothing current for more than
/// `dt_max` = 150 ms; from then on it is dropped. MON-32.
#[test]
fn a_message_of_a_starved_group_says_so() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    let mut monitor = buffers.on(&cross_sections);
    let station = driven(&mut monitor, 3);
    let session = station.sessions[0].expect("MOT is remote");
    let mut why_at = |ms: i64| {
        let (now, stamp) = (at(ms * MS), at((ms + 1000) * MS));
        let sent = Message { stamp, ..message(session, now, World::at(ms * MS).tracks) };
        let answer = why(&monitor.tracks(now, sent).expect("a station"));
        let later = at((ms + 10) * MS);
        let own = Inputs::new(later, World::at((ms + 10) * MS).ego);
        let _ends_plan = monitor.tick(later);
        let (decision, _) = monitor.cycle(&own);
        assert!(matches!(decision, mufasa::monitor::Decision::Safe { .. }), "{decision:?}");
        answer
    };
    assert_eq!([300, 341, 400].map(&mut why_at), [None, None, Some(DropReason::Starved)]);
}

/// More tracks than rows were lent are dropped when they come, and no cycle is unsafe by them; a
/// station that goes on so is silent. MON-20.
#[test]
fn a_list_too_long_for_the_lent_memory_is_no_arrival() {
    let cross_sections = road();
    let mut buffers = Buffers::new(16, 40);
    buffers.0.rows.truncate(4);
    let mut monitor = buffers.on(&cross_sections);
    let mut station = driven(&mut monitor, 3);
    let session = station.sessions[0].expect("MOT is remote");
    let send = |monitor: &mut Monitor<'_>, ms: i64, count: usize| {
        let now = at(ms * MS);
        let track = World::at(ms * MS).tracks[0];
        let items: Vec<_> = (0..).map(|id| Track { id, ..track }).take(count).collect();
        why(&monitor.tracks(now, message(session, now, items)).expect("a station"))
    };
    assert_eq!(send(&mut monitor, 210, 4), None);
    assert_eq!(send(&mut monitor, 230, 5), Some(DropReason::TooLong));
    assert_eq!(monitor.source(Group::Mot), Source::Remote { station: 1 });
    let world = World::at(240 * MS);
    let now = at(world.now_ns);
    let own = Inputs::new(now, world.ego).detections(now, &world.detections);
    assert!(monitor.tick(now).is_empty());
    let (decision, _) = monitor.cycle(&own);
    assert!(matches!(decision, mufasa::monitor::Decision::Safe { .. }), "{decision:?}");
    assert_eq!(send(&mut monitor, 360, 5), Some(DropReason::TooLong));
    // 151 ms after the last arrival.
    station.take(&monitor.tick(at(361 * MS)));
    assert_eq!(monitor.source(Group::Mot), Source::Local);
}
