//! Somebody on the broker who makes up sessions, and bytes that are no messages, a hundred times a second.
//!
//! `cargo run --release -p mufasa-link --example forger -- amqp://guest:guest@127.0.0.1:5699 SECONDS`

use std::error::Error;
use std::time::Duration;

use mufasa::services::configuration::Group;
use mufasa_drives::{Options, demo};
use mufasa_link::clock::SharedClock;
use mufasa_link::message::{Message, Payload, encode};
use mufasa_link::play::Played;
use mufasa_link::transport::amqp::Amqp;
use mufasa_link::transport::{Address, Transport};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, url, seconds] = arguments.as_slice() else {
        return Err("give the address of a broker, and for how many seconds".into());
    };
    let rounds = seconds.parse::<u32>()?.saturating_mul(100);
    let frame = Played::new(demo(&Options::default())?.collect()?)?.frame()?;
    let clock = SharedClock::new()?;
    let mut broker = Amqp::new(url, Address::Vehicle(4_294_967_295))?;
    let (vehicle, station) = (Address::Vehicle(1), Address::Station(1));
    for round in 0..rounds {
        let now_ns = clock.now_ns();
        let session = [1, now_ns, i64::MAX][usize::try_from(round % 3)?];
        let of_station = [
            Payload::Confirm { group: Group::Mot, session },
            Payload::Reject { group: Group::Plan, session },
            Payload::Tracks { session, stamp_ns: now_ns, tracks: Vec::new() },
        ];
        for payload in of_station {
            let message = Message { sender: 1, receiver: 1, generated_ns: now_ns, payload };
            broker.send(now_ns, vehicle, encode(&message, &frame)?);
        }
        let release = Payload::Release { group: Group::Mot, session };
        let message = Message { sender: 1, receiver: 1, generated_ns: now_ns, payload: release };
        broker.send(now_ns, station, encode(&message, &frame)?);
        for address in [vehicle, station] {
            let byte = round.to_le_bytes()[0];
            broker.send(now_ns, address, vec![byte; usize::from(byte)]);
        }
        broker.wait(Duration::from_millis(10));
        while broker.receive(now_ns).is_some() {}
    }
    println!("{:?}", broker.health());
    Ok(())
}
