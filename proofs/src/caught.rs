//! A panic as a value.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::string::{String, ToString};

/// What `act` returns, or the message of its panic.
pub fn catch<T>(act: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(act)).map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(ToString::to_string);
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        text.unwrap_or_else(|| String::from("a panic"))
    })
}
