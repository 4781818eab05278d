//! Items of Python as those of `mufasa`: named tuples, dataclasses, mappings, rows of numbers, arrays.
//! An array is anything with `dtype` and `tolist`, so that numpy need not be here.

use mufasa::input::cycle::{CrossSection, Detection, Ego, Track, TrajectoryPoint};
use mufasa_model::report::InvalidInput;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyList, PyMapping, PyTuple};

/// A type with named numbers, which are the columns of a row.
pub trait Columns: Sized {
    /// Each name, and how many numbers it stands for.
    const COLUMNS: &'static [(&'static str, usize)];

    /// From the cells of an item.
    fn read(cells: &Cells<'_, '_>) -> Result<Self, InvalidInput>;
}

macro_rules! width {
    (pair) => {
        2
    };
    ($number:ident) => {
        1
    };
}

macro_rules! columns {
    ($($type:ident { $($name:ident: $kind:ident),* })*) => {$(
        impl Columns for $type {
            const COLUMNS: &'static [(&'static str, usize)] =
                &[$((stringify!($name), width!($kind))),*];

            fn read(cells: &Cells<'_, '_>) -> Result<Self, InvalidInput> {
                Ok(Self { $($name: cells.$kind(stringify!($name))?),* })
            }
        }
    )*};
}

columns! {
    Ego {
        x: number, y: number, cos: number, sin: number, speed: number, length: number,
        width: number, center_offset: number
    }
    Track {
        id: integer, x: number, y: number, cos: number, sin: number, vx: number, vy: number,
        length: number, width: number
    }
    Detection {
        x: number, y: number, cos: number, sin: number, length: number, width: number
    }
    TrajectoryPoint { t_ns: integer, x: number, y: number, cos: number, sin: number }
    CrossSection { x: number, y: number, left: pair, right: pair }
}

/// The items of a list or an array. `field`: its dotted path.
pub fn list<T: Columns>(value: &Bound<'_, PyAny>, field: &str) -> Result<Vec<T>, InvalidInput> {
    let wrong = |what: &str, error: PyErr| InvalidInput {
        field: field.to_owned(),
        index: None,
        message: format!("{what}: {error}"),
    };
    let rows = by_place::<T>(value, field, None)?;
    let rows = rows.try_iter().map_err(|error| wrong("must be a list or an array", error))?;
    let mut items = Vec::new();
    for (index, row) in rows.enumerate() {
        let row = row.map_err(|error| wrong("cannot be read", error))?;
        items.push(T::read(&Cells::of::<T>(&row, field, Some(index))?)?);
    }
    Ok(items)
}

/// An item that is in no list.
pub fn item<T: Columns>(value: &Bound<'_, PyAny>, field: &str) -> Result<T, InvalidInput> {
    T::read(&Cells::of::<T>(value, field, None)?)
}

/// What an array holds as lists and tuples, of a structured one the columns by their names; anything
/// else as it is.
fn by_place<'py, T: Columns>(
    value: &Bound<'py, PyAny>,
    field: &str,
    index: Option<usize>,
) -> Result<Bound<'py, PyAny>, InvalidInput> {
    let Ok(dtype) = value.getattr("dtype") else { return Ok(value.clone()) };
    let wrong = |field: String, message: String| InvalidInput { field, index, message };
    let all = |error: PyErr| wrong(field.to_owned(), format!("cannot be read: {error}"));
    let names = dtype.getattr("names").map_err(all)?;
    let mut array = value.clone();
    if !names.is_none() {
        let columns: Vec<&str> = T::COLUMNS.iter().map(|(name, _)| *name).collect();
        for name in &columns {
            if !names.contains(*name).map_err(all)? {
                return Err(wrong(format!("{field}.{name}"), String::from("is missing")));
            }
        }
        array = value.get_item(columns).map_err(all)?;
    }
    array.call_method0("tolist").map_err(all)
}

/// One cell, or a list of those that belong together.
fn narrow<'c, 'py: 'c>(
    mut cells: impl ExactSizeIterator<Item = &'c Bound<'py, PyAny>>,
) -> Option<Bound<'py, PyAny>> {
    let first = cells.next()?;
    if cells.len() == 0 {
        return Some(first.clone());
    }
    let together: Vec<_> = std::iter::once(first).chain(cells).collect();
    PyList::new(first.py(), together).ok().map(Bound::into_any)
}

/// The numbers of one item.
pub struct Cells<'py, 'f> {
    form: Form<'py>,
    field: &'f str,
    index: Option<usize>,
}

enum Form<'py> {
    Mapping(Bound<'py, PyMapping>),
    Object(Bound<'py, PyAny>),
    Row { cells: Vec<Bound<'py, PyAny>>, columns: &'static [(&'static str, usize)], is_flat: bool },
}

impl<'py, 'f> Cells<'py, 'f> {
    fn of<T: Columns>(
        value: &Bound<'py, PyAny>,
        field: &'f str,
        index: Option<usize>,
    ) -> Result<Self, InvalidInput> {
        let value = by_place::<T>(value, field, index)?;
        let is_named =
            value.is_instance_of::<PyTuple>() && value.hasattr("_fields").unwrap_or(false);
        let form = if let Ok(mapping) = value.cast::<PyMapping>() {
            Form::Mapping(mapping.clone())
        } else if is_named
            || !(value.is_instance_of::<PyTuple>() || value.is_instance_of::<PyList>())
        {
            Form::Object(value)
        } else {
            let all = |message| InvalidInput { field: field.to_owned(), index, message };
            let cells: Vec<Bound<'py, PyAny>> =
                value.extract().map_err(|error: PyErr| all(format!("cannot be read: {error}")))?;
            let columns = T::COLUMNS;
            let flat: usize = columns.iter().map(|(_, width)| width).sum();
            if cells.len() != columns.len() && cells.len() != flat {
                let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
                let (names, found) = (names.join(", "), cells.len());
                return Err(all(format!("must have {flat} columns ({names}), not {found}")));
            }
            Form::Row { is_flat: cells.len() == flat, cells, columns }
        };
        Ok(Self { form, field, index })
    }

    fn integer(&self, name: &str) -> Result<i64, InvalidInput> {
        const EXACT: f64 = 9_007_199_254_740_992.0;
        let cell = self.cell(name)?;
        // Arrays of doubles hold whole numbers, too; beyond 2^53 not each of them.
        let whole = |number: f64| {
            #[allow(clippy::cast_possible_truncation, reason = "a whole number within 53 bits")]
            let integer = number as i64;
            (number.abs() <= EXACT && number.fract().abs() <= 0.0).then_some(integer)
        };
        let found = if cell.is_instance_of::<PyBool>() { None } else { cell.extract::<i64>().ok() };
        found.or_else(|| double(&cell).and_then(whole)).ok_or_else(|| {
            self.wrong(name, &cell, "an integer of 64 bits (as a double at most 2^53)")
        })
    }

    fn number(&self, name: &str) -> Result<f64, InvalidInput> {
        let cell = self.cell(name)?;
        double(&cell).ok_or_else(|| self.wrong(name, &cell, "a number"))
    }

    fn pair(&self, name: &str) -> Result<[f64; 2], InvalidInput> {
        let cell = self.cell(name)?;
        let pair: Option<[Bound<'py, PyAny>; 2]> = cell.extract().ok();
        let [first, second] = pair.unwrap_or_else(|| [cell.clone(), cell.clone()]);
        match (double(&first), double(&second)) {
            (Some(first), Some(second)) => Ok([first, second]),
            _ => Err(self.wrong(name, &cell, "two numbers")),
        }
    }

    fn cell(&self, name: &str) -> Result<Bound<'py, PyAny>, InvalidInput> {
        let found = match &self.form {
            Form::Mapping(mapping) => mapping.get_item(name).ok(),
            Form::Object(object) => object.getattr(name).ok(),
            Form::Row { cells, columns, is_flat } => {
                let at = columns.iter().position(|(column, _)| *column == name).unwrap_or(0);
                let before = columns.iter().take(at);
                match (is_flat, columns.get(at)) {
                    (true, Some((_, width))) => {
                        let first = before.map(|(_, width)| width).sum();
                        narrow(cells.iter().skip(first).take(*width))
                    }
                    _ => cells.get(at).cloned(),
                }
            }
        };
        found.ok_or_else(|| self.at(name, String::from("is missing")))
    }

    fn wrong(&self, name: &str, cell: &Bound<'py, PyAny>, wanted: &str) -> InvalidInput {
        let found = cell.repr().map_or_else(|error| error.to_string(), |text| text.to_string());
        let found = mufasa_records::shown(&found);
        self.at(name, format!("must be {wanted}, not {found}"))
    }

    fn at(&self, name: &str, message: String) -> InvalidInput {
        let Self { field, index, .. } = *self;
        InvalidInput { field: format!("{field}.{name}"), index, message }
    }
}

/// No truth value is a number.
fn double(cell: &Bound<'_, PyAny>) -> Option<f64> {
    if cell.is_instance_of::<PyBool>() { None } else { cell.extract().ok() }
}
