//! Dilated grids: the marks of scipy.ndimage, cell by cell, with radii that meet distances of
//! cell centres exactly.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{
    CrossSection, Cycle, Ego, Grid, Profile, Route, Trajectory, TrajectoryPoint,
};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration;
use mufasa_props::bridge::check_impl;

/// Side of a cell, m: five times a number of cells is the hypotenuse of a 3-4-5 triangle.
const RESOLUTION: f64 = 5.0;

/// Every so many cells the exact model is asked too, at most.
const MODEL_CELLS: usize = 8;

/// A table of whole numbers, row by row.
type Table = Vec<Vec<i64>>;

fn table(name: &str) -> Option<Table> {
    let text = super::read(&format!("morphology/{name}.csv"))?;
    let number = |cell: &str| cell.trim().parse().expect("a whole number");
    Some(text.lines().map(|line| line.split(',').map(number).collect()).collect())
}

#[test]
fn marked_cells_are_those_of_scipy() {
    let mut compared = 0;
    for index in 0..8 {
        let Some(occupied) = table(&format!("g{index}")) else { return };
        for radius in ["1", "1.5", "2", "3.7", "5"] {
            let Some(dilated) = table(&format!("g{index}_dil_r{radius}")) else { return };
            let radius: f64 = radius.parse().expect("a radius");
            compared += compare(&occupied, &dilated, radius);
        }
        let Some(squared) = table(&format!("g{index}_edt2")) else { return };
        let Some(dilated) = table(&format!("g{index}_dil_r5")) else { return };
        for (row, marks) in squared.iter().zip(&dilated) {
            for (square, mark) in row.iter().zip(marks) {
                assert_eq!((0..=25).contains(square), *mark == 1, "the two files disagree");
            }
        }
    }
    println!("{compared} cells of scipy.ndimage");
    assert!(compared > 10_000, "only {compared} cells");
}

/// Asks about every cell; the number of cells.
fn compare(occupied: &Table, dilated: &Table, radius_in_cells: f64) -> usize {
    let mut cycle = cycle(occupied, radius_in_cells);
    let cells = occupied.len() * occupied[0].len();
    let every = cells.div_ceil(MODEL_CELLS);
    for (row, marks) in dilated.iter().enumerate() {
        for (column, mark) in marks.iter().enumerate() {
            let index = row * marks.len() + column;
            stand_in(&mut cycle, column, row);
            let implementation = check_impl(&cycle).expect("valid input");
            let place = format!("column {column}, row {row}, r {radius_in_cells}");
            assert_eq!(implementation.failed_stage.is_some(), *mark == 1, "{place}");
            if index.is_multiple_of(every) {
                let model = check(&cycle, Reading::Exact).expect("valid input");
                assert_eq!(model.failed_stage.is_some(), *mark == 1, "model, {place}");
            }
        }
    }
    cells
}

/// Puts the only disk of the CAV on the centre of a cell.
#[expect(clippy::cast_precision_loss, reason = "columns and rows are few")]
fn stand_in(cycle: &mut Cycle, column: usize, row: usize) {
    let (x, y) = (RESOLUTION * (column as f64 + 0.5), RESOLUTION * (row as f64 + 0.5));
    let point = TrajectoryPoint { t_ns: 0, x, y, cos: 1.0, sin: 0.0 };
    cycle.trajectory = Some(Trajectory { stamp_ns: 0, points: vec![point] });
    let cross_section = |x: f64| CrossSection { x, y, left: [x, y + 1.0], right: [x, y - 1.0] };
    cycle.route = Route {
        closed: false,
        cross_sections: vec![cross_section(x - 1.0), cross_section(x + 1.0)],
    };
}

/// The grid under a CAV with one disk of this radius: sides 3 k and 4 k, so the diagonal is 5 k.
fn cycle(occupied: &Table, radius_in_cells: f64) -> Cycle {
    let (rows, columns) = (occupied.len(), occupied[0].len());
    let mut bitmap = vec![0; (rows * columns).div_ceil(8)];
    for (row, cells) in occupied.iter().enumerate() {
        for (column, cell) in cells.iter().enumerate() {
            if *cell == 1 {
                let bit = row * columns + column;
                bitmap[bit / 8] |= 1 << (bit % 8);
            }
        }
    }
    let k = 2.0 * radius_in_cells * RESOLUTION / 5.0;
    let ego = Ego {
        x: 0.0,
        y: 0.0,
        cos: 1.0,
        sin: 0.0,
        speed: 0.0,
        length: 3.0 * k,
        width: 4.0 * k,
        center_offset: 0.0,
    };
    let parameters = Parameters { n: 1, ..Parameters::default() };
    Cycle {
        profile: Profile::PAPER,
        parameters,
        now_ns: 0,
        configuration: Configuration::MotRemote,
        ego,
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: Vec::new() },
        grid: Some(Grid {
            stamp_ns: 0,
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            resolution: RESOLUTION,
            width: i64::try_from(columns).expect("a small grid"),
            height: i64::try_from(rows).expect("a small grid"),
            occupied: bitmap,
            unknown: None,
        }),
        detection_history: Vec::new(),
    }
}
