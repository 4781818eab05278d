//! A cycle made smaller: fewer inputs and objects, the CAV at the origin, round numbers.

use mufasa_model::input::cycle::{Cycle, Grid};
use mufasa_model::input::parameters::Parameters;

use super::Case;
use super::numbers::{directions, numbers, places, stamps, vectors};
use super::pair::pair;

/// When the shrunk cycle is decided, ns.
const NOW_NS: i64 = 1_000_000_000;

/// One pass over everything.
pub fn smaller(case: &mut Case<'_, Cycle>) {
    inputs(case);
    lists(case);
    parameters(case);
    frame(case);
    pair(case);
    times(case);
    cells(case);
    rounded(case);
}

fn inputs(case: &mut Case<'_, Cycle>) {
    case.change(|cycle| cycle.grid = None);
    case.change(|cycle| cycle.previous_tracks = None);
    case.change(|cycle| cycle.lead = None);
    case.change(|cycle| cycle.detections = None);
    case.change(|cycle| cycle.tracks = None);
    case.change(|cycle| cycle.trajectory = None);
    case.change(|cycle| {
        if let Some(grid) = &mut cycle.grid {
            grid.unknown = None;
        }
    });
}

fn lists(case: &mut Case<'_, Cycle>) {
    case.thin(|cycle| cycle.previous_tracks.as_mut().map(|list| &mut list.items));
    case.thin(|cycle| cycle.tracks.as_mut().map(|list| &mut list.items));
    case.thin(|cycle| cycle.detections.as_mut().map(|list| &mut list.items));
    case.thin(|cycle| cycle.trajectory.as_mut().map(|list| &mut list.points));
    case.thin(|cycle| Some(&mut cycle.route.cross_sections));
    case.change(|cycle| cycle.route.closed = false);
}

fn parameters(case: &mut Case<'_, Cycle>) {
    macro_rules! by_default {
        ($($name:ident),*) => {
            let Parameters { $($name),* } = Parameters::default();
            $(case.change(|cycle| cycle.parameters.$name = $name);)*
        };
    }
    if case.change(|cycle| cycle.parameters = Parameters::default()) {
        return;
    }
    by_default!(
        theta_tr,
        theta_map,
        theta_obj,
        a_b,
        safety_time,
        max_age_ns,
        n,
        theta_track_max,
        miss_budget,
        tau,
        a_max,
        start_tolerance,
        v_max,
        step_max_ns,
        theta_velocity,
        work_limit,
        delta
    );
}

/// The CAV at the origin and in the direction of the x axis.
fn frame(case: &mut Case<'_, Cycle>) {
    case.change(|cycle| {
        let (x, y) = (cycle.ego.x, cycle.ego.y);
        for (px, py) in places(cycle) {
            (*px, *py) = (*px - x, *py - y);
        }
    });
    case.change(|cycle| {
        let (cos, sin) = (cycle.ego.cos, cycle.ego.sin);
        let (x, y) = (cycle.ego.x, cycle.ego.y);
        let turned = |a: f64, b: f64| (a * cos + b * sin, b * cos - a * sin);
        for (px, py) in places(cycle) {
            let (a, b) = turned(*px - x, *py - y);
            (*px, *py) = (x + a, y + b);
        }
        for (a, b) in vectors(cycle) {
            (*a, *b) = turned(*a, *b);
        }
        (cycle.ego.cos, cycle.ego.sin) = (1.0, 0.0);
    });
    for index in 0..directions(&mut case.value).len() {
        case.change(|cycle| {
            if let Some((cos, sin)) = directions(cycle).into_iter().nth(index) {
                (*cos, *sin) = (1.0, 0.0);
            }
        });
    }
}

/// Everything at one time, and trajectory times that are multiples of 100, 10 or 1 ms.
fn times(case: &mut Case<'_, Cycle>) {
    case.change(|cycle| {
        let shift = |t_ns: i64| t_ns.saturating_sub(cycle.now_ns).saturating_add(NOW_NS);
        let mut moved = cycle.clone();
        for t_ns in stamps(&mut moved) {
            *t_ns = shift(*t_ns);
        }
        for point in moved.trajectory.iter_mut().flat_map(|list| &mut list.points) {
            point.t_ns = shift(point.t_ns);
        }
        moved.now_ns = NOW_NS;
        *cycle = moved;
    });
    for index in 0..stamps(&mut case.value).len() {
        let now_ns = case.value.now_ns;
        case.change(|cycle| {
            stamps(cycle).into_iter().skip(index).take(1).for_each(|t_ns| *t_ns = now_ns);
        });
    }
    for unit in [100_000_000, 10_000_000, 1_000_000] {
        let done = case.change(|cycle| {
            for point in cycle.trajectory.iter_mut().flat_map(|list| &mut list.points) {
                point.t_ns = (point.t_ns / unit).saturating_mul(unit);
            }
        });
        if done {
            break;
        }
    }
}

/// A smaller grid with fewer marked cells.
fn cells(case: &mut Case<'_, Cycle>) {
    let Some(grid) = &case.value.grid else { return };
    let bytes = grid.occupied.len();
    for byte in 0..bytes {
        if case.value.grid.as_ref().is_none_or(|grid| grid.occupied.iter().all(|it| *it == 0)) {
            break;
        }
        let was = case.value.grid.as_ref().and_then(|grid| grid.occupied.get(byte).copied());
        if was.unwrap_or(0) == 0 {
            continue;
        }
        for keep in [0, 1, 2, 4, 8, 16, 32, 64, 128] {
            let done = case.change(|cycle| {
                if let Some(it) = cycle.grid.as_mut().and_then(|it| it.occupied.get_mut(byte)) {
                    *it &= keep;
                }
            });
            if done {
                break;
            }
        }
    }
    for halves in [true, false] {
        while (0..4).any(|side| {
            case.change(|cycle| {
                if let Some(cut) = cycle.grid.as_ref().and_then(|grid| cropped(grid, side, halves))
                {
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

/// Every number with as few decimals as possible: all at once, then one by one.
fn rounded(case: &mut Case<'_, Cycle>) {
    const DECIMALS: [i32; 6] = [0, 1, 2, 3, 6, 9];
    let to = |value: f64, decimals: i32| {
        let scale = 10_f64.powi(decimals);
        (value * scale).round() / scale
    };
    for decimals in DECIMALS {
        let all = case.change(|cycle| {
            for number in numbers(cycle) {
                *number = to(*number, decimals);
            }
        });
        if all {
            break;
        }
    }
    for index in 0..numbers(&mut case.value).len() {
        let was = *numbers(&mut case.value)[index];
        let simpler = |value: f64| value.to_string().len() < was.to_string().len();
        for value in [0.0].into_iter().chain(DECIMALS.map(|decimals| to(was, decimals))) {
            if simpler(value) && case.change(|cycle| *numbers(cycle)[index] = value) {
                break;
            }
        }
    }
}
