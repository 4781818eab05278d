//! The decoder of the link takes any bytes behind the start of a good message; what is read can be written, and is read
//! as the same again.
#![no_main]

use mufasa_link::message::{decode, encode};

#[path = "../../../link/tests/codec/common.rs"]
mod common;

libfuzzer_sys::fuzz_target!(|input: (u8, u8, &[u8])| {
    let (kind, kept, bytes) = input;
    let (messages, frame) = (common::messages(), common::frame());
    let mut whole = encode(&messages[usize::from(kind) % messages.len()], &frame).unwrap();
    whole.truncate(kept.into());
    whole.extend(bytes);
    if let Ok(message) = decode(&whole, &frame) {
        assert_eq!(decode(&encode(&message, &frame).unwrap(), &frame), Ok(message));
    }
});
