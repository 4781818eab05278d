//! The routes of drives as JSON Lines: of each drive its name, the files that it is from, the
//! cross sections of its route (reference point, left, right) and the places of the CAV.
//! `scripts/corridors` reads them.

use std::path::PathBuf;

use mufasa_drives::{Options, Tail, read};
use serde_json::json;

fn main() {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    for drive in read(&files, &Options { tail: Tail::Keep, ..Options::default() }) {
        match drive {
            Ok(drive) => {
                let cycles = || drive.cycles.iter().map(|it| &it.cycle);
                let route =
                    cycles().next().map_or_else(Vec::new, |it| it.route.cross_sections.clone());
                let sections: Vec<_> =
                    route.iter().map(|it| [[it.x, it.y], it.left, it.right]).collect();
                let places: Vec<_> = cycles().map(|it| [it.ego.x, it.ego.y]).collect();
                let record = json!({
                    "drive": drive.name, "source": drive.source, "sections": sections, "places": places,
                });
                println!("{record}");
            }
            Err(error) => eprintln!("routes: {error}"),
        }
    }
}
