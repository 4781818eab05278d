//! Lists the vectors with their texts: those of `data/vectors`, as people wrote them, for `src/vectors/authored.rs`, and
//! what is published of each file in `vectors`, for `src/cases/vectors.rs`.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [written, published] = [here.join("data/vectors"), here.join("../../vectors")];
    let (mut authored, mut asked) = (String::from("&[\n"), String::from("&[\n"));
    for folder in sorted(&written)?.iter().filter(|it| it.is_dir() && !it.ends_with("records")) {
        for file in sorted(folder)? {
            let name = file.strip_prefix(&written).map_err(io::Error::other)?;
            let other = published.join(name).with_extension("jsonl");
            let name = name.with_extension("").display().to_string().replace('\\', "/");
            let text = |file: &Path| {
                let file = file.display().to_string();
                format!("({name:?}, include_str!({file:?})),\n")
            };
            authored += &text(&file);
            // A new file is published by a program that is built before.
            if other.exists() {
                asked += &text(&other);
            }
        }
    }
    for folder in [&written, &published] {
        println!("cargo::rerun-if-changed={}", folder.display());
    }
    let out = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(out.join("authored.rs"), authored + "]")?;
    fs::write(out.join("published.rs"), asked + "]")
}

fn sorted(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|it| it.map(|it| it.path())).collect::<Result<_, _>>()?;
    paths.sort();
    Ok(paths)
}
