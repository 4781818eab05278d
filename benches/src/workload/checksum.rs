//! The workloads are the published ones, to the bit. `checksums.txt` was made, number by number in the order
//! of `checksum`, of the files that the published `workloads.py` (numpy 2.4, Python 3.11, glibc) wrote; sines and logarithms are the C library's on both sides.

use super::SIZES;
use super::recipe::{Numbers, Object, Size};

struct Fnv(u64);

impl Fnv {
    fn byte(&mut self, byte: u8) {
        self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
    }

    fn numbers(&mut self, values: &[f64]) {
        for byte in values.iter().flat_map(|value| value.to_le_bytes()) {
            self.byte(byte);
        }
    }
}

fn checksum(size: &Size) -> u64 {
    let numbers = Numbers::new(size);
    let mut sum = Fnv(0xCBF2_9CE4_8422_2325);
    for points in [&numbers.reference, &numbers.left, &numbers.right] {
        points.iter().for_each(|point| sum.numbers(point));
    }
    for &(t, arc, pose) in &numbers.trajectory {
        sum.numbers(&[t, arc, pose.x, pose.y, pose.heading]);
    }
    for tracks in [&numbers.tracks, &numbers.ghost, &numbers.drift] {
        for &Object { pose, length, width, velocity: [vx, vy] } in tracks {
            sum.numbers(&[pose.x, pose.y, pose.heading, length, width, vx, vy]);
        }
    }
    for &Object { pose, length, width, .. } in &numbers.detections {
        sum.numbers(&[pose.x, pose.y, pose.heading, length, width]);
    }
    sum.numbers(&numbers.origin);
    sum.numbers(&[numbers.radius]);
    for cells in numbers.occupied.chunks(8) {
        sum.byte(cells.iter().rev().fold(0, |byte, &cell| byte << 1 | u8::from(cell)));
    }
    sum.0
}

#[test]
fn the_workloads_are_the_published_ones() {
    let lines: Vec<String> =
        SIZES.iter().map(|size| format!("W{} {:016x}", size.number, checksum(size))).collect();
    let published = include_str!("../../checksums.txt");
    assert_eq!(lines, published.lines().collect::<Vec<_>>());
}

#[test]
fn the_checksum_sees_a_single_bit() {
    let mut other = Fnv(1);
    let mut sum = Fnv(1);
    sum.numbers(&[1.0]);
    other.numbers(&[f64::from_bits(1.0_f64.to_bits() + 1)]);
    assert_ne!(sum.0, other.0);
}
