//! The program `mufasa`; everything is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    mufasa_oracle::cli::main()
}
