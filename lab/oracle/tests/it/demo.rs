//! The demo: what it says and draws, and that the documents show it.

use std::fs;
use std::path::Path;

use mufasa_oracle::document;
use roxmltree::Document;

use crate::kit::{Said, folder, said, write};

#[test]
fn without_arguments_the_demo_shows_what_it_should() {
    let folder = folder("demo");
    let Said { code, out: text, err } = said(&folder, &[]);
    let words = "mufasa: no command, so the demo, which writes into mufasa-demo/\n";
    assert_eq!((code, err.as_str()), (Some(0), words), "{text}");
    let (hardened, paper) = text.split_once("PAPER PROFILE").unwrap();
    for (attack, stage) in [("wrong-map", "ii"), ("empty-tracks", "iv"), ("ghost-tracks", "i")] {
        let (_, told) = hardened.split_once(&format!("{attack}: from")).unwrap();
        let verdict = told.lines().find(|line| line.starts_with("  caught at ")).unwrap();
        assert!(verdict.contains(&format!(" by stage {stage}, ")), "{attack}: {verdict}");
    }
    assert!(hardened.contains("cycles safe, no fallback"));
    assert!(paper.contains("empty-tracks: NOT caught") && paper.contains("F-14"));
    assert!(text.lines().last().unwrap().contains("model and implementation agree"));
    let pictures = text.lines().filter_map(|line| line.strip_prefix("picture: "));
    let witnesses = pictures.map(|picture| {
        let text = fs::read_to_string(folder.join(picture)).unwrap();
        let document = Document::parse(&text).unwrap();
        document.descendants().filter(|node| node.attribute("id") == Some("witness")).count()
    });
    let witnesses: Vec<_> = witnesses.collect();
    assert!(witnesses.len() >= 3 && witnesses.iter().all(|count| *count == 1), "{witnesses:?}");
    let mut pictures = text.lines().filter_map(|line| line.strip_prefix("picture: "));
    let emptied = pictures.find(|picture| picture.contains("+empty-tracks-")).unwrap();
    let picture = fs::read_to_string(folder.join(emptied)).unwrap();
    the_documents_show_it(hardened, paper, &picture);
    // The command that it names next works.
    let (_, more) = text.split_once("more: mufasa ").unwrap();
    let more: Vec<_> = more.lines().next().unwrap().split(' ').collect();
    said(&folder, &more).has(1, "", "");
}

/// The table of `docs/drives.md` and the picture of the README are what the demo says and draws;
/// with `UPDATE_DOCS` set they are written.
fn the_documents_show_it(hardened: &str, paper: &str, picture: &str) {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let mut table =
        String::from("| injected | hardened profile | paper profile |\n|---|---|---|\n");
    for case in ["clean", "wrong-map", "empty-tracks", "ghost-tracks"] {
        let (_, told) = hardened.split_once(&format!("\n{case}: ")).unwrap();
        let told = told.lines().take_while(|line| !line.is_empty()).last().unwrap();
        let (_, again) = paper.split_once(&format!("\n  {case}: ")).unwrap();
        let again = again.lines().next().unwrap();
        table.extend([format!("| {case} | {} | {again} |\n", told.trim())]);
    }
    let (page, kept) = (docs.join("drives.md"), docs.join("demo.svg"));
    if std::env::var_os("UPDATE_DOCS").is_some() {
        document::write(&page, "mufasa demo", &table).unwrap();
        fs::write(&kept, picture).unwrap();
    }
    let why = "UPDATE_DOCS=1 cargo test -p mufasa-oracle --test demo";
    assert_eq!(document::read(&page, "mufasa demo").unwrap().trim(), table.trim(), "{why}");
    assert!(fs::read_to_string(kept).unwrap() == picture, "{why}");
}

#[test]
fn a_demo_that_cannot_write_says_so() {
    let folder = folder("file");
    write(&folder, "file", "");
    said(&folder, &["demo", "--out", "file"]).has(2, "", "file");
}
