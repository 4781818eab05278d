//! What model and implementation are to be as sources: no code or constant shared, lists equal, and what
//! the documentation says does not compile does not.

mod constants;
mod dependencies;
mod does_not_compile;
