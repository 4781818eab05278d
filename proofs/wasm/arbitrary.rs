//! What a part of the implementation answers where it is replaced by any answer at all
//! (`cfg(arbitrary = "...")`): imports, as the arbitrary values of a harness.
#![no_std]

#[link(wasm_import_module = "env")]
unsafe extern "C" {
    pub safe fn any_below(limit: u32) -> u32;
    pub safe fn any_f64() -> f64;
}
