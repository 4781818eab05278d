//! What a vehicle says of what changes.

use std::cell::Cell;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use mufasa_drives::{Options, demo};
use mufasa_link::play::Played;
use mufasa_link::run::settings;
use mufasa_link::transport::{Address, Health, Transport};
use mufasa_link::vehicle::Vehicle;
use mufasa_link::vehicle::memory::lent;
use mufasa_link::vehicle::summary::Tally;

use super::world::{MS, START_NS, World};

#[test]
fn a_silence_and_a_fallback_are_said_once_each_with_their_reasons() {
    let disturbances = vec!["cut@4..6"];
    let seen = World { disturbances, inject: vec!["ghost-tracks@8..9"], ..World::default() };
    let said = seen.drive().said;
    let said: Vec<_> = said.iter().map(|(ms, it)| (*ms, it.as_str())).collect();
    let not_confirmed =
        |ms| [(ms, "mot: session left: not confirmed"), (ms, "plan: session left: not confirmed")];
    let own_plan = "Local: control follows the CAV's own plan";
    let copy = "Local: control follows what it followed last, and brakes in time";
    let station = "AllRemote: control follows station 1";
    let expected = [
        &[(0, "the vehicle begins"), (130, "connected"), (130, own_plan)][..],
        &[(730, station)],
        &[(4_130, "mot: session left: silent"), (4_130, "plan: session left: silent")],
        &[(4_130, own_plan)],
        &not_confirmed(4_730),
        &not_confirmed(5_330),
        &not_confirmed(5_930),
        &[(6_130, station)],
        &[(8_130, "plan: session left: silent"), (8_130, "fallback to Local: i failed")],
        &[(8_130, "mot: session left: unsafe"), (8_130, copy), (8_230, own_plan)],
        &[(18_230, station)],
        &[(18_830, "mot: session left: end"), (18_830, "plan: session left: end")],
    ];
    assert_eq!(said, expected.concat());
}

#[test]
fn while_nothing_current_comes_the_last_verified_trajectory_is_followed() {
    let requester = mufasa_model::offloading::requester::Parameters {
        dt_max_ns: 400 * MS,
        ..World::default().requester
    };
    let world = World { disturbances: vec!["cut@4..4.2"], requester, ..World::default() };
    let said = world.drive().said;
    let around = said.iter().filter(|(ms, _)| (3_000..6_000).contains(ms)).cloned();
    let braking = "AllRemote: control follows what it followed last, and brakes in time";
    let again = "AllRemote: control follows station 1";
    let expected = [(4_130, braking.to_owned()), (4_330, again.to_owned())];
    assert_eq!(around.collect::<Vec<_>>(), expected);
}

/// A broker that is lost and back; each look at it is of another cycle.
#[derive(Default)]
struct Broker {
    looks: Cell<u64>,
}

impl Transport for Broker {
    fn send(&mut self, _: i64, _: Address, _: Vec<u8>) {}

    fn receive(&mut self, _: i64) -> Option<Vec<u8>> {
        None
    }

    fn wait(&mut self, _: Duration) {}

    fn health(&self) -> Health {
        let look = self.looks.replace(self.looks.get() + 1);
        let (connected, connections) = [(false, 0), (true, 1), (true, 1), (false, 1), (true, 3)]
            [usize::try_from(look.min(4)).expect("small")];
        let last_error = (look > 2).then(|| "reset".to_owned());
        Health { connected, shed: 0, connections, last_error }
    }
}

#[test]
fn a_broker_that_is_lost_and_back_is_said() {
    let played = Played::new(demo(&Options::default()).unwrap().collect().unwrap()).unwrap();
    let (mut lent, mut broker) = (lent(&played), Broker::default());
    let said = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&said);
    let mut tally = Tally::heard_by(Box::new(move |entry| {
        heard.lock().unwrap().extend(entry.what.change());
    }));
    let settings = settings(&played, &World::default().requester);
    let vehicle = Vehicle::new(1, START_NS, &played, settings, &mut lent, &mut broker, &mut tally);
    let mut vehicle = vehicle.unwrap();
    for ms in 0..800 {
        vehicle.step(START_NS + ms * MS).unwrap();
    }
    let of_link = |it: &String| it.contains("connected");
    let said: Vec<String> = said.lock().unwrap().iter().filter(|it| of_link(it)).cloned().collect();
    assert_eq!(
        said,
        [
            "not connected, and tried again: no answer yet",
            "connected",
            "not connected, and tried again: reset",
            "connected again",
        ]
    );
}
