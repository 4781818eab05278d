//! A cycle made smaller: the CAV at the origin, one time, one pair, few cells, round numbers.

use mufasa_model::input::cycle::{Cycle, Grid};
use serde_json::{Value, json};

use crate::cases::question::Question;
use crate::shrink::record::{Case, leaves};

/// When the shrunk cycle is decided, ns.
const NOW_NS: i64 = 1_000_000_000;

/// Where the detection is put, m ahead of the CAV; hence the radius of the field of view.
const RADIUS_M: f64 = 10.0;

/// Beside a threshold, but nearer than the margin of rounding: not on it, m.
const BESIDE_M: f64 = 5e-7;

/// One pass over everything.
pub fn smaller(case: &mut Case<'_>) {
    frame(case);
    one_pair(case);
    times(case);
    cells(case);
    rounded(case);
}

impl Case<'_> {
    /// The cycle that is shrunk.
    pub fn cycle(&self) -> Option<&Cycle> {
        match &self.question {
            Question::Cycle(cycle) => Some(cycle),
            _ => None,
        }
    }

    /// A change that is easier to say of the cycle than of its record.
    pub fn change_cycle(&mut self, change: impl FnOnce(&mut Cycle)) -> bool {
        let Some(mut cycle) = self.cycle().cloned() else { return false };
        change(&mut cycle);
        let changed = Question::Cycle(Box::new(cycle)).record();
        self.change(|record| *record = changed.unwrap_or_default())
    }

    fn number(&self, pointer: &str) -> f64 {
        self.value.pointer(pointer).and_then(Value::as_f64).unwrap_or(f64::NAN)
    }
}

/// Two numbers that belong together: of an object by their names, or the two of a list.
type Names = [&'static str; 2];
const PLACE: Names = ["x", "y"];
const DIRECTION: Names = ["cos", "sin"];
const VELOCITY: Names = ["vx", "vy"];

/// Changes all such pairs. Points of boundaries are lists of two numbers, hence places.
fn pairs(value: &mut Value, names: Names, change: &mut impl FnMut(f64, f64) -> (f64, f64)) {
    let mut at = |a: &Value, b: &Value| {
        let (a, b) = change(a.as_f64()?, b.as_f64()?);
        Some([json!(a), json!(b)])
    };
    match value {
        Value::Array(items) => {
            if let ([a, b], PLACE) = (items.as_slice(), names)
                && let Some(changed) = at(a, b)
            {
                *items = changed.into();
            }
            items.iter_mut().for_each(|item| pairs(item, names, change));
        }
        Value::Object(fields) => {
            if let (Some(a), Some(b)) = (fields.get(names[0]), fields.get(names[1]))
                && let Some(changed) = at(a, b)
            {
                fields.extend(names.map(String::from).into_iter().zip(changed));
            }
            fields.values_mut().for_each(|field| pairs(field, names, change));
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// The CAV at the origin and in the direction of the x axis.
fn frame(case: &mut Case<'_>) {
    let (x, y) = (case.number("/ego/x"), case.number("/ego/y"));
    case.change(|record| pairs(record, PLACE, &mut |px, py| (px - x, py - y)));
    let (cos, sin) = (case.number("/ego/cos"), case.number("/ego/sin"));
    let (x, y) = (case.number("/ego/x"), case.number("/ego/y"));
    let turned = |a: f64, b: f64| (a * cos + b * sin, b * cos - a * sin);
    case.change(|record| {
        pairs(record, PLACE, &mut |px, py| {
            let (a, b) = turned(px - x, py - y);
            (x + a, y + b)
        });
        for names in [DIRECTION, VELOCITY] {
            pairs(record, names, &mut |a, b| turned(a, b));
        }
        (record["ego"]["cos"], record["ego"]["sin"]) = (json!(1.0), json!(0.0));
    });
    for place in leaves(&case.value, |place, _| place.ends_with("/cos")) {
        case.change(|record| {
            let object = place.strip_suffix("/cos").and_then(|it| record.pointer_mut(it));
            if let Some(object) = object {
                (object["cos"], object["sin"]) = (json!(1.0), json!(0.0));
            }
        });
    }
}

/// Taking a pair away moves the mean of the others, so that a cycle at the threshold of stage i
/// would keep them all. Puts the first track so that it alone is at a threshold: of the mean, of a
/// pair's distance, of the field of view.
fn one_pair(case: &mut Case<'_>) {
    let length = |cycle: &Cycle| {
        let tracks = cycle.tracks.as_ref().map_or(0, |list| list.items.len());
        (tracks, cycle.detections.as_ref().map_or(0, |list| list.items.len()))
    };
    let Some(cycle) = case.cycle() else { return };
    if !matches!(length(cycle), (1.., 2..) | (2.., 1..)) {
        return;
    }
    let sides = |threshold_m: f64| {
        [threshold_m, threshold_m + BESIDE_M, threshold_m - BESIDE_M].into_iter()
    };
    let parameters = cycle.parameters.clone();
    // A track that may be missed is at no threshold alone. Of a distance of 1 m doubles know the threshold itself.
    let settings = [parameters.theta_tr, 1.0]
        .into_iter()
        .flat_map(|theta_tr| [(theta_tr, parameters.miss_budget), (theta_tr, 0)]);
    for (theta_tr, miss_budget) in settings {
        let behind = sides(theta_tr).chain(sides(parameters.theta_track_max));
        let behind = behind.map(|distance_m| (RADIUS_M - distance_m, 0.0));
        let border = sides(RADIUS_M).map(|radius_m| (0.0, radius_m));
        for (ahead_m, left_m) in behind.chain(border) {
            let done = case.change_cycle(|cycle| {
                let (x, y) = (cycle.ego.x, cycle.ego.y);
                (cycle.parameters.theta_tr, cycle.parameters.miss_budget) = (theta_tr, miss_budget);
                if let Some(list) = &mut cycle.tracks {
                    list.items.truncate(1);
                    list.items.iter_mut().for_each(|it| (it.x, it.y) = (x + ahead_m, y + left_m));
                }
                if let Some(list) = &mut cycle.detections {
                    list.items.truncate(1);
                    list.items.iter_mut().for_each(|it| (it.x, it.y) = (x + RADIUS_M, y));
                }
            });
            if done {
                return;
            }
        }
    }
}

/// Everything at one time, and trajectory times that are multiples of 100, 10 or 1 ms.
fn times(case: &mut Case<'_>) {
    let ending = |case: &Case<'_>, end| {
        leaves(&case.value, |place, _| place.ends_with(end) && !place.starts_with("/parameters"))
    };
    let all = ending(case, "_ns");
    let now_ns = case.value["now_ns"].as_i64().unwrap_or(NOW_NS);
    let shift = |t_ns: i64| t_ns.saturating_sub(now_ns).saturating_add(NOW_NS);
    case.change_at(&all, |old| old.as_i64().map(|t_ns| json!(shift(t_ns))));
    let now_ns = case.value["now_ns"].clone();
    for place in ending(case, "/stamp_ns") {
        case.put(&place, [now_ns.clone()]);
    }
    let points = ending(case, "/t_ns");
    let round = |t_ns: i64, unit: i64| json!((t_ns / unit).saturating_mul(unit));
    let units = [100_000_000, 10_000_000, 1_000_000];
    units
        .into_iter()
        .any(|unit| case.change_at(&points, |old| old.as_i64().map(|t_ns| round(t_ns, unit))));
}

/// A smaller grid with fewer marked cells.
fn cells(case: &mut Case<'_>) {
    let Some(grid) = case.cycle().and_then(|cycle| cycle.grid.as_ref()) else { return };
    let marked: Vec<usize> = (0..grid.occupied.len()).filter(|i| grid.occupied[*i] != 0).collect();
    for byte in marked {
        for keep in [0, 1, 2, 4, 8, 16, 32, 64, 128] {
            if case.change_cycle(|cycle| {
                if let Some(it) = cycle.grid.as_mut().and_then(|it| it.occupied.get_mut(byte)) {
                    *it &= keep;
                }
            }) {
                break;
            }
        }
    }
    for half in [true, false] {
        while (0..4).any(|side| {
            case.change_cycle(|cycle| {
                if let Some(cut) = cycle.grid.as_ref().and_then(|grid| cropped(grid, side, half)) {
                    cycle.grid = Some(cut);
                }
            })
        }) {}
    }
}

/// The grid without one half, or one row or column, at a side: left, right, below, above.
fn cropped(grid: &Grid, side: usize, half: bool) -> Option<Grid> {
    let (width, height) = (usize::try_from(grid.width).ok()?, usize::try_from(grid.height).ok()?);
    let cells = width.checked_mul(height).filter(|cells| *cells <= 1 << 24)?;
    if grid.occupied.len() != cells.div_ceil(8) {
        return None;
    }
    let across = side < 2;
    let length = if across { width } else { height };
    let cut = if half { length / 2 } else { 1 };
    if cut == 0 || cut >= length {
        return None;
    }
    let (new_width, new_height) =
        if across { (width - cut, height) } else { (width, height - cut) };
    let (left, below) = match side {
        0 => (cut, 0),
        2 => (0, cut),
        _ => (0, 0),
    };
    let copied = |from: &Vec<u8>| {
        let mut bits = vec![0_u8; (new_width * new_height).div_ceil(8)];
        for row in 0..new_height {
            for column in 0..new_width {
                let old = (row + below) * width + column + left;
                let new = row * new_width + column;
                if from.get(old / 8).is_some_and(|byte| byte >> (old % 8) & 1 == 1) {
                    bits[new / 8] |= 1 << (new % 8);
                }
            }
        }
        bits
    };
    let (a, b) = (steps(left) * grid.resolution, steps(below) * grid.resolution);
    Some(Grid {
        x: grid.x + a * grid.cos - b * grid.sin,
        y: grid.y + a * grid.sin + b * grid.cos,
        width: i64::try_from(new_width).ok()?,
        height: i64::try_from(new_height).ok()?,
        occupied: copied(&grid.occupied),
        unknown: grid.unknown.as_ref().map(copied),
        ..grid.clone()
    })
}

#[expect(clippy::cast_precision_loss, reason = "at most 2^24 cells")]
fn steps(cells: usize) -> f64 {
    cells as f64
}

/// Every number that may have a fraction with as few decimals as possible: all at once, then one by
/// one. Parameters keep theirs.
pub fn rounded(case: &mut Case<'_>) {
    const DECIMALS: [i32; 6] = [0, 1, 2, 3, 6, 9];
    let to = |value: f64, decimals: i32| {
        let scale = 10_f64.powi(decimals);
        (value * scale).round() / scale
    };
    let numbers = leaves(&case.value, |place, it| it.is_f64() && !place.starts_with("/parameters"));
    DECIMALS.into_iter().any(|decimals| {
        case.change_at(&numbers, |old| old.as_f64().map(|number| json!(to(number, decimals))))
    });
    for place in numbers {
        let was = case.number(&place);
        let rounder = [0.0].into_iter().chain(DECIMALS.map(|decimals| to(was, decimals)));
        case.put(&place, rounder.filter(|it| it.to_string().len() < was.to_string().len()));
    }
}
