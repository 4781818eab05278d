//! What is sent arrives, to within the rounding of `spec/6-link.md#rounding`.

use mufasa_link::message::{decode, encode};

use crate::common::{frame, messages};

#[test]
fn tmp() {
    let frame = frame();
    for message in messages() {
        let bytes = encode(&message, &frame).unwrap();
        let back = decode(&bytes, &frame).unwrap();
        println!(
            "{} bytes {:02x?}\n{message:?}\n{back:?}\n",
            bytes.len(),
            &bytes[..bytes.len().min(40)]
        );
        assert_eq!(encode(&back, &frame).unwrap(), bytes);
    }
}
