//! The figures of `spec/`, drawn from what the exact model computes: the stages, the requester, and of the rules
//! places, windows, motions, and what each object counts as. `UPDATE_FIGURES=1 cargo test -p mufasa-drives --test figures` writes them.

mod fail_safe;
mod others;
mod requester;
mod rules;
mod seen;
mod sheet;
mod stages;
mod world;

use std::fs;
use std::path::Path;

#[test]
fn the_figures_are_what_the_model_computes() {
    let figures = [
        ("figures/stages", stages::stages()),
        ("figures/requester", requester::states()),
        ("hardened/figures/H-01", rules::h01()),
        ("hardened/figures/H-04", rules::h04()),
        ("hardened/figures/H-06", rules::h06()),
        ("hardened/figures/H-07", rules::h07()),
        ("hardened/figures/H-11", rules::h11()),
        ("hardened/figures/H-14-path", fail_safe::path()),
        ("hardened/figures/H-14-windows", fail_safe::windows()),
        ("hardened/figures/H-14-reach", fail_safe::reach()),
        ("hardened/figures/H-14-motions", fail_safe::motions()),
        ("hardened/figures/H-14-others", others::others()),
        ("hardened/figures/H-14-beside", others::beside()),
        ("hardened/figures/what-the-cav-saw", seen::terms()),
    ];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../spec");
    let mut old = Vec::new();
    for (name, figure) in figures {
        let file = folder.join(format!("{name}.svg"));
        if std::env::var_os("UPDATE_FIGURES").is_some() {
            fs::write(&file, &figure).expect("the figure can be written");
        }
        if fs::read_to_string(&file).ok().as_ref() != Some(&figure) {
            old.push(name);
        }
        assert!(figure.len() < 40_000, "{name}: {} bytes", figure.len());
    }
    assert!(
        old.is_empty(),
        "old: {old:?}; UPDATE_FIGURES=1 cargo test -p mufasa-drives --test figures"
    );
}
