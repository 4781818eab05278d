//! A table once: for a terminal, for a page and for a document.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use mufasa_drives::pictures::escape;

/// A table of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// Of every column, with whether it holds numbers.
    header: Vec<(&'static str, bool)>,
    rows: Vec<Vec<String>>,
}

/// A column: its name, whether it holds numbers, and what a row has there.
pub type Column<R> = (&'static str, bool, fn(&R) -> String);

/// A column of words.
pub const fn text<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, false, cell)
}

/// A column of numbers.
pub const fn number<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, true, cell)
}

impl Rows {
    /// A table with a line for each.
    pub fn new<R>(of: &[R], columns: &[Column<R>]) -> Self {
        let header = columns.iter().map(|(name, is_number, _)| (*name, *is_number)).collect();
        let row = |row: &R| columns.iter().map(|(.., cell)| cell(row)).collect();
        Self { header, rows: of.iter().map(row).collect() }
    }

    /// For a terminal, no wider than so many characters where that is said.
    pub fn text(&self, width: Option<u16>) -> String {
        let mut table = Table::new();
        table.load_style(presets::UTF8_FULL_CONDENSED);
        if let Some(width) = width {
            table.set_content_arrangement(ContentArrangement::Dynamic).set_width(width);
        }
        table.set_header(self.header.iter().map(|(name, _)| *name));
        for row in &self.rows {
            table.add_row(row);
        }
        for (column, (_, is_number)) in table.column_iter_mut().zip(&self.header) {
            if *is_number {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        format!("{table}\n")
    }

    /// For a page: behind each number a bar, so long as its share of the greatest in its column, of percents as its
    /// share of 100.
    pub fn html(&self) -> String {
        let mut out = String::from("<table>\n<tr>");
        for (name, _) in &self.header {
            // A string takes whatever is written.
            let _ = write!(out, "<th>{}</th>", escape(name));
        }
        out.push_str("</tr>\n");
        let most: Vec<f64> = (0..self.header.len()).map(|column| self.most(column)).collect();
        for row in &self.rows {
            out.push_str("<tr>");
            for ((cell, (_, is_number)), most) in row.iter().zip(&self.header).zip(&most) {
                let bar = value(cell).filter(|_| *is_number && *most > 0.0);
                let bar = bar.map_or_else(String::new, |value| {
                    format!(" style=\"--bar:{:.0}%\"", 100.0 * value / most)
                });
                let class = if *is_number { " class=\"number\"" } else { "" };
                let _ = write!(out, "<td{class}{bar}>{}</td>", escape(cell));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</table>\n");
        out
    }

    fn most(&self, column: usize) -> f64 {
        let cells = || self.rows.iter().map(|row| row[column].as_str());
        if cells().any(|cell| cell.ends_with('%')) {
            return 100.0;
        }
        cells().filter_map(value).fold(0.0, f64::max)
    }

    /// For a document.
    pub fn markdown(&self) -> String {
        let names: Vec<&str> = self.header.iter().map(|(name, _)| *name).collect();
        let mut out = format!("| {} |\n|", names.join(" | "));
        for (_, is_number) in &self.header {
            out.push_str(if *is_number { "--:|" } else { "---|" });
        }
        out.push('\n');
        for row in &self.rows {
            let row: Vec<_> = row.iter().map(|cell| cell.replace('\n', "; ")).collect();
            let _ = writeln!(out, "| {} |", row.join(" | "));
        }
        out
    }
}

/// The number that a cell holds.
fn value(cell: &str) -> Option<f64> {
    cell.trim_end_matches(" %").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_shares_of_the_greatest_or_of_100_percent() {
        let columns: [Column<f64>; 3] = [
            text("n", |_| String::from("7")),
            number("m", f64::to_string),
            number("s", |it| format!("{it} %")),
        ];
        let html = Rows::new(&[20.0, 5.0], &columns).html();
        for (bar, count) in [("--bar:100%", 1), ("--bar:25%", 1), ("--bar:20%", 1), ("--bar:5%", 1)]
        {
            assert_eq!(html.matches(&format!("\"{bar}\"")).count(), count, "{html}");
        }
        assert!(html.contains("<td>7</td>"), "{html}");
        assert!(!Rows::new(&[0.0], &columns[..2]).html().contains("--bar"));
    }
}
