//! How wrong an assumption may be: the scenes, with one error of growing size (`mufasa_sim::experiment::scenes::wrong`).

use std::collections::BTreeSet;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use mufasa_drives::progress;
use mufasa_records::files;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::scenes::wrong::{Axis, Wrong, picture};
use mufasa_sim::experiment::scenes::{Options, Row, Scenes};
use mufasa_sim::vehicle::TAU_S;

use super::tables;
use super::work::pool;
use crate::document;
use crate::ended::{Ended, cannot};
use crate::limits::whole;
use crate::rows::{Rows, number, text};

/// Marks the place of the tables.
const TABLE: &str = "mufasa evaluate margins";

/// How many scenes, and where the tables go.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
The same scenes as of `mufasa evaluate scenes` in the hardened profile, for each axis and each of its sizes. Each error
goes the way that hides a collision. Avoidable is what a CAV avoids that brakes at once, and as it is assumed to.

Exit codes: 0 done, 2 bad input or a file cannot be written.")]
pub struct MarginsArguments {
    /// Scenes for each size.
    #[arg(long, value_name = "N", default_value = "2000", value_parser = whole(1_u64, 1_000_000), allow_negative_numbers = true)]
    pub scenes: u64,
    /// Of what is drawn.
    #[arg(long, value_name = "SEED", default_value = "0", value_parser = whole(0_u64, 1_000_000_000), allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads [default: all processors]. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = whole(1_u16, 1024), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Put the table into a document, between the lines that mark its place.
    #[arg(long, value_name = "FILE")]
    pub into: Option<PathBuf>,
    /// Draw a curve of each axis into this file.
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
}

/// A line of the table.
struct Margin {
    wrong: Wrong,
    all: Row,
    /// Scenes that collide avoidably, and do not without the error.
    added: u64,
}

/// Makes the study and writes its table to `out`; the exit code.
pub fn run(arguments: &MarginsArguments, out: &mut impl Write) -> Ended {
    let &MarginsArguments { scenes, seed, .. } = arguments;
    document::has_place(arguments.into.as_deref(), TABLE)?;
    let stamp = document::stamp(arguments.into.as_deref())?;
    if let Some(file) = &arguments.svg {
        files::prepare_file(file).map_err(cannot(file, "written"))?;
    }
    let sized = |axis: Axis| axis.sizes().map(|size| Wrong { axis, size });
    let wrongs: Vec<Wrong> = Axis::ALL.into_iter().flat_map(sized).collect();
    let bar = progress::bar(
        scenes.saturating_mul(36),
        "{prefix} {bar:30} {pos}/{len} scenes, {left} left",
    );
    bar.set_prefix("margins");
    let mut without = BTreeSet::new();
    let margin = |wrong: Wrong| {
        let (profile, only) = (Variant::Hardened, Vec::new());
        let options = Options { profile, tau_s: TAU_S, seed, only, wrong: Some(wrong) };
        let mut made = Scenes::nothing(options);
        made.add(scenes, &|| bar.inc(1));
        let failed: BTreeSet<u64> = made.failures().map(|it| it.scene).collect();
        if wrong.size == 0.0 {
            without.clone_from(&failed);
        }
        let added = u64::try_from(failed.difference(&without).count()).unwrap_or(u64::MAX);
        made.rows.into_iter().next().map(|all| Margin { wrong, all, added })
    };
    let margins: Vec<Margin> =
        pool(arguments.threads)?.install(|| wrongs.into_iter().filter_map(margin).collect());
    bar.finish_and_clear();
    let table = table(&margins);
    tables::write(&table, out)?;
    if let Some(file) = &arguments.into {
        let size = format!("`{TABLE} --scenes {scenes} --seed {seed}`:\n\n");
        let all = format!("{stamp}{size}{}", table.markdown());
        document::write(file, TABLE, &all).map_err(cannot(file, "written"))?;
    }
    if let Some(file) = &arguments.svg {
        let of = |axis: Axis| margins.iter().filter(move |it| it.wrong.axis == axis);
        let curve = |axis| (axis, of(axis).map(|it| (it.wrong.size, it.added)).collect());
        files::write(file, &picture(&Axis::ALL.map(curve))).map_err(cannot(file, "written"))?;
    }
    Ok(0)
}

fn table(margins: &[Margin]) -> Rows {
    Rows::new(
        margins,
        &[
            text("wrong", |it: &Margin| it.wrong.axis.name().to_owned()),
            number("by", |it| format!("{} {}", it.wrong.size, it.wrong.axis.unit())),
            number("avoidable", |it| it.all.avoidable.to_string()),
            number("collided all the same", |it| it.all.collided.to_string()),
            number("because of the error", |it| it.added.to_string()),
            number("never rejected", |it| it.all.never_rejected.to_string()),
            number("clean", |it| it.all.clean.to_string()),
            number("rejected", |it| it.all.alarms.to_string()),
        ],
    )
}
