//! The harnesses as WebAssembly for CBMC: every arbitrary value, assumption and cover is an import
//! that `driver.c` gives a meaning to; a panic is a trap. Built by `scripts/prove-wasm` with
//! Rust 1.85; no member of the workspace, because the imports need `unsafe`.
#![no_std]

#[path = "../src/harness/mod.rs"]
mod harness;
#[path = "../src/law/mod.rs"]
mod law;

/// What the harnesses use of Kani.
pub mod kani {
    mod import {
        #[link(wasm_import_module = "env")]
        unsafe extern "C" {
            pub safe fn any_u64() -> u64;
            pub safe fn any_below(limit: u32) -> u32;
            pub safe fn any_f64() -> f64;
            pub safe fn assume_that(condition: u32);
            pub safe fn cover_that(name: u32, condition: u32);
        }
    }

    pub trait Arbitrary {
        fn any() -> Self;
    }

    macro_rules! arbitrary {
        ($($Type:ty: $value:expr;)*) => {$(
            impl Arbitrary for $Type {
                fn any() -> Self {
                    $value
                }
            }
        )*};
    }

    arbitrary! {
        u64: import::any_u64();
        i64: i64::from_ne_bytes(import::any_u64().to_ne_bytes());
        u8: import::any_u64().to_le_bytes()[0];
        bool: import::any_u64() & 1 == 1;
        f64: import::any_f64();
    }

    pub fn any<T: Arbitrary>() -> T {
        T::any()
    }

    pub fn below(limit: u8) -> u8 {
        import::any_below(limit.into()).to_le_bytes()[0]
    }

    pub fn near(_least: f64, _most: f64) -> f64 {
        any()
    }

    pub fn near_integer(_least: i64, _most: i64) -> i64 {
        any()
    }

    pub fn assume(condition: bool) {
        import::assume_that(u32::from(condition));
    }

    pub fn cover(condition: bool, name: u32) {
        import::cover_that(name, u32::from(condition));
    }

    /// FNV-1a, so that a cover is a number on the way out.
    pub const fn number(name: &str) -> u32 {
        let mut rest = name.as_bytes();
        let mut hash = 0x811c_9dc5_u32;
        while let [byte, tail @ ..] = rest {
            hash = (hash ^ *byte as u32).wrapping_mul(0x0100_0193);
            rest = tail;
        }
        hash
    }

    macro_rules! cover_macro {
        ($condition:expr, $name:literal) => {
            kani::cover($condition, const { kani::number($name) })
        };
    }

    pub(crate) use cover_macro as cover;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

// One function without arguments for each harness.
include!("exports.rs");
