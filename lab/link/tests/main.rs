//! All tests of the package but that of memory, in one program: each links everything.

mod codec;
mod loops;
