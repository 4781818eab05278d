//! What the documents of a checkout say, as parts of a page; nothing where a document is not there.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use mufasa_drives::pictures::escape;

/// The tables of the text of a Markdown file, at most so many.
pub(super) fn tables(text: &str, file: &str, up: Option<&str>, most: usize) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let blocks = lines.split(|it| !it.starts_with('|')).filter(|it| !it.is_empty());
    blocks.take(most).map(|rows| table(rows, file, up)).collect()
}

fn table(rows: &[&str], file: &str, up: Option<&str>) -> String {
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let rows = rows.iter().filter(|it| it.contains(|c| !"|-: ".contains(c)));
    let cells = rows.map(|row| {
        let row = row.replace("\\|", "\u{1}");
        let row = row.trim_start_matches('|').trim_end().trim_end_matches('|');
        let words = |cell: &str| inline(&cell.trim().replace('\u{1}', "|"), folder, up);
        row.split('|').map(words).collect()
    });
    html(cells.collect())
}

/// The lines of a Markdown file that begin with one of these, without what leads to a table below.
pub(super) fn lines(root: &Path, file: &str, starts: &[&str], up: Option<&str>) -> String {
    let text = fs::read_to_string(root.join(file)).unwrap_or_default();
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let its = text.lines().filter(|line| starts.iter().any(|it| line.starts_with(it)));
    let paragraph = |it: &str| {
        let words = inline(it.trim_end_matches(" The others:"), folder, up);
        format!("<p>{words}</p>\n")
    };
    its.map(paragraph).collect()
}

/// A table of comma-separated values, folded.
pub(super) fn matrix(root: &Path, file: &str) -> String {
    let Ok(mut reader) =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).from_path(root.join(file))
    else {
        return String::new();
    };
    let cell = |it: &str| escape(&it.replace('\n', "; "));
    let rows: Vec<Vec<_>> =
        reader.records().flatten().map(|row| row.iter().map(cell).collect()).collect();
    let count = rows.len().saturating_sub(1);
    format!("<details>\n<summary>{count} requirements</summary>\n{}</details>\n", html(rows))
}

/// A table of cells that are HTML; the first row names the columns.
fn html(rows: Vec<Vec<String>>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let row = |(index, cells): (usize, Vec<String>)| {
        let tag = if index == 0 { "th" } else { "td" };
        let cells = cells.into_iter().map(|it| format!("<{tag}>{it}</{tag}>"));
        format!("<tr>{}</tr>\n", cells.collect::<Vec<_>>().concat())
    };
    let rows: String = rows.into_iter().enumerate().map(row).collect();
    format!("<div class=\"wide\">\n<table>\n{rows}</table>\n</div>\n")
}

/// Words of Markdown: code, and links to files of the checkout.
fn inline(text: &str, folder: &str, up: Option<&str>) -> String {
    let part = |(index, part): (usize, &str)| match index % 2 {
        0 => links(part, folder, up),
        _ => format!("<code>{}</code>", escape(part)),
    };
    text.split('`').enumerate().map(part).collect()
}

fn links(mut text: &str, folder: &str, up: Option<&str>) -> String {
    let mut out = String::new();
    while let Some((before, behind)) = text.split_once("](") {
        let Some(((plain, words), (target, rest))) =
            before.rsplit_once('[').zip(behind.split_once(')'))
        else {
            break;
        };
        let target = match target.strip_prefix("../") {
            Some(from_root) => from_root.to_owned(),
            None => format!("{folder}/{target}"),
        };
        out.push_str(&escape(plain));
        out.push_str(&link(&target, words, up));
        text = rest;
    }
    out + &escape(text)
}

/// Words that lead to a file of the checkout, if there is a way `up` to its root.
pub(super) fn link(file: &str, words: &str, up: Option<&str>) -> String {
    let words = escape(words);
    up.map_or(words.clone(), |up| format!("<a href=\"{up}{}\">{words}</a>", escape(file)))
}

/// All pictures (SVG) of a folder.
pub(super) fn pictures(root: &Path, folder: &str) -> String {
    let entries = fs::read_dir(root.join(folder)).into_iter().flatten().flatten();
    let files = entries.map(|it| it.path());
    let pictures = files.filter(|it| it.extension().is_some_and(|it| it == "svg"));
    let names = pictures.filter_map(|it| it.file_name()?.to_str().map(str::to_owned));
    let mut names: Vec<_> = names.collect();
    names.sort();
    names.into_iter().map(|name| picture(root, &format!("{folder}/{name}"))).collect()
}

/// A picture (SVG), whose styles are its own and whose scripts, if there were any, do not run.
pub(super) fn picture(root: &Path, file: &str) -> String {
    let Ok(svg) = fs::read(root.join(file)) else { return String::new() };
    let mut data = String::new();
    for byte in svg {
        if byte.is_ascii_alphanumeric() || b" -./".contains(&byte) {
            data.push(byte.into());
        } else {
            // Writing to a string cannot fail.
            let _ = write!(data, "%{byte:02X}");
        }
    }
    let name = escape(file);
    format!(
        "<figure>\n<img alt=\"{name}\" src=\"data:image/svg+xml,{data}\"/>\n<figcaption>{name}</figcaption>\n</figure>\n"
    )
}
