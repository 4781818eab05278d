//! `mufasa-compiled FILE.wasm EXPORT [SECONDS]`: proves an exported harness. Prints what was found.

use std::process::ExitCode;

use mufasa_compiled::module::Module;
use mufasa_compiled::prove::{Trap, prove_export};

/// The machine calls itself for blocks in blocks.
const STACK_BYTES: usize = 1 << 30;

fn main() -> ExitCode {
    let run = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(judge);
    match run.map(std::thread::JoinHandle::join) {
        Ok(Ok(Ok(()))) => ExitCode::SUCCESS,
        Ok(Ok(Err(why))) => {
            println!("unknown: {why}");
            ExitCode::SUCCESS
        }
        Ok(Err(_)) | Err(_) => ExitCode::FAILURE,
    }
}

fn judge() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, export, seconds @ ..] = arguments.as_slice() else {
        return Err("usage: mufasa-compiled FILE.wasm EXPORT [SECONDS]".to_owned());
    };
    let seconds: u32 =
        seconds.first().map_or(Ok(120), |text| text.parse()).map_err(|_| "seconds")?;
    let bytes = std::fs::read(file).map_err(|error| format!("{file}: {error}"))?;
    let found = prove_export(&Module::read(&bytes)?, export, seconds.saturating_mul(1000))?;
    match &found.trap {
        Trap::Never => println!("proved"),
        Trap::At(place) => println!("refuted: {place}"),
        Trap::Unknown(why) => println!("unknown: {why}"),
    }
    println!("reached: {:?}", found.reached);
    println!("{} instructions, {} terms, {} questions", found.steps, found.terms, found.questions);
    Ok(())
}
