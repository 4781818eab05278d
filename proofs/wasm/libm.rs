//! `libm` where `expected.toml` names it among the parts that answer anything: any root and any whole
//! number, also none.
#![no_std]

pub fn sqrt(_value: f64) -> f64 {
    arbitrary::any_f64()
}

pub fn floor(_value: f64) -> f64 {
    arbitrary::any_f64()
}
