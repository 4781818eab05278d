//! What the implementation must be besides right
//! (`spec/4-arithmetic.md#conformance-of-an-implementation`): the same every time, and without
//! heap, panic, unbounded recursion, `unsafe` and clock.

mod arbitrary;
mod limits;
mod repeated;
mod source;
