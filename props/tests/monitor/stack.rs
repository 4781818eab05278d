//! The stack that a monitor needs (`impl/src/monitor/memory.rs`).

use std::thread;

use mufasa::input::cycle::Track;
use mufasa::monitor::{Arrival, Decision, Inputs};

use crate::kit::{Buffers, MS, World, at, message, road};
use crate::misuse::driven;

/// Bytes. A thread that needs more ends the whole test by a signal.
const STACK: usize = 40 << 10;

/// Making a monitor, its events and its cycles with long lists, all in a thread with so much stack.
#[test]
fn a_monitor_fits_into_a_stack_of_40_kib() {
    // On the heap, as far as it is not the monitor's.
    let cross_sections = road();
    let world = World::at(300 * MS);
    let near = world.tracks[0];
    // Beside the road, far from each other.
    let far = (1..900_i32).map(|i| Track {
        id: 1000 + i64::from(i),
        y: 60.0 + 8.0 * f64::from(i),
        ..near
    });
    let tracks: Vec<Track> = world.tracks.iter().copied().chain(far).collect();
    let run = move || {
        let mut buffers = Buffers::new(2048, cross_sections.len());
        let mut monitor = buffers.on(&cross_sections);
        let station = driven(&mut monitor, 3);
        let session = station.sessions[0].expect("MOT is remote");
        let now = at(world.now_ns);
        let _actions = monitor.tick(now);
        let arrival = monitor.tracks(now, message(session, now, tracks)).expect("a station");
        let (Arrival::Accepted(tracks), _) = arrival else { panic!("{arrival:?}") };
        let own = Inputs::new(now, world.ego).detections(now, &world.detections);
        match monitor.cycle(&own.remote_tracks(&tracks)).0 {
            Decision::Safe { tracks, .. } => tracks.map(|list| list.items.len()),
            Decision::Unsafe { report, .. } => panic!("{report:?}"),
        }
    };
    let thread = thread::Builder::new().stack_size(STACK).spawn(run).expect("a thread");
    assert!(thread.join().expect("a cycle") > Some(900));
}
