//! Every instruction on numbers, compared with what Rust computes, at limits and in between.
#![expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "32 bits of 64")]

use mufasa_compiled::module::Module;
use mufasa_compiled::prove::{END, Trap, prove_export};

type Two<T> = (&'static str, fn(T, T) -> T);
type Compare<T> = (&'static str, fn(T, T) -> bool);

const NUMBERS: [u64; 10] =
    [0, 1, 2, 31, 0x7f, 0x80, 0x7fff_ffff, 0x8000_0000_ffff_8180, 0x7fff_ffff_ffff_ffff, u64::MAX];

const TWO_OF_32: [Two<u32>; 11] = [
    ("add", u32::wrapping_add),
    ("sub", u32::wrapping_sub),
    ("mul", u32::wrapping_mul),
    ("and", |a, b| a & b),
    ("or", |a, b| a | b),
    ("xor", |a, b| a ^ b),
    ("shl", u32::wrapping_shl),
    ("shr_u", u32::wrapping_shr),
    ("shr_s", |a, b| a.cast_signed().wrapping_shr(b).cast_unsigned()),
    ("rotl", |a, b| a.rotate_left(b % 32)),
    ("rotr", |a, b| a.rotate_right(b % 32)),
];

const TWO_OF_64: [Two<u64>; 11] = [
    ("add", u64::wrapping_add),
    ("sub", u64::wrapping_sub),
    ("mul", u64::wrapping_mul),
    ("and", |a, b| a & b),
    ("or", |a, b| a | b),
    ("xor", |a, b| a ^ b),
    ("shl", |a, b| a << (b % 64)),
    ("shr_u", |a, b| a >> (b % 64)),
    ("shr_s", |a, b| (a.cast_signed() >> (b % 64)).cast_unsigned()),
    ("rotl", |a, b| a.rotate_left((b % 64) as u32)),
    ("rotr", |a, b| a.rotate_right((b % 64) as u32)),
];

const COMPARE_32: [Compare<u32>; 10] = [
    ("eq", |a, b| a == b),
    ("ne", |a, b| a != b),
    ("lt_u", |a, b| a < b),
    ("le_u", |a, b| a <= b),
    ("gt_u", |a, b| a > b),
    ("ge_u", |a, b| a >= b),
    ("lt_s", |a, b| a.cast_signed() < b.cast_signed()),
    ("le_s", |a, b| a.cast_signed() <= b.cast_signed()),
    ("gt_s", |a, b| a.cast_signed() > b.cast_signed()),
    ("ge_s", |a, b| a.cast_signed() >= b.cast_signed()),
];

const COMPARE_64: [Compare<u64>; 10] = [
    ("eq", |a, b| a == b),
    ("ne", |a, b| a != b),
    ("lt_u", |a, b| a < b),
    ("le_u", |a, b| a <= b),
    ("gt_u", |a, b| a > b),
    ("ge_u", |a, b| a >= b),
    ("lt_s", |a, b| a.cast_signed() < b.cast_signed()),
    ("le_s", |a, b| a.cast_signed() <= b.cast_signed()),
    ("gt_s", |a, b| a.cast_signed() > b.cast_signed()),
    ("ge_s", |a, b| a.cast_signed() >= b.cast_signed()),
];

/// A check of `(result == expected)` as text.
fn check(kind: &str, call: &str, expected: u64) -> String {
    format!("(if ({kind}.ne {call} ({kind}.const {expected})) (then unreachable))\n")
}

fn checks() -> Vec<String> {
    let mut checks = Vec::new();
    for a in NUMBERS {
        let (low, whole) = (a as u32, a);
        let one = |call: &str| format!("({call} (i64.const {a}))");
        let one_32 = |call: &str| format!("({call} (i32.const {low}))");
        checks.push(check("i32", &one("i32.wrap_i64"), low.into()));
        checks.push(check("i32", &one("i64.eqz"), (a == 0).into()));
        checks.push(check("i32", &one_32("i32.eqz"), (low == 0).into()));
        checks.push(check("i64", &one_32("i64.extend_i32_u"), low.into()));
        let wide = i64::from(low.cast_signed()).cast_unsigned();
        checks.push(check("i64", &one_32("i64.extend_i32_s"), wide));
        let (byte, half) = (a as u8, a as u16);
        let (byte, half) = (i64::from(byte.cast_signed()), i64::from(half.cast_signed()));
        let of = |value: i64| u64::from(value as u32);
        checks.push(check("i32", &one_32("i32.extend8_s"), of(byte)));
        checks.push(check("i32", &one_32("i32.extend16_s"), of(half)));
        checks.push(check("i64", &one("i64.extend8_s"), byte.cast_unsigned()));
        checks.push(check("i64", &one("i64.extend16_s"), half.cast_unsigned()));
        checks.push(check("i64", &one("i64.extend32_s"), wide));
        for b in NUMBERS {
            let (low_b, whole_b) = (b as u32, b);
            let call_32 =
                |name: &str| format!("(i32.{name} (i32.const {low}) (i32.const {low_b}))");
            let call_64 = |name: &str| format!("(i64.{name} (i64.const {a}) (i64.const {b}))");
            for (name, of) in TWO_OF_32 {
                checks.push(check("i32", &call_32(name), of(low, low_b).into()));
            }
            for (name, of) in TWO_OF_64 {
                checks.push(check("i64", &call_64(name), of(whole, whole_b)));
            }
            for (name, of) in COMPARE_32 {
                checks.push(check("i32", &call_32(name), of(low, low_b).into()));
            }
            for (name, of) in COMPARE_64 {
                checks.push(check("i32", &call_64(name), of(whole, whole_b).into()));
            }
        }
    }
    checks
}

fn judge(body: &str) -> Trap {
    let text = format!(
        r#"(module (global (export "__heap_base") i32 (i32.const 0)) (func (export "run") {body}))"#
    );
    let bytes = wat::parse_str(text).expect("WebAssembly");
    let found =
        prove_export(&Module::read(&bytes).expect("a module"), "run", 1000).expect("a judgement");
    assert_eq!(found.reached.contains(&END), found.trap == Trap::Never);
    found.trap
}

#[test]
fn every_instruction_computes_what_rust_does() {
    let checks = checks();
    assert_eq!(judge(&checks.concat()), Trap::Never);
    let wrong = check("i32", "(i32.add (i32.const 1) (i32.const 1))", 3);
    assert!(matches!(judge(&wrong), Trap::At(_)));
}
