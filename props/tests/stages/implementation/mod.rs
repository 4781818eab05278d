//! What the implementation must be besides right
//! (`spec/4-arithmetic.md#conformance-of-an-implementation`): without heap, panic, unbounded
//! recursion, `unsafe` and clock. That it repeats itself is tested in `determinism`.

mod arbitrary;
mod limits;
mod source;
