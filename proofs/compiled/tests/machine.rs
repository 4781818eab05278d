//! Small modules of which it is known what they do.

use mufasa_compiled::module::Module;
use mufasa_compiled::prove::{END, Found, Trap, prove_export};

/// The judgement on a body that may draw, assume and cover, with 64 bytes of memory in use.
fn judge(body: &str) -> Found {
    let text = format!(
        r#"(module
        (import "env" "any_u64" (func $any (result i64)))
        (import "env" "any_below" (func $below (param i32) (result i32)))
        (import "env" "assume_that" (func $assume (param i32)))
        (import "env" "cover_that" (func $cover (param i32 i32)))
        (memory 1)
        (global (export "__heap_base") i32 (i32.const 64))
        (data (i32.const 8) "\01\02\03\04\05\06\07\08")
        (func $double (param i64) (result i64) (i64.add (local.get 0) (local.get 0)))
        (func $count (param i32) (result i32) (local i32)
          (loop $again
            (local.set 1 (i32.add (local.get 1) (i32.const 1)))
            (br_if $again (i32.lt_u (local.get 1) (local.get 0))))
          (local.get 1))
        (func (export "run") (local $x i64) (local $y i64) (local $i i32) {body}))"#
    );
    let bytes = wat::parse_str(text).expect("WebAssembly");
    prove_export(&Module::read(&bytes).expect("a module"), "run", 10_000).expect("a judgement")
}

fn assert_proved(body: &str) {
    let found = judge(body);
    assert_eq!(found.trap, Trap::Never, "{body}");
    assert!(found.reached.contains(&END), "{body}");
}

fn assert_refuted(body: &str) {
    assert!(matches!(judge(body).trap, Trap::At(_)), "{body}");
}

/// Traps unless the condition holds.
fn must(condition: &str) -> String {
    format!("(if (i32.eqz {condition}) (then unreachable))")
}

#[test]
fn what_always_holds_is_proved_and_what_does_not_is_refuted() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    let draw = "(local.set $x (call $any))";
    let all = must("(i64.eq (call $double (local.get $x)) (i64.shl (local.get $x) (i64.const 1)))");
    let but_one = must("(i64.ne (local.get $x) (i64.const 0x123456789))");
    assert_proved(&format!("{draw} {all}"));
    assert_refuted(&format!("{draw} {but_one}"));
    let assumed = "(call $assume (i64.lt_u (local.get $x) (i64.const 0x123456789)))";
    assert_proved(&format!("{draw} {assumed} {but_one}"));
    assert_refuted(&format!("{draw} {but_one} {assumed}"));
}

#[test]
fn a_number_below_a_limit_is_any_of_them() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    let draw = "(local.set $i (call $below (i32.const 5)))";
    for number in 0..5 {
        assert_refuted(&format!(
            "{draw} {}",
            must(&format!("(i32.ne (local.get $i) (i32.const {number}))"))
        ));
    }
    assert_proved(&format!("{draw} {}", must("(i32.lt_u (local.get $i) (i32.const 5))")));
    assert!(judge("(drop (call $below (i32.const 0)))").reached.is_empty());
}

#[test]
fn what_cannot_be_is_not_reached() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    let cover =
        |number: u32, condition: &str| format!("(call $cover (i32.const {number}) {condition})");
    let small = cover(7, "(i64.lt_u (local.get $x) (i64.const 3))");
    let none = cover(8, "(i64.gt_u (local.get $x) (i64.const 9))");
    let assumed =
        "(local.set $x (call $any)) (call $assume (i64.lt_u (local.get $x) (i64.const 9)))";
    assert_eq!(judge(&format!("{assumed} {small} {none}")).reached, [END, 7]);
    let nothing = judge("(call $assume (i32.const 0)) unreachable");
    assert_eq!((nothing.trap, nothing.reached), (Trap::Never, vec![]));
}

#[test]
fn branches_come_together_with_the_values_of_each() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    // The sum of two choices, by blocks, an if with a value, and a table.
    let body = |sum: i64| {
        format!(
            "(local.set $x (call $any))
            (block $out (block $two (block $one
              (br_table $one $two $out (i32.wrap_i64 (local.get $x))))
              (local.set $y (i64.const 10)) (br $out))
              (local.set $y (i64.const 20)))
            (local.set $y (i64.add (local.get $y)
              (if (result i64) (i64.eqz (call $any)) (then (i64.const 1)) (else (i64.const 2)))))
            {}",
            must(&format!("(i64.ne (local.get $y) (i64.const {sum}))"))
        )
    };
    for sum in [1, 2, 11, 12, 21, 22] {
        assert_refuted(&body(sum));
    }
    for sum in [0, 3, 10, 20, 23, 31] {
        assert_proved(&body(sum));
    }
}

#[test]
fn loops_end_where_they_do() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    let rounds = |most: u32, must: &str| {
        format!(
            "(local.set $x (call $any)) (call $assume (i64.le_u (local.get $x) (i64.const {most})))
            (local.set $i (call $count (i32.wrap_i64 (local.get $x)))) {must}"
        )
    };
    let small = must("(i32.lt_u (local.get $i) (i32.const 20))");
    assert_proved(&rounds(19, &small));
    assert_refuted(&rounds(20, &small));
    let same = must("(i64.eq (i64.extend_i32_u (local.get $i)) (local.get $x))");
    // It counts to 1 at least.
    assert_refuted(&rounds(5, &same));
    let drawn = "(call $assume (i64.ne (local.get $x) (i64.const 0)))";
    assert_proved(&rounds(5, &format!("{drawn} {same}")));
}

/// So many rounds that the machine asks whether there is another one.
#[test]
fn a_long_loop_is_left_when_it_cannot_go_on() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    // By steps of 2 from 0 to the number drawn, which is even.
    let body = |most: u32, must: &str| {
        format!(
            "(local.set $x (i64.shl (call $any) (i64.const 1)))
            (call $assume (i64.le_u (local.get $x) (i64.const {most})))
            (block $out (loop $again
              (br_if $out (i64.eq (local.get $y) (local.get $x)))
              (local.set $y (i64.add (local.get $y) (i64.const 2)))
              (br $again)))
            {must}"
        )
    };
    let same = must("(i64.eq (local.get $y) (local.get $x))");
    assert_proved(&body(40, &same));
    let below = must("(i64.lt_u (local.get $y) (i64.const 500))");
    assert_proved(&body(498, &below));
    assert_refuted(&body(500, &below));
}

#[test]
fn a_loop_without_end_is_no_proof() {
    let text = r#"(module
        (global (export "__heap_base") i32 (i32.const 0))
        (func (export "run") (loop $again (br $again))))"#;
    let bytes = wat::parse_str(text).expect("WebAssembly");
    let judged = prove_export(&Module::read(&bytes).expect("a module"), "run", 1000);
    assert_eq!(judged, Err("50000000 instructions".to_owned()));
}

#[test]
fn memory_holds_what_was_stored_last() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    // Any of eight places, each a byte, and what stands there at first.
    let store = "(local.set $x (call $any)) (local.set $y (call $any))
        (call $assume (i64.lt_u (local.get $x) (i64.const 8)))
        (i64.store8 offset=8 (i32.wrap_i64 (local.get $x)) (local.get $y))";
    let load = |offset: u32| format!("(i64.load8_u offset={offset} (i32.wrap_i64 (local.get $x)))");
    let written = must(&format!("(i64.eq {} (i64.and (local.get $y) (i64.const 255)))", load(8)));
    assert_proved(&format!("{store} {written}"));
    let first = must("(i32.eq (i32.load8_u (i32.const 8)) (i32.const 1))");
    assert_refuted(&format!("{store} {first}"));
    let elsewhere = "(call $assume (i64.ne (local.get $x) (i64.const 0)))";
    assert_proved(&format!("{store} {elsewhere} {first}"));
    let word = must("(i64.eq (i64.load (i32.const 8)) (i64.const 0x0807060504030201))");
    assert_proved(&word);
    assert_refuted(&format!("{store} {word}"));
    let signed = must("(i32.eq (i32.load16_s (i32.const 20)) (i32.const -2))");
    assert_proved(&format!("(i32.store16 (i32.const 20) (i32.const 0xfffe)) {signed}"));
}

#[test]
fn an_access_outside_of_memory_is_a_trap() {
    if mufasa_z3::version().is_none() {
        eprintln!("NOT RUN: z3 is not installed");
        return;
    }
    assert_proved("(drop (i32.load (i32.const 60)))");
    assert_refuted("(drop (i32.load (i32.const 61)))");
    assert_refuted("(i32.store8 offset=4294967295 (i32.const 1) (i32.const 0))");
    let drawn = |limit: u32| {
        format!(
            "(local.set $i (i32.wrap_i64 (call $any)))
            (call $assume (i32.lt_u (local.get $i) (i32.const {limit})))
            (i64.store offset=50 (local.get $i) (i64.const 1))"
        )
    };
    assert_proved(&drawn(7));
    assert_refuted(&drawn(8));
}
