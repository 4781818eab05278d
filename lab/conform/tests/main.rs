//! The oracle and the vectors, in one program.

mod oracle;
mod vectors;
