//! Bytes of somebody who means harm: each ends in an error with a name, or in a message that obeys the laws.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use mufasa_link::message::{DecodeError, Frame, decode, encode};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::common::{frame, messages};

/// The name of an error; without a catch-all, so that a new one is counted.
fn kind(error: &DecodeError) -> String {
    match error {
        DecodeError::TooLong { .. } => "too long".to_owned(),
        DecodeError::Malformed { pdu, .. } => format!("malformed {pdu}"),
        DecodeError::Trailing { pdu, .. } => format!("trailing {pdu}"),
        DecodeError::Version { .. } => "version".to_owned(),
        DecodeError::Header { pdu, .. } => format!("header {pdu}"),
        DecodeError::Sender { pdu, .. } => format!("sender {pdu}"),
        DecodeError::Clock { .. } => "clock".to_owned(),
        DecodeError::OtherFrame { .. } => "other frame".to_owned(),
        DecodeError::Missing(_) => "missing".to_owned(),
        DecodeError::OutOfRange(_) => "out of range".to_owned(),
        DecodeError::Unsupported(_) => "unsupported".to_owned(),
        DecodeError::Incomplete { .. } => "incomplete".to_owned(),
    }
}

/// What every decoder owes to any bytes: no panic; what is read can be written, and is read as the same again.
fn outcome(bytes: &[u8], frame: &Frame) -> String {
    match decode(bytes, frame) {
        Err(error) => {
            assert!(!error.to_string().is_empty());
            kind(&error)
        }
        Ok(message) => {
            let again = encode(&message, frame);
            let again = again.unwrap_or_else(|error| panic!("{message:?} is read, but {error}"));
            assert_eq!(decode(&again, frame), Ok(message), "of {bytes:02x?}");
            "read".to_owned()
        }
    }
}

/// A good message, spoiled one to three times.
fn spoiled(good: &[Vec<u8>], rng: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = good[rng.random_range(0..good.len())].clone();
    for _ in 0..rng.random_range(1..=3) {
        let at = rng.random_range(0..=bytes.len());
        let to = rng.random_range(at..=bytes.len());
        match rng.random_range(0..9) {
            // A bit, a byte, a length that claims all there can be.
            0..=2 if at < bytes.len() => bytes[at] ^= 1 << rng.random_range(0..8),
            3 if at < bytes.len() => bytes[at] = rng.random_range(0..=u8::MAX),
            4 => bytes[at..to.min(at + 4)].fill(0xff),
            // A cut, at the end or within.
            5 => bytes.truncate(at),
            6 => drop(bytes.drain(at..to)),
            // A part once more, sometimes too often.
            7 => {
                let part = bytes[at..to].to_vec();
                let times = if rng.random_range(0..10) == 0 { 20_000 } else { 1 };
                let repeated = part.into_iter().cycle().take((to - at) * times).take(50_000);
                bytes.splice(at..at, repeated.collect::<Vec<_>>());
            }
            // The start of one message and the end of another.
            _ => {
                let other = &good[rng.random_range(0..good.len())];
                let from = rng.random_range(0..=other.len());
                bytes.truncate(at);
                bytes.extend_from_slice(&other[from..]);
            }
        }
    }
    bytes
}

fn good() -> Vec<Vec<u8>> {
    messages().iter().map(|message| encode(message, &frame()).unwrap()).collect()
}

/// LINK-20, LINK-21: spoiled messages reach every error there is but `Missing`, of which the tests of
/// the codec have an example of each. `HOSTILE_SECONDS` goes on with other seeds for that long.
#[test]
fn spoiled_messages() {
    let seconds = std::env::var("HOSTILE_SECONDS").ok().and_then(|it| it.parse().ok()).unwrap_or(0);
    let (good, frame) = (good(), frame());
    let end = Instant::now() + Duration::from_secs(seconds);
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for seed in 0.. {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        for _ in 0..100_000 {
            *counts.entry(outcome(&spoiled(&good, &mut rng), &frame)).or_default() += 1;
        }
        if Instant::now() >= end {
            break;
        }
    }
    println!("{counts:#?}");
    // A missing value shifts all bits behind it: what is left is seldom a CPM.
    let reached: Vec<&str> =
        counts.keys().map(String::as_str).filter(|it| *it != "missing").collect();
    let all = [
        "clock",
        "header CAM",
        "header CPM",
        "incomplete",
        "malformed CAM",
        "malformed CPM",
        "malformed message",
        "other frame",
        "out of range",
        "read",
        "sender CAM",
        "sender CPM",
        "too long",
        "trailing CAM",
        "trailing CPM",
        "trailing message",
        "unsupported",
        "version",
    ];
    assert_eq!(reached, all);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    // LINK-22
    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        outcome(&bytes, &frame());
    }

    // LINK-22
    #[test]
    fn any_bytes_after_a_good_start(start in 0..12_usize, bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut whole = good().swap_remove(start);
        whole.truncate(18);
        whole.extend(bytes);
        outcome(&whole, &frame());
    }
}
