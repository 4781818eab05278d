//! A cycle that is written out is read back the same.

use mufasa_model::input::cycle::Cycle;
use mufasa_records::{Record, cycle_to_line, parse};
use serde_json::{Map, Value, json};

use crate::oracle::common::{CYCLE, Random};

const CYCLES: usize = 3_000;
const SEED: u64 = 20_250_711;

fn read(line: &str) -> (String, Box<Cycle>) {
    match parse(line.as_bytes(), 1) {
        Ok(Record::Cycle { id, cycle }) => (id, cycle),
        other => panic!("{line}\n{other:?}"),
    }
}

#[test]
fn a_written_cycle_is_read_back_bit_for_bit() {
    let mut random = Random::new(SEED);
    let example: Value = serde_json::from_str(CYCLE).unwrap();
    for _ in 0..CYCLES {
        let mut record = example.clone();
        let list = record["detections"].clone();
        record["detection_history"] = vec![list; random.below(4)].into();
        changed(&mut random, "", &mut record);
        record["parameters"] = parameters(&mut random);
        grid(&mut random, &mut record["grid"]);
        let (id, cycle) = read(&record.to_string());
        assert_eq!(id, record["id"]);
        let line = cycle_to_line(&id, &cycle);
        assert!(!line.contains('\n'), "{line}");
        // Debug output holds the shortest digits of every double and the sign of zero.
        assert_eq!(format!("{:?}", read(&line)), format!("{:?}", (id, cycle)), "{line}");
    }
}

#[test]
fn doubles_are_written_shortest_and_parameters_at_their_default_left_out() {
    let (id, mut cycle) = read(CYCLE);
    cycle.ego.x = 0.1 + 0.2;
    cycle.ego.y = -0.0;
    cycle.ego.speed = 5.0;
    cycle.ego.length = f64::MAX;
    cycle.ego.width = 1e-7;
    let line = cycle_to_line(&id, &cycle);
    let ego = "\"ego\": {\"x\": 0.30000000000000004, \"y\": -0, \"cos\": 1, \"sin\": 0, \
               \"speed\": 5, \"length\": 1.7976931348623157e308, \"width\": 1e-7,";
    assert!(line.contains(ego), "{line}");
    assert!(line.contains("\"parameters\": {},"));
}

/// Puts any value of its type in the place of each, and other items or none into each list.
fn changed(random: &mut Random, key: &str, value: &mut Value) {
    match value {
        Value::Object(fields) => {
            for (key, field) in fields {
                let may_be_absent = ["trajectory", "tracks", "detections", "lead", "grid"];
                if may_be_absent.contains(&key.as_str()) && random.below(4) == 0 {
                    *field = Value::Null;
                }
                changed(random, key, field);
            }
        }
        Value::Array(items) => {
            if let [Value::Object(first), ..] = items.as_slice() {
                *items = vec![first.clone().into(); random.below(4)];
            }
            items.iter_mut().for_each(|item| changed(random, key, item));
        }
        Value::Bool(bit) => *bit = random.bits() & 1 == 0,
        Value::Number(_) if key == "id" || key.ends_with("_ns") => *value = integer(random).into(),
        Value::Number(_) => *value = float(random),
        Value::String(text) => match key {
            "id" => *text = id(random),
            "profile" => (*random.pick(&["paper", "hardened"])).clone_into(text),
            "configuration" => {
                let all = ["Local", "MotRemote", "AllRemote", "PlanRemote"];
                (*random.pick(&all)).clone_into(text);
            }
            _ => {}
        },
        Value::Null => {}
    }
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        /// Some of them.
        fn parameters(random: &mut Random) -> Value {
            let mut given = Map::new();
            $(if random.bits() & 1 == 0 {
                given.insert(stringify!($name).to_owned(), any!($number)(random).into());
            })*
            given.into()
        }
    };
}

macro_rules! any {
    (f64) => {
        float
    };
    (i64) => {
        integer
    };
}

mufasa_model::parameters!(parameters);

/// A grid whose bitmaps fit its size, as those of every valid cycle do, or one with a size
/// outside the domain.
fn grid(random: &mut Random, grid: &mut Value) {
    use base64::Engine as _;
    if grid.is_null() {
        return;
    }
    let [columns, rows] = [1 + random.below(40), 1 + random.below(40)];
    let mut bitmap = || {
        let bytes: Vec<u8> = (0..(columns * rows).div_ceil(8)).map(|_| random.byte()).collect();
        base64::engine::general_purpose::STANDARD.encode(bytes)
    };
    (grid["occupied"], grid["unknown"]) = (bitmap().into(), bitmap().into());
    if random.below(4) == 0 {
        grid["unknown"] = Value::Null;
    }
    let is_outside = random.below(8) == 0;
    let side = |cells: usize| if is_outside { json!(-1) } else { json!(cells) };
    (grid["width"], grid["height"]) = (side(columns), side(rows));
}

fn integer(random: &mut Random) -> i64 {
    let any = random.bits().cast_signed();
    *random.pick(&[any, any, any >> 40, 0, i64::MIN, i64::MAX])
}

/// Any bits, numbers of ordinary size, and the corners; as a record writes them.
fn float(random: &mut Random) -> Value {
    let bits = random.bits();
    let small = f64::from(u32::try_from(bits >> 32).unwrap()) / 1e6;
    let corners =
        [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, f64::MAX];
    let (any, corner) = (f64::from_bits(bits), *random.pick(&corners));
    let number =
        *random.pick(&[any, any, small, -small, corner, small.trunc(), f64::from_bits(bits >> 12)]);
    match number {
        _ if number.is_nan() => json!("nan"),
        f64::INFINITY => json!("inf"),
        f64::NEG_INFINITY => json!("-inf"),
        _ => json!(number),
    }
}

fn id(random: &mut Random) -> String {
    let characters = ['a', '"', '\\', '\n', '\0', '\u{7f}', '\u{e9}', '\u{2028}', '\u{1f697}'];
    (0..random.below(6)).map(|_| *random.pick(&characters)).collect()
}
